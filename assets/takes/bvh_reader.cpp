// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/files/file_io.h"
#include "assets/files/shown_text.h"
#include "assets/takes/bvh.h"
#include "assets/takes/text.h"

namespace ego {
namespace {

constexpr std::size_t kMostJoints = 10000;
constexpr std::size_t kDeepest = 500;
constexpr std::size_t kMostChannels = 12;  // of one joint
constexpr double kLargest = 1e9;           // of any length or angle: beyond it is no motion

enum class Channel : std::uint8_t {
  kXposition,
  kYposition,
  kZposition,
  kXrotation,
  kYrotation,
  kZrotation,
  kIgnored,
};
constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Words of the text, with the line they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  /// The next word; braces are words of their own. Empty at the end of the text.
  std::string_view Next() {
    SkipSpace();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !IsSpace(text_[at_])) {
      const bool brace = text_[at_] == '{' || text_[at_] == '}';
      if (brace && at_ > begin) break;
      ++at_;
      if (brace) break;
    }
    return text_.substr(begin, at_ - begin);
  }
  std::string_view Peek() {
    const Words saved = *this;
    const std::string_view word = Next();
    *this = saved;
    return word;
  }
  /// What is left of the line, up to an opening brace: a name may hold blanks.
  std::string_view Name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r' && text_[at_] != '{') {
      ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }
  std::size_t line() const { return line_; }
  std::size_t left() const { return text_.size() - at_; }

