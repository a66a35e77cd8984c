// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_recovery.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/calibration/calibration_format.h"
#include "assets/files/file_io.h"

namespace ego {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kSuffix = ".recovery.json";
/// The avatar's absolute path: a recovery file is a calibration file with this key added.
constexpr const char* kAvatar = "recoveryOf";

std::string PathText(const fs::path& avatar) {
  std::error_code code;
  const fs::path absolute = fs::absolute(avatar, code);
  return (code ? avatar : absolute).lexically_normal().string();
}

/// The avatar's own name, for people, and a hash of its path (FNV-1a, 64 bits).
fs::path FileFor(const fs::path& folder, const fs::path& avatar) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : PathText(avatar)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  return folder / (avatar.filename().string() + "-" + HashText(hash) + std::string(kSuffix));
}

std::size_t CountPicked(const Json& json) {
  if (!json.is_structured()) return 0;
  std::size_t count = 0;
  if (json.is_object()) {
    const auto state = json.find("state");
    if (state != json.end() && state->is_string() &&
        (*state == Name(PickState::kPicked) || *state == Name(PickState::kConfirmed))) {
      ++count;
    }
  }
  for (const Json& inner : json) count += CountPicked(inner);
  return count;
}

std::optional<Recovery> Look(const fs::path& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return std::nullopt;
  Recovery recovery;
  recovery.path = path;
  recovery.written = fs::last_write_time(path, code);
  if (code) return std::nullopt;
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return std::nullopt;
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto avatar = json.find(kAvatar);
  if (avatar == json.end() || !avatar->is_string()) return std::nullopt;
  recovery.avatar = avatar->get<std::string>();
  recovery.picked = CountPicked(json);
  return recovery;
}

}  // namespace

fs::path RecoveryFolder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && fs::path(state).is_absolute()) {
    return fs::path(state) / "egostudio" / "recovery";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return fs::path(home) / ".local" / "state" / "egostudio" / "recovery";
}

Result<void> WriteRecovery(const fs::path& folder, const fs::path& avatar,
                           const Character& character, const AvatarCalibration& calibration) {
  if (folder.empty()) return Error{"there is no folder to keep unsaved picks in"};
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) {
    return Error{folder.string() + ": cannot be made to keep unsaved picks in: " + code.message()};
  }
  Json json = Json::parse(FormatCalibration(character, calibration));
  json[kAvatar] = PathText(avatar);
  return WriteFileAtomically(FileFor(folder, avatar),
                             json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::optional<Recovery> FindRecovery(const fs::path& folder, const fs::path& avatar) {
  if (folder.empty()) return std::nullopt;
  std::optional<Recovery> recovery = Look(FileFor(folder, avatar));
  if (recovery && recovery->avatar != PathText(avatar)) return std::nullopt;
  return recovery;
}

std::vector<Recovery> FindRecoveries(const fs::path& folder) {
  std::vector<Recovery> all;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    const std::string name = at->path().filename().string();
    if (name.size() < kSuffix.size() ||
        name.compare(name.size() - kSuffix.size(), kSuffix.size(), kSuffix) != 0) {
      continue;
    }
    if (auto recovery = Look(at->path())) all.push_back(*std::move(recovery));
  }
  std::sort(all.begin(), all.end(), [](const Recovery& a, const Recovery& b) {
    return std::pair(b.written, a.path) < std::pair(a.written, b.path);
  });
  return all;
}

Result<LoadedCalibration> ReadRecovery(const Recovery& recovery, const Character& character) {
  return ReadCalibration(recovery.path, character);
}

void DiscardRecovery(const fs::path& folder, const fs::path& avatar) {
  if (folder.empty()) return;
  std::error_code code;
  fs::remove(FileFor(folder, avatar), code);
}

}  // namespace ego
