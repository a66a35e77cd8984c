// SPDX-License-Identifier: MIT
#include "core/egocentric/normalize.h"

#include <algorithm>
#include <cmath>

#include "core/egocentric/capsule_relations.h"
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
  const BoneDirections bone_direction;
  double scale;  // height over 1.78 m: what the settings' lengths are multiplied by
};

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

/// A point against the ground, with what it has to capsules; those importances and the meshes' are
/// in `importance` already. Returns what all importances are to be multiplied by.
double NormalizePoint(const Context& context, LimbPoint j, double mesh_importance_max,
                      const std::array<CapsuleQuad, kOtherCapsuleCount>& capsule,
                      ImportanceTotal& importance, PointCoordinates& out) {
  const Limb limb = LimbOf(j);
  const std::size_t group = GroupOf(j);
  const std::size_t lane = LaneOf(j);
  out.mesh_importance_max = mesh_importance_max;
  for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
    CapsuleRelation& relation = slot == kHandSlot ? out.hand : out.capsule[slot];
    if (RelatesToCapsule(context.settings.form, group, slot)) {
      relation = {capsule[slot].importance[lane], capsule[slot].axial[lane],
                  capsule[slot].direction_ls.At(lane)};
    } else {
      relation = {};
    }
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
void NormalizeNormal(const Context& context, Limb limb, const TriangleImportances& importance,
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
    const Lanes weight = {share * importance[t][lane], share * importance[t + 1][lane]};
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
  const GroupQuery query{.constants = context.constants,
                         .posed = context.posed,
                         .bone_direction = context.bone_direction,
                         .group = group,
                         .own_thickness = settings.form.own_thickness,
                         .epsilon = context.scale * settings.surface_epsilon,
                         .gamma_epsilon = context.scale * settings.gamma_epsilon,
                         .softness = context.scale * settings.orthogonality_softness,
                         .floor = settings.orthogonality_floor,
                         .least_factor = 1e-9 * context.body.height};
  Importances importance;
  TriangleImportances triangle;
  RelateToMeshes(query, out.mesh[group], importance, triangle);
  const Quad mesh_importance_max = importance.max;
  std::array<CapsuleQuad, kOtherCapsuleCount> capsule;
  RelateToCapsules(query, settings.form, capsule, out.capsule_distance[group], importance);
  Quad share{};
  for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
    const LimbPoint j = kPointGroups[group][lane];
    if (IsHandPoint(j) && !settings.form.hand_points) continue;
    ImportanceTotal total{query.epsilon, query.gamma_epsilon, importance.sum[lane],
                          importance.max[lane], importance.priority[lane]};
    share[lane] =
        NormalizePoint(context, j, mesh_importance_max[lane], capsule, total, out.point[Index(j)]);
    const Limb limb = LimbOf(j);
    if (j != OrientingPoint(out, limb)) continue;
    NormalizeNormal(context, limb, triangle, lane, share[lane], out.normal[Index(limb)]);
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
  const Context context{
      performer, settings, constants, posed, BoneDirectionsOf(posed), performer.height / 1.78};

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
