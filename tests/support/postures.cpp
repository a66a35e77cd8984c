// SPDX-License-Identifier: MIT
#include "tests/support/postures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ego::test {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

constexpr std::array<std::string_view, 10> kPostures = {
    "standing",       "hands on belly", "hand on head",
    "arms crossed",   "hands clasped",  "hand on opposite shoulder",
    "squat",          "crossed legs",   "hand to ankle",
    "hands on thighs"};
constexpr std::array<std::string_view, 11> kMotions = {"hands on belly",
                                                       "hand on head",
                                                       "arms crossed",
                                                       "hands clasped",
                                                       "hand on opposite shoulder",
                                                       "squat",
                                                       "crossed legs",
                                                       "hand to ankle",
                                                       "hands on thighs",
                                                       "walk",
                                                       "free swing"};

/// Rotation that takes the orthonormal pair (a, b) to (c, d).
Quat FrameRotation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Mat3 from(a, b, glm::cross(a, b));
  const Mat3 to(c, d, glm::cross(c, d));
  return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

Vec3 Orthonormal(const Vec3& v, const Vec3& axis) {
  return glm::normalize(v - glm::dot(v, axis) * axis);
}

/// World rotations while a posture is put together.
class Builder {
 public:
  explicit Builder(const Body& body) : body_(body), pose_(CanonicalPose(body.skeleton)) {
    Update();
  }
  Pose pose() const { return pose_; }
  void Root(const Vec3& position, const Quat& rotation) {
    pose_.root_ws = position;
    pose_.rotation_ls[0] = rotation;
    Update();
  }
  void Turn(J joint, const Quat& local) {
    pose_.rotation_ls[Index(joint)] = local;
    Update();
  }
  const ModelPose& model() const { return model_; }

  /// Two-bone IK in closed form, with the mid joint towards `hint`.
  void Reach(Limb limb, const Vec3& end, const Vec3& hint, const Quat& end_ws) {
    const LimbJoints joints = JointsOf(limb);
    const Vec3 base = model_.Position(joints.base);
    const double upper = BoneLength(body_.skeleton, joints.mid);
    const double lower = BoneLength(body_.skeleton, joints.end);
    Vec3 chord = end - base;
    const double wanted = glm::length(chord);
    const double distance =
        std::clamp(wanted, std::abs(upper - lower) + 0.15 * lower, 0.998 * (upper + lower));
    chord /= wanted;
    const double along = (distance * distance + upper * upper - lower * lower) / (2.0 * distance);
    const Vec3 out = Orthonormal(hint, chord);
    const Vec3 mid =
        base + along * chord + std::sqrt(std::max(0.0, upper * upper - along * along)) * out;
    const Vec3 target = base + distance * chord;
    const Vec3 axis = CanonicalDirection(limb);
    const Vec3 hinge = FlexionAxis(limb);
    const Vec3 upper_dir = glm::normalize(mid - base);
    const Vec3 lower_dir = glm::normalize(target - mid);
    const Vec3 normal = glm::normalize(glm::cross(upper_dir, lower_dir));
    SetWorld(joints.base, FrameRotation(axis, hinge, upper_dir, normal));
    SetWorld(joints.mid, FrameRotation(axis, hinge, lower_dir, normal));
    SetWorld(joints.end, end_ws);
  }

  /// The palm on a point of the surface, facing it, fingers along `fingers`.
  void Lay(Limb arm, const Vec3& point, const Vec3& surface_normal, const Vec3& fingers,
           const Vec3& elbow_hint) {
    const std::size_t side = Index(arm);
    const Vec3 palm = -glm::normalize(surface_normal);
    const Vec3 along = Orthonormal(fingers, palm);
    const Quat hand = FrameRotation(CanonicalDirection(arm), {0.0, -1.0, 0.0}, along, palm);
    const auto rest = CanonicalPositions(body_.skeleton);
    const Vec3 offset = body_.surface.hand[side].palm_ms - rest[Index(JointsOf(arm).end)];
    Reach(arm, point - hand * offset, elbow_hint, hand);
  }

