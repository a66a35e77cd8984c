// SPDX-License-Identifier: MIT
#include "core/egocentric/normalize.h"

#include <algorithm>
#include <cmath>

#include "core/egocentric/clearance.h"
#include "core/egocentric/importance.h"
#include "core/egocentric/posed_body.h"
#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// One posture on its way: what the steps below share.
struct Context {
  const Body& body;
  const NormalizeSettings& settings;
  const BodyConstants& constants;
  const PosedBody& posed;
  double scale;  // height over 1.78 m: what the settings' lengths are multiplied by
};

/// Equations 4 and 5 for a displacement of length `reach` along the unit `direction`, of which
/// `filled` lies inside the surfaces.
void NormalizeDistance(const Context& context, const KinematicPath& path, const Vec3& direction,
                       double reach, double filled, NormalizedDistance& distance) {
  distance.inside = filled > 0.0 ? std::min(1.0, reach / filled) : 1.0;
  CosinesAlong(path, direction, context.posed.bone_direction, distance.cosine);
  const double tau = PathFactor(path, distance.cosine, context.constants.bone_length);
  distance.gap = std::max(0.0, reach - filled) / std::max(tau, 1e-9 * context.body.height);
}

/// Importances before normalisation are collected here: sum, largest, and the one for gamma.
struct Importance {
  double epsilon;
  double gamma_epsilon;
  double sum = 0.0;
  double max = 0.0;
  double priority = 0.0;

  double Of(double gap, double orthogonality) { return Of(gap, orthogonality, epsilon); }
  double Of(double gap, double orthogonality, double saturation) {
    const double importance = Proximity(gap, saturation) * orthogonality;
    sum += importance;
    max = std::max(max, importance);
    priority = std::max(priority, Proximity(gap, gamma_epsilon) * orthogonality);
    return importance;
  }
};

/// The bones to one limb point, component by component, so that all are treated at once.
struct PathBones {
  PathBones(const Context& context, const MeshPaths& all) : paths(all) {
    for (std::size_t i = 0; i < paths.length; ++i) {
      const Vec3& direction = context.posed.bone_direction[paths.bone[i]];
      x[i] = direction.x;
      y[i] = direction.y;
      z[i] = direction.z;
      length[i] = context.constants.bone_length[paths.bone[i]];
    }
  }
  const MeshPaths& paths;
  std::array<double, kMaxPathLength> x{};
  std::array<double, kMaxPathLength> y{};
  std::array<double, kMaxPathLength> z{};
  std::array<double, kMaxPathLength> length{};
};

/// Relations to the triangles of one mesh, summed in world space.
struct MeshSum {
  Vec3 inside{0.0};
  std::array<double, kMaxPathLength> x{};
  std::array<double, kMaxPathLength> y{};
  std::array<double, kMaxPathLength> z{};
};

/// Relates a point to all triangles of one mesh; `weight` are their importances before
/// normalisation.
void RelateToMesh(const Context& context, std::size_t first, std::size_t count, LimbPoint j,
                  const MeshPaths& paths, Importance& importance,
                  std::array<double, kTriangleCount>& weight, PointCoordinates& out,
                  MeshRelations& relations) {
  const Vec3& p = context.posed.point[Index(j)];
  const double filled =
      context.settings.form.own_thickness ? context.constants.thickness[Index(j)] : 0.0;
  const double softness = context.scale * context.settings.orthogonality_softness;
  const double least_tau = 1e-9 * context.body.height;
  const PathBones bones(context, paths);
  MeshSum sum;
  for (std::size_t t = first; t < first + count; ++t) {
    const Triangle& triangle = context.posed.triangle[t];
    const Vec3 barycentric = ClosestOnTriangle(triangle, p);
    const Vec3 v = p - AtBarycentric(triangle, barycentric);
    const double reach = glm::length(v);
    const Vec3 direction = reach > 1e-12 ? v / reach : triangle.normal;
    const double lambda =
        importance.Of(reach - filled, Orthogonality(glm::dot(v, triangle.normal), reach, softness,
                                                    context.settings.orthogonality_floor));
    weight[t] = lambda;
    relations.importance += lambda;
    const SampleTriangle& corner = SampleTriangles()[t];
    for (std::size_t k = 0; k < 3; ++k) {
      out.sample[Index(corner[k])] += lambda * barycentric[static_cast<int>(k)];
    }
    const double inside = filled > 0.0 ? std::min(1.0, reach / filled) : 1.0;
    sum.inside += (lambda * inside) * direction;

    // Equations 4 and 5: the gap over tau, spread over the bones again.
    const std::size_t parent = Index(ParentJoint(t));
    const std::size_t used = bones.paths.used[parent];
    const std::array<double, kMaxPathLength>& on_path = bones.paths.on_path[parent];
    std::array<double, kMaxPathLength> factor;
    double tau = 0.0;
    for (std::size_t i = 0; i < used; ++i) {
      factor[i] = on_path[i] *
                  (kLeastCosine + std::abs(direction.x * bones.x[i] + direction.y * bones.y[i] +
                                           direction.z * bones.z[i]));
    }
    for (std::size_t i = 0; i < used; ++i) tau += bones.length[i] * factor[i];
    const double gap = std::max(0.0, reach - filled) / std::max(tau, least_tau);
    const Vec3 step = (lambda * gap) * direction;
    for (std::size_t i = 0; i < used; ++i) {
      sum.x[i] += factor[i] * step.x;
      sum.y[i] += factor[i] * step.y;
      sum.z[i] += factor[i] * step.z;
    }
  }
  relations.inside = sum.inside * context.posed.hips;
  for (std::size_t i = 0; i < kMaxPathLength; ++i) {
    relations.along[i] = Vec3{sum.x[i], sum.y[i], sum.z[i]} * context.posed.hips;
  }
}

