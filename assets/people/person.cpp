// SPDX-License-Identifier: MIT
#include "assets/people/person.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "assets/people/figure_builder.h"
#include "assets/people/person_body.h"
#include "assets/people/person_face.h"
#include "assets/people/person_shape.h"
#include "assets/people/person_skin.h"
#include "assets/people/polygonise.h"
#include "assets/people/refine.h"
#include "assets/people/region_cut.h"
#include "assets/people/relief.h"
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

/// Cells of about one part in 76 of the height, larger for the stout, finer in the head, for thin
/// shins and forearms, and across the hands, where fingers lie close: the lattice tapers along the
/// limbs and above the neck.
SampleLattice LatticeOf(const PersonShape& shape) {
  const PersonParameters& m = shape.parameters();
  const double cell = std::sqrt(m.height / 76.0 *
                                std::max(m.height / 76.0, (m.chest_width + m.waist_width) / 25.0));
  const Vec3 wrist = shape.Joint(J::kLeftHand);
  const double hand_fine = std::min(1.0, 0.021 * m.hand_length / cell);
  const double hand_along = std::min(1.0, 0.032 * m.hand_length / cell);
  const double head_fine = std::min(1.0, 0.070 * m.head_height / cell);
  const double neck = shape.Joint(J::kNeck).y;
  const double face = shape.ChinHeight() + 0.15 * m.head_height;
  const double beside = std::max(0.5 * m.shoulder_width, 0.6 * m.head_width / head_fine);
  const double forearm = wrist.x - shape.Joint(J::kLeftLowerArm).x;
  // Out from here there is only arm.
  const double armpit = std::max({shape.Joint(J::kLeftUpperArm).x, 0.75 * m.head_width,
                                  0.6 * m.waist_width, 0.6 * m.hips_width});
  const double forearm_fine = std::clamp(m.lower_arm_radius / (2.4 * cell), hand_fine, 1.0);
  const auto on_hand = [=](double x) {
    return SmoothStep(wrist.x - 0.45 * m.hand_length, wrist.x + 0.30 * m.hand_length, std::abs(x));
  };
  // Along the arm, where a cuff must not fall between two planes, and across it.
  const double cuff = shape.CuffReach();
  const double trim = shape.TrimWidth();
  const auto along_scale = [=](double x) {
    const bool near_cuff = x > cuff - 2.5 * trim && x < cuff + trim;
    return std::min(glm::mix(1.0, hand_along, on_hand(x)), near_cuff ? 0.85 * trim / cell : 1.0);
  };
  // Beside the arm the lattice is what it is elsewhere: legs lie below.
  const double beside_hand = 0.15 * m.hand_length / hand_fine;
  const auto hand_scale = [=](double x, double y) {
    const double lower =
        SmoothStep(armpit, std::max(armpit, wrist.x - forearm) + 0.2 * forearm, std::abs(x));
    const double on_arm = glm::mix(glm::mix(1.0, forearm_fine, lower), hand_fine, on_hand(x));
    return glm::mix(on_arm, 1.0, SmoothStep(beside_hand, 2.5 * beside_hand, std::abs(y - wrist.y)));
  };
  const auto head_scale = [=](double x, double y) {
    const double above = SmoothStep(neck, face, y);
    return 1.0 + (head_fine - 1.0) * above *
                     (1.0 - SmoothStep(beside, beside + 0.5 * m.shoulder_width, std::abs(x)));
  };
  const double knee = shape.Joint(J::kLeftLowerLeg).y;
  const double leg_fine = std::clamp(0.42 * m.lower_leg_radius / cell, 0.45, 1.0);
  const auto leg_scale = [=](double y) {
    const double above = SmoothStep(knee, knee + 0.3 * (wrist.y - knee), y);
    const double below = 1.0 - SmoothStep(1.0 * m.ankle_height, 2.6 * m.ankle_height, y);
    return glm::mix(leg_fine, 1.0, std::max(above, below));
  };

  SampleLattice lattice;
  const std::vector<double> half =
      Planes(0.0, wrist.x + 1.1 * m.hand_length, [&](double x) { return cell * along_scale(x); });
  for (std::size_t i = half.size() - 1; i > 0; --i) lattice.x.push_back(-half[i]);
  lattice.x.insert(lattice.x.end(), half.begin(), half.end());
  lattice.y = Planes(-2.37 * cell, m.height + 2.0 * cell, [&](double y) {
    return cell * leg_scale(y) * (y < 1.5 * m.ankle_height ? 0.7 : head_scale(0.0, y));
  });
  const double hand_reach = 0.45 * m.hand_length / hand_fine;
  const double head_reach = (m.hair == Hair::kBun ? 1.0 : 0.75) * m.head_depth / head_fine;
  const double legs = 1.5 * std::max(m.upper_leg_radius, m.lower_leg_radius);
  const double trunk_back =
      std::max({0.7 * m.chest_depth, 0.7 * m.hips_depth, legs, 1.5 * m.upper_arm_radius}) + cell;
  const double front =
      std::max({m.belly_thickness, 0.5 * m.chest_depth + 2.0 * m.bust, trunk_back}) + cell;
  lattice.z =
      Planes(-std::max({hand_reach, head_reach, trunk_back, 0.3 * m.foot_length / leg_fine}),
             std::max({hand_reach, head_reach, front, 0.9 * m.foot_length / leg_fine}),
             [&](double) { return cell; });
  const double head_z = shape.HeadDepth();
  lattice.place = [=](const Vec3& p) {
    const double hand = hand_scale(p.x, p.y);
    const double head = head_scale(p.x, p.y);
    const Vec3 q{p.x * head, wrist.y + (p.y - wrist.y) * hand, wrist.z + (p.z - wrist.z) * hand};
    const double leg = leg_scale(p.y);
    return Vec3{q.x * leg, q.y, (head_z + (q.z - head_z) * head) * leg};
  };
  return lattice;
}

