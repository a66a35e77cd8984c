// SPDX-License-Identifier: MIT
#include "assets/people/robot.h"

#include <algorithm>
#include <string>
#include <utility>

#include "assets/people/field.h"
#include "assets/people/figure_builder.h"
#include "assets/people/person_shape.h"
#include "assets/people/polygonise.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// Adds pieces to a figure, those of the left side on the right as well.
class Workshop {
 public:
  Workshop(FigureBuilder& figure, double cell) : figure_(figure), cell_(cell) {}

  void Box(J joint, Region region, const Vec3& centre, const Vec3& half, double round) {
    Add(joint, region, centre - half, centre + half,
        [=](const Vec3& p) { return field::RoundBox(p, centre, half, round); });
  }
  void Capsule(J joint, Region region, const Vec3& a, const Vec3& b, double ra, double rb) {
    const Vec3 r(std::max(ra, rb));
    Add(joint, region, glm::min(a, b) - r, glm::max(a, b) + r,
        [=](const Vec3& p) { return field::Capsule(p, a, b, ra, rb); });
  }
  void BallPiece(J joint, Region region, const Vec3& centre, const Vec3& radius) {
    AddMesh(joint, region, ego::Ball(centre, radius, 24));
  }

 private:
  void Add(J joint, Region region, const Vec3& low, const Vec3& high,
           const ImplicitSurface& surface) {
    const Vec3 size = high - low;
    const double cell = std::min(cell_, 0.16 * std::min({size.x, size.y, size.z}));
    AddMesh(joint, region, Polygonise(surface, UniformLattice(low, high, cell)));
  }
  void AddMesh(J joint, Region region, ClosedMesh mesh) {
    static constexpr std::array<const char*, kRegionCount> kNames = {"Metal", "Shell", "Frame",
                                                                     "Feet", "Visor"};
    figure_.AddRigid(kNames[static_cast<std::size_t>(region)], mesh, joint, region);
    if (Mirror(joint) == joint) return;
    for (Vec3& p : mesh.positions) p.x = -p.x;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    figure_.AddRigid(kNames[static_cast<std::size_t>(region)], mesh, Mirror(joint), region);
  }

  FigureBuilder& figure_;
  double cell_;
};

}  // namespace