void Multiply(MeshRelations& relations, double share) {
  relations.importance *= share;
  relations.inside *= share;
  for (Vec3& along : relations.along) along *= share;
}

void RelateToCapsule(const Context& context, const PosedCapsule& capsule, HumanoidJoint parent,
                     LimbPoint j, Importance& importance, CapsuleRelation& relation) {
  const Vec3& p = context.posed.point[Index(j)];
  const double own =
      context.settings.form.own_thickness ? context.constants.thickness[Index(j)] : 0.0;
  relation.axial = ClosestOnSegment(p, capsule.start, capsule.end);
  const Vec3 v = p - capsule.At(relation.axial);
  const double reach = glm::length(v);
  const Vec3 direction = reach > 1e-12 ? v / reach : capsule.frame[1];
  relation.direction_ls = glm::transpose(capsule.frame) * direction;
  NormalizeDistance(context, PathBetween(parent, j), direction, reach, capsule.radius + own,
                    relation.distance);
  // The displacement from a capsule is always along its normal.
  relation.importance = importance.Of(reach - capsule.radius - own, 1.0);
}

GroundRelation RelateToGround(const Context& context, LimbPoint j, Importance& importance) {
  const double h_root = context.body.standing_root_height;
  const Vec3& ankle = context.posed.point[Index(j)];
  const Vec3& root = context.posed.pose.position_ws[0];
  GroundRelation relation;
  Vec3 sole = ankle;
  if (context.settings.form.sole_contact) {
    const Quat& foot = context.posed.pose.Rotation(JointOf(j));
    relation.on_ball = StandsOnBall(context.body, LimbOf(j), foot);
    const SoleOffset offset =
        MeasureSole(context.body, context.constants, LimbOf(j), foot, relation.on_ball);
    sole = {ankle.x + offset.middle.x, ankle.y + offset.low, ankle.z + offset.middle.z};
  }
  relation.offset = Vec2{sole.x - root.x, sole.z - root.z} / h_root;
  relation.gap = sole.y / h_root;
  relation.importance =
      importance.Of(std::abs(sole.y), 1.0, context.scale * context.settings.ground_epsilon);
  return relation;
}

/// `triangle` are the triangles' shares, for the normals.
void NormalizePoint(const Context& context, LimbPoint j, PointCoordinates& out,
                    std::array<double, kTriangleCount>& triangle) {
  const NormalizeSettings& settings = context.settings;
  const Limb limb = LimbOf(j);
  Importance importance{context.scale * settings.surface_epsilon,
                        context.scale * settings.gamma_epsilon};
  out.sample = {};
  out.trunk = {};
  out.head = {};
  RelateToMesh(context, 0, kTrunkTriangleCount, j, PathsFromTrunk(j), importance, triangle, out,
               out.trunk);
  RelateToMesh(context, kTrunkTriangleCount, kTriangleCount - kTrunkTriangleCount, j,
               PathsFromHead(j), importance, triangle, out, out.head);
  out.mesh_importance_max = importance.max;
  for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
    const LimbSegment other = OtherSegment(limb, slot);
    if (!IsArm(limb) && IsArm(LimbOf(other)) && !settings.form.legs_relate_to_arms) {
      out.capsule[slot] = {};
      continue;
    }
    RelateToCapsule(context, context.posed.capsule[Index(other)], StartJoint(other), j, importance,
                    out.capsule[slot]);
  }
  out.hand = {};
  if (IsArm(limb) && settings.form.hand_points) {
    const Limb other = Mirror(limb);
    RelateToCapsule(context, context.posed.hand[Index(other)], JointsOf(other).end, j, importance,
                    out.hand);
  }
  out.ground = {};
  if (!IsArm(limb) && j == EndPoint(limb)) out.ground = RelateToGround(context, j, importance);

  // Normalised linearly so that they sum to one (section 5.1).
  const double share = 1.0 / importance.sum;
  for (double& weight : triangle) weight *= share;
  for (double& weight : out.sample) weight *= share;
  Multiply(out.trunk, share);
  Multiply(out.head, share);
  out.mesh_importance_max *= share;
  for (CapsuleRelation& relation : out.capsule) relation.importance *= share;
  out.hand.importance *= share;
  out.ground.importance *= share;
  out.importance_sum = importance.sum * context.body.height;
  out.importance_max = importance.max * context.body.height;
  out.priority = importance.priority * context.body.height;
}

