// SPDX-License-Identifier: MIT
#include "core/metrics/arm_reach.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ego {
namespace {

constexpr std::size_t kDirectionCount = 64;
constexpr std::size_t kSwivelCount = 12;
const double kMostBent = std::cos(Radians(180.0 - 155.0));  // of the angle inside the elbow
/// Heights by which the steps of the search may miss the way between two obstacles.
constexpr double kTolerance = 0.01;

/// Unit vectors evenly over the sphere (golden spiral).
const std::array<Vec3, kDirectionCount>& Directions() {
  static const std::array<Vec3, kDirectionCount> all = [] {
    std::array<Vec3, kDirectionCount> made;
    for (std::size_t k = 0; k < made.size(); ++k) {
      const double y = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / kDirectionCount;
      const double angle = static_cast<double>(k) * kPi * (3.0 - std::sqrt(5.0));
      const double r = std::sqrt(1.0 - y * y);
      made[k] = {r * std::cos(angle), y, r * std::sin(angle)};
    }
    return made;
  }();
  return all;
}

double Depth(const MeasuredBody& body, const Vec3& p) {
  return -std::min(TrunkDistance(body, p), HeadDistance(body, p));
}

/// A chain of up to three bones from a shoulder, of which the last may be a part.
struct Chain {
  Vec3 shoulder{0.0};
  double upper = 0.0;
  double lower = 0.0;
  double hand = 0.0;
  double Reach() const { return upper + lower + hand; }
};

class Search {
 public:
  Search(const MeasuredBody& body, double depth)
      : body_(body), depth_(depth + kTolerance * body.body->height) {}

  /// Whether the chain's end can be brought to a point.
  bool Reaches(const Chain& chain, const Vec3& point) const {
    if (glm::distance(chain.shoulder, point) > chain.Reach()) return false;
    if (chain.lower == 0.0) return IsUpperClear(chain.shoulder, point);
    if (chain.hand == 0.0) return ReachesWrist(chain, point, Vec3{0.0});
    for (const Vec3& along : Directions()) {
      const Vec3 wrist = point - chain.hand * along;
      if (IsClear(wrist) && IsClear(glm::mix(wrist, point, 0.5)) &&
          ReachesWrist(chain, wrist, along)) {
        return true;
      }
    }
    return false;
  }

 private:
  bool IsClear(const Vec3& p) const { return Depth(body_, p) <= depth_; }
  /// The half at the shoulder belongs to the trunk.
  bool IsUpperClear(const Vec3& shoulder, const Vec3& elbow) const {
    return IsClear(elbow) && IsClear(glm::mix(shoulder, elbow, 0.75));
  }

  bool ReachesWrist(const Chain& chain, const Vec3& wrist, const Vec3& along) const {
    const double a = chain.upper;
    const double b = chain.lower;
    const Vec3 offset = wrist - chain.shoulder;
    const double square = glm::dot(offset, offset);
    const double least = a * a + b * b - 2.0 * a * b * kMostBent;
    if (square > (a + b) * (a + b) || square < least || square < 1e-12) return false;
    const double distance = std::sqrt(square);
    const Vec3 axis = offset / distance;
    const double foot = (square + a * a - b * b) / (2.0 * distance);
    const double radius = std::sqrt(std::max(0.0, a * a - foot * foot));
    const Vec3 any = std::abs(axis.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 u = glm::normalize(glm::cross(axis, any));
    const Vec3 v = glm::cross(axis, u);
    for (std::size_t k = 0; k < kSwivelCount; ++k) {
      const double angle = 2.0 * kPi * static_cast<double>(k) / kSwivelCount;
      const Vec3 elbow =
          chain.shoulder + foot * axis + radius * (std::cos(angle) * u + std::sin(angle) * v);
      if (glm::dot(wrist - elbow, along) < 0.0) continue;  // the hand bends farther than it can
      if (IsUpperClear(chain.shoulder, elbow) && IsClear(glm::mix(elbow, wrist, 1.0 / 3.0)) &&
          IsClear(glm::mix(elbow, wrist, 2.0 / 3.0))) {
        return true;
      }
    }
    return false;
  }

  const MeasuredBody& body_;
  double depth_;
};

Chain ChainOf(const MeasuredBody& body, Limb arm, double beyond_wrist) {
  const LimbJoints joints = JointsOf(arm);
  return {body.pose.Position(joints.base), BoneLength(body.body->skeleton, joints.mid),
          BoneLength(body.body->skeleton, joints.end), beyond_wrist};
}

/// The point of a bone's skin that is nearest to a shoulder.
Vec3 Facing(const Vec3& shoulder, const Vec3& on_axis, double radius) {
  const Vec3 offset = shoulder - on_axis;
  const double distance = glm::length(offset);
  return on_axis + std::min(1.0, radius / std::max(distance, 1e-12)) * offset;
}

/// Whether both arms can bring themselves to where they touch: where the other is, or anywhere it
/// can go.
bool CanMeet(const MeasuredBody& body, const Search& search, const Chain& chain, Limb other,
             const SurfacePlace& place, const MeasuredBone& bone) {
  const std::size_t k = place.index;
  Chain partner = ChainOf(
      body, other, k < kSegmentCount ? 0.0 : place.axial * glm::distance(bone.start, bone.end));
  const bool on_upper = k < kSegmentCount && !IsLower(static_cast<LimbSegment>(k));
  if (on_upper) partner = {partner.shoulder, place.axial * partner.upper, 0.0, 0.0};
  if (!on_upper && k < kSegmentCount) partner.lower *= place.axial;
  for (const double share : {1.0, 0.75, 0.5}) {
    for (const Vec3& direction : Directions()) {
      const Vec3 on_axis = partner.shoulder + share * partner.Reach() * direction;
      const Vec3 point = Facing(chain.shoulder, on_axis, bone.radius);
      if (glm::distance(chain.shoulder, point) > chain.Reach()) continue;
      if (search.Reaches(partner, on_axis) && search.Reaches(chain, point)) return true;
    }
    if (on_upper) break;
  }
  return false;
}

}  // namespace

bool CanTouch(const MeasuredBody& body, Limb arm, const SurfacePlace& place, double beyond_wrist,
              double depth) {
  const Search search(body, depth);
  const Chain chain = ChainOf(body, arm, beyond_wrist);
  if (place.on_mesh) return search.Reaches(chain, OnMesh(body, place));
  const MeasuredBone bone = BoneOf(body, arm, place.index);
  const Vec3 on_axis = glm::mix(bone.start, bone.end, place.axial);
  if (search.Reaches(chain, Facing(chain.shoulder, on_axis, bone.radius))) return true;
  const bool on_arm =
      place.index == kSegmentCount || IsArm(LimbOf(static_cast<LimbSegment>(place.index)));
  return on_arm && CanMeet(body, search, chain, Mirror(arm), place, bone);
}

double BoneDepth(const MeasuredBody& body, Limb arm, const Vec3& point) {
  const LimbJoints joints = JointsOf(arm);
  const Vec3& shoulder = body.pose.Position(joints.base);
  const Vec3& elbow = body.pose.Position(joints.mid);
  const Vec3& wrist = body.pose.Position(joints.end);
  double depth = 0.0;
  for (const Vec3& p : {glm::mix(shoulder, elbow, 0.75), elbow, glm::mix(elbow, wrist, 1.0 / 3.0),
                        glm::mix(elbow, wrist, 2.0 / 3.0), wrist, glm::mix(wrist, point, 0.5)}) {
    depth = std::max(depth, Depth(body, p));
  }
  return depth;
}

}  // namespace ego