Person MakeRobot(const PersonParameters& m) {
  const PersonShape shape(m);
  FigureBuilder figure(m, shape.skeleton());
  Workshop make(figure, m.height / 90.0);
  const auto at = [&](J joint) { return shape.Joint(joint); };
  const double trunk = shape.TrunkLength();
  const double hip = shape.HipHeight();
  const auto y = [&](double share) { return hip + share * trunk; };

  const double z = -0.01 * trunk;
  make.Box(J::kHips, Region::kTrousers, {0.0, y(0.01), z},
           {0.5 * m.hips_width, 0.15 * trunk, 0.46 * m.hips_depth}, 0.08 * trunk);
  make.Box(J::kSpine, Region::kShirt, {0.0, y(0.30), z},
           {0.5 * m.waist_width, 0.17 * trunk, 0.5 * m.belly_thickness}, 0.12 * trunk);
  make.Capsule(J::kChest, Region::kTrousers, {-0.26 * m.waist_width, y(0.47), z},
               {0.26 * m.waist_width, y(0.47), z}, 0.13 * trunk, 0.13 * trunk);
  make.Box(J::kUpperChest, Region::kShirt, {0.0, y(0.72), z},
           {0.5 * m.chest_width, 0.22 * trunk, 0.5 * m.chest_depth}, 0.12 * trunk);
  const double head = m.head_height;
  const Vec3 middle{0.0, m.height - 0.5 * head, shape.HeadDepth()};
  make.Capsule(J::kNeck, Region::kTrousers, at(J::kNeck) - Vec3{0.0, 0.10 * trunk, 0.0},
               middle - Vec3{0.0, 0.35 * head, 0.0}, m.neck_radius, m.neck_radius);
  make.Box(J::kHead, Region::kShirt, middle,
           Vec3{0.5 * m.head_width, 0.5 * head, 0.5 * m.head_depth}, 0.30 * head);
  make.Box(J::kHead, Region::kHair, middle + Vec3{0.0, 0.04 * head, 0.40 * m.head_depth},
           {0.40 * m.head_width, 0.24 * head, 0.14 * m.head_depth}, 0.10 * head);
  make.Capsule(J::kHead, Region::kTrousers, middle + Vec3{-0.52 * m.head_width, 0.0, -0.02 * head},
               middle + Vec3{0.52 * m.head_width, 0.0, -0.02 * head}, 0.15 * head, 0.15 * head);
  for (const double side : {1.0, -1.0}) {
    figure.AddDetail(
        "Eyes",
        Ball(middle + Vec3{side * 0.19 * m.head_width, 0.05 * head, 0.525 * m.head_depth},
             {0.060 * head, 0.085 * head, 0.03 * head}, 20),
        J::kHead, {0.55f, 0.93f, 0.98f});
  }

  // Arms: balls at the joints, shells along the bones.
  const Vec3 shoulder = at(J::kLeftUpperArm);
  const Vec3 elbow = at(J::kLeftLowerArm);
  const Vec3 wrist = at(J::kLeftHand);
  const double ru = m.upper_arm_radius;
  const double rl = m.lower_arm_radius;
  make.Capsule(J::kLeftShoulder, Region::kTrousers, at(J::kLeftShoulder), shoulder, 0.9 * ru,
               0.9 * ru);
  make.BallPiece(J::kLeftUpperArm, Region::kShirt, shoulder, Vec3(1.25 * ru));
  make.Capsule(J::kLeftUpperArm, Region::kSkin, shoulder, elbow, ru, ru);
  make.BallPiece(J::kLeftLowerArm, Region::kTrousers, elbow, Vec3(1.08 * std::max(ru, rl)));
  make.Capsule(J::kLeftLowerArm, Region::kSkin, elbow, wrist - Vec3{0.4 * rl, 0.0, 0.0}, rl, rl);
  make.BallPiece(J::kLeftHand, Region::kTrousers, wrist, Vec3(0.80 * rl));
  const double reach = m.hand_length;
  make.Box(J::kLeftHand, Region::kShirt, wrist + Vec3{0.33 * reach, 0.0, 0.0},
           {0.23 * reach, 0.09 * reach, 0.22 * reach}, 0.06 * reach);
  for (const double finger : {-0.155, -0.044, 0.067, 0.172}) {
    make.Capsule(J::kLeftHand, Region::kSkin, wrist + reach * Vec3{0.50, -0.01, finger},
                 wrist + reach * Vec3{0.942 - 0.4 * std::abs(finger - 0.067), -0.03, finger},
                 0.052 * reach, 0.050 * reach);
  }
  make.Capsule(J::kLeftHand, Region::kSkin, wrist + reach * Vec3{0.20, -0.02, 0.18},
               wrist + reach * Vec3{0.45, -0.04, 0.34}, 0.065 * reach, 0.060 * reach);

  // Legs and feet.
  const Vec3 hip_joint = at(J::kLeftUpperLeg);
  const Vec3 knee = at(J::kLeftLowerLeg);
  const Vec3 ankle = at(J::kLeftFoot);
  const double tu = m.upper_leg_radius;
  const double tl = m.lower_leg_radius;
  make.Capsule(J::kLeftUpperLeg, Region::kSkin, hip_joint, knee, tu, tu);
  make.BallPiece(J::kLeftLowerLeg, Region::kTrousers, knee, Vec3(1.05 * std::max(tu, tl)));
  make.Capsule(J::kLeftLowerLeg, Region::kSkin, knee, ankle, tl, tl);
  make.BallPiece(J::kLeftFoot, Region::kTrousers, ankle, Vec3(0.9 * std::min(tl, ankle.y)));
  const double foot = m.foot_length;
  const double toes = at(J::kLeftToes).z - ankle.z;
  const double sole = 0.5 * m.ankle_height;
  make.Box(J::kLeftFoot, Region::kShoes, {ankle.x, sole, ankle.z + 0.5 * (toes - 0.16 * foot)},
           {0.19 * foot, sole, 0.5 * (toes + 0.28 * foot)}, 0.4 * sole);
  make.Box(J::kLeftToes, Region::kShoes,
           {ankle.x, 0.8 * sole, ankle.z + 0.5 * (toes + 0.78 * foot)},
           {0.18 * foot, 0.8 * sole, 0.5 * (0.78 * foot - toes) + 0.01 * foot}, 0.4 * sole);
  return std::move(figure).Finish(shape);
}

}  // namespace ego
