// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/avatar_calibration.h"

namespace ego {

/// Which point of a calibration: an address that stays valid while the calibration changes.
struct PointId {
  enum class Kind : std::uint8_t {
    kSample,  // owner: SamplePoint
    kPalm,    // owner of hands and feet: 0 left, 1 right
    kBackOfHand,
    kFingertip,
    kHeel,
    kBall,
    kToeTip,
    kDot,  // owner: LimbSegment; `dot` its number in the segment
  };
  Kind kind = Kind::kSample;
  std::uint8_t owner = 0;
  std::uint16_t dot = 0;

  static constexpr PointId Of(SamplePoint point) {
    return {Kind::kSample, static_cast<std::uint8_t>(point), 0};
  }
  static constexpr PointId Of(LimbSegment segment, std::size_t dot_index) {
    return {Kind::kDot, static_cast<std::uint8_t>(segment), static_cast<std::uint16_t>(dot_index)};
  }
  bool IsDot() const { return kind == Kind::kDot; }
  friend auto operator<=>(const PointId&, const PointId&) = default;
};

/// The 44 single points (samples, hands, feet; not the dots) in the order in which a person is
/// asked for them: trunk from the front, back, head, hands, feet; left and right next to each
/// other.
std::span<const PointId> PickOrder();

/// The point in a calibration; null for a dot that it does not have.
CalibrationPoint* Find(AvatarCalibration& calibration, PointId id);
const CalibrationPoint* Find(const AvatarCalibration& calibration, PointId id);

/// Stable name, as in files and AllPoints ("navel", "leftPalm", "leftThigh[3]"), and back.
std::string Name(PointId id);
std::optional<PointId> PointNamed(std::string_view name);

/// For a person: a title ("Navel", "Left palm") and one phrase that says where on the body it is
/// ("the belly button, front of the trunk").
std::string Title(PointId id);
std::string Place(PointId id);
/// "Left upper arm".
std::string Title(LimbSegment segment);

/// The partner on the other side; points of the middle are their own. A dot's partner is the dot
/// of the same number on the other side.
PointId Mirror(PointId id);
/// The segment of the other side.
constexpr LimbSegment Mirror(LimbSegment segment) {
  return static_cast<LimbSegment>(static_cast<std::uint8_t>(segment) ^ 2u);
}

}  // namespace ego