  Vec3 Sample(S point) const {
    std::array<Vec3, kSampleCount> samples;
    PoseSamples(body_.skeleton, body_.surface, model_, samples);
    return samples[Index(point)];
  }

 private:
  void Update() { model_ = ForwardKinematics(body_.skeleton, pose_); }
  void SetWorld(J joint, const Quat& world) {
    const Quat& parent = model_.Rotation(Parent(joint));
    pose_.rotation_ls[Index(joint)] = glm::normalize(glm::conjugate(parent) * world);
    Update();
  }

  const Body& body_;
  Pose pose_;
  ModelPose model_;
};

Vec3 Side(Limb limb) { return {IsLeft(limb) ? 1.0 : -1.0, 0.0, 0.0}; }

void HangArm(Builder& b, Limb arm, const Body& body) {
  const Vec3 shoulder = b.model().Position(JointsOf(arm).base);
  const double reach =
      BoneLength(body.skeleton, JointsOf(arm).mid) + BoneLength(body.skeleton, JointsOf(arm).end);
  const Vec3 down = glm::normalize(Vec3{0.0, -1.0, 0.08} + 0.28 * Side(arm));
  const Vec3 inward = Orthonormal(-Side(arm), down);
  b.Reach(arm, shoulder + 0.985 * reach * down, Vec3{0.0, 0.0, -1.0} + 0.3 * Side(arm),
          FrameRotation(CanonicalDirection(arm), {0.0, -1.0, 0.0}, down, inward));
}

void PlantFeet(Builder& b, const Body& body, const std::array<Vec3, 2>& ankle,
               const std::array<Quat, 2>& foot) {
  (void)body;
  b.Reach(Limb::kLeftLeg, ankle[0], {0.15, 0.0, 1.0}, foot[0]);
  b.Reach(Limb::kRightLeg, ankle[1], {-0.15, 0.0, 1.0}, foot[1]);
}

Quat Pitch(double degrees) { return glm::angleAxis(Radians(degrees), Vec3{1.0, 0.0, 0.0}); }

}  // namespace

std::span<const std::string_view> PostureNames() { return kPostures; }
std::span<const std::string_view> MotionNames() { return kMotions; }

