// SPDX-License-Identifier: MIT
#include "assets/calibration/test_postures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/baselines/retarget_method.h"
#include "core/geometry/closest_point.h"
#include "core/metrics/surface_gap.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

/// Rotation that takes the orthonormal pair (a, b) to (c, d).
Quat FrameRotation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Mat3 from(a, b, glm::cross(a, b));
  const Mat3 to(c, d, glm::cross(c, d));
  return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

Vec3 Across(const Vec3& v, const Vec3& axis) {
  return glm::normalize(v - glm::dot(v, axis) * axis);
}

Quat Pitch(double degrees) { return glm::angleAxis(Radians(degrees), Vec3{1.0, 0.0, 0.0}); }
Vec3 SideOf(Limb limb) { return {IsLeft(limb) ? 1.0 : -1.0, 0.0, 0.0}; }

constexpr std::array<J, kLimbCount> kEndOf = {J::kLeftHand, J::kRightHand, J::kLeftFoot,
                                              J::kRightFoot};

/// Puts a posture together: later parts stand on earlier ones.
class PostureBuilder {
 public:
  explicit PostureBuilder(const Body& body)
      : body_(body), rest_(CanonicalPositions(body.skeleton)), pose_(CanonicalPose(body.skeleton)) {
    Update();
  }

  const Pose& pose() const { return pose_; }
  const ModelPose& model() const { return model_; }
  const Vec3& Rest(J joint) const { return rest_[Index(joint)]; }

  void Root(const Vec3& position, const Quat& rotation) {
    pose_.root_ws = position;
    Turn(J::kHips, rotation);
  }
  void Turn(J joint, const Quat& local) {
    pose_.rotation_ls[Index(joint)] = local;
    Update();
  }

  /// Two-bone inverse kinematics in closed form: the end joint at `end`, as near as the limb
  /// reaches, the mid joint towards `hint`.
  void Reach(Limb limb, const Vec3& end, const Vec3& hint, const Quat& end_ws) {
    const LimbJoints joints = JointsOf(limb);
    const Vec3 base = model_.Position(joints.base);
    const double upper = BoneLength(body_.skeleton, joints.mid);
    const double lower = BoneLength(body_.skeleton, joints.end);
    const double wanted = std::max(glm::distance(end, base), 1e-9);
    const Vec3 chord = (end - base) / wanted;
    const double distance =
        std::clamp(wanted, std::abs(upper - lower) + 0.15 * lower, 0.998 * (upper + lower));
    const double along = (distance * distance + upper * upper - lower * lower) / (2.0 * distance);
    const Vec3 mid = base + along * chord +
                     std::sqrt(std::max(0.0, upper * upper - along * along)) * Across(hint, chord);
    const Vec3 upper_way = glm::normalize(mid - base);
    const Vec3 lower_way = glm::normalize(base + distance * chord - mid);
    const Vec3 hinge = glm::normalize(glm::cross(upper_way, lower_way));
    const Vec3 bone = CanonicalDirection(limb);
    SetWorld(joints.base, FrameRotation(bone, FlexionAxis(limb), upper_way, hinge));
    SetWorld(joints.mid, FrameRotation(bone, FlexionAxis(limb), lower_way, hinge));
    SetWorld(joints.end, end_ws);
  }

  /// The palm on a point of the surface, facing it, fingers along `fingers`.
  void Lay(Limb arm, const Vec3& point, const Vec3& surface_normal, const Vec3& fingers,
           const Vec3& elbow) {
    const Vec3 palm = -glm::normalize(surface_normal);
    const Vec3 along = Across(fingers, palm);
    const Quat hand = FrameRotation(CanonicalDirection(arm), {0.0, -1.0, 0.0}, along, palm);
    const Vec3 offset = body_.surface.hand[Index(arm)].palm_ms - Rest(kEndOf[Index(arm)]);
    Reach(arm, point - hand * offset, elbow, hand);
  }
  /// The palm on a limb segment, at a share of its bone, on the side of `toward`.
  void LayOn(Limb arm, LimbSegment segment, double share, const Vec3& toward, const Vec3& fingers,
             const Vec3& elbow) {
    const Vec3 start = model_.Position(StartJoint(segment));
    const Vec3 end = model_.Position(EndJoint(segment));
    const Vec3 out = Across(toward, glm::normalize(end - start));
    const double radius = body_.surface.limb_radius[Index(segment)];
    Lay(arm, glm::mix(start, end, share) + radius * out, out, fingers, elbow);
  }
  void Hang(Limb arm) {
    const LimbJoints joints = JointsOf(arm);
    const double reach =
        BoneLength(body_.skeleton, joints.mid) + BoneLength(body_.skeleton, joints.end);
    const Vec3 down = glm::normalize(Vec3{0.0, -1.0, 0.08} + 0.28 * SideOf(arm));
    Reach(
        arm, model_.Position(joints.base) + 0.985 * reach * down,
        Vec3{0.0, 0.0, -1.0} + 0.3 * SideOf(arm),
        FrameRotation(CanonicalDirection(arm), {0.0, -1.0, 0.0}, down, Across(-SideOf(arm), down)));
  }

