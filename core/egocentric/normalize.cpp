// SPDX-License-Identifier: MIT
#include "core/egocentric/normalize.h"

#include <algorithm>
#include <cmath>

#include "core/egocentric/clearance.h"
#include "core/egocentric/importance.h"
#include "core/egocentric/mesh_relations.h"
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
  const double tau = MeasurePath(path, direction, context.posed.bone_direction,
                                 context.constants.bone_length, distance.cosine);
  distance.gap = std::max(0.0, reach - filled) / std::max(tau, 1e-9 * context.body.height);
}

void RelateToCapsule(const Context& context, const PosedCapsule& capsule, HumanoidJoint parent,
                     LimbPoint j, ImportanceTotal& importance, CapsuleRelation& relation) {
  const Vec3& p = context.posed.point[Index(j)];
  const double own =
      context.settings.form.own_thickness ? context.constants.thickness[Index(j)] : 0.0;
  relation.axial = ClosestOnSegment(p, capsule.start, capsule.end);
  const Vec3 v = p - capsule.At(relation.axial);
  const double reach = glm::length(v);
  const Vec3 direction = reach > 1e-12 ? (1.0 / reach) * v : capsule.frame[1];
  relation.direction_ls = direction * capsule.frame;
  NormalizeDistance(context, PathBetween(parent, j), direction, reach, capsule.radius + own,
                    relation.distance);
  // The displacement from a capsule is always along its normal.
  relation.importance = importance.Add(reach - capsule.radius - own, 1.0);
}

GroundRelation RelateToGround(const Context& context, LimbPoint j, ImportanceTotal& importance) {
  const double h_root = context.body.standing_root_height;
  const Vec3& ankle = context.posed.point[Index(j)];
  const Vec3& root = context.posed.pose.position_ws[0];
  GroundRelation relation;
  Vec3 sole = ankle;
  Vec2 standing{0.0};
  if (context.settings.form.sole_contact) {
    const Quat& foot = context.posed.pose.Rotation(JointOf(j));
    relation.on_ball = StandsOnBall(context.body, LimbOf(j), foot);
    const SoleOffset offset =
        MeasureSole(context.body, context.constants, LimbOf(j), foot, relation.on_ball);
    sole = {ankle.x + offset.middle.x, ankle.y + offset.low, ankle.z + offset.middle.z};
    standing = StandingPlace(context.body, context.constants, LimbOf(j), foot,
                             context.posed.pose.rotation_ws[0]);
  }
  relation.offset = (Vec2{sole.x - root.x, sole.z - root.z} - standing) / h_root;
  relation.gap = sole.y / h_root;
  relation.importance =
      importance.Add(std::abs(sole.y), 1.0, context.scale * context.settings.ground_epsilon);
  return relation;
}

/// A point against everything but trunk and head, whose importances are in `importance` already.
/// Returns what all importances are to be multiplied by.
double NormalizePoint(const Context& context, LimbPoint j, ImportanceTotal& importance,
                      PointCoordinates& out) {
  const NormalizeSettings& settings = context.settings;
  const Limb limb = LimbOf(j);
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
  out.mesh_importance_max *= share;
  for (CapsuleRelation& relation : out.capsule) relation.importance *= share;
  out.hand.importance *= share;
  out.ground.importance *= share;
  out.importance_sum = importance.sum * context.body.height;
  out.importance_max = importance.max * context.body.height;
  out.priority = importance.priority * context.body.height;
  return share;
}

/// `importance` are those of all triangles for the orienting point, `share` what they are to be
/// multiplied by.
void NormalizeNormal(const Context& context, Limb limb, const MeshImportances& importance,
                     std::size_t lane, double share, NormalCoordinates& out) {
  const BodySurface& surface = context.body.surface;
  const std::size_t side = IsLeft(limb) ? 0 : 1;
  const Vec3& normal_ms =
      IsArm(limb) ? surface.hand[side].palm_normal_ms : surface.foot[side].sole_normal_ms;
  const Vec3 normal = context.posed.pose.Rotation(JointsOf(limb).end) * normal_ms;
  const Lanes3 both = Splat<Lanes>(normal);
  for (std::size_t t = 0; t < kTriangleCount; t += kLaneCount<Lanes>) {
    const std::size_t first = t % 4;
    const TangentQuad& tangent = context.posed.tangent[t / 4];
    const Lanes weight = {share * importance.triangle[t][lane],
                          share * importance.triangle[t + 1][lane]};
    const auto part = [&](const QuadVectors& of) {
      return weight * Dot(both, Load<Lanes>(of, first));
    };
    Store<Lanes>(Lanes3{part(context.posed.triangle[t / 4].normal), part(tangent.along),
                        part(tangent.third)},
                 out.triangle[t / 4], first);
  }
  for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
    const PosedCapsule& capsule = context.posed.capsule[Index(OtherSegment(limb, slot))];
    out.capsule[slot] = glm::transpose(capsule.frame) * normal;
  }
  out.ground = normal;
}

/// The points of a group, and the normals that they orient.
void NormalizeGroup(const Context& context, std::size_t group, EgocentricPose& out) {
  const NormalizeSettings& settings = context.settings;
  const MeshQuery query{.constants = context.constants,
                        .posed = context.posed,
                        .group = group,
                        .own_thickness = settings.form.own_thickness,
                        .epsilon = context.scale * settings.surface_epsilon,
                        .gamma_epsilon = context.scale * settings.gamma_epsilon,
                        .softness = context.scale * settings.orthogonality_softness,
                        .floor = settings.orthogonality_floor,
                        .least_factor = 1e-9 * context.body.height};
  MeshImportances importances;
  RelateToMeshes(query, out.mesh[group], importances);
  Quad share{};
  for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
    const LimbPoint j = kPointGroups[group][lane];
    if (IsHandPoint(j) && !settings.form.hand_points) continue;
    ImportanceTotal total{query.epsilon, query.gamma_epsilon, importances.sum[lane],
                          importances.max[lane], importances.priority[lane]};
    share[lane] = NormalizePoint(context, j, total, out.point[Index(j)]);
    const Limb limb = LimbOf(j);
    if (j != OrientingPoint(out, limb)) continue;
    NormalizeNormal(context, limb, importances, lane, share[lane], out.normal[Index(limb)]);
  }
  ScaleMeshCoordinates(share, group, out.mesh[group]);
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

  for (std::size_t group = 0; group < kPointGroupCount; ++group) {
    NormalizeGroup(context, group, out);
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