void NormalizeNormal(const Context& context, Limb limb,
                     const std::array<double, kTriangleCount>& importance, NormalCoordinates& out) {
  const BodySurface& surface = context.body.surface;
  const std::size_t side = IsLeft(limb) ? 0 : 1;
  const Vec3& normal_ms =
      IsArm(limb) ? surface.hand[side].palm_normal_ms : surface.foot[side].sole_normal_ms;
  const Vec3 normal = context.posed.pose.Rotation(JointsOf(limb).end) * normal_ms;
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    out.triangle[t] = importance[t] * (normal * context.posed.tangent[t]);
  }
  for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
    const PosedCapsule& capsule = context.posed.capsule[Index(OtherSegment(limb, slot))];
    out.capsule[slot] = glm::transpose(capsule.frame) * normal;
  }
  out.ground = normal;
}

/// Both planes of two segments (section 5.3); they share the closest pair.
void NormalizePlanes(const Context& context, LimbSegment i, LimbSegment j, EgocentricPose& out) {
  const PosedCapsule& a = context.posed.capsule[Index(i)];
  const PosedCapsule& b = context.posed.capsule[Index(j)];
  const SegmentPair pair = ClosestOnSegments(a.start, a.end, b.start, b.end);
  const Vec3 from_b = a.At(pair.s) - b.At(pair.t);
  const double distance = glm::length(from_b);
  const Vec3 normal = distance > 1e-9
                          ? from_b / distance
                          : NormalizedOr(glm::cross(a.frame[0], b.frame[0]), b.frame[1]);
  // Measured at the ends, where the half-space is enforced, so that the performer's own posture
  // never violates it.
  const auto slack = [&](const PosedCapsule& own, const Vec3& plane, const Vec3& n) {
    const double ends = std::min(glm::dot(n, own.start - plane), glm::dot(n, own.end - plane));
    return std::min(0.0, ends - a.radius - b.radius) / context.body.height;
  };
  out.plane[Index(i)][SlotOf(LimbOf(i), j)] = {pair.t, glm::transpose(b.frame) * normal,
                                               slack(a, b.At(pair.t), normal)};
  out.plane[Index(j)][SlotOf(LimbOf(j), i)] = {pair.s, glm::transpose(a.frame) * -normal,
                                               slack(b, a.At(pair.s), -normal)};
}

}  // namespace

NormalizeSettings NormalizeSettings::Paper() {
  NormalizeSettings paper;
  paper.form = {.hand_points = false,
                .own_thickness = false,
                .sole_contact = false,
                .legs_relate_to_arms = true,
                .clearance = false};
  paper.surface_epsilon = 0.0005;
  paper.ground_epsilon = 0.0005;
  paper.gamma_epsilon = 0.0005;
  paper.orthogonality_softness = 0.0;
  return paper;
}

void Normalize(const Body& performer, const Pose& pose, const NormalizeSettings& settings,
               EgocentricPose& out) {
  const BodyConstants constants(performer);
  PosedBody posed;
  PlaceBody(performer, constants, pose, posed);
  const Context context{performer, settings, constants, posed, performer.height / 1.78};

  out.form = settings.form;
  out.rotation_ls = pose.rotation_ls;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (performer.skeleton.locked[i]) out.rotation_ls[i] = kIdentity;
  }
  out.rotation_ws = posed.pose.rotation_ws;
  out.root = pose.root_ws / performer.standing_root_height;

  const std::size_t points = settings.form.hand_points ? kLimbPointCount : kLimbJointCount;
  std::array<double, kTriangleCount> triangle;
  for (std::size_t k = 0; k < points; ++k) {
    const auto j = static_cast<LimbPoint>(k);
    NormalizePoint(context, j, out.point[k], triangle);
    const Limb limb = LimbOf(j);
    if (j == OrientingPoint(out, limb)) {
      NormalizeNormal(context, limb, triangle, out.normal[Index(limb)]);
    }
  }
  for (std::size_t i = 0; i < kSegmentCount; ++i) {
    for (std::size_t j = 2 * (i / 2) + 2; j < kSegmentCount; ++j) {
      NormalizePlanes(context, static_cast<LimbSegment>(i), static_cast<LimbSegment>(j), out);
    }
  }
  if (settings.form.clearance) {
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      MeasureClearance(performer, posed, arm, out.clearance[Index(arm)]);
    }
  }
}

}  // namespace ego