Pose Posture(const Body& body, std::string_view name, double slide) {
  Builder b(body);
  const double s = body.height / 1.78;
  const auto rest = CanonicalPositions(body.skeleton);
  const std::array<Vec3, 2> stand = {rest[Index(J::kLeftFoot)] + Vec3{0.04 * s, 0.0, 0.0},
                                     rest[Index(J::kRightFoot)] - Vec3{0.04 * s, 0.0, 0.0}};
  const std::array<Quat, 2> flat = {kIdentity, kIdentity};
  Vec3 root = rest[0] - Vec3{0.0, 0.012 * s, 0.0};
  Quat facing = kIdentity;
  if (name == "squat") {
    root.y -= 0.38 * s;
    root.z -= 0.16 * s;
    facing = Pitch(35.0);
  } else if (name == "hand to ankle") {
    root.y -= 0.14 * s;
    root.z -= 0.12 * s;
    facing = Pitch(75.0);
  } else if (name == "crossed legs" || name == "hands on thighs") {
    root.y -= 0.42 * s;  // seated
    root.z -= 0.05 * s;
  }
  b.Root(root, facing);
  b.Turn(J::kSpine, Pitch(name == "hand to ankle" ? 20.0 : 4.0));
  b.Turn(J::kChest, Pitch(name == "hand to ankle" ? 15.0 : 3.0));
  b.Turn(J::kHead, Pitch(-5.0));
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) HangArm(b, arm, body);

  if (name == "crossed legs") {
    const std::array<Vec3, 2> ankle = {stand[0] + Vec3{-0.02, 0.0, 0.42} * s,
                                       stand[1] + Vec3{0.33, 0.24, 0.42} * s};
    b.Reach(Limb::kLeftLeg, ankle[0], {0.05, 0.5, 1.0}, kIdentity);
    b.Reach(Limb::kRightLeg, ankle[1], {0.25, 1.0, 0.6},
            glm::angleAxis(Radians(25.0), Vec3{0.0, 0.0, 1.0}) * Pitch(15.0));
  } else if (name == "hands on thighs") {
    PlantFeet(b, body, {stand[0] + Vec3{0.0, 0.0, 0.40 * s}, stand[1] + Vec3{0.0, 0.0, 0.40 * s}},
              flat);
  } else {
    PlantFeet(b, body, stand, flat);
  }

  const Vec3 forward{0.0, 0.0, 1.0};
  if (name == "hands on belly") {
    const double low = 0.25 * slide;
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      const S side = IsLeft(arm) ? S::kLeftBellySide : S::kRightBellySide;
      const Vec3 point =
          glm::mix(glm::mix(b.Sample(side), b.Sample(S::kNavel), 0.2), b.Sample(S::kPubis), low);
      b.Lay(arm, point, forward + 0.35 * Side(arm), -Side(arm) + Vec3{0.0, -0.3, 0.0},
            Side(arm) + Vec3{0.0, -0.6, -0.3});
    }
  } else if (name == "hand on head") {
    const Vec3 point = glm::mix(b.Sample(S::kCrown), b.Sample(S::kForehead), 0.3 + 0.4 * slide);
    b.Lay(Limb::kRightArm, point, {-0.1, 1.0, 0.4 + slide}, {1.0, 0.0, -0.3}, {-1.0, 0.1, 0.2});
  } else if (name == "arms crossed") {
    const auto forearm = [&](Limb arm, double depth, double lift) {
      const Vec3 chest = b.Sample(S::kSternumBase) + Vec3{0.0, lift, depth} * s;
      b.Lay(arm, chest - (0.10 + 0.03 * slide) * s * Side(arm), forward, -Side(arm),
            0.6 * Side(arm) + Vec3{0.0, -1.0, 0.1});
    };
    forearm(Limb::kLeftArm, 0.055, 0.02);
    forearm(Limb::kRightArm, 0.135, 0.035);
  } else if (name == "hands clasped") {
    const Vec3 point = b.Sample(S::kSternumBase) + Vec3{0.0, -0.05 - 0.1 * slide, 0.16} * s;
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      b.Lay(arm, point, Side(arm), Vec3{0.0, 0.8, 0.8}, Side(arm) + Vec3{0.0, -0.7, 0.0});
    }
  } else if (name == "hand on opposite shoulder") {
    const Vec3 point =
        glm::mix(b.Sample(S::kLeftShoulderTop), b.Sample(S::kLeftChest), 0.4 * slide);
    b.Lay(Limb::kRightArm, point, {0.2, 1.0, 0.6}, {0.6, 0.0, -0.6}, {0.0, -1.0, 0.4});
  } else if (name == "hand to ankle") {
    const Vec3 knee = b.model().Position(J::kRightLowerLeg);
    const Vec3 ankle = b.model().Position(J::kRightFoot);
    const Vec3 along = glm::normalize(ankle - knee);
    const Vec3 out = Orthonormal({-0.3, 0.0, 1.0}, along);
    const double radius = body.surface.limb_radius[Index(LimbSegment::kRightCalf)];
    b.Lay(Limb::kRightArm, glm::mix(ankle, knee, 0.25 + 0.2 * slide) + radius * out, out, along,
          {-1.0, 0.0, 0.2});
  } else if (name == "hands on thighs") {
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      const Limb leg = IsLeft(arm) ? Limb::kLeftLeg : Limb::kRightLeg;
      const Vec3 hip = b.model().Position(JointsOf(leg).base);
      const Vec3 knee = b.model().Position(JointsOf(leg).mid);
      const Vec3 along = glm::normalize(knee - hip);
      const Vec3 out = Orthonormal({0.0, 1.0, 0.0}, along);
      const double radius = body.surface.limb_radius[2 * Index(leg)];
      b.Lay(arm, glm::mix(hip, knee, 0.65 + 0.2 * slide) + radius * out, out, along,
            Side(arm) + Vec3{0.0, 0.0, -0.7});
    }
  }
  return b.pose();
}

