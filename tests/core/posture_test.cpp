// SPDX-License-Identifier: MIT
#include "core/solve/posture.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/body/body.h"
#include "core/solve/posture_cost.h"
#include "core/solve/skin_slide.h"

namespace ego {
namespace {

using J = HumanoidJoint;

Posture RandomPosture(unsigned seed, double spread) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, spread);
  std::array<double, kPoseDof> step;
  for (double& s : step) s = normal(random);
  return Moved(NeutralPosture(), step);
}

MarkerModel SomeMarkers() {
  MarkerModel model;
  model.skeleton = TemplateSkeleton(1.7);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const double d = 0.01 * static_cast<double>(j);
    model.markers.push_back({model.markers.size(), static_cast<J>(j), {0.05 + d, 0.04, -d}});
    model.markers.push_back({model.markers.size(), static_cast<J>(j), {-0.03, d, 0.06}});
  }
  return model;
}

struct Seen {
  std::vector<Vec3> position;
  std::vector<std::uint8_t> visible;
  MarkerFrame Frame() const { return {0.0, position, visible}; }
};

Seen Observe(const MarkerModel& model, const Posture& posture, double error, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, error);
  const ModelPose pose = Placed(model.skeleton, posture);
  Seen seen;
  for (const BoundMarker& m : model.markers) {
    seen.position.push_back(pose.Position(m.joint) + pose.Rotation(m.joint) * m.offset_ls +
                            Vec3{normal(random), normal(random), normal(random)});
    seen.visible.push_back(1);
  }
  return seen;
}

TEST(Posture, ChainsHoldExactlyTheJointsAbove) {
  for (std::size_t j = 0; j < kJointCount; ++j) {
    std::size_t expected = 3;
    for (std::size_t k = j;; k = Index(kParent[k])) {
      expected += DofsOf(static_cast<J>(k)).count;
      if (k == 0) break;
    }
    EXPECT_EQ(Chain(static_cast<J>(j)).size(), expected) << Name(static_cast<J>(j));
  }
}

TEST(Posture, RoundTripsThroughAPose) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Posture posture = RandomPosture(seed, 0.5);
    const Posture back = PostureFromPose(PoseFromPosture(posture));
    for (std::size_t limb = 0; limb < kLimbCount; ++limb) {
      EXPECT_NEAR(back.flexion[limb], posture.flexion[limb], 1e-9);
      EXPECT_NEAR(back.axial[limb], posture.axial[limb], 1e-9);
    }
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_NEAR(std::abs(glm::dot(back.rotation_ls[j], posture.rotation_ls[j])), 1.0, 1e-12);
    }
  }
}

TEST(RotationVector, InvertsExpAndItsJacobianIsTheDerivative) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 axis = glm::normalize(Vec3{normal(random), normal(random), normal(random)});
    const Vec3 v = axis * (trial == 0 ? 0.0 : trial == 1 ? 1e-6 : 3.1 * trial / 100.0);
    EXPECT_LT(glm::distance(RotationVector(Exp(v)), v), 1e-9);
    const Mat3 jacobian = RotationVectorJacobian(v);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 3; ++k) {
      Vec3 delta{0.0};
      delta[k] = kStep;
      const Vec3 slope =
          (RotationVector(Exp(v) * Exp(delta)) - RotationVector(Exp(v) * Exp(-delta))) /
          (2.0 * kStep);
      EXPECT_LT(glm::distance(slope, jacobian[k]), 1e-4) << "|v| = " << glm::length(v);
    }
  }
}

TEST(PostureCost, GradientIsTheFiniteDifferenceOfTheCost) {
  const MarkerModel model = SomeMarkers();
  for (unsigned seed = 1; seed < 6; ++seed) {
    const Posture posture = RandomPosture(seed, 0.35);
    const Posture before = RandomPosture(seed + 100, 0.30);
    const Seen seen = Observe(model, RandomPosture(seed + 50, 0.3), 0.02, seed);
    const MarkerLoss loss{0.02, 5.0};
    Priors priors;
    priors.previous = &before;
    const auto cost = [&](const Posture& p) {
      return PriorCost(p, priors) +
             MarkerCost(model, seen.Frame(), Placed(model.skeleton, p), loss);
    };
    NormalEquations equations;
    const double linear_cost =
        AddPriors(posture, priors, equations) +
        AddMarkers(model, seen.Frame(), Placed(model.skeleton, posture), loss, equations);
    EXPECT_NEAR(linear_cost, cost(posture), 1e-9 * linear_cost);
    for (std::size_t d = 0; d < kPoseDof; ++d) {
      constexpr double kStep = 1e-6;
      std::array<double, kPoseDof> step{};
      step[d] = kStep;
      const double ahead = cost(Moved(posture, step));
      step[d] = -kStep;
      const double behind = cost(Moved(posture, step));
      const double slope = (ahead - behind) / (2.0 * kStep);
      EXPECT_NEAR(equations.g[d], slope, 1e-4 * std::max(1.0, std::abs(slope))) << "dof " << d;
    }
  }
}

