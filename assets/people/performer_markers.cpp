// SPDX-License-Identifier: MIT
#include "assets/people/performer_markers.h"

#include <string>
#include <utility>
#include <vector>

#include "assets/people/person_body.h"
#include "assets/people/posture.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

/// Centre of a 14 mm marker above the skin.
constexpr double kStandOff = 0.007;

struct Marker {
  std::string label;
  SkinPoint skin;
};

std::vector<Marker> Table(const Person& person) {
  const FigureSurface surface = SurfaceOf(person.character);
  const std::array<Vec3, kJointCount> joint = CanonicalPositions(person.body.skeleton);
  const Body& body = person.body;
  std::vector<Marker> markers;
  const auto add = [&](std::string label, const Vec3& origin, const Vec3& direction) {
    markers.push_back({std::move(label), PointAlong(surface, origin, glm::normalize(direction))});
  };
  const auto at = [&](J j) { return joint[Index(j)]; };
  const auto sample = [&](S s) { return body.surface.sample_ms[Index(s)]; };

  // Head and trunk.
  const Vec3 head{0.0, sample(S::kForehead).y, at(J::kHead).z};
  add("CLAV", {0.0, sample(S::kCollarNotch).y, at(J::kUpperChest).z}, {0.0, 0.0, 1.0});
  add("STRN", {0.0, sample(S::kSternumBase).y, at(J::kChest).z}, {0.0, 0.0, 1.0});
  add("C7", {0.0, sample(S::kNapeBase).y - 0.02, at(J::kNeck).z}, {0.0, 0.0, -1.0});
  add("T10", {0.0, sample(S::kMidBack).y, at(J::kChest).z}, {0.0, 0.0, -1.0});
  for (const double out : {1.0, -1.0}) {
    const std::string l = out > 0.0 ? "L" : "R";
    const auto side = [&](J left) { return at(out > 0.0 ? left : Mirror(left)); };
    const Vec3 elbow = side(J::kLeftLowerArm);
    const Vec3 wrist = side(J::kLeftHand);
    const Vec3 shoulder = side(J::kLeftUpperArm);
    const Vec3 hip = side(J::kLeftUpperLeg);
    const Vec3 knee = side(J::kLeftLowerLeg);
    const Vec3 ankle = side(J::kLeftFoot);
    const Vec3 toes = side(J::kLeftToes);
    add(l + "FHD", head, {0.55 * out, 0.15, 1.0});
    add(l + "BHD", head, {0.55 * out, 0.15, -1.0});
    add(l + "SHO", shoulder, {0.0, 1.0, 0.0});
    add(l + "UPA", glm::mix(shoulder, elbow, 0.55), {0.0, 0.8, -0.6});
    add(l + "ELB", elbow, {0.0, 0.9, -0.7});
    add(l + "IEL", elbow, {0.0, -0.9, -0.7});
    add(l + "WRA", wrist - Vec3{0.012 * out, 0.0, 0.0}, {0.0, 0.3, 1.0});
    add(l + "WRB", wrist - Vec3{0.012 * out, 0.0, 0.0}, {0.0, 0.3, -1.0});
    add(l + "FIN", wrist + Vec3{0.075 * out, 0.0, 0.0}, {0.0, 1.0, 0.0});
    add(l + "ASI", {0.0, sample(S::kPubis).y + 0.11, at(J::kHips).z}, {0.75 * out, 0.0, 1.0});
    add(l + "PSI", {0.0, sample(S::kSacrum).y + 0.03, at(J::kHips).z}, {0.4 * out, 0.0, -1.0});
    add(l + "THI", glm::mix(hip, knee, 0.55), {out, 0.0, 0.35});
    add(l + "KNE", knee, {out, 0.0, 0.1});
    add(l + "SHN", glm::mix(knee, ankle, 0.45), {0.35 * out, 0.0, 1.0});
    add(l + "ANK", ankle, {out, 0.0, 0.0});
    add(l + "HEE", {ankle.x, 0.5 * ankle.y, ankle.z}, {0.0, 0.0, -1.0});
    add(l + "TOE", {toes.x, 0.03, toes.z + 0.01}, {0.25 * out, 1.0, 0.3});
  }
  return markers;
}

}  // namespace

std::shared_ptr<const MarkerTake> MarkersOn(const Person& person, const CapturedMotion& motion) {
  const std::vector<Marker> markers = Table(person);
  const PostureSolver solver(person.body);
  auto take = std::make_shared<MarkerTake>();
  take->name = motion.name;
  take->rate_hz = motion.rate_hz;
  take->frame_count = motion.poses.size();
  for (const Marker& marker : markers) take->labels.push_back(marker.label);
  for (const Pose& pose : motion.poses) {
    const ModelPose model = ForwardKinematics(person.body.skeleton, pose);
    for (const Marker& marker : markers) {
      const SkinPoint skin = solver.Posed(marker.skin, model);
      take->position_ws.push_back(skin.position_ms + kStandOff * skin.normal_ms);
    }
  }
  take->visible.assign(take->position_ws.size(), 1);
  return take;
}

}  // namespace ego