namespace {

Pose Blend(const Pose& a, const Pose& b, double t) {
  Pose pose;
  pose.root_ws = glm::mix(a.root_ws, b.root_ws, t);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    pose.rotation_ls[j] = glm::normalize(glm::slerp(a.rotation_ls[j], b.rotation_ls[j], t));
  }
  return pose;
}

Pose Stride(const Body& body, double time) {
  // A schematic gait: 1 m/s, feet planted while they carry, lifted over half the cycle.
  Builder b(body);
  const double s = body.height / 1.78;
  const auto rest = CanonicalPositions(body.skeleton);
  const double step = 0.30 * s;  // each foot from +step to -step about the hips
  const double period = 1.0;
  const double speed = 4.0 * step / period;
  b.Root(rest[0] +
             Vec3{0.0, -0.045 * s + 0.012 * s * std::cos(4.0 * kPi * time / period), speed * time},
         glm::angleAxis(0.05 * std::sin(2.0 * kPi * time / period), kUp));
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
    HangArm(b, arm, body);
    const double swing = (IsLeft(arm) ? 1.0 : -1.0) * 0.35 * std::sin(2.0 * kPi * time / period);
    Pose pose = b.pose();
    const J base = JointsOf(arm).base;
    b.Turn(base, Pitch(Degrees(swing)) * pose.rotation_ls[Index(base)]);
  }
  std::array<Vec3, 2> ankle;
  std::array<Quat, 2> foot;
  for (std::size_t side = 0; side < 2; ++side) {
    double phase = time / period + (side == 0 ? 0.0 : 0.5);
    const double cycle = std::floor(phase);
    phase -= cycle;
    const double offset = side == 0 ? 0.0 : -0.5 * period;
    Vec3 at = rest[Index(side == 0 ? J::kLeftFoot : J::kRightFoot)];
    const double planted = speed * (cycle * period + offset) + step;  // where the stance foot is
    if (phase < 0.5) {
      at.z += planted;
      foot[side] = kIdentity;
    } else {
      const double u = (phase - 0.5) * 2.0;
      const double smooth = u * u * u * (u * (u * 6.0 - 15.0) + 10.0);
      at.z += planted + smooth * speed * period;
      at.y += 0.09 * s * std::sin(kPi * u) * std::sin(kPi * u);
      foot[side] = Pitch(25.0 * std::sin(2.0 * kPi * u) * std::sin(kPi * u));
    }
    ankle[side] = at;
  }
  PlantFeet(b, body, ankle, foot);
  return b.pose();
}

}  // namespace

std::vector<Pose> Motion(const Body& body, std::string_view name) {
  std::vector<Pose> poses;
  for (int frame = 0; frame < 120; ++frame) {
    const double t = frame / kMotionRate;
    if (name == "walk") {
      poses.push_back(Stride(body, t));
      continue;
    }
    const Pose standing = Posture(body, "standing");
    if (name == "free swing") {
      Pose pose = standing;
      for (const J joint : {J::kLeftUpperArm, J::kRightUpperArm}) {
        const double sign = joint == J::kLeftUpperArm ? 1.0 : -1.0;
        Quat& q = pose.rotation_ls[Index(joint)];
        q = glm::angleAxis(sign * (0.9 + 0.5 * std::sin(2.0 * kPi * t)), Vec3{0.0, 0.0, 1.0}) *
            glm::angleAxis(0.5 * std::sin(kPi * t), Vec3{1.0, 0.0, 0.0}) * q;
      }
      poses.push_back(pose);
      continue;
    }
    const auto ease = [](double x) {
      const double u = std::clamp(x, 0.0, 1.0);
      return u * u * u * (u * (u * 6.0 - 15.0) + 10.0);
    };
    const double in = ease(t / 0.6) * ease((2.0 - t) / 0.6);
    const double slide = 0.5 - 0.5 * std::cos(kPi * std::clamp((t - 0.6) / 0.8, 0.0, 1.0));
    poses.push_back(Blend(standing, Posture(body, name, slide), in));
  }
  return poses;
}

}  // namespace ego::test
