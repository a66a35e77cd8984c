// SPDX-License-Identifier: MIT
#include "assets/people/person.h"

#include <algorithm>
#include <cmath>

#include "assets/people/figure_builder.h"
#include "assets/people/person_body.h"
#include "assets/people/person_face.h"
#include "assets/people/person_shape.h"
#include "assets/people/person_skin.h"
#include "assets/people/polygonise.h"
#include "assets/people/region_cut.h"
#include "assets/people/robot.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using field::SmoothStep;

/// Planes whose distance follows `cell`, from low to high.
std::vector<double> Planes(double low, double high, const std::function<double(double)>& cell) {
  std::vector<double> planes = {low};
  while (planes.back() < high) planes.push_back(planes.back() + cell(planes.back()));
  return planes;
}

/// Cells of about one part in 96 of the height, finer in the hands and the head,
/// finer for thin shins: the lattice tapers along the limbs and above the neck.
SampleLattice LatticeOf(const PersonShape& shape) {
  const PersonParameters& m = shape.parameters();
  const double cell = m.height / 96.0;
  const Vec3 wrist = shape.Joint(J::kLeftHand);
  const double hand_fine = std::min(1.0, 0.042 * m.hand_length / cell);
  const double head_fine = std::min(1.0, 0.054 * m.head_height / cell);
  const double neck = shape.Joint(J::kNeck).y;
  const double face = shape.ChinHeight() + 0.15 * m.head_height;
  const double beside = std::max(0.5 * m.shoulder_width, 0.6 * m.head_width / head_fine);
  // Thin forearms get the denser lattice from the elbow on.
  const double forearm = wrist.x - shape.Joint(J::kLeftLowerArm).x;
  const double taper = m.lower_arm_radius < 2.2 * cell ? 1.2 * forearm : 0.9 * m.hand_length;
  const auto hand_scale = [=](double x) {
    return 1.0 + (hand_fine - 1.0) *
                     SmoothStep(wrist.x - taper, wrist.x - 0.05 * m.hand_length, std::abs(x));
  };
  const auto head_scale = [=](double x, double y) {
    const double above = SmoothStep(neck, face, y);
    return 1.0 + (head_fine - 1.0) * above *
                     (1.0 - SmoothStep(beside, beside + 0.5 * m.shoulder_width, std::abs(x)));
  };
  const double knee = shape.Joint(J::kLeftLowerLeg).y;
  const double leg_fine = std::clamp(0.32 * m.lower_leg_radius / cell, 0.45, 1.0);
  const auto leg_scale = [=](double y) {
    return leg_fine + (1.0 - leg_fine) * SmoothStep(knee, knee + 0.3 * (wrist.y - knee), y);
  };

  SampleLattice lattice;
  const std::vector<double> half =
      Planes(0.0, wrist.x + 1.1 * m.hand_length, [&](double x) { return cell * hand_scale(x); });
  for (std::size_t i = half.size() - 1; i > 0; --i) lattice.x.push_back(-half[i]);
  lattice.x.insert(lattice.x.end(), half.begin(), half.end());
  lattice.y = Planes(-2.37 * cell, m.height + 2.0 * cell, [&](double y) {
    return cell * leg_scale(y) * (y < 1.5 * m.ankle_height ? 0.7 : head_scale(0.0, y));
  });
  const double hand_reach = 0.45 * m.hand_length / hand_fine;
  const double head_reach = (m.hair == Hair::kBun ? 1.0 : 0.75) * m.head_depth / head_fine;
  const double trunk_back = 0.7 * std::max(m.chest_depth, m.hips_depth);
  const double front = std::max(m.belly_thickness, 0.5 * m.chest_depth + 2.0 * m.bust);
  lattice.z =
      Planes(-std::max({hand_reach, head_reach, trunk_back, 0.3 * m.foot_length / leg_fine}),
             std::max({hand_reach, head_reach, front, 0.9 * m.foot_length / leg_fine}),
             [&](double) { return cell; });
  const double head_z = shape.HeadDepth();
  lattice.place = [=](const Vec3& p) {
    const double hand = hand_scale(p.x);
    const double head = head_scale(p.x, p.y);
    const Vec3 q{p.x * head, wrist.y + (p.y - wrist.y) * hand, wrist.z + (p.z - wrist.z) * hand};
    const double leg = leg_scale(p.y);
    return Vec3{q.x * leg, q.y, (head_z + (q.z - head_z) * head) * leg};
  };
  return lattice;
}

Person MakeSoftPerson(const PersonParameters& parameters) {
  const PersonShape shape(parameters);
  FigureBuilder figure(parameters, shape.skeleton());

  ClosedMesh mesh = Polygonise([&](const Vec3& p) { return shape(p); }, LatticeOf(shape));
  const std::vector<Region> regions =
      CutByRegion(mesh, [&](const Vec3& p) { return shape.RegionAt(p); });
  std::vector<Vec3> normals;
  std::vector<JointWeights> weights;
  for (const Vec3& p : mesh.positions) {
    normals.push_back(shape.Normal(p));
    weights.push_back(SkinWeights(shape, p));
  }
  figure.AddSkin(mesh, normals, weights, regions);
  AddFace(shape, figure);
  return std::move(figure).Finish(shape);
}

}  // namespace

Person MakePerson(const PersonParameters& parameters) {
  return parameters.style == PersonStyle::kRobot ? MakeRobot(parameters)
                                                 : MakeSoftPerson(parameters);
}

}  // namespace ego
