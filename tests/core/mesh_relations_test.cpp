// SPDX-License-Identifier: MIT
#include "core/egocentric/mesh_relations.h"

#include <gtest/gtest.h>

#include "core/adapt/body_sum.h"
#include "core/egocentric/capsule_relations.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

struct Outcome {
  MeshCoordinates mesh;
  Importances importance;
  TriangleImportances triangle;
};

/// A body in place with what follows from it.
struct PlacedPerformer {
  explicit PlacedPerformer(const Pose& pose) : body(StudioPerformer()), constants(body) {
    PlaceBody(body, constants, pose, posed);
    bone_direction = BoneDirectionsOf(posed);
  }
  Body body;
  BodyConstants constants;
  PosedBody posed;
  BoneDirections bone_direction;
};

GroupQuery QueryOf(const PlacedPerformer& placed, std::size_t group) {
  return {.constants = placed.constants,
          .posed = placed.posed,
          .bone_direction = placed.bone_direction,
          .group = group,
          .own_thickness = true,
          .epsilon = 0.01,
          .gamma_epsilon = 0.02,
          .softness = 0.005,
          .floor = 0.02,
          .least_factor = 1e-9};
}

Outcome Relate(const GroupQuery& query, LaneWidth lanes) {
  Outcome outcome;
  RelateToMeshes(query, outcome.mesh, outcome.importance, outcome.triangle, lanes);
  return outcome;
}

void ExpectEqual(const QuadVectors& a, const QuadVectors& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
}

void ExpectEqual(const MeshRelations& a, const MeshRelations& b, std::size_t length) {
  EXPECT_EQ(a.importance, b.importance);
  ExpectEqual(a.inside, b.inside);
  for (std::size_t i = 0; i < length; ++i) ExpectEqual(a.along[i], b.along[i]);
}

TEST(RelateToMeshes, GivesTheSameBitsInAnyWidth) {
  for (const auto& [name, pose] : StudioPostures()) {
    const PlacedPerformer placed(pose);
    for (std::size_t group = 0; group < kPointGroupCount; ++group) {
      const GroupQuery query = QueryOf(placed, group);
      const Outcome two = Relate(query, LaneWidth::kTwo);
      const Outcome fastest = Relate(query, FastestLanes());
      EXPECT_EQ(two.importance.sum, fastest.importance.sum);
      EXPECT_EQ(two.importance.max, fastest.importance.max);
      EXPECT_EQ(two.importance.priority, fastest.importance.priority);
      EXPECT_EQ(two.triangle, fastest.triangle);
      EXPECT_EQ(two.mesh.sample, fastest.mesh.sample);
      ExpectEqual(two.mesh.trunk, fastest.mesh.trunk, PathsFromTrunk(group).length);
      ExpectEqual(two.mesh.head, fastest.mesh.head, PathsFromHead(group).length);
    }
  }
}

/// What a mesh's relations give on a body of other bones and thickness, by equations 2 and 5.
Vec3 Displacement(const MeshRelations& relations, const MeshPaths& paths, std::size_t lane,
                  const std::array<double, kBoneCount>& bone_length, double thickness) {
  Vec3 sum = thickness * relations.inside.At(lane);
  for (std::size_t i = 0; i < paths.length; ++i) {
    sum += bone_length[paths.bone[i][lane]] * relations.along[i].At(lane);
  }
  return sum;
}

/// tau of equation 5 for bones of these lengths, seen along a unit direction.
double PathFactor(const KinematicPath& path, const Vec3& direction,
                  const BoneDirections& bone_direction,
                  const std::array<double, kBoneCount>& length) {
  double tau = 0.0;
  for (std::size_t i = 0; i < path.length; ++i) {
    const std::size_t bone = path.bone[i];
    tau += length[bone] * (kLeastCosine + std::abs(glm::dot(direction, bone_direction[bone])));
  }
  return tau;
}

