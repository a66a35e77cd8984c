// SPDX-License-Identifier: MIT
#include "core/pipeline/skeleton_capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/body/surface_fit.h"
#include "core/skeleton/humanoid_map.h"
#include "core/skeleton/rest_alignment.h"

namespace ego {
namespace {

using J = HumanoidJoint;

// Shares of the template's height (core/body/body.cpp).
constexpr double kLegShare = 0.84 / 1.78;  // hip joint to ankle, stretched
constexpr double kHeadJointShare = 1.60 / 1.78;
constexpr double kAnkleShare = 0.08 / 1.78;  // joint above the sole
constexpr double kToesShare = 0.02 / 1.78;
constexpr double kToeTipShare = 0.01 / 1.78;
constexpr double kFootShare = 0.21 / 1.78;   // ankle to toe tip, level
constexpr double kShortFoot = 0.75;          // of that: what ends here is the ball of the foot
constexpr double kHandShare = 0.185 / 1.78;  // wrist to fingertip
constexpr double kPalmInHand = 0.085 / 0.185;
constexpr double kUsualHeight = 1.7;

/// Global transforms of all joints of a tree in one pose, file space.
struct GlobalPose {
  std::vector<Quat> rotation;
  std::vector<Vec3> position;
};

GlobalPose FramePose(const JointMotion& motion, std::size_t frame) {
  const std::size_t n = motion.tree.joints.size();
  GlobalPose pose{std::vector<Quat>(n), std::vector<Vec3>(n)};
  for (std::size_t j = 0; j < n; ++j) {
    const Quat& rotation = motion.rotation_ls[frame * n + j];
    const Vec3& translation = motion.translation_ls[frame * n + j];
    if (motion.tree.joints[j].parent < 0) {
      pose.rotation[j] = rotation;
      pose.position[j] = translation;
      continue;
    }
    const auto parent = static_cast<std::size_t>(motion.tree.joints[j].parent);
    pose.rotation[j] = pose.rotation[parent] * rotation;
    pose.position[j] = pose.position[parent] + pose.rotation[parent] * translation;
  }
  return pose;
}

std::vector<Mat4> Matrices(const GlobalPose& pose) {
  std::vector<Mat4> matrices(pose.position.size());
  for (std::size_t j = 0; j < matrices.size(); ++j) {
    matrices[j] = glm::mat4_cast(pose.rotation[j]);
    matrices[j][3] = Vec4(pose.position[j], 1.0);
  }
  return matrices;
}

std::optional<Vec3> Direction(const Vec3& v) {
  const double length = glm::length(v);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return v / length;
}

/// How far a pose is from a T-pose: 0 for one, 1 with both arms hanging, more for bent legs, bent
/// elbows and raised arms; infinite where the joints have no shape of a person.
double DistanceFromTPose(const HumanoidMap& map, std::span<const Mat4> global) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto at = [&](J joint) {
    return Vec3(global[static_cast<std::size_t>(map.Node(joint))][3]);
  };
  const std::optional<Vec3> up = Direction(at(J::kHead) - at(J::kHips));
  if (!up) return kNone;
  const Vec3 across = at(J::kLeftUpperArm) - at(J::kRightUpperArm);
  const std::optional<Vec3> left = Direction(across - glm::dot(across, *up) * *up);
  if (!left) return kNone;
  double distance = 0.0;
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    const Vec3 base = at(joints.base);
    const Vec3 mid = at(joints.mid);
    const std::optional<Vec3> upper = Direction(mid - base);
    if (!upper) return kNone;
    const Vec3 wanted = !IsArm(limb) ? -*up : IsLeft(limb) ? *left : -*left;
    const double weight = IsArm(limb) ? 0.5 : 2.0;
    distance += weight * (1.0 - glm::dot(*upper, wanted));
    if (map.Node(joints.end) < 0) continue;
    if (const std::optional<Vec3> lower = Direction(at(joints.end) - mid)) {
      distance += 1.0 - glm::dot(*upper, *lower);
    }
  }
  return std::isfinite(distance) ? distance : kNone;
}

