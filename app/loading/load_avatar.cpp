// SPDX-License-Identifier: MIT
#include "app/loading/load_avatar.h"

#include <utility>

#include "app/loading/file_kind.h"
#include "assets/calibration/calibration_document.h"
#include "assets/gltf/character_file.h"
#include "assets/people/person.h"
#include "core/model/avatar_body.h"

namespace ego {
namespace {

// The part [from, to] of a longer piece of work.
Progress Part(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [&whole, from, to](double fraction, std::string_view what) {
    return whole(from + (to - from) * fraction, what);
  };
}

}  // namespace

Result<LoadedAvatar> LoadAvatar(const std::filesystem::path& path, const Progress& progress) {
  const Result<FileKind> kind = KindOf(path);
  if (!kind) return Error{kind.error()};
  if (*kind != FileKind::kAvatar) {
    return Error{path.string() + ": a take, where an avatar (.glb, .gltf or .vrm) is expected"};
  }
  Result<Character> character = ReadCharacter(path, Part(progress, 0.0, 0.4));
  if (!character) return Error{character.error()};
  const Result<CalibrationDocument> loaded =
      LoadCalibrated(*std::move(character), Part(progress, 0.4, 1.0));
  if (!loaded) return Error{loaded.error()};

  LoadedAvatar avatar;
  avatar.name = path.stem().string();
  avatar.path = path;
  avatar.character = loaded->character;
  avatar.body =
      std::make_shared<const Body>(MakeAvatarBody(*avatar.character, loaded->calibration));
  avatar.calibration = Summarize(loaded->calibration);
  avatar.calibrated_by_file = loaded->from_file;
  avatar.notes = avatar.character->notes;
  avatar.notes.insert(avatar.notes.end(), loaded->warnings.begin(), loaded->warnings.end());
  return avatar;
}

std::size_t DemoAvatarCount() { return DemoCast().size() - 1; }

LoadedAvatar LoadDemoAvatar(std::size_t index) {
  const PersonParameters parameters = DemoCast().at(index + 1);
  Person person = MakePerson(parameters);
  LoadedAvatar avatar;
  avatar.name = parameters.name;
  avatar.body = std::make_shared<const Body>(std::move(person.body));
  avatar.character = std::make_shared<const Character>(std::move(person.character));
  return avatar;
}

}  // namespace ego
