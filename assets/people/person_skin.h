// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "assets/people/person_hand.h"
#include "assets/people/person_shape.h"
#include "core/body/body_surface.h"

namespace ego {

/// How much each joint carries a point of the surface, canonical pose, model space. Sums to one.
using JointWeights = std::array<double, kJointCount>;

/// Smooth weights along the skeleton: each joint takes over from its parent across a band as wide
/// as the body is thick there; arms and legs begin where their own surface is nearer than the
/// trunk's, so that nothing bleeds from an arm to the trunk or from one leg to the other.
JointWeights SkinWeights(const PersonShape& shape, const Vec3& p_ms);

/// The joints of the body and, after them, those of the fingers of the left and the right hand
/// (person_hand.h): a generated character's palette.
inline constexpr std::size_t kSkinJointCount = kJointCount + 2 * hand::kFingerJointCount;
using SkinJointWeights = std::array<double, kSkinJointCount>;

/// The same, with what the hand carries shared with its fingers.
SkinJointWeights SkinWeightsWithFingers(const PersonShape& shape, const Vec3& p_ms);

/// A piece rigid on one joint of the palette.
SkinJointWeights Rigid(std::size_t skin_joint);
/// Fingers counted as their hand.
JointWeights WithoutFingers(const SkinJointWeights& weights);

/// The four strongest, normalised.
Attachment StrongestFour(const JointWeights& weights);

}  // namespace ego
