// SPDX-License-Identifier: MIT
#include "assets/calibration/test_postures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "assets/motions/motions.h"
#include "core/baselines/retarget_method.h"
#include "core/geometry/closest_point.h"
#include "core/metrics/surface_gap.h"

namespace ego {
namespace {

struct Source {
  std::string_view title;
  std::string_view motion;  // the shipped script that shows it
  bool legs_cross = false;  // the right calf lies on the left thigh
};
constexpr std::array<Source, kTestPostureCount> kSources = {{{"Arms crossed", "arms_crossed"},
                                                             {"Hands on belly", "hands_clasped"},
                                                             {"Hand on head", "disappointment"},
                                                             {"Crossed legs", "thoughtful", true},
                                                             {"Hand to ankle", "ankle_hold"}}};

const Source& SourceOf(TestPosture posture) { return kSources[static_cast<std::size_t>(posture)]; }

/// A point of a hand that lies on the body.
struct Touch {
  std::size_t side = 0;
  bool fingertip = false;
};

/// The instant of a script that shows its longest touch.
struct Target {
  Pose stance;
  Pose pose;
  std::vector<Touch> touches;
};

Target TargetOf(const Source& source) {
  const Result<const MotionScript*> script = FindMotion(source.motion);
  if (!script) return {};  // a test proves that all are there
  const MotionPlayer player(ScriptedFigure(), **script);
  const TrueContact* longest = nullptr;
  for (const TrueContact& contact : player.contacts()) {
    if (longest == nullptr || contact.to_s - contact.from_s > longest->to_s - longest->from_s) {
      longest = &contact;
    }
  }
  const double time = longest == nullptr ? 0.0 : 0.5 * (longest->from_s + longest->to_s);
  Target target{player.At(0.0), player.At(time), {}};
  for (const TrueContact& contact : player.contacts()) {
    if (contact.foot || time < contact.from_s || time > contact.to_s) continue;
    target.touches.push_back({contact.side, contact.face == TouchFace::kFingertips});
  }
  return target;
}

/// How much room is between the right calf and the left thigh, metres, negative when they overlap.
double LegGap(const Body& body, const ModelPose& pose) {
  const auto thigh = LimbSegment::kLeftThigh;
  const auto calf = LimbSegment::kRightCalf;
  const Vec3 a0 = pose.Position(StartJoint(thigh));
  const Vec3 a1 = pose.Position(EndJoint(thigh));
  const Vec3 b0 = pose.Position(StartJoint(calf));
  const Vec3 b1 = pose.Position(EndJoint(calf));
  const SegmentPair pair = ClosestOnSegments(a0, a1, b0, b1);
  return glm::distance(glm::mix(a0, a1, pair.s), glm::mix(b0, b1, pair.t)) -
         body.surface.limb_radius[Index(thigh)] - body.surface.limb_radius[Index(calf)];
}

/// Room at everything that touches, in heights.
std::vector<double> Gaps(const Body& body, const Pose& pose, const Source& source,
                         const Target& target) {
  const MeasuredBody measured(body, pose);
  std::vector<double> gaps;
  for (const Touch& touch : target.touches) {
    const Limb arm = touch.side == 0 ? Limb::kLeftArm : Limb::kRightArm;
    const Vec3 point = touch.fingertip ? measured.Fingertip(touch.side) : measured.Palm(touch.side);
    gaps.push_back(SurfaceGap(measured, arm, point) / body.height);
  }
  if (source.legs_cross) gaps.push_back(LegGap(body, measured.pose) / body.height);
  return gaps;
}

}  // namespace

std::string_view Title(TestPosture posture) { return SourceOf(posture).title; }

struct TestPostures::Impl {
  const Body& performer = ScriptedPerformer().body;
  std::array<Target, kTestPostureCount> target;
  std::unique_ptr<RetargetMethod> method = MakeRetargetMethod("mdb");
};

TestPostures::TestPostures() : impl_(std::make_unique<Impl>()) {
  for (std::size_t i = 0; i < kTestPostureCount; ++i) impl_->target[i] = TargetOf(kSources[i]);
}
TestPostures::~TestPostures() = default;
TestPostures::TestPostures(TestPostures&&) noexcept = default;

const Body& TestPostures::Performer() const { return impl_->performer; }

Pose TestPostures::PerformerPose(TestPosture posture, double amount) const {
  const double share = std::clamp(amount, 0.0, 1.0);
  const auto& [stance, target, touches] = impl_->target[static_cast<std::size_t>(posture)];
  Pose pose = target;  // with its fingers
  pose.root_ws = glm::mix(stance.root_ws, target.root_ws, share);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    pose.rotation_ls[j] = glm::slerp(stance.rotation_ls[j], target.rotation_ls[j], share);
  }
  return pose;
}

TestPostureResult TestPostures::Apply(const Body& avatar, TestPosture posture, double amount) {
  TestPostureResult result;
  impl_->method->SetPerformerPose(impl_->performer, PerformerPose(posture, amount));
  impl_->method->Adapt(avatar, result.pose);
  if (amount < 1.0) return result;
  const Source& source = SourceOf(posture);
  const Target& target = impl_->target[static_cast<std::size_t>(posture)];
  const std::vector<double> own = Gaps(impl_->performer, target.pose, source, target);
  const std::vector<double> now = Gaps(avatar, result.pose, source, target);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double beyond = avatar.height * (now[i] - own[i]);
    if (std::abs(beyond) > std::abs(result.contact_gap)) result.contact_gap = beyond;
  }
  return result;
}

}  // namespace ego