/// The tree with the joints at the distances that they keep in the motion: some files move every
/// joint by channels of its own and have offsets that mean nothing.
JointTree WithMotionOffsets(const JointMotion& motion) {
  constexpr std::size_t kSampledFrames = 100;
  constexpr double kSame = 1e-3;  // relative
  JointTree tree = motion.tree;
  const std::size_t n = tree.joints.size();
  const std::size_t step = std::max<std::size_t>(1, motion.frame_count / kSampledFrames);
  for (std::size_t j = 0; j < n; ++j) {
    if (tree.joints[j].parent < 0) continue;
    Vec3 sum{0.0};
    double count = 0.0;
    for (std::size_t f = 0; f < motion.frame_count; f += step, count += 1.0) {
      sum += motion.translation_ls[f * n + j];
    }
    const Vec3 mean = sum / count;
    const Vec3 offset(tree.joints[j].rest_local[3]);
    if (glm::length(mean - offset) > kSame * glm::length(mean)) {
      tree.joints[j].rest_local[3] = Vec4(mean, 1.0);
    }
  }
  return tree;
}

/// The tree with a frame of the motion as its rest pose.
JointTree RestingIn(const JointMotion& motion, std::size_t frame) {
  JointTree tree = motion.tree;
  const std::size_t n = tree.joints.size();
  for (std::size_t j = 0; j < n; ++j) {
    tree.joints[j].rest_local = glm::mat4_cast(motion.rotation_ls[frame * n + j]);
    tree.joints[j].rest_local[3] = Vec4(motion.translation_ls[frame * n + j], 1.0);
  }
  return tree;
}

/// The humanoid in the motion's tree, and the rest pose from which the canonical one is found.
struct RestPose {
  JointTree tree;
  HumanoidMap map;
  std::vector<Mat4> global;
};

/// Maps the joints in the zero pose, else in the first frame that shows a person.
Result<RestPose> FindHumanoid(const JointMotion& motion) {
  constexpr std::size_t kTries = 8;
  const JointTree zero = WithMotionOffsets(motion);
  Result<HumanoidMap> map = MapHumanoid(zero);
  if (map) return RestPose{zero, *std::move(map), zero.RestGlobal()};
  for (std::size_t k = 0; k < kTries; ++k) {
    JointTree tree = RestingIn(motion, k * (motion.frame_count - 1) / (kTries - 1));
    if (Result<HumanoidMap> other = MapHumanoid(tree)) {
      std::vector<Mat4> global = tree.RestGlobal();
      return RestPose{std::move(tree), *std::move(other), std::move(global)};
    }
  }
  return Error{map.error()};
}

/// Keeps a rest pose that a person could stand in; else takes the frame nearest to a T-pose, and
/// maps the joints again there.
void ImproveRestPose(const JointMotion& motion, RestPose& rest, std::vector<std::string>& notes) {
  constexpr double kGoodEnough = 1.3;  // arms down and legs a little apart
  constexpr std::size_t kSampledFrames = 1000;
  double distance = DistanceFromTPose(rest.map, rest.global);
  if (distance < kGoodEnough) return;
  const std::size_t step = std::max<std::size_t>(1, motion.frame_count / kSampledFrames);
  std::size_t chosen = motion.frame_count;
  for (std::size_t f = 0; f < motion.frame_count; f += step) {
    const double d = DistanceFromTPose(rest.map, Matrices(FramePose(motion, f)));
    if (d >= distance) continue;
    distance = d;
    chosen = f;
  }
  if (chosen == motion.frame_count) return;
  notes.push_back("the zero pose is no standing pose; frame " + std::to_string(chosen + 1) +
                  " serves instead");
  rest.tree = RestingIn(motion, chosen);
  rest.global = rest.tree.RestGlobal();
  if (Result<HumanoidMap> map = MapHumanoid(rest.tree)) rest.map = *std::move(map);
}