  Vec3 Sample(S point) const {
    std::array<Vec3, kSampleCount> sample;
    PoseSamples(body_.skeleton, body_.surface, model_, sample);
    return sample[Index(point)];
  }

 private:
  void Update() { model_ = ForwardKinematics(body_.skeleton, pose_); }
  void SetWorld(J joint, const Quat& world) {
    Turn(joint, glm::normalize(glm::conjugate(model_.Rotation(Parent(joint))) * world));
  }

  const Body& body_;
  std::array<Vec3, kJointCount> rest_;
  Pose pose_;
  ModelPose model_;
};

/// How much room is between two limb segments, metres, negative when they overlap.
double CapsuleGap(const Body& body, const ModelPose& pose, LimbSegment a, LimbSegment b) {
  const Vec3 a0 = pose.Position(StartJoint(a));
  const Vec3 a1 = pose.Position(EndJoint(a));
  const Vec3 b0 = pose.Position(StartJoint(b));
  const Vec3 b1 = pose.Position(EndJoint(b));
  const SegmentPair pair = ClosestOnSegments(a0, a1, b0, b1);
  return glm::distance(glm::mix(a0, a1, pair.s), glm::mix(b0, b1, pair.t)) -
         body.surface.limb_radius[Index(a)] - body.surface.limb_radius[Index(b)];
}

constexpr LimbSegment kUpperLeg = LimbSegment::kLeftThigh;  // crossed legs: carries ...
constexpr LimbSegment kLowerLeg = LimbSegment::kRightCalf;  // ... this one

void Stand(PostureBuilder& b, double scale, const Vec3& shift, const Quat& hips) {
  b.Root(b.Rest(J::kHips) + scale * shift, hips);
  b.Turn(J::kHead, Pitch(-4.0));
  b.Turn(J::kSpine, Pitch(3.0));
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) b.Hang(arm);
}

void PlantFeet(PostureBuilder& b, double scale, const Vec3& shift = Vec3{0.0}) {
  for (const Limb leg : {Limb::kLeftLeg, Limb::kRightLeg}) {
    b.Reach(leg, b.Rest(kEndOf[Index(leg)]) + scale * (shift + 0.04 * SideOf(leg)),
            Vec3{0.0, 0.0, 1.0} + 0.15 * SideOf(leg), kIdentity);
  }
}

/// Seated, the right calf `lift` (at 1.78 m) over the floor across the left thigh.
Pose CrossedLegs(const Body& body, double scale, double lift) {
  PostureBuilder b(body);
  Stand(b, scale, {0.0, -0.42, -0.05}, kIdentity);
  const Vec3 left = b.Rest(J::kLeftFoot) + scale * Vec3{0.02, 0.0, 0.42};
  const Vec3 right = b.Rest(J::kRightFoot) + scale * Vec3{0.37, lift, 0.42};
  b.Reach(Limb::kLeftLeg, left, {0.05, 0.5, 1.0}, kIdentity);
  b.Reach(Limb::kRightLeg, right, {0.25, 1.0, 0.6},
          glm::angleAxis(Radians(25.0), Vec3{0.0, 0.0, 1.0}) * Pitch(15.0));
  return b.pose();
}

Pose CrossedLegs(const Body& body, double scale) {
  // The lift at which the calf just lies on the thigh.
  double low = 0.1;
  double high = 0.6;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    const Pose pose = CrossedLegs(body, scale, middle);
    const ModelPose model = ForwardKinematics(body.skeleton, pose);
    (CapsuleGap(body, model, kUpperLeg, kLowerLeg) < 0.0 ? low : high) = middle;
  }
  return CrossedLegs(body, scale, high);
}

Pose Relaxed(const Body& body, double scale) {
  PostureBuilder b(body);
  Stand(b, scale, {0.0, -0.012, 0.0}, kIdentity);
  PlantFeet(b, scale);
  return b.pose();
}

