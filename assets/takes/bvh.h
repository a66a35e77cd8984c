// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/base/result.h"
#include "core/body/body.h"
#include "core/skeleton/joint_tree.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Reads a BVH motion: any channel order and count, positions on any joint (where a joint has
/// one, it replaces the offset), several roots. End sites become joints without motion, named
/// "<parent>_end". Rotations are sign-continuous quaternions. File units and axes.
/// Errors: no HIERARCHY or MOTION, a malformed line, numbers that are missing or not finite,
/// fewer frames than declared. More numbers than declared are left out with a warning.
Result<JointMotion> ReadBvh(const std::filesystem::path& path);

/// The same from memory. `name` stands for the file in messages; the motion is called after it,
/// without folder and extension.
Result<JointMotion> ParseBvh(std::string_view text, std::string_view name);

/// Writes the canonical skeleton with end sites (crown, fingertips, toe tips) and one line of
/// channels per pose: hips with six, all others with three (Zrotation Xrotation Yrotation), in
/// degrees. Lengths in centimetres, as Blender users expect from captured BVH (import scale 0.01);
/// Y up, facing +Z, zero rotation = canonical T-pose. Joints are named as in VRM 1.0.
Result<void> WriteBvh(const std::filesystem::path& path, const Body& body,
                      std::span<const Pose> poses, double rate_hz);

}  // namespace ego
