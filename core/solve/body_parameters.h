// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// One length of the skeleton that a take may show: it shifts joints relative to their parents.
struct LengthParameter {
  struct Shift {
    HumanoidJoint joint;
    Vec3 per_metre{0.0};  // change of the joint's offset per metre of the parameter
  };
  std::array<Shift, 6> shifts{};
  std::size_t shift_count = 0;
  double template_length = 0.0;  // of the 1.78 m template, metres; 0: a displacement
  double sigma = 0.02;           // spread about the scaled template, metres
  int mirror = -1;               // the other side's parameter
  bool sizes_body = false;       // long enough to tell the body's scale
};

/// Trunk, neck, shoulder place (three axes), hip width, upper arm, forearm, thigh, shin: what
/// markers on a moving body can show. All else keeps the template's proportions.
inline constexpr std::size_t kLengthCount = 18;
const std::array<LengthParameter, kLengthCount>& LengthParameters();

/// Values of the parameters, metres beyond the scaled template.
using LengthValues = std::array<double, kLengthCount>;

/// The template of this scale (1: 1.78 m) with its lengths changed. The hips' height above ground
/// follows the legs.
Skeleton SkeletonOf(double scale, const LengthValues& values);

/// The joint at the far end of the bone that a joint carries; the joint itself where there is no
/// single one (hips, head, hands, feet).
HumanoidJoint BoneEnd(HumanoidJoint joint);

/// How far along its joint's bone a canonical offset lies, 0 to 1: a marker by the elbow moves
/// with the elbow when the upper arm turns out longer.
double AlongBone(HumanoidJoint joint, const Vec3& template_offset);

}  // namespace ego
