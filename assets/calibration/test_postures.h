// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Postures that show a bad calibration at once: each has contacts of the body with itself.
enum class TestPosture : std::uint8_t {
  kArmsCrossed,
  kHandsOnBelly,
  kHandOnHead,
  kCrossedLegs,
  kHandToAnkle,
};
inline constexpr std::size_t kTestPostureCount = 5;
/// "Arms crossed".
std::string_view Title(TestPosture posture);

struct TestPostureResult {
  Pose pose;  // of the avatar
  /// Of the surfaces that touch on the performer: the largest distance that is left between them
  /// on the avatar beyond the performer's own, metres; negative when they sink into each other
  /// instead. Zero for an amount below 1, where nothing touches yet.
  double contact_gap = 0.0;
};

/// The studio's performer at one instant each of shipped motions (assets/motions), and what the
/// egocentric method makes of them on any avatar. Making it takes about a second, applying a
/// frame's work.
class TestPostures {
 public:
  TestPostures();
  ~TestPostures();
  TestPostures(TestPostures&&) noexcept;

  /// The performer's posture, `amount` of the way (0 to 1) from a relaxed stance.
  Pose PerformerPose(TestPosture posture, double amount) const;
  const Body& Performer() const;
  /// The posture on an avatar. Deterministic, continuous in `amount`.
  TestPostureResult Apply(const Body& avatar, TestPosture posture, double amount);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