/// Markers on every joint whose skin follows its neighbours and slips on the bone's twist, slides
/// besides, and slides alone.
std::vector<BoundMarker> SlidingMarkers() {
  std::vector<BoundMarker> markers;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    BoundMarker marker{j, joint, {0.05, 0.04, -0.01 * static_cast<double>(j)}};
    for (std::size_t c = 1; c < kJointCount; ++c) {
      if (kParent[c] == joint) marker.child = static_cast<J>(c);
    }
    marker.share = {j == 0 ? 0.0 : 0.15, marker.child == J::kHips ? 0.0 : 0.2, 0.3};
    markers.push_back(marker);
    marker.slides = true;
    for (std::size_t i = 0; i < kSlideCount; ++i) {
      const double d = 0.01 * static_cast<double>(i);
      marker.slide[i] = {0.02 - d, 0.01, d - 0.03};
    }
    markers.push_back(marker);
    marker.share = {};  // what slides needs no share to follow what hangs on its bone
    markers.push_back(marker);
    marker.child = J::kHips;
    markers.push_back(marker);
  }
  return markers;
}

TEST(BoundMarker, JacobiansAreTheFiniteDifferencesOfThePosition) {
  const Skeleton skeleton = TemplateSkeleton(1.7);
  constexpr double kStep = 1e-6;
  for (unsigned seed = 3; seed < 8; ++seed) {
    const Posture posture = RandomPosture(seed, 0.5);
    const ModelPose pose = Placed(skeleton, posture);
    std::array<Vec3, kPoseDof> axes;
    DofAxes(pose, axes);
    for (const BoundMarker& marker : SlidingMarkers()) {
      const CarriedMarker carried = Carry(marker, pose);
      std::array<Vec3, kPoseDof> columns;
      MarkerJacobian(marker, carried, pose, axes, columns);
      std::array<Vec3, kPoseDof> all{};  // those off the chain are zero
      for (std::size_t i = 0; i < Chain(marker).size(); ++i) all[Chain(marker)[i]] = columns[i];
      for (std::size_t d = 0; d < kPoseDof; ++d) {
        std::array<double, kPoseDof> step{};
        step[d] = kStep;
        const Vec3 ahead = MarkerPosition(marker, Placed(skeleton, Moved(posture, step)));
        step[d] = -kStep;
        const Vec3 behind = MarkerPosition(marker, Placed(skeleton, Moved(posture, step)));
        EXPECT_LT(glm::distance((ahead - behind) / (2.0 * kStep), all[d]), 1e-7)
            << Name(marker.joint) << " dof " << d;
      }
      const Mat3 by_offset = OffsetJacobian(marker, carried, pose);
      for (int axis = 0; axis < 3; ++axis) {
        BoundMarker moved = marker;
        moved.offset_ls[axis] += kStep;
        EXPECT_LT(glm::distance((MarkerPosition(moved, pose) - carried.point_ws) / kStep,
                                by_offset[axis]),
                  1e-7)
            << Name(marker.joint);
      }
      const std::array<Vec3, kSkinShareCount> by_share = ShareJacobian(marker, carried, pose);
      for (std::size_t i = 0; i < kSkinShareCount; ++i) {
        if (i == 0 && marker.joint == J::kHips) continue;
        BoundMarker moved = marker;
        moved.share[i] += kStep;
        EXPECT_LT(
            glm::distance((MarkerPosition(moved, pose) - carried.point_ws) / kStep, by_share[i]),
            1e-6)
            << Name(marker.joint) << " share " << i;
      }
    }
  }
}

TEST(BoundMarker, StaysWhereItIsWhenTheFrameOfItsFootIsTurned) {
  const Skeleton skeleton = TemplateSkeleton(1.7);
  const Quat level = glm::angleAxis(Radians(12.0), glm::normalize(Vec3{1.0, 0.2, 0.5}));
  Skeleton turned_skeleton = skeleton;
  Vec3& to_toes = turned_skeleton.offset[Index(J::kLeftToes)];
  to_toes = level * to_toes;
  for (unsigned seed = 3; seed < 8; ++seed) {
    const Posture posture = RandomPosture(seed, 0.5);
    Posture turned = posture;
    Quat& foot = turned.rotation_ls[Index(J::kLeftFoot)];
    foot = foot * glm::conjugate(level);
    Quat& toes = turned.rotation_ls[Index(J::kLeftToes)];
    toes = level * toes * glm::conjugate(level);
    for (const BoundMarker& marker : SlidingMarkers()) {
      if (marker.child == J::kLeftFoot || marker.child == J::kLeftToes) continue;  // by shares
      BoundMarker along = marker;
      TurnFootFrame(J::kLeftFoot, level, along);
      EXPECT_LT(glm::distance(MarkerPosition(marker, Placed(skeleton, posture)),
                              MarkerPosition(along, Placed(turned_skeleton, turned))),
                1e-12)
          << Name(marker.joint);
    }
  }
}

