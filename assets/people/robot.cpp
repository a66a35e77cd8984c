// SPDX-License-Identifier: MIT
#include "assets/people/robot.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "assets/people/closed_shapes.h"
#include "assets/people/figure_builder.h"
#include "assets/people/person_hand.h"
#include "assets/people/person_shape.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// Adds pieces to a figure, those of the left side on the right as well.
class Workshop {
 public:
  explicit Workshop(FigureBuilder& figure) : figure_(figure) {}

  void Box(J joint, Region region, const Vec3& centre, const Vec3& half, double round) {
    Add(Index(joint), region, RoundBox(centre, half, round, 8));
  }
  void Capsule(J joint, Region region, const Vec3& a, const Vec3& b, double ra, double rb) {
    Add(Index(joint), region, Shell(a, b, ra, rb, 24));
  }
  void BallPiece(J joint, Region region, const Vec3& centre, const Vec3& radius) {
    Add(Index(joint), region, Ball(centre, radius, 24));
  }
  /// One segment of a finger of the left hand.
  void FingerPiece(std::size_t finger_joint, const Vec3& a, const Vec3& b, double ra, double rb) {
    Add(kJointCount + finger_joint, Region::kSkin, Shell(a, b, ra, rb, 10));
  }

 private:
  static ClosedMesh Shell(const Vec3& a, const Vec3& b, double ra, double rb, int segments) {
    std::vector<Vec3> points;
    std::vector<double> radii;
    for (int i = 0; i <= 2; ++i) {
      points.push_back(glm::mix(a, b, 0.5 * i));
      radii.push_back(glm::mix(ra, rb, 0.5 * i));
    }
    return Tube(points, radii, segments);
  }
  void Add(std::size_t skin_joint, Region region, ClosedMesh mesh) {
    const auto name = [&]() -> const char* {
      switch (region) {
        case Region::kShirt:
          return "Shell";
        case Region::kTrousers:
          return "Frame";
        case Region::kShoes:
          return "Feet";
        case Region::kHair:
          return "Visor";
        default:
          return "Metal";
      }
    }();
    figure_.AddRigid(name, mesh, skin_joint, region);
    const bool finger = skin_joint >= kJointCount;
    const auto joint = static_cast<J>(skin_joint);
    if (!finger && Mirror(joint) == joint) return;
    for (Vec3& p : mesh.positions) p.x = -p.x;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    figure_.AddRigid(name, mesh,
                     finger ? skin_joint + hand::kFingerJointCount : Index(Mirror(joint)), region);
  }

  FigureBuilder& figure_;
};

}  // namespace

Person MakeRobot(const PersonParameters& m) {
  const PersonShape shape(m);
  FigureBuilder figure(m, shape.skeleton());
  Workshop make(figure);
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
  for (std::size_t f = 0; f < hand::kFingerJointCount; ++f) {
    const hand::Finger& finger = hand::Fingers()[f / hand::kJointsPerFinger];
    const std::size_t k = f % hand::kJointsPerFinger;
    make.FingerPiece(f, wrist + reach * finger.point[k], wrist + reach * finger.point[k + 1],
                     0.92 * reach * finger.radius[k], 0.92 * reach * finger.radius[k + 1]);
  }

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