/// Equations 4 to 6 and appendix A written out for one point and one triangle after the other, read
/// on a body with other bones and thicknesses.
TEST(RelateToMeshes, AgreesWithTheEquationsTriangleByTriangle) {
  const PlacedPerformer placed(Posture("standing"));
  const auto& [body, constants, posed, bone_direction] = placed;
  std::array<double, kBoneCount> other_length = constants.bone_length;
  for (std::size_t k = 0; k < kBoneCount; ++k) {
    other_length[k] *= 0.6 + 0.1 * static_cast<double>(k % 9);
  }
  for (std::size_t j = 0; j < kLimbPointCount; ++j) {
    const auto limb_point = static_cast<LimbPoint>(j);
    const std::size_t lane = LaneOf(limb_point);
    const std::size_t group = GroupOf(limb_point);
    const GroupQuery query = QueryOf(placed, group);
    const Outcome found = Relate(query, FastestLanes());
    const double thickness = constants.thickness[j];
    const double other_thickness = 1.7 * thickness;
    Vec3 wanted{0.0};  // sum of lambda (x + v), on the other body
    double sum = 0.0;
    double max = 0.0;
    double priority = 0.0;
    for (std::size_t t = 0; t < kTriangleCount; ++t) {
      const SampleTriangle& s = SampleTriangles()[t];
      const Triangle triangle = Triangle::Of(posed.sample[Index(s[0])], posed.sample[Index(s[1])],
                                             posed.sample[Index(s[2])]);
      const Vec3 x = AtBarycentric(triangle, ClosestOnTriangle(triangle, posed.point[j]));
      const Vec3 v = posed.point[j] - x;
      const double reach = glm::length(v);
      const double orthogonality =
          Orthogonality(glm::dot(v, triangle.normal), reach, query.softness, query.floor);
      const double lambda = Proximity(reach - thickness, query.epsilon) * orthogonality;
      const KinematicPath& path = PathBetween(ParentJoint(t), limb_point);
      const Vec3 direction = v / reach;
      double length = std::max(0.0, reach - thickness) /
                      PathFactor(path, direction, bone_direction, constants.bone_length) *
                      PathFactor(path, direction, bone_direction, other_length);
      length += other_thickness * (thickness > 0.0 ? std::min(1.0, reach / thickness) : 1.0);
      wanted += lambda * (x + length * direction);
      sum += lambda;
      max = std::max(max, lambda);
      priority =
          std::max(priority, Proximity(reach - thickness, query.gamma_epsilon) * orthogonality);
      EXPECT_NEAR(found.triangle[t][lane], lambda, 1e-9 * lambda);
    }
    Vec3 given{0.0};
    for (std::size_t s = 0; s < kSampleCount; ++s) {
      given += found.mesh.sample[s][lane] * posed.sample[s];
    }
    const Vec3 displacement =
        Displacement(found.mesh.trunk, PathsFromTrunk(group), lane, other_length, other_thickness) +
        Displacement(found.mesh.head, PathsFromHead(group), lane, other_length, other_thickness);
    given += posed.hips * displacement;
    EXPECT_NEAR(found.importance.sum[lane], sum, 1e-9 * sum);
    EXPECT_NEAR(found.importance.max[lane], max, 1e-9 * max);
    EXPECT_NEAR(found.importance.priority[lane], priority, 1e-9 * priority);
    EXPECT_NEAR(found.mesh.trunk.importance[lane] + found.mesh.head.importance[lane], sum,
                1e-9 * sum);
    EXPECT_LT(glm::distance(given, wanted), 1e-9 * sum);
  }
}