 private:
  void SkipSpace() {
    for (; at_ < text_.size() && IsSpace(text_[at_]); ++at_) {
      if (text_[at_] == '\n') ++line_;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// The text as it is read; every step returns the sentence of the first mistake.
class Parser {
 public:
  explicit Parser(std::string_view text) : words_(text), text_size_(text.size()) {}

  Result<JointMotion> Run() {
    if (Result<void> r = Hierarchy(); !r) return Error{r.error()};
    if (Result<void> r = Motion(); !r) return Error{r.error()};
    return std::move(motion_);
  }

 private:
  Error At(const std::string& what) const {
    return Error{"line " + std::to_string(words_.line()) + ": " + what};
  }
  Error Expected(std::string_view expected, std::string_view found) const {
    return At(std::string(expected) + " is expected, " +
              (found.empty() ? "the file ends" : Quoted(found) + " stands there"));
  }

  Result<double> Number(std::string_view what) {
    const std::string_view word = words_.Next();
    const std::optional<double> number = ReadNumber(word);
    if (!number) return Expected(what, word);
    if (!(std::abs(*number) <= kLargest * kLargest)) {
      return At(std::string(what) + " is not a finite number");
    }
    return *number;
  }

  Result<Vec3> Offset() {
    Vec3 offset{0.0};
    for (int axis = 0; axis < 3; ++axis) {
      const Result<double> number = Number("a number of an OFFSET");
      if (!number) return Error{number.error()};
      if (std::abs(*number) > kLargest) return At("an OFFSET is too large for a body");
      offset[axis] = *number;
    }
    return offset;
  }

  Result<int> AddJoint(std::string name, int parent) {
    if (motion_.tree.joints.size() >= kMostJoints) {
      return At("more than " + std::to_string(kMostJoints) + " joints");
    }
    const int index = static_cast<int>(motion_.tree.joints.size());
    if (name.empty()) name = "joint" + std::to_string(index);
    motion_.tree.joints.push_back({std::move(name), parent, Mat4{1.0}});
    offset_.push_back(Vec3{0.0});
    channels_.emplace_back();
    return index;
  }

  Result<void> Channels(std::size_t joint) {
    const Result<double> count = Number("the number of CHANNELS");
    if (!count) return Error{count.error()};
    if (*count < 0.0 || *count > static_cast<double>(kMostChannels) ||
        *count != std::floor(*count)) {
      return At("a joint has 0 to " + std::to_string(kMostChannels) + " channels");
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(*count); ++i) {
      const std::string_view word = words_.Next();
      Channel channel = Channel::kIgnored;
      for (std::size_t k = 0; k < kChannelNames.size(); ++k) {
        if (SameWord(word, kChannelNames[k])) channel = static_cast<Channel>(k);
      }
      if (channel == Channel::kIgnored) {
        if (word.size() != 6 || !SameWord(word.substr(1), "scale")) {
          return Expected("a channel such as Xrotation", word);
        }
        scaled_ = true;
      }
      channels_[joint].push_back(channel);
      ++channel_count_;
    }
    return {};
  }

  Result<void> Hierarchy() {
    if (const std::string_view word = words_.Next(); !SameWord(word, "HIERARCHY")) {
      return Error{"is not a BVH file: it does not begin with HIERARCHY"};
    }
    std::vector<int> open;      // joints whose brace is open
    std::vector<bool> is_site;  // same shape
    while (true) {
      const std::string_view word = words_.Next();
      const bool root = SameWord(word, "ROOT");
      if (root || SameWord(word, "JOINT") || SameWord(word, "End")) {
        const bool site = !root && SameWord(word, "End");
        if (root != open.empty() || (!open.empty() && is_site.back())) {
          return At(Quoted(word) + " stands at the wrong level");
        }
        if (open.size() >= kDeepest) {
          return At("joints are nested deeper than " + std::to_string(kDeepest));
        }
        const int parent = open.empty() ? -1 : open.back();
        std::string name = CleanText(words_.Name());
        if (site) name = motion_.tree.joints[static_cast<std::size_t>(parent)].name + "_end";
        const Result<int> joint = AddJoint(std::move(name), parent);
        if (!joint) return Error{joint.error()};
        if (const std::string_view brace = words_.Next(); brace != "{") {
          return Expected("\"{\"", brace);
        }
        open.push_back(*joint);
        is_site.push_back(site);
      } else if (SameWord(word, "OFFSET") && !open.empty()) {
        const Result<Vec3> offset = Offset();
        if (!offset) return Error{offset.error()};
        const auto joint = static_cast<std::size_t>(open.back());
        offset_[joint] = *offset;
        motion_.tree.joints[joint].rest_local[3] = Vec4(*offset, 1.0);
      } else if (SameWord(word, "CHANNELS") && !open.empty() && !is_site.back()) {
        if (Result<void> r = Channels(static_cast<std::size_t>(open.back())); !r) return r;
      } else if (word == "}" && !open.empty()) {
        open.pop_back();
        is_site.pop_back();
      } else if (SameWord(word, "MOTION") && open.empty()) {
        break;
      } else {
        return Expected(open.empty() ? "ROOT or MOTION" : "a joint, OFFSET, CHANNELS or \"}\"",
                        word);
      }
    }
    if (motion_.tree.joints.empty()) return Error{"has no joints"};
    if (scaled_) motion_.warnings.push_back("scale channels are left out");
    return {};
  }

  Result<void> Motion() {
    if (const std::string_view word = words_.Next(); !SameWord(word, "Frames:")) {
      return Expected("\"Frames:\"", word);
    }
    const Result<double> frames = Number("the number of frames");
    if (!frames) return Error{frames.error()};
    if (*frames < 1.0 || *frames != std::floor(*frames)) {
      return At("the number of frames must be a whole number above zero");
    }
    if (const std::string_view word = words_.Next(); !SameWord(word, "Frame")) {
      return Expected("\"Frame Time:\"", word);
    }
    if (const std::string_view word = words_.Next(); !SameWord(word, "Time:")) {
      return Expected("\"Frame Time:\"", word);
    }
    const Result<double> frame_time = Number("the frame time");
    if (!frame_time) return Error{frame_time.error()};
    motion_.rate_hz = Rate(*frame_time);

    // Each number takes at least two characters; joints without channels take none, so they are
    // bounded by the file's size as well. Only then is memory asked for.
    const auto channels = static_cast<double>(channel_count_);
    const auto joints = static_cast<double>(motion_.tree.joints.size());
    if (*frames * std::max(1.0, 2.0 * channels) > static_cast<double>(words_.left()) + 1.0) {
      return Error{"is cut off: it is too short for the " + FrameText(*frames) +
                   " frames that it declares"};
    }
    if (*frames * joints > static_cast<double>(text_size_) + 65536.0) {
      return Error{"declares " + FrameText(*frames) + " frames of " +
                   std::to_string(motion_.tree.joints.size()) +
                   " joints, most of them without channels"};
    }
    return Frames(static_cast<std::size_t>(*frames));
  }

  static std::string FrameText(double frames) {
    return frames < 1e15 ? std::to_string(static_cast<long long>(frames)) : "countless";
  }

  /// Frame times are printed with few digits: 0.00833333 means 120 Hz, 0.0333667 means 29.97 Hz.
  double Rate(double frame_time) {
    constexpr double kAssumed = 30.0;
    constexpr double kPrinted = 2e-5;  // relative error of a time with five digits
    if (!(frame_time > 1e-5 && frame_time < 1e3)) {
      motion_.warnings.push_back("no usable frame time is given; 30 frames a second are assumed");
      return kAssumed;
    }
    const double rate = 1.0 / frame_time;
    const double whole = std::round(rate);
    if (whole >= 1.0 && std::abs(rate - whole) <= kPrinted * rate) return whole;
    const double broadcast = std::round(rate * 1.001) / 1.001;
    if (broadcast >= 1.0 && std::abs(rate - broadcast) <= kPrinted * rate) return broadcast;
    return rate;
  }

  Result<void> Frames(std::size_t frame_count) {
    const std::size_t n = motion_.tree.joints.size();
    motion_.frame_count = frame_count;
    motion_.rotation_ls.resize(frame_count * n, kIdentity);
    motion_.translation_ls.resize(frame_count * n);
    for (std::size_t f = 0; f < frame_count; ++f) {
      for (std::size_t j = 0; j < n; ++j) {
        if (Result<void> r = JointFrame(f, j); !r) return r;
      }
    }
    if (!words_.Peek().empty()) {
      motion_.warnings.push_back("more numbers than the " + std::to_string(frame_count) +
                                 " declared frames need; the rest is left out");
    }
    return {};
  }

  Result<void> JointFrame(std::size_t frame, std::size_t joint) {
    const std::size_t n = motion_.tree.joints.size();
    Vec3 translation = offset_[joint];
    Quat rotation = kIdentity;
    for (const Channel channel : channels_[joint]) {
      const std::string_view word = words_.Next();
      const std::optional<double> value = ReadNumber(word);
      if (word.empty()) {
        return Error{"is cut off: it ends in frame " + std::to_string(frame + 1) + " of " +
                     std::to_string(motion_.frame_count)};
      }
      if (!value || !(std::abs(*value) <= kLargest)) {
        return Error{"frame " + std::to_string(frame + 1) + ", joint " +
                     Quoted(motion_.tree.joints[joint].name) + ": " + Quoted(word) +
                     " stands where a number is expected"};
      }
      if (channel == Channel::kIgnored) continue;
      const int axis = static_cast<int>(channel) % 3;
      if (channel <= Channel::kZposition) {
        translation[axis] = *value;
      } else {
        Vec3 direction{0.0};
        direction[axis] = 1.0;
        // Degrees are taken modulo whole turns first: huge angles keep their digits.
        rotation = rotation * glm::angleAxis(Radians(std::fmod(*value, 720.0)), direction);
      }
    }
    rotation = glm::normalize(rotation);
    const std::size_t at = frame * n + joint;
    if (frame > 0 && glm::dot(rotation, motion_.rotation_ls[at - n]) < 0.0) rotation = -rotation;
    motion_.rotation_ls[at] = rotation;
    motion_.translation_ls[at] = translation;
    return {};
  }

  Words words_;
  std::size_t text_size_;
  JointMotion motion_;
  std::vector<Vec3> offset_;
  std::vector<std::vector<Channel>> channels_;
  std::size_t channel_count_ = 0;
  bool scaled_ = false;
};

}  // namespace

Result<JointMotion> ParseBvh(std::string_view text, std::string_view name) {
  Result<JointMotion> motion = Parser(text).Run();
  if (!motion) return Error{std::string(name) + ": " + motion.error()};
  motion->name = TakeName(name);
  return motion;
}

Result<JointMotion> ReadBvh(const std::filesystem::path& path) {
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  return ParseBvh(*text, path.string());
}

}  // namespace ego
