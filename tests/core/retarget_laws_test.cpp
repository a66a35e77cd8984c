// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/baselines/retarget_method.h"
#include "core/egocentric/normalize.h"
#include "tests/support/bodies.h"
#include "tests/support/postures.h"

namespace ego::test {
namespace {

/// Largest distance of any joint between two poses, metres.
double JointError(const Body& body, const Pose& a, const Pose& b) {
  const ModelPose ma = ForwardKinematics(body.skeleton, a);
  const ModelPose mb = ForwardKinematics(body.skeleton, b);
  double worst = 0.0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    worst = std::max(worst, glm::distance(ma.position_ws[j], mb.position_ws[j]));
  }
  return worst;
}

double RotationError(const Pose& a, const Pose& b) {
  double worst = 0.0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const Quat q = glm::conjugate(a.rotation_ls[j]) * b.rotation_ls[j];
    worst = std::max(worst, 2.0 * std::atan2(std::hypot(q.x, q.y, q.z), std::abs(q.w)));
  }
  return worst;
}

class Laws : public testing::TestWithParam<std::string_view> {
 protected:
  std::unique_ptr<RetargetMethod> method_ = MakeRetargetMethod(GetParam());
  Pose Map(const Body& performer, const Pose& pose, const Body& avatar) {
    method_->SetPerformerPose(performer, pose);
    Pose out;
    method_->Adapt(avatar, out);
    return out;
  }
};

TEST_P(Laws, IdentityOnEveryBody) {
  std::vector<Body> bodies = StudyBodies();
  bodies.push_back(TemplateBody());
  bodies.push_back(PoorRig());
  for (const Body& body : bodies) {
    for (const std::string_view name : PostureNames()) {
      const Pose pose = Posture(body, name, 0.3);
      const Pose out = Map(body, pose, body);
      EXPECT_LT(JointError(body, pose, out) / body.height, 1e-6) << body.name << ": " << name;
    }
  }
}

TEST_P(Laws, UniformScaleKeepsJointAngles) {
  const Body body = TemplateBody();
  for (const double factor : {0.3, 0.67, 1.5}) {
    const Body scaled = Scaled(body, factor);
    for (const std::string_view name : PostureNames()) {
      const Pose pose = Posture(body, name, 0.3);
      const Pose out = Map(body, pose, scaled);
      EXPECT_LT(RotationError(pose, out), 1e-5) << name;
      EXPECT_LT(glm::distance(out.root_ws, factor * pose.root_ws), 1e-9 * scaled.height) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Laws, testing::ValuesIn(RetargetMethodNames()),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace ego::test