TEST(SumOverBody, IsWhatTheCoefficientsSay) {
  const PlacedPerformer placed(Posture("salute"));
  const auto& [body, constants, posed, bone_direction] = placed;
  for (std::size_t group = 0; group < kPointGroupCount; ++group) {
    const Outcome found = Relate(QueryOf(placed, group), FastestLanes());
    const BodySum sum = SumOverBody(found.mesh, constants, posed, group, true);
    const BodySum two = SumOverBody(found.mesh, constants, posed, group, true, LaneWidth::kTwo);
    ExpectEqual(sum.trunk, two.trunk);
    ExpectEqual(sum.head, two.head);
    for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
      Vec3 wanted{0.0};
      for (std::size_t s = 0; s < kSampleCount; ++s) {
        wanted += found.mesh.sample[s][lane] * posed.sample[s];
      }
      const double thickness = constants.thickness[Index(kPointGroups[group][lane])];
      wanted += posed.hips * (Displacement(found.mesh.trunk, PathsFromTrunk(group), lane,
                                           constants.bone_length, thickness) +
                              Displacement(found.mesh.head, PathsFromHead(group), lane,
                                           constants.bone_length, thickness));
      const double scale = found.importance.sum[lane];
      EXPECT_LT(glm::distance(sum.trunk.At(lane) + sum.head.At(lane), wanted), 1e-12 * scale);
    }
  }
}

TEST(SumOfNormals, IsWhatTheCoefficientsSay) {
  const Body& body = StudioPerformer();
  PosedBody posed;
  PlaceBody(body, BodyConstants(body), Posture("salute"), posed);
  NormalCoordinates normal;
  Vec3 wanted{0.0};
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    const double k = static_cast<double>(t);
    const Vec3 part{std::sin(k), std::cos(k), std::sin(3.0 * k)};
    normal.triangle[t / 4].Set(t % 4, part);
    wanted += part.x * posed.triangle[t / 4].normal.At(t % 4) +
              part.y * posed.tangent[t / 4].along.At(t % 4) +
              part.z * posed.tangent[t / 4].third.At(t % 4);
  }
  EXPECT_LT(glm::distance(SumOfNormals(normal, posed), wanted), 1e-12);
  EXPECT_EQ(SumOfNormals(normal, posed, LaneWidth::kTwo), SumOfNormals(normal, posed));
}

struct CapsuleOutcome {
  std::array<CapsuleQuad, kOtherCapsuleCount> relations{};
  GroupDistances distances{};
  Importances importance;
};

CapsuleOutcome RelateToCapsules(const GroupQuery& query, LaneWidth lanes = FastestLanes()) {
  CapsuleOutcome outcome;
  ego::RelateToCapsules(query, EgocentricForm{}, outcome.relations, outcome.distances,
                        outcome.importance, lanes);
  return outcome;
}

TEST(RelateToCapsules, GivesTheSameBitsInAnyWidth) {
  for (const auto& [name, pose] : StudioPostures()) {
    const PlacedPerformer placed(pose);
    for (std::size_t group = 0; group < kPointGroupCount; ++group) {
      const CapsuleOutcome two = RelateToCapsules(QueryOf(placed, group), LaneWidth::kTwo);
      const CapsuleOutcome fastest = RelateToCapsules(QueryOf(placed, group));
      EXPECT_EQ(two.importance.sum, fastest.importance.sum);
      EXPECT_EQ(two.importance.max, fastest.importance.max);
      EXPECT_EQ(two.importance.priority, fastest.importance.priority);
      for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
        EXPECT_EQ(two.relations[slot].importance, fastest.relations[slot].importance);
        EXPECT_EQ(two.relations[slot].axial, fastest.relations[slot].axial);
        ExpectEqual(two.relations[slot].direction_ls, fastest.relations[slot].direction_ls);
        EXPECT_EQ(two.distances[slot].inside, fastest.distances[slot].inside);
        EXPECT_EQ(two.distances[slot].gap, fastest.distances[slot].gap);
        EXPECT_EQ(two.distances[slot].cosine, fastest.distances[slot].cosine);
      }
    }
  }
}