/// Metres per file unit from the length of the legs; nothing when they have none.
std::optional<double> ChooseUnit(const HumanoidMap& map, std::span<const Mat4> rest,
                                 std::vector<std::string>& notes) {
  struct Unit {
    const char* name;
    double metres;
  };
  constexpr std::array<Unit, 5> kUnits = {{{"metres", 1.0},
                                           {"centimetres", 1e-2},
                                           {"inches", 0.0254},
                                           {"millimetres", 1e-3},
                                           {"decimetres", 1e-1}}};
  const auto at = [&](J joint) { return Vec3(rest[static_cast<std::size_t>(map.Node(joint))][3]); };
  double leg = 0.0;
  for (const Limb limb : {Limb::kLeftLeg, Limb::kRightLeg}) {
    const LimbJoints joints = JointsOf(limb);
    const double upper = glm::length(at(joints.mid) - at(joints.base));
    const double lower =
        map.Node(joints.end) < 0 ? upper : glm::length(at(joints.end) - at(joints.mid));
    leg += 0.5 * (upper + lower);
  }
  const double height = leg / kLegShare;  // file units
  if (!(height > 1e-9 && height < 1e12)) return std::nullopt;
  const Unit* best = nullptr;
  const auto strangeness = [&](const Unit& unit) {
    return std::abs(std::log(height * unit.metres / kUsualHeight));
  };
  for (const Unit& unit : kUnits) {
    const double metres = height * unit.metres;
    if (metres < 1.0 || metres > 2.5) continue;
    if (best == nullptr || strangeness(unit) < strangeness(*best)) best = &unit;
  }
  if (best != nullptr) return best->metres;
  notes.push_back("the unit is not known; the person is taken to be 1.7 m tall");
  return kUsualHeight / height;
}

/// A node of the rest pose in the canonical pose, carried by a joint, metres.
Vec3 CanonicalPoint(const Alignment& alignment, std::span<const Mat4> rest, J joint, int node) {
  return Vec3(alignment.CanonicalFromRest(joint) * rest[static_cast<std::size_t>(node)][3]);
}

/// Puts the ground below the feet: joints lie inside the foot, by as much as the template's.
void MoveGroundToSoles(Alignment& alignment, const HumanoidMap& map, std::span<const Mat4> rest,
                       double height) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(alignment.skeleton);
  double sole = std::numeric_limits<double>::infinity();
  for (std::size_t side = 0; side < 2; ++side) {
    const J foot = side == 0 ? J::kLeftFoot : J::kRightFoot;
    const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
    if (map.Node(toes) >= 0) {
      sole = std::min(sole, canonical[Index(toes)].y - kToesShare * height);
    } else {
      sole = std::min(sole, canonical[Index(foot)].y - kAnkleShare * height);
    }
    if (map.toe_tip[side] >= 0) {
      const Vec3 tip = CanonicalPoint(alignment, rest, toes, map.toe_tip[side]);
      const bool is_ball = tip.z - canonical[Index(foot)].z < kShortFoot * kFootShare * height;
      sole = std::min(sole, tip.y - (is_ball ? kToesShare : kToeTipShare) * height);
    }
  }
  alignment.MoveGround(sole);
}

/// Crown above ground: from an end site right above the head joint where there is one.
double CrownHeight(const JointMotion& motion, const Alignment& alignment, const HumanoidMap& map,
                   std::span<const Mat4> rest) {
  const Vec3 head = CanonicalPositions(alignment.skeleton)[Index(J::kHead)];
  const double usual = head.y * (1.0 / kHeadJointShare - 1.0);
  for (std::size_t n = 0; n < motion.tree.joints.size(); ++n) {
    if (motion.tree.joints[n].parent != map.Node(J::kHead)) continue;
    const Vec3 top = CanonicalPoint(alignment, rest, J::kHead, static_cast<int>(n)) - head;
    if (top.y > 0.6 * usual && top.y < 1.8 * usual && std::hypot(top.x, top.z) < 0.3 * top.y) {
      return head.y + top.y;
    }
  }
  return head.y + usual;
}