/// How the regions stand out over one another: clothes over skin, hair over the face, lids over
/// the eyes.
LiftBeside LiftsOf(const PersonParameters& m) {
  const double cloth = 0.0022 * m.height;
  const double head = m.head_height;
  return [=](Region region, Region other) -> Lift {
    switch (region) {
      case Region::kTrim:
        return {cloth, 0.0};
      case Region::kShirt:
        if (other == Region::kTrousers) return {1.4 * cloth, 14.0 * cloth};
        return other == Region::kSkin ? Lift{cloth, 6.0 * cloth} : Lift{};
      case Region::kTrousers:
        return other == Region::kShirt ? Lift{} : Lift{1.2 * cloth, 12.0 * cloth};
      case Region::kShoes:
        return other == Region::kSkin ? Lift{0.9 * cloth, 8.0 * cloth} : Lift{};
      case Region::kSoles:
        return {1.2 * cloth, 0.0};
      case Region::kHair:
        return {0.020 * head, 0.16 * head};
      case Region::kSkin:
        return IsEye(other) ? Lift{0.0085 * head * m.eye_size, 0.045 * head * m.eye_size} : Lift{};
      default:
        return {};
    }
  };
}

double Wanted(const PersonParameters& m, LimbSegment segment) {
  switch (segment) {
    case LimbSegment::kLeftUpperArm:
    case LimbSegment::kRightUpperArm:
      return m.upper_arm_radius;
    case LimbSegment::kLeftForearm:
    case LimbSegment::kRightForearm:
      return m.lower_arm_radius;
    case LimbSegment::kLeftThigh:
    case LimbSegment::kRightThigh:
      return m.upper_leg_radius;
    default:
      return m.lower_leg_radius;
  }
}

/// Widens each limb about its bone until its radius, measured on the mesh, is the wanted one: flat
/// triangles cut round limbs, and hems add to them.
void FitRadii(const PersonShape& shape, std::span<const SkinJointWeights> weights,
              ReliefMesh& skin) {
  FigureSurface surface;
  surface.position_ms = skin.mesh.positions;
  surface.attachment.resize(surface.position_ms.size());
  surface.triangles = skin.mesh.triangles;
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const Vec3 start = shape.Joint(StartJoint(segment));
    const Vec3 bone = shape.Joint(EndJoint(segment)) - start;
    const double factor =
        Wanted(shape.parameters(), segment) / MeasureRadius(surface, start, start + bone) - 1.0;
    const std::size_t carrier = Index(StartJoint(segment));
    for (std::size_t v = 0; v < surface.position_ms.size(); ++v) {
      const double share = weights[skin.source[v]][carrier];
      if (share == 0.0) continue;
      Vec3& p = skin.mesh.positions[v];
      const double t = glm::dot(p - start, bone) / glm::dot(bone, bone);
      const double window = SmoothStep(0.05, 0.28, t) * (1.0 - SmoothStep(0.72, 0.95, t));
      p += share * window * factor * (p - start - t * bone);
    }
  }
}

Person MakeSoftPerson(const PersonParameters& parameters) {
  const PersonShape shape(parameters);
  const ImplicitSurface surface = [&](const Vec3& p) { return shape(p); };
  FigureBuilder figure(parameters, shape.skeleton());

  ClosedMesh mesh = Polygonise([&](const Vec3& p) { return shape.Coarse(p); }, LatticeOf(shape));
  const double hand = shape.Joint(HumanoidJoint::kLeftHand).x;
  for (Vec3& p : mesh.positions) {
    const bool ear = p.y > shape.ChinHeight() && std::abs(p.x) > 0.4 * parameters.head_width;
    if (std::abs(p.x) < hand && !ear) continue;
    const double bound = ear ? 0.04 * parameters.head_height : 0.03 * parameters.hand_length;
    p = DrawOnto(surface, p, bound, 3);
  }
  Refine(
      surface, [&](const Vec3& p) { return shape.LongestEdge(p); }, 3, mesh);
  const std::vector<Region> regions =
      CutByRegion(mesh, [&](const Vec3& p) { return shape.RegionAt(p); });
  std::vector<Vec3> normals;
  std::vector<SkinJointWeights> weights;
  for (const Vec3& p : mesh.positions) {
    normals.push_back(shape.Normal(p));
    weights.push_back(SkinWeightsWithFingers(shape, p));
  }
  ReliefMesh skin = Relieve(mesh, regions, normals, LiftsOf(parameters));
  FitRadii(shape, weights, skin);
  // The edge of the upper lid carries the lashes.
  const double eye = shape.head().IrisFront().y;
  for (std::size_t t = 0; t < skin.regions.size(); ++t) {
    if (!skin.step[t] || skin.regions[t] != Region::kSkin) continue;
    const Vec3& p = skin.mesh.positions[skin.mesh.triangles[t][0]];
    if (p.y > eye) skin.regions[t] = Region::kLashes;
  }
  figure.AddSkin(skin, weights);
  AddFace(shape, figure);
  return std::move(figure).Finish(shape);
}

}  // namespace

Person MakePerson(const PersonParameters& parameters) {
  return parameters.style == PersonStyle::kRobot ? MakeRobot(parameters)
                                                 : MakeSoftPerson(parameters);
}

}  // namespace ego