Pose Target(const Body& body, TestPosture posture) {
  const double scale = body.height / 1.78;
  if (posture == TestPosture::kCrossedLegs) return CrossedLegs(body, scale);
  const bool bent = posture == TestPosture::kHandToAnkle;
  PostureBuilder b(body);
  Stand(b, scale, bent ? Vec3{0.0, -0.14, -0.12} : Vec3{0.0, -0.012, 0.0},
        bent ? Pitch(75.0) : kIdentity);
  if (bent) {
    b.Turn(J::kSpine, Pitch(20.0));
    b.Turn(J::kChest, Pitch(15.0));
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) b.Hang(arm);
  }
  PlantFeet(b, scale);
  const Vec3 forward{0.0, 0.0, 1.0};
  const std::array<Limb, 2> arms = {Limb::kLeftArm, Limb::kRightArm};
  switch (posture) {
    case TestPosture::kArmsCrossed:
      // The left hand on the right ribs, then the right forearm over it, its hand on the left arm.
      b.Lay(Limb::kLeftArm, glm::mix(b.Sample(S::kRightChest), b.Sample(S::kRightRibs), 0.5),
            forward + Vec3{-0.8, 0.0, 0.0}, {-0.9, 0.3, -0.3}, {0.8, -0.9, 0.4});
      b.LayOn(Limb::kRightArm, LimbSegment::kLeftUpperArm, 0.6, {0.3, 0.3, 1.0}, {0.5, 0.8, -0.2},
              {-0.8, -0.9, 0.7});
      break;
    case TestPosture::kHandsOnBelly:
      for (const Limb arm : arms) {
        const S side = IsLeft(arm) ? S::kLeftBellySide : S::kRightBellySide;
        b.Lay(arm, glm::mix(b.Sample(side), b.Sample(S::kNavel), 0.2), forward + 0.35 * SideOf(arm),
              -SideOf(arm) + Vec3{0.0, -0.3, 0.0}, SideOf(arm) + Vec3{0.0, -0.6, -0.3});
      }
      break;
    case TestPosture::kHandsOnHead:
      for (const Limb arm : arms) {
        const S ear = IsLeft(arm) ? S::kLeftEar : S::kRightEar;
        b.Lay(arm, glm::mix(b.Sample(S::kCrown), b.Sample(ear), 0.4),
              Vec3{0.0, 0.8, 0.0} + SideOf(arm), -0.8 * SideOf(arm) + Vec3{0.0, 1.0, -0.2},
              SideOf(arm) + Vec3{0.0, 0.2, 0.2});
      }
      break;
    default:
      b.LayOn(Limb::kRightArm, LimbSegment::kRightCalf, 0.75, {-0.3, 0.0, 1.0}, {0.0, -1.0, 0.0},
              {-1.0, 0.0, 0.2});
      break;
  }
  return b.pose();
}

/// Which palms touch something in the posture.
std::vector<Limb> TouchingArms(TestPosture posture) {
  switch (posture) {
    case TestPosture::kCrossedLegs:
      return {};
    case TestPosture::kHandToAnkle:
      return {Limb::kRightArm};
    default:
      return {Limb::kLeftArm, Limb::kRightArm};
  }
}

double ContactGap(const Body& body, const Pose& pose, TestPosture posture) {
  const MeasuredBody measured(body, pose);
  if (posture == TestPosture::kCrossedLegs) {
    return CapsuleGap(body, measured.pose, kUpperLeg, kLowerLeg);
  }
  double worst = 0.0;
  for (const Limb arm : TouchingArms(posture)) {
    const double gap = SurfaceGap(measured, arm, measured.Palm(Index(arm)));
    if (std::abs(gap) > std::abs(worst)) worst = gap;
  }
  return worst;
}

}  // namespace

std::string_view Title(TestPosture posture) {
  constexpr std::array<std::string_view, kTestPostureCount> kTitles = {
      "Arms crossed", "Hands on belly", "Hands on head", "Crossed legs", "Hand to ankle"};
  return kTitles[static_cast<std::size_t>(posture)];
}

struct TestPostures::Impl {
  Body performer = TemplateBody();
  Pose relaxed = Relaxed(performer, performer.height / 1.78);
  std::array<Pose, kTestPostureCount> target;
  std::unique_ptr<RetargetMethod> method = MakeRetargetMethod("mdb");
};

TestPostures::TestPostures() : impl_(std::make_unique<Impl>()) {
  for (std::size_t i = 0; i < kTestPostureCount; ++i) {
    impl_->target[i] = Target(impl_->performer, static_cast<TestPosture>(i));
  }
}
TestPostures::~TestPostures() = default;
TestPostures::TestPostures(TestPostures&&) noexcept = default;

const Body& TestPostures::Performer() const { return impl_->performer; }

Pose TestPostures::PerformerPose(TestPosture posture, double amount) const {
  const double share = std::clamp(amount, 0.0, 1.0);
  const Pose& target = impl_->target[static_cast<std::size_t>(posture)];
  Pose pose;
  pose.root_ws = glm::mix(impl_->relaxed.root_ws, target.root_ws, share);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    pose.rotation_ls[j] = glm::slerp(impl_->relaxed.rotation_ls[j], target.rotation_ls[j], share);
  }
  return pose;
}

TestPostureResult TestPostures::Apply(const Body& avatar, TestPosture posture, double amount) {
  TestPostureResult result;
  impl_->method->SetPerformerPose(impl_->performer, PerformerPose(posture, amount));
  impl_->method->Adapt(avatar, result.pose);
  if (amount >= 1.0) result.contact_gap = ContactGap(avatar, result.pose, posture);
  return result;
}

}  // namespace ego