/// Hands and feet as long as the motion's own skeleton shows them, within what people have.
void FitExtremities(Body& body, const Alignment& alignment, const HumanoidMap& map,
                    std::span<const Mat4> rest) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const J wrist = side == 0 ? J::kLeftHand : J::kRightHand;
    if (map.fingertip[side] >= 0 && map.Node(wrist) >= 0) {
      const Vec3 tip = CanonicalPoint(alignment, rest, wrist, map.fingertip[side]);
      const double length = glm::length(tip - canonical[Index(wrist)]) / body.height;
      if (length > 0.7 * kHandShare && length < 1.4 * kHandShare) {
        HandSurface& hand = body.surface.hand[side];
        const double x = canonical[Index(wrist)].x;
        hand.fingertip_ms.x = x + sign * length * body.height;
        hand.palm_ms.x = x + sign * kPalmInHand * length * body.height;
      }
    }
    const J ankle = side == 0 ? J::kLeftFoot : J::kRightFoot;
    const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
    FootSurface& foot = body.surface.foot[side];
    if (map.toe_tip[side] >= 0) {
      const double z = CanonicalPoint(alignment, rest, toes, map.toe_tip[side]).z;
      const double length = (z - canonical[Index(ankle)].z) / body.height;
      if (length > kShortFoot * kFootShare && length < 1.4 * kFootShare) foot.toe_tip_ms.z = z;
    }
    if (map.Node(toes) >= 0) {
      const double ball = canonical[Index(toes)].z;
      if (ball > canonical[Index(ankle)].z + 0.2 * kFootShare * body.height &&
          ball < foot.toe_tip_ms.z) {
        foot.ball_ms.z = ball;
      }
    }
  }
}

/// Height of the lowest point of both feet in a pose, metres.
double LowestSole(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                  const Pose& pose) {
  const ModelPose posed = ForwardKinematics(body.skeleton, pose);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t side = 0; side < 2; ++side) {
    const FootSurface& foot = body.surface.foot[side];
    const J ankle = side == 0 ? J::kLeftFoot : J::kRightFoot;
    const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
    for (const auto& [joint, point] :
         {std::pair{ankle, foot.heel_ms}, std::pair{ankle, foot.ball_ms},
          std::pair{toes, foot.toe_tip_ms}}) {
      lowest = std::min(lowest, PosePoint(canonical, posed, joint, point).y);
    }
  }
  return lowest;
}

/// The floor of a take: a height that the feet reach often and hardly ever pass. Metres.
double FloorHeight(const Body& body, std::span<const Pose> poses) {
  constexpr double kShare = 0.05;
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  std::vector<double> lowest;
  lowest.reserve(poses.size());
  for (const Pose& pose : poses) lowest.push_back(LowestSole(body, canonical, pose));
  const auto low =
      lowest.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(lowest.size() - 1));
  std::nth_element(lowest.begin(), low, lowest.end());
  return *low;
}

}  // namespace

Result<CapturedMotion> CaptureFromJointMotion(const JointMotion& motion,
                                              std::vector<std::string>* notes) {
  std::vector<std::string> unheard;
  std::vector<std::string>& said = notes != nullptr ? *notes : unheard;
  if (motion.frame_count == 0) return Error{"the motion has no frames"};
  Result<RestPose> found = FindHumanoid(motion);
  if (!found) return Error{found.error()};
  ImproveRestPose(motion, *found, said);
  const HumanoidMap& map = found->map;
  const std::vector<Mat4>& rest = found->global;
  said.insert(said.end(), map.notes.begin(), map.notes.end());

  const std::optional<double> metres_per_unit = ChooseUnit(map, rest, said);
  if (!metres_per_unit) return Error{"the legs of the skeleton have no usable length"};
  Result<Alignment> alignment = AlignRestPose(found->tree, rest, map, *metres_per_unit);
  if (!alignment) return Error{alignment.error()};
  const double first_guess =
      CanonicalPositions(alignment->skeleton)[Index(J::kHead)].y / kHeadJointShare;
  MoveGroundToSoles(*alignment, map, rest, first_guess);

  CapturedMotion captured;
  captured.name = motion.name;
  captured.rate_hz = motion.rate_hz;
  captured.performer = BodyFromSkeleton(motion.name, alignment->skeleton,
                                        CrownHeight(motion, *alignment, map, rest));
  FitExtremities(captured.performer, *alignment, map, rest);

  std::vector<Quat> rest_rotation(rest.size());
  std::transform(rest.begin(), rest.end(), rest_rotation.begin(), RotationOf);
  captured.poses.reserve(motion.frame_count);
  for (std::size_t f = 0; f < motion.frame_count; ++f) {
    const GlobalPose global = FramePose(motion, f);
    captured.poses.push_back(
        PoseFromNodes(*alignment, map, rest_rotation, global.rotation, global.position));
  }
  captured.floor_offset = -FloorHeight(captured.performer, captured.poses);
  for (Pose& pose : captured.poses) pose.root_ws.y += captured.floor_offset;
  FitSurfaceToMotion(captured.performer, captured.poses);
  return captured;
}

}  // namespace ego