TEST(JointTurn, IsZeroAtNeutralAndHasNoJumpAtHalfATurn) {
  const Quat neutral = NeutralPosture().rotation_ls[Index(J::kLeftUpperArm)];
  EXPECT_LT(glm::length(TurnOf(J::kLeftUpperArm, neutral).value), 1e-12);
  const Vec3 axis = glm::normalize(Vec3{1.0, 2.0, -0.5});
  for (const double angle : {0.1, 0.8, 1.5}) {
    const Vec3 turn = TurnOf(J::kLeftUpperArm, neutral * glm::angleAxis(angle, axis)).value;
    EXPECT_LT(glm::distance(turn, 2.0 * std::sin(0.5 * angle) * axis), 0.02 * angle);
    const Vec3 same = TurnOf(J::kLeftUpperArm, -(neutral * glm::angleAxis(angle, axis))).value;
    EXPECT_LT(glm::distance(turn, same), 1e-12);
  }
  const Vec3 before = TurnOf(J::kLeftUpperArm, neutral * glm::angleAxis(kPi - 1e-3, axis)).value;
  const Vec3 after = TurnOf(J::kLeftUpperArm, neutral * glm::angleAxis(kPi + 1e-3, axis)).value;
  EXPECT_LT(glm::distance(before, after), 0.02);
}

TEST(FitSlides, LearnsWhatSlidesAndLeavesTheRestRigid) {
  // Postures are known; every other marker slides 25 mm per radian, the rest not at all.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.001);
  Bundle truth;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    FittedMarker marker;
    marker.label = j;
    marker.joint = static_cast<J>(j);
    marker.template_offset = {0.05, 0.02, 0.04};
    marker.child = BoneEnd(marker.joint) == marker.joint ? J::kHips : BoneEnd(marker.joint);
    marker.share_sigma = {0.05, 0.05, 0.05};
    truth.markers.push_back(marker);
  }
  Bundle found = truth;
  for (std::size_t m = 0; m < truth.markers.size(); m += 2) {
    truth.markers[m].slide[0] = {0.0, 0.025, 0.0};
    truth.markers[m].slide[4] = {0.015, 0.0, -0.020};
  }
  const MarkerModel model = ModelOf(truth);
  std::vector<Posture> postures;
  std::vector<Seen> seen;
  for (unsigned seed = 0; seed < 100; ++seed) {
    postures.push_back(RandomPosture(seed, 0.3));
    const ModelPose pose = Placed(model.skeleton, postures.back());
    Seen instant;
    for (const BoundMarker& marker : model.markers) {
      instant.position.push_back(MarkerPosition(marker, pose) +
                                 Vec3{noise(random), noise(random), noise(random)});
      instant.visible.push_back(1);
    }
    // A ghost in every tenth frame.
    if (seed % 10 == 0) instant.position[seed / 10] += Vec3{0.5, 1.0, -0.3};
    seen.push_back(instant);
  }
  std::vector<MarkerFrame> frames;
  for (const Seen& instant : seen) frames.push_back(instant.Frame());
  FitSlides(frames, postures, found);
  const MarkerModel learnt = ModelOf(found);
  const ModelPose pose = Placed(model.skeleton, RandomPosture(1000, 0.3));  // one not learnt from
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    EXPECT_LT(glm::distance(MarkerPosition(learnt.markers[m], pose),
                            MarkerPosition(model.markers[m], pose)),
              0.002)
        << Name(model.markers[m].joint);
  }
}

TEST(BoundMarker, WithoutSharesItIsRigidAndTheTwistIsFollowedContinuously) {
  const Skeleton skeleton = TemplateSkeleton(1.7);
  const ModelPose pose = Placed(skeleton, RandomPosture(2, 0.5));
  BoundMarker marker{0, J::kLeftLowerArm, {0.1, 0.03, 0.02}};
  marker.child = J::kLeftHand;
  EXPECT_LT(
      glm::distance(MarkerPosition(marker, pose),
                    pose.Position(marker.joint) + pose.Rotation(marker.joint) * marker.offset_ls),
      1e-12);
  // Turning the forearm all the way round, the marker never jumps.
  marker.share = {0.0, 0.0, 0.5};
  Vec3 last{0.0};
  for (int i = 0; i <= 720; ++i) {
    Posture posture = NeutralPosture();
    std::array<double, kPoseDof> step{};
    step[DofsOf(J::kLeftLowerArm).first + 1] = Radians(0.5 * i);
    posture = Moved(posture, step);
    const Vec3 now = MarkerPosition(marker, Placed(skeleton, posture));
    if (i > 0) {
      EXPECT_LT(glm::distance(now, last), 0.001) << i;
    }
    last = now;
  }
}

TEST(MarkerLoss, IsQuadraticNearAndFadesFar) {
  const MarkerLoss loss{0.01, 5.0};
  EXPECT_NEAR(loss.Cost(1e-6), 0.5 * 1e-6 / 1e-4, 1e-5);
  // The pull, weight times distance, falls beyond the outlier distance.
  const auto pull = [&](double r) { return loss.Weight(r * r) * r; };
  EXPECT_GT(pull(0.05), pull(0.02));
  EXPECT_GT(pull(0.05), pull(0.2));
  EXPECT_LT(pull(1.0), 0.15 * pull(0.05));
}

}  // namespace
}  // namespace ego
