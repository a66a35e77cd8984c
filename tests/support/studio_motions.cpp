// SPDX-License-Identifier: MIT
#include "tests/support/studio_motions.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "assets/files/file_io.h"
#include "assets/motions/motions.h"
#include "assets/people/person.h"

namespace ego::test {
namespace {

[[noreturn]] void Give(std::string_view sentence) {
  std::fprintf(stderr, "%.*s\n", static_cast<int>(sentence.size()), sentence.data());
  std::abort();
}

/// Values one after the other as they lie in memory: the program that reads them is built with the
/// one that writes them.
class Writer {
 public:
  template <typename T>
  void Put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
  }
  template <typename Range>
  void PutAll(const Range& range) {
    Put(range.size());
    for (const auto& value : range) Put(value);
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <typename T>
  void Get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() < sizeof(T)) Give("The recording of the studio's motions is cut off.");
    std::memcpy(static_cast<void*>(&value), bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
  }
  template <typename Range>
  void GetAll(Range& range) {
    std::size_t size = 0;
    Get(size);
    if (size > bytes_.size()) Give("The recording of the studio's motions is cut off.");
    range.resize(size);
    for (auto& value : range) Get(value);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

struct Recording {
  std::vector<Body> cast;
  std::vector<StudioMotion> motions;
};

const Recording& Recorded() {
  static const Recording recording = [] {
    const Result<std::vector<std::uint8_t>> bytes = ReadFile(EGO_STUDIO_RECORDING);
    if (!bytes) Give(bytes.error());
    Reader in(*bytes);
    Recording made;
    std::size_t count = 0;
    in.Get(count);
    for (std::size_t i = 0; i < count; ++i) {
      Body& body = made.cast.emplace_back();
      in.GetAll(body.name);
      in.Get(body.skeleton);
      in.Get(body.surface);
      in.Get(body.height);
      in.Get(body.standing_root_height);
    }
    in.Get(count);
    for (std::size_t i = 0; i < count; ++i) {
      StudioMotion& motion = made.motions.emplace_back();
      in.GetAll(motion.name);
      in.GetAll(motion.poses);
      in.GetAll(motion.touches);
    }
    return made;
  }();
  return recording;
}

template <typename T>
const T& Named(const std::vector<T>& all, std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const T& t) { return t.name == name; });
  if (found == all.end()) Give("The studio has no \"" + std::string(name) + "\".");
  return *found;
}

/// The frame that shows a motion best.
std::size_t TellingFrame(const StudioMotion& motion) {
  double longest = -1.0;
  double time = 0.5 * static_cast<double>(motion.poses.size()) / kStudioRate;
  for (const StudioTouch& touch : motion.touches) {
    if (touch.plate || touch.to_s - touch.from_s <= longest) continue;
    longest = touch.to_s - touch.from_s;
    time = 0.5 * (touch.from_s + touch.to_s);
  }
  return std::min(static_cast<std::size_t>(time * kStudioRate), motion.poses.size() - 1);
}

}  // namespace

const Body& StudioBody(std::string_view name) { return Named(Recorded().cast, name); }
const Body& StudioPerformer() { return Recorded().cast.front(); }

const std::vector<Body>& StudyBodies() {
  static const std::vector<Body> bodies = {StudioBody("Woman"), StudioBody("Child"),
                                           StudioBody("Alien"), StudioBody("Big belly"),
                                           StudioBody("Long arms")};
  return bodies;
}

const std::vector<StudioMotion>& StudioMotions() { return Recorded().motions; }
const StudioMotion& Motion(std::string_view name) { return Named(StudioMotions(), name); }

const std::vector<StudioPosture>& StudioPostures() {
  static const std::vector<StudioPosture> postures = [] {
    std::vector<StudioPosture> made;
    for (const StudioMotion& motion : StudioMotions()) {
      made.push_back({motion.name, motion.poses[TellingFrame(motion)]});
    }
    made.push_back({"standing", StudioMotions().front().poses.front()});
    return made;
  }();
  return postures;
}

const Pose& Posture(std::string_view name) { return Named(StudioPostures(), name).pose; }

Pose PoseOn(const Body& body, const Pose& performer_pose) {
  Pose pose = performer_pose;
  pose.root_ws *= body.standing_root_height / StudioPerformer().standing_root_height;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (body.skeleton.locked[j]) pose.rotation_ls[j] = kIdentity;
  }
  return pose;
}

Result<void> RecordStudio(const std::filesystem::path& path) {
  Writer out;
  const std::vector<PersonParameters> cast = DemoCast();
  out.Put(cast.size());
  for (const PersonParameters& parameters : cast) {
    const bool performs = &parameters == &cast.front();
    const Body body = performs ? ScriptedPerformer().body : MakePerson(parameters).body;
    out.PutAll(parameters.name);
    out.Put(body.skeleton);
    out.Put(body.surface);
    out.Put(body.height);
    out.Put(body.standing_root_height);
  }
  out.Put(ShippedMotions().size());
  for (const MotionScript& script : ShippedMotions()) {
    const ScriptedTake take = Perform(ScriptedFigure(), script);
    out.PutAll(script.name);
    out.PutAll(take.motion.poses);
    std::vector<StudioTouch> touches;
    for (const TrueContact& c : take.contacts) {
      touches.push_back({c.from_s, c.to_s, c.side, c.foot, c.face, c.on, c.plate_ws.has_value()});
    }
    out.PutAll(touches);
  }
  return WriteFileAtomically(path, out.bytes());
}

}  // namespace ego::test
