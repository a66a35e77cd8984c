// SPDX-License-Identifier: MIT
#include "app/calibrate/pick_item.h"

#include <algorithm>
#include <array>
#include <vector>

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;
using Kind = PointId::Kind;

// From where a point of the left side, or of the middle, is seen best: degrees.
struct Side {
  double yaw = 0.0;
  double pitch = 0.0;
};

Side SideOf(SamplePoint point) {
  switch (point) {
    case S::kNapeBase:
      return {180.0, 25.0};
    case S::kMidBack:
    case S::kLowerBack:
    case S::kSacrum:
    case S::kLeftShoulderBlade:
    case S::kRightShoulderBlade:
      return {180.0, 5.0};
    case S::kLeftShoulderTop:
    case S::kRightShoulderTop:
      return {0.0, 40.0};
    case S::kLeftRibs:
    case S::kRightRibs:
    case S::kLeftWaistSide:
    case S::kRightWaistSide:
    case S::kLeftHipSide:
    case S::kRightHipSide:
      return {55.0, 0.0};
    case S::kCrown:
      return {0.0, 55.0};
    case S::kBackOfHead:
      return {180.0, 8.0};
    case S::kThroat:
      return {0.0, -32.0};
    case S::kLeftEar:
    case S::kRightEar:
      return {72.0, 5.0};
    default:
      return {0.0, 4.0};
  }
}

Side SideOf(const PickItem& item) {
  if (item.segment) return IsArm(LimbOf(*item.segment)) ? Side{10.0, 15.0} : Side{25.0, 5.0};
  switch (item.point.kind) {
    case Kind::kSample:
      return SideOf(static_cast<SamplePoint>(item.point.owner));
    case Kind::kPalm:
    case Kind::kFingertip:
      return {8.0, -58.0};
    case Kind::kBackOfHand:
      return {8.0, 58.0};
    case Kind::kHeel:
      return {125.0, -24.0};
    case Kind::kBall:
      return {50.0, -38.0};
    case Kind::kToeTip:
    case Kind::kDot:
      break;
  }
  return {30.0, 22.0};
}

Limb LimbOfExtremity(const PickItem& item) {
  const bool hand = item.point.kind == Kind::kPalm || item.point.kind == Kind::kBackOfHand ||
                    item.point.kind == Kind::kFingertip;
  if (hand) return item.point.owner == 0 ? Limb::kLeftArm : Limb::kRightArm;
  return item.point.owner == 0 ? Limb::kLeftLeg : Limb::kRightLeg;
}

// What is to be in the picture around an item.
std::vector<Vec3> Around(const PickItem& item, const Body& body, const ModelPose& pose) {
  std::vector<Vec3> points;
  if (item.segment) {
    const LimbJoints joints = JointsOf(LimbOf(*item.segment));
    for (const J joint : {joints.base, joints.mid, joints.end}) {
      points.push_back(pose.Position(joint));
    }
    return points;
  }
  if (item.point.kind == Kind::kSample) {
    std::array<Vec3, kSampleCount> samples;
    PoseSamples(body.skeleton, body.surface, pose, samples);
    const bool head = IsHead(static_cast<SamplePoint>(item.point.owner));
    const std::size_t from = head ? kTrunkSampleCount : 0;
    const std::size_t end = head ? kSampleCount : kTrunkSampleCount;
    points.assign(samples.begin() + static_cast<std::ptrdiff_t>(from),
                  samples.begin() + static_cast<std::ptrdiff_t>(end));
    return points;
  }
  points.push_back(pose.Position(JointsOf(LimbOfExtremity(item)).end));
  const std::uint8_t owner = item.point.owner;
  const bool arm = IsArm(LimbOfExtremity(item));
  for (const Kind kind : {Kind::kPalm, Kind::kBackOfHand, Kind::kFingertip, Kind::kHeel,
                          Kind::kBall, Kind::kToeTip}) {
    if ((kind < Kind::kHeel) == arm) {
      points.push_back(PositionOn(PickItem::Of({kind, owner, 0}), body, pose));
    }
  }
  return points;
}

std::ptrdiff_t OrderOf(const std::optional<PickItem>& item) {
  const auto items = PickItems();
  if (!item) return -1;
  return std::find(items.begin(), items.end(), *item) - items.begin();
}

// The next in order, going around, whose state `wanted` accepts.
template <class Wanted>
std::optional<PickItem> Next(const AvatarCalibration& calibration, std::optional<PickItem> after,
                             bool forward, Wanted wanted) {
  const auto items = PickItems();
  const auto count = static_cast<std::ptrdiff_t>(items.size());
  const std::ptrdiff_t start = after || forward ? OrderOf(after) : 0;
  for (std::ptrdiff_t k = 1; k <= count; ++k) {
    const std::ptrdiff_t at = ((start + (forward ? k : -k)) % count + count) % count;
    const PickItem& item = items[static_cast<std::size_t>(at)];
    if (wanted(StateOf(calibration, item))) return item;
  }
  return std::nullopt;
}

}  // namespace

