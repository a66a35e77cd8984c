// SPDX-License-Identifier: MIT
#include "core/model/finger_rig.h"

#include <gtest/gtest.h>

#include "assets/motions/motions.h"
#include "core/baselines/retarget_method.h"
#include "core/model/rig.h"
#include "core/skeleton/pose.h"

namespace ego {
namespace {

const Character& Performer() { return ScriptedPerformer().character; }

std::vector<Mat4> Nodes(const Pose& pose) {
  std::vector<Mat4> nodes(Performer().nodes.joints.size());
  PoseNodes(Performer().rig, pose, nodes);
  return nodes;
}

Vec3 NodeAt(const std::vector<Mat4>& nodes, const std::string& name) {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (Performer().nodes.joints[n].name == name) return Vec3(nodes[n][3]);
  }
  ADD_FAILURE() << "no node " << name;
  return Vec3{0.0};
}

HandShape Bent(double bend, double curl) {
  HandShape shape;
  shape.digit.fill({bend, curl});
  return shape;
}

TEST(FingerRig, FindsThirtyJointsOfTheCast) {
  ASSERT_EQ(Performer().rig.fingers.joints.size(), kMostFingerJoints);
  for (const FingerRig::Joint& joint : Performer().rig.fingers.joints) {
    EXPECT_EQ(joint.parent < 0, joint.segment == 0);
    EXPECT_GT(joint.position_ms.x * (joint.side == 0 ? 1.0 : -1.0), 0.0);
    EXPECT_NEAR(glm::length(joint.axis), 1.0, 1e-12);
  }
}

TEST(FingerRig, BendsTipsTowardsThePalmAndKeepsBones) {
  Pose pose = CanonicalPose(Performer().rig.skeleton);
  const std::vector<Mat4> flat = Nodes(pose);
  pose.hand = {Bent(0.8, 0.9), Bent(0.8, 0.9)};
  const std::vector<Mat4> bent = Nodes(pose);
  for (const std::string side : {"left", "right"}) {
    for (const std::string finger : {"Index", "Middle", "Ring", "Little"}) {
      const std::string name = side + finger;
      // The palm looks down.
      EXPECT_LT(NodeAt(bent, name + "Tip").y, NodeAt(flat, name + "Tip").y - 0.03) << name;
      EXPECT_LT(std::abs(NodeAt(bent, name + "Tip").x), std::abs(NodeAt(flat, name + "Tip").x));
      EXPECT_NEAR(glm::distance(NodeAt(bent, name + "Distal"), NodeAt(bent, name + "Intermediate")),
                  glm::distance(NodeAt(flat, name + "Distal"), NodeAt(flat, name + "Intermediate")),
                  1e-12);
      EXPECT_LT(glm::distance(NodeAt(bent, name + "Proximal"), NodeAt(flat, name + "Proximal")),
                1e-12);
    }
    // A thumb goes under the palm.
    EXPECT_LT(NodeAt(bent, side + "ThumbTip").y, NodeAt(flat, side + "ThumbTip").y);
    EXPECT_LT(NodeAt(bent, side + "ThumbTip").z, NodeAt(flat, side + "ThumbTip").z);
    EXPECT_EQ(NodeAt(bent, side + "Hand"), NodeAt(flat, side + "Hand"));
  }
}

TEST(FingerRig, BothHandsAreMirrorImages) {
  Pose pose = CanonicalPose(Performer().rig.skeleton);
  pose.hand = {Bent(0.3, 0.7), Bent(0.3, 0.7)};
  const std::vector<Mat4> nodes = Nodes(pose);
  for (const char* name : {"ThumbTip", "IndexTip", "MiddleDistal", "LittleTip"}) {
    const Vec3 left = NodeAt(nodes, std::string("left") + name);
    const Vec3 right = NodeAt(nodes, std::string("right") + name);
    EXPECT_LT(glm::distance(left, Vec3{-right.x, right.y, right.z}), 1e-9) << name;
  }
}

TEST(FingerRig, FollowsOneChildWhereAFingerForks) {
  // A hand whose fingers fork at every joint, as files may have it.
  JointTree tree;
  std::vector<HumanoidJoint> driver;
  std::vector<Mat4> global;
  const auto add = [&](int parent, const Vec3& at) {
    Mat4 place(1.0);
    place[3] = Vec4(at, 1.0);
    tree.joints.push_back({.name = parent < 0 ? "LeftHand" : "LeftHandIndex", .parent = parent});
    driver.push_back(HumanoidJoint::kLeftHand);
    global.push_back(place);
    return static_cast<int>(tree.joints.size()) - 1;
  };
  const int hand = add(-1, {0.7, 1.4, 0.0});
  std::vector<int> level = {add(hand, {0.8, 1.4, 0.0})};
  for (int depth = 1; depth < 6; ++depth) {
    std::vector<int> next;
    for (const int parent : level) {
      for (const double z : {0.0, 0.01}) {
        next.push_back(add(parent, {0.8 + 0.02 * depth, 1.4, z + 0.02 * (parent % 3)}));
      }
    }
    level = next;
  }
  const FingerRig rig = FindFingers(tree, driver, global);
  ASSERT_EQ(rig.joints.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(rig.joints[k].segment, k);
  for (std::size_t n = 1; n < tree.joints.size(); ++n) EXPECT_GE(rig.joint_of[n], 0) << n;
  std::vector<Mat4> motion(rig.joints.size());
  BendFingers(rig, {Bent(0.5, 0.5), HandShape{}}, motion);
}

TEST(FingerRig, EveryMethodPassesTheFingersOn) {
  Pose pose = CanonicalPose(Performer().rig.skeleton);
  pose.hand[1] = Bent(0.5, 0.4);
  for (const std::string_view name : RetargetMethodNames()) {
    const auto method = MakeRetargetMethod(name);
    method->SetPerformerPose(ScriptedPerformer().body, pose);
    Pose out;
    method->Adapt(ScriptedPerformer().body, out);
    EXPECT_EQ(out.hand, pose.hand) << name;
  }
}

}  // namespace
}  // namespace ego
