// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace ego {

/// What a joint's name says it is. Words that different conventions use for different joints
/// ("LeftShoulder" is a clavicle for one and an upper arm for another) stay ambiguous here; the
/// tree around them decides.
enum class NameRole : std::uint8_t {
  kNone,     // the name says nothing
  kIgnored,  // twist, IK, end, face, prop, hair, ...: never a joint of the humanoid
  kHips,
  kSpine,
  kNeck,
  kHead,
  kClavicle,
  kShoulder,  // clavicle, or upper arm where no other upper arm follows
  kUpperArm,
  kArm,  // upper arm, or the forearm below an upper arm
  kForearm,
  kHand,
  kThumb,
  kIndex,
  kLittle,
  kFinger,  // middle, ring, palm, or just "finger"
  kHip,     // "LeftHip": thigh, or a helper above one
  kThigh,
  kLeg,  // shin below a thigh, else the thigh
  kShin,
  kFoot,
  kToes,
};

enum class NameSide : std::uint8_t { kNone, kLeft, kRight };

struct NameVote {
  NameRole role = NameRole::kNone;
  NameSide side = NameSide::kNone;
  bool end = false;  // an end site or leaf: marks a tip
};

/// Reads a joint's name: separators, case, numbers, name spaces ("mixamorig:") and the usual
/// prefixes are ignored; sides are "left", "L", "_l", ".R", "lShldr" and the like.
NameVote ReadJointName(std::string_view name);

}  // namespace ego
