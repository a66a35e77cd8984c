// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego::test {

/// A named posture of a body, built with closed-form IK of its own: hands lie flat on named
/// places of the surface, feet on the ground. `slide` in [0, 1] moves the contact along the
/// surface.
Pose Posture(const Body& body, std::string_view name, double slide = 0.0);
std::span<const std::string_view> PostureNames();

/// Two seconds at 60 fps: from standing into the posture, sliding along the contact, and back;
/// for "walk" four steps and for "free swing" arms that touch nothing.
std::vector<Pose> Motion(const Body& body, std::string_view name);
std::span<const std::string_view> MotionNames();
inline constexpr double kMotionRate = 60.0;

}  // namespace ego::test