/// Equations 4 to 6 written out for one point and one capsule after the other, read on the body
/// itself and on one of other lengths.
TEST(RelateToCapsules, AgreesWithTheEquationsCapsuleByCapsule) {
  const PlacedPerformer placed(Posture("hands_clasped"));
  const auto& [body, constants, posed, bone_direction] = placed;
  Body other = body;
  BodyConstants other_constants = constants;
  for (std::size_t k = 0; k < kBoneCount; ++k) {
    other_constants.bone_length[k] *= 0.6 + 0.1 * static_cast<double>(k % 9);
  }
  for (double& radius : other.surface.limb_radius) radius *= 1.4;
  for (HandSurface& hand : other.surface.hand) hand.half_thickness *= 0.8;
  for (double& thickness : other_constants.thickness) thickness *= 1.7;
  for (std::size_t j = 0; j < kLimbPointCount; ++j) {
    const auto limb_point = static_cast<LimbPoint>(j);
    const Limb limb = LimbOf(limb_point);
    const std::size_t lane = LaneOf(limb_point);
    const std::size_t group = GroupOf(limb_point);
    const CapsuleOutcome found = RelateToCapsules(QueryOf(placed, group));
    std::array<Quad, kOtherCapsuleCount> reach;
    CapsuleReaches(other, other_constants, EgocentricForm{}, group, found.distances, reach);
    double sum = 0.0;
    for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
      if (!RelatesToCapsule(EgocentricForm{}, group, slot)) {
        EXPECT_EQ(reach[slot][lane], 0.0);
        continue;
      }
      const bool hand = slot == kHandSlot;
      const PosedCapsule& capsule =
          hand ? posed.hand[Index(Mirror(limb))] : posed.capsule[Index(OtherSegment(limb, slot))];
      const double t = ClosestOnSegment(posed.point[j], capsule.start, capsule.end);
      const Vec3 away = posed.point[j] - capsule.At(t);
      const double length = glm::length(away);
      const double filled = capsule.radius + constants.thickness[j];
      const double other_radius = hand ? other.surface.hand[Index(Mirror(limb))].half_thickness
                                       : other.surface.limb_radius[Index(OtherSegment(limb, slot))];
      const double other_filled = other_radius + other_constants.thickness[j];
      const KinematicPath& path = PathBetween(
          hand ? JointsOf(Mirror(limb)).end : StartJoint(OtherSegment(limb, slot)), limb_point);
      const double wanted =
          other_filled * std::min(1.0, length / filled) +
          std::max(0.0, length - filled) /
              PathFactor(path, away / length, bone_direction, constants.bone_length) *
              PathFactor(path, away / length, bone_direction, other_constants.bone_length);
      EXPECT_NEAR(reach[slot][lane], wanted, 1e-12);
      const CapsuleQuad& relation = found.relations[slot];
      EXPECT_NEAR(relation.axial[lane], t, 1e-12);
      EXPECT_LT(glm::distance(capsule.frame * relation.direction_ls.At(lane), away / length),
                1e-12);
      EXPECT_NEAR(relation.importance[lane], Proximity(length - filled, 0.01), 1e-9);
      sum += relation.importance[lane];
    }
    EXPECT_NEAR(found.importance.sum[lane], sum, 1e-9 * sum);
  }
}

TEST(MeshPaths, RunAlongTheBonesOfEveryTrianglesPath) {
  for (std::size_t j = 0; j < kLimbPointCount; ++j) {
    const auto to = static_cast<LimbPoint>(j);
    for (std::size_t t = 0; t < kTriangleCount; ++t) {
      const MeshPaths& paths =
          t < kTrunkTriangleCount ? PathsFromTrunk(GroupOf(to)) : PathsFromHead(GroupOf(to));
      const KinematicPath& path = PathBetween(ParentJoint(t), to);
      for (std::size_t i = paths.begin[t]; i < paths.length; ++i) {
        const std::size_t k = i - paths.begin[t];
        EXPECT_EQ(paths.bone[i][LaneOf(to)], k < path.length ? path.bone[k] : 0);
      }
      EXPECT_GE(paths.length - paths.begin[t], path.length);
    }
  }
}

}  // namespace
}  // namespace ego::test