std::span<const PickItem> PickItems() {
  static const std::vector<PickItem> items = [] {
    std::vector<PickItem> all;
    for (const PointId id : PickOrder()) all.push_back(PickItem::Of(id));
    using L = LimbSegment;
    for (const L segment : {L::kLeftUpperArm, L::kRightUpperArm, L::kLeftForearm, L::kRightForearm,
                            L::kLeftThigh, L::kRightThigh, L::kLeftCalf, L::kRightCalf}) {
      all.push_back(PickItem::Of(segment));
    }
    return all;
  }();
  return items;
}

std::string Title(const PickItem& item) {
  return item.segment ? Title(*item.segment) : Title(item.point);
}

std::string Place(const PickItem& item) {
  if (item.segment) {
    return "Anywhere around its middle; a click lays a ring of points around the limb";
  }
  std::string place = Place(item.point);
  if (!place.empty() && place[0] >= 'a' && place[0] <= 'z') {
    place[0] = static_cast<char>(place[0] - 'a' + 'A');
  }
  return place;
}

std::string_view GroupOf(const PickItem& item) {
  if (item.segment) return "Limbs";
  if (item.point.kind == Kind::kSample) {
    return IsHead(item) ? "Head" : "Trunk";
  }
  return item.point.kind < Kind::kHeel ? "Hands" : "Feet";
}

PickItem Mirror(const PickItem& item) {
  return item.segment ? PickItem::Of(Mirror(*item.segment)) : PickItem::Of(Mirror(item.point));
}

bool IsHead(const PickItem& item) {
  return !item.segment && item.point.kind == Kind::kSample &&
         IsHead(static_cast<SamplePoint>(item.point.owner));
}

bool IsRight(const PickItem& item) { return OrderOf(Mirror(item)) < OrderOf(item); }

PickState StateOf(const AvatarCalibration& calibration, const PickItem& item) {
  if (item.segment) return calibration.At(*item.segment).state;
  const CalibrationPoint* point = Find(calibration, item.point);
  return point ? point->state : PickState::kMissing;
}

double ConfidenceOf(const AvatarCalibration& calibration, const PickItem& item) {
  if (item.segment) return calibration.At(*item.segment).confidence;
  const CalibrationPoint* point = Find(calibration, item.point);
  return point ? point->confidence : 0.0;
}

const std::string& ReasonOf(const AvatarCalibration& calibration, const PickItem& item) {
  static const std::string none;
  if (item.segment) return calibration.At(*item.segment).reason;
  const CalibrationPoint* point = Find(calibration, item.point);
  return point ? point->reason : none;
}

std::optional<PickItem> NextUnsettled(const AvatarCalibration& calibration,
                                      std::optional<PickItem> after) {
  return Next(calibration, after, true, [](PickState state) { return !Settled(state); });
}

std::optional<PickItem> NextDoubtful(const AvatarCalibration& calibration,
                                     std::optional<PickItem> after, bool forward) {
  return Next(calibration, after, forward, [](PickState state) {
    return state == PickState::kMissing || state == PickState::kDoubtful;
  });
}

std::size_t SettledItems(const AvatarCalibration& calibration) {
  const auto items = PickItems();
  return static_cast<std::size_t>(std::count_if(items.begin(), items.end(), [&](const auto& item) {
    return Settled(StateOf(calibration, item));
  }));
}

Vec3 PositionOn(const PickItem& item, const Body& body, const ModelPose& pose) {
  if (item.segment) {
    return 0.5 *
           (pose.Position(StartJoint(*item.segment)) + pose.Position(EndJoint(*item.segment)));
  }
  if (item.point.kind == Kind::kSample) {
    std::array<Vec3, kSampleCount> samples;
    PoseSamples(body.skeleton, body.surface, pose, samples);
    return samples[item.point.owner];
  }
  const auto canonical = CanonicalPositions(body.skeleton);
  const std::size_t side = item.point.owner;
  const J hand = side == 0 ? J::kLeftHand : J::kRightHand;
  const J foot = side == 0 ? J::kLeftFoot : J::kRightFoot;
  const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
  const HandSurface& h = body.surface.hand[side];
  const FootSurface& f = body.surface.foot[side];
  switch (item.point.kind) {
    case Kind::kPalm:
      return PosePoint(canonical, pose, hand, h.palm_ms);
    case Kind::kBackOfHand:
      return PosePoint(canonical, pose, hand,
                       h.palm_ms - 2.0 * h.half_thickness * h.palm_normal_ms);
    case Kind::kFingertip:
      return PosePoint(canonical, pose, hand, h.fingertip_ms);
    case Kind::kHeel:
      return PosePoint(canonical, pose, foot, f.heel_ms);
    case Kind::kBall:
      return PosePoint(canonical, pose, foot, f.ball_ms);
    default:
      return PosePoint(canonical, pose, toes, f.toe_tip_ms);
  }
}

Camera CameraFor(const PickItem& item, const Body& body, const ModelPose& pose, ViewportSize size) {
  Camera camera;
  const Side side = SideOf(item);
  const double sign = IsRight(item) ? -1.0 : 1.0;
  camera.yaw = sign * Radians(side.yaw);
  camera.pitch = Radians(side.pitch);
  Box3 box;
  for (const Vec3& p : Around(item, body, pose)) box.Add(p);
  if (box.IsEmpty()) return camera;
  const double margin = 0.03 * body.height;
  box.Add(box.min - margin);
  box.Add(box.max + margin);
  camera.Frame(box, size, 0.1);
  return camera;
}

}  // namespace ego
