// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/body/body.h"
#include "core/model/calibration_point.h"
#include "render/camera.h"

namespace ego {

/// One thing that a person settles: a point on the skin, or the thickness of a limb segment.
struct PickItem {
  PointId point;                       // where there is no segment
  std::optional<LimbSegment> segment;  // its thickness, from the ring of dots around it

  static PickItem Of(PointId id) {
    if (id.IsDot()) return Of(static_cast<LimbSegment>(id.owner));
    return {id, {}};
  }
  static PickItem Of(LimbSegment segment) { return {PointId::Of(segment, 0), segment}; }
  friend bool operator==(const PickItem&, const PickItem&) = default;
};

/// Everything that a person is asked for, in that order: the points of PickOrder, then the limbs.
std::span<const PickItem> PickItems();

/// For a person: what it is, and where on the body it lies.
std::string Title(const PickItem& item);
std::string Place(const PickItem& item);
/// The part of the body that lists group it under ("Trunk", "Head", "Hands", "Feet", "Limbs").
std::string_view GroupOf(const PickItem& item);
PickItem Mirror(const PickItem& item);
/// Whether it lies on the head.
bool IsHead(const PickItem& item);
/// Whether its mirror image is asked for before it.
bool IsRight(const PickItem& item);

PickState StateOf(const AvatarCalibration& calibration, const PickItem& item);
double ConfidenceOf(const AvatarCalibration& calibration, const PickItem& item);
/// Why it is doubtful or missing; empty for nothing to say.
const std::string& ReasonOf(const AvatarCalibration& calibration, const PickItem& item);

/// The next in order, going around, that nobody picked or confirmed; nothing when all are.
std::optional<PickItem> NextUnsettled(const AvatarCalibration& calibration,
                                      std::optional<PickItem> after);
/// The next that is missing or doubtful, forward or backward.
std::optional<PickItem> NextDoubtful(const AvatarCalibration& calibration,
                                     std::optional<PickItem> after, bool forward = true);
/// How many a person picked or confirmed.
std::size_t SettledItems(const AvatarCalibration& calibration);

/// Looks at the part of a posed body on which an item lies, from where it is seen best.
Camera CameraFor(const PickItem& item, const Body& body, const ModelPose& pose, ViewportSize size);

/// Where an item is on a body whose surface is known, world space.
Vec3 PositionOn(const PickItem& item, const Body& body, const ModelPose& pose);

}  // namespace ego
