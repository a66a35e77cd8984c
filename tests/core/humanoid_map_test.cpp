// SPDX-License-Identifier: MIT
#include "core/skeleton/humanoid_map.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "core/skeleton/joint_names.h"
#include "core/skeleton/rest_alignment.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// A person of 1.75 m in T-pose, joint by joint.
const std::array<Vec3, kJointCount>& Places() {
  static const std::array<Vec3, kJointCount> places = {
      Vec3(0, .95, 0),        Vec3(0, 1.06, 0),    Vec3(0, 1.18, -.01), Vec3(0, 1.31, -.02),
      Vec3(0, 1.48, 0),       Vec3(0, 1.58, .02),  Vec3(.04, 1.44, 0),  Vec3(.18, 1.44, -.01),
      Vec3(.46, 1.44, -.02),  Vec3(.71, 1.44, 0),  Vec3(-.04, 1.44, 0), Vec3(-.18, 1.44, -.01),
      Vec3(-.46, 1.44, -.02), Vec3(-.71, 1.44, 0), Vec3(.09, .92, 0),   Vec3(.09, .5, .02),
      Vec3(.09, .08, -.02),   Vec3(.09, .02, .12), Vec3(-.09, .92, 0),  Vec3(-.09, .5, .02),
      Vec3(-.09, .08, -.02),  Vec3(-.09, .02, .12)};
  return places;
}

using Names = std::array<std::string, kJointCount>;  // "" where the rig has no such joint

int Add(JointTree& tree, std::vector<Vec3>& at, const std::string& name, int parent,
        const Vec3& position) {
  Mat4 local(1.0);
  local[3] = Vec4(parent < 0 ? position : position - at[static_cast<std::size_t>(parent)], 1.0);
  tree.joints.push_back({name, parent, local});
  at.push_back(position);
  return static_cast<int>(at.size()) - 1;
}

/// The rig of these names, first turned and scaled as a whole. Returns where each joint went.
JointTree MakeRig(const Names& names, std::array<int, kJointCount>& node,
                  const std::string& root = "", const Mat3& axes = Mat3(1.0)) {
  JointTree tree;
  std::vector<Vec3> at;
  int top = -1;
  if (!root.empty()) top = Add(tree, at, root, -1, Vec3(0.0));
  std::array<int, kJointCount> nearest{};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const int parent = j == 0 ? top : nearest[Index(kParent[j])];
    node[j] = -1;
    nearest[j] = parent;
    if (names[j].empty()) continue;
    node[j] = nearest[j] = Add(tree, at, names[j], parent, axes * Places()[j]);
  }
  return tree;
}

struct Convention {
  const char* label;
  const char* root;
  Names names;
};

void PrintTo(const Convention& convention, std::ostream* out) { *out << convention.label; }

const std::vector<Convention>& Conventions() {
  static const std::vector<Convention> all = {
      {"Mixamo", "", {"mixamorig:Hips",         "mixamorig:Spine",         "mixamorig:Spine1",
                      "mixamorig:Spine2",       "mixamorig:Neck",          "mixamorig:Head",
                      "mixamorig:LeftShoulder", "mixamorig:LeftArm",       "mixamorig:LeftForeArm",
                      "mixamorig:LeftHand",     "mixamorig:RightShoulder", "mixamorig:RightArm",
                      "mixamorig:RightForeArm", "mixamorig:RightHand",     "mixamorig:LeftUpLeg",
                      "mixamorig:LeftLeg",      "mixamorig:LeftFoot",      "mixamorig:LeftToeBase",
                      "mixamorig:RightUpLeg",   "mixamorig:RightLeg",      "mixamorig:RightFoot",
                      "mixamorig:RightToeBase"}},
      {"MixamoNumberedPrefix",
       "Armature",
       {"mixamorig9_Hips",         "mixamorig9_Spine",         "mixamorig9_Spine1",
        "mixamorig9_Spine2",       "mixamorig9_Neck",          "mixamorig9_Head",
        "mixamorig9_LeftShoulder", "mixamorig9_LeftArm",       "mixamorig9_LeftForeArm",
        "mixamorig9_LeftHand",     "mixamorig9_RightShoulder", "mixamorig9_RightArm",
        "mixamorig9_RightForeArm", "mixamorig9_RightHand",     "mixamorig9_LeftUpLeg",
        "mixamorig9_LeftLeg",      "mixamorig9_LeftFoot",      "mixamorig9_LeftToeBase",
        "mixamorig9_RightUpLeg",   "mixamorig9_RightLeg",      "mixamorig9_RightFoot",
        "mixamorig9_RightToeBase"}},
      {"Unreal", "root", {"pelvis",     "spine_01",   "spine_02",   "spine_03",   "neck_01",
                          "head",       "clavicle_l", "upperarm_l", "lowerarm_l", "hand_l",
                          "clavicle_r", "upperarm_r", "lowerarm_r", "hand_r",     "thigh_l",
                          "calf_l",     "foot_l",     "ball_l",     "thigh_r",    "calf_r",
                          "foot_r",     "ball_r"}},
      {"Quaternius", "Root", {"Hips",       "Abdomen", "Torso",      "",
                              "Neck",       "Head",    "Shoulder.L", "UpperArm.L",
                              "LowerArm.L", "Fist.L",  "Shoulder.R", "UpperArm.R",
                              "LowerArm.R", "Fist.R",  "UpperLeg.L", "LowerLeg.L",
                              "Foot.L",     "",        "UpperLeg.R", "LowerLeg.R",
                              "Foot.R",     ""}},
      {"QuaterniusWithoutDot",
       "Bone",
       {"Hips",      "Abdomen",   "Torso",     "",          "Neck",      "Head",
        "ShoulderL", "UpperArmL", "LowerArmL", "PalmL",     "ShoulderR", "UpperArmR",
        "LowerArmR", "PalmR",     "UpperLegL", "LowerLegL", "FootL",     "",
        "UpperLegR", "LowerLegR", "FootR",     ""}},
      {"KayKit", "root", {"hips",       "spine",      "chest",      "",           "",
                          "head",       "",           "upperarm.l", "lowerarm.l", "wrist.l",
                          "",           "upperarm.r", "lowerarm.r", "wrist.r",    "upperleg.l",
                          "lowerleg.l", "foot.l",     "toes.l",     "upperleg.r", "lowerleg.r",
                          "foot.r",     "toes.r"}},
      {"VRoid",
       "Root",
       {"J_Bip_C_Hips",     "J_Bip_C_Spine",   "J_Bip_C_Chest",    "J_Bip_C_UpperChest",
        "J_Bip_C_Neck",     "J_Bip_C_Head",    "J_Bip_L_Shoulder", "J_Bip_L_UpperArm",
        "J_Bip_L_LowerArm", "J_Bip_L_Hand",    "J_Bip_R_Shoulder", "J_Bip_R_UpperArm",
        "J_Bip_R_LowerArm", "J_Bip_R_Hand",    "J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg",
        "J_Bip_L_Foot",     "J_Bip_L_ToeBase", "J_Bip_R_UpperLeg", "J_Bip_R_LowerLeg",
        "J_Bip_R_Foot",     "J_Bip_R_ToeBase"}},
      {"ShoulderIsUpperArm",
       "",
       {"char:hips",    "char:spine_01",   "char:spine_02",   "char:spine_03", "char:neck",
        "char:head",    "char:l_clav",     "char:l_shoulder", "char:l_elbow",  "char:l_wrist",
        "char:r_clav",  "char:r_shoulder", "char:r_elbow",    "char:r_wrist",  "char:l_thigh",
        "char:l_knee",  "char:l_ankle",    "char:l_ball",     "char:r_thigh",  "char:r_knee",
        "char:r_ankle", "char:r_ball"}},
      {"Daz", "", {"hip",      "abdomen", "abdomen2", "chest", "neck",    "head",
                   "lCollar",  "lShldr",  "lForeArm", "lHand", "rCollar", "rShldr",
                   "rForeArm", "rHand",   "lThigh",   "lShin", "lFoot",   "lToe",
                   "rThigh",   "rShin",   "rFoot",    "rToe"}},
      {"Biped", "Bip01", {"Bip01 Pelvis",    "Bip01 Spine",  "Bip01 Spine1",     "Bip01 Spine2",
                          "Bip01 Neck",      "Bip01 Head",   "Bip01 L Clavicle", "Bip01 L UpperArm",
                          "Bip01 L Forearm", "Bip01 L Hand", "Bip01 R Clavicle", "Bip01 R UpperArm",
                          "Bip01 R Forearm", "Bip01 R Hand", "Bip01 L Thigh",    "Bip01 L Calf",
                          "Bip01 L Foot",    "Bip01 L Toe0", "Bip01 R Thigh",    "Bip01 R Calf",
                          "Bip01 R Foot",    "Bip01 R Toe0"}},
      {"Acclaim", "", {"root",      "lowerback", "upperback", "thorax", "lowerneck", "head",
                       "lclavicle", "lhumerus",  "lradius",   "lwrist", "rclavicle", "rhumerus",
                       "rradius",   "rwrist",    "lfemur",    "ltibia", "lfoot",     "ltoes",
                       "rfemur",    "rtibia",    "rfoot",     "rtoes"}},
      {"HipKneeAnkle",
       "",
       {"Hips",       "Chest",        "Chest2",     "Chest3",    "Neck",        "Head",
        "LeftCollar", "LeftShoulder", "LeftElbow",  "LeftWrist", "RightCollar", "RightShoulder",
        "RightElbow", "RightWrist",   "LeftHip",    "LeftKnee",  "LeftAnkle",   "LeftToe",
        "RightHip",   "RightKnee",    "RightAnkle", "RightToe"}},
      {"Xsens", "", {"Pelvis",       "L5",        "T12",           "T8",
                     "Neck",         "Head",      "LeftShoulder",  "LeftUpperArm",
                     "LeftForeArm",  "LeftHand",  "RightShoulder", "RightUpperArm",
                     "RightForeArm", "RightHand", "LeftUpperLeg",  "LeftLowerLeg",
                     "LeftFoot",     "LeftToe",   "RightUpperLeg", "RightLowerLeg",
                     "RightFoot",    "RightToe"}},
      {"Rokoko",
       "Newton",
       {"Hips",         "Spine1",    "Spine2",      "Spine3",   "Neck",          "Head",
        "LeftShoulder", "LeftArm",   "LeftForeArm", "LeftHand", "RightShoulder", "RightArm",
        "RightForeArm", "RightHand", "LeftThigh",   "LeftShin", "LeftFoot",      "LeftToe",
        "RightThigh",   "RightShin", "RightFoot",   "RightToe"}},
      {"OptiTrack", "", {"Hip",       "Ab",    "Chest",  "",      "Neck",      "Head",
                         "LShoulder", "LUArm", "LFArm",  "LHand", "RShoulder", "RUArm",
                         "RFArm",     "RHand", "LThigh", "LShin", "LFoot",     "LToe",
                         "RThigh",    "RShin", "RFoot",  "RToe"}},
      {"LowerCaseGlued",
       "",
       {"hips",         "spine",     "chest",       "upperchest", "neck",          "head",
        "leftshoulder", "leftarm",   "leftforearm", "lefthand",   "rightshoulder", "rightarm",
        "rightforearm", "righthand", "leftupleg",   "leftleg",    "leftfoot",      "lefttoe",
        "rightupleg",   "rightleg",  "rightfoot",   "righttoe"}},
      {"Spaces", "", {"Hips",           "Spine",         "Chest",       "Upper Chest", "Neck",
                      "Head",           "Left shoulder", "Left arm",    "Left elbow",  "Left wrist",
                      "Right shoulder", "Right arm",     "Right elbow", "Right wrist", "Left leg",
                      "Left knee",      "Left ankle",    "Left toe",    "Right leg",   "Right knee",
                      "Right ankle",    "Right toe"}},
      {"NamesSayNothing",
       "bone_00",
       {"bone_01", "bone_02", "bone_03", "bone_04", "bone_05", "bone_06", "bone_07", "bone_08",
        "bone_09", "bone_10", "bone_11", "bone_12", "bone_13", "bone_14", "bone_15", "bone_16",
        "bone_17", "bone_18", "bone_19", "bone_20", "bone_21", "bone_22"}},
      {"NoNamesNoClavicles", "", {"a", "b", "",  "",  "c", "d", "",  "e", "f", "g", "",
                                  "h", "i", "j", "k", "l", "m", "n", "o", "p", "q", "r"}},
  };
  return all;
}

class Mapping : public testing::TestWithParam<Convention> {};

TEST_P(Mapping, FindsEveryJoint) {
  std::array<int, kJointCount> node;
  const JointTree tree = MakeRig(GetParam().names, node, GetParam().root);
  const Result<HumanoidMap> map = MapHumanoid(tree);
  ASSERT_TRUE(map) << map.error();
  for (std::size_t j = 0; j < kJointCount; ++j) {
    EXPECT_EQ(map->joint[j].node, node[j])
        << Name(static_cast<J>(j)) << ": " << map->joint[j].reason;
    EXPECT_FALSE(map->joint[j].reason.empty());
  }
}

TEST_P(Mapping, DoesNotDependOnAxesAndUnit) {
  // Z up and looking along -Y in centimetres; X up; Y up but looking along -Z.
  const Mat3 z_up = 100.0 * Mat3(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
  const Mat3 x_up = Mat3(Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const Mat3 back = Mat3(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1));
  for (const Mat3& axes : {z_up, x_up, back}) {
    std::array<int, kJointCount> node;
    const JointTree tree = MakeRig(GetParam().names, node, GetParam().root, axes);
    const Result<HumanoidMap> map = MapHumanoid(tree);
    ASSERT_TRUE(map) << map.error();
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_EQ(map->joint[j].node, node[j]) << Name(static_cast<J>(j));
    }
  }
}

TEST_P(Mapping, AlignsToTheSameSkeleton) {
  const Mat3 axes = 100.0 * Mat3(Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0));
  std::array<int, kJointCount> node;
  const JointTree tree = MakeRig(GetParam().names, node, GetParam().root, axes);
  const Result<HumanoidMap> map = MapHumanoid(tree);
  ASSERT_TRUE(map) << map.error();
  const Result<Alignment> aligned = AlignRestPose(tree, tree.RestGlobal(), *map, 0.01);
  ASSERT_TRUE(aligned) << aligned.error();
  const auto canonical = CanonicalPositions(aligned->skeleton);
  for (const J j : {J::kHead, J::kLeftUpperArm, J::kRightUpperArm, J::kLeftUpperLeg}) {
    const Vec3 from_hips = canonical[Index(j)] - canonical[0];
    const Vec3 expected = Places()[Index(j)] - Places()[0];
    EXPECT_LT(glm::length(from_hips - expected), 1e-9) << Name(j);
  }
  EXPECT_NEAR(canonical[Index(J::kLeftHand)].y, canonical[Index(J::kLeftUpperArm)].y, 1e-12);
  EXPECT_GT(canonical[Index(J::kLeftHand)].x, 0.5);
  EXPECT_LT(canonical[Index(J::kRightHand)].x, -0.5);
}

INSTANTIATE_TEST_SUITE_P(Conventions, Mapping, testing::ValuesIn(Conventions()),
                         [](const auto& param) { return std::string(param.param.label); });

TEST(MapHumanoid, ChoosesSpineJointsByHeight) {
  // Five spine joints; the first sits in the hips.
  JointTree tree;
  std::vector<Vec3> at;
  const int hips = Add(tree, at, "Hips", -1, Places()[0]);
  int last = hips;
  std::vector<int> spine;
  for (const double height : {0.95, 1.07, 1.13, 1.2, 1.32}) {
    last = Add(tree, at, "Spine" + std::to_string(spine.size()), last, Vec3(0.0, height, 0.0));
    spine.push_back(last);
  }
  const int neck = Add(tree, at, "Neck", last, Places()[Index(J::kNeck)]);
  Add(tree, at, "Head", neck, Places()[Index(J::kHead)]);
  for (const char* side : {"Left", "Right"}) {
    const double s = *side == 'L' ? 1.0 : -1.0;
    const auto place = [&](J j) { return Places()[Index(j)] * Vec3(s, 1.0, 1.0); };
    const int arm = Add(tree, at, std::string(side) + "Arm", last, place(J::kLeftUpperArm));
    const int fore = Add(tree, at, std::string(side) + "ForeArm", arm, place(J::kLeftLowerArm));
    Add(tree, at, std::string(side) + "Hand", fore, place(J::kLeftHand));
    const int thigh = Add(tree, at, std::string(side) + "UpLeg", hips, place(J::kLeftUpperLeg));
    const int shin = Add(tree, at, std::string(side) + "Leg", thigh, place(J::kLeftLowerLeg));
    Add(tree, at, std::string(side) + "Foot", shin, place(J::kLeftFoot));
  }
  const Result<HumanoidMap> map = MapHumanoid(tree);
  ASSERT_TRUE(map) << map.error();
  EXPECT_EQ(map->Node(J::kSpine), spine[1]);
  EXPECT_EQ(map->Node(J::kChest), spine[3]);
  EXPECT_EQ(map->Node(J::kUpperChest), spine[4]);
  EXPECT_EQ(map->notes.size(), 1u);
}

TEST(MapHumanoid, TakesDeclaredJointsAsTheyAre) {
  std::array<int, kJointCount> node;
  Names names;
  for (std::size_t j = 0; j < kJointCount; ++j) names[j] = std::to_string(j);
  const JointTree tree = MakeRig(names, node);
  HumanoidHints hints;
  hints.node = node;
  // A declaration outranks shape: the neck is declared to be the head.
  hints.node[Index(J::kHead)] = node[Index(J::kNeck)];
  hints.node[Index(J::kNeck)] = -1;
  const Result<HumanoidMap> map = MapHumanoid(tree, hints);
  ASSERT_TRUE(map) << map.error();
  EXPECT_EQ(map->Node(J::kHead), node[Index(J::kNeck)]);
  EXPECT_EQ(map->Node(J::kNeck), -1);
}

TEST(MapHumanoid, NamesWhatIsMissing) {
  JointTree tree;
  std::vector<Vec3> at;
  const int root = Add(tree, at, "Chassis", -1, Vec3(0.0));
  for (const char* wheel : {"WheelFL", "WheelFR", "WheelRL", "WheelRR"}) {
    Add(tree, at, wheel, root, Vec3(1.0, 0.0, 0.0));
  }
  const Result<HumanoidMap> map = MapHumanoid(tree);
  ASSERT_FALSE(map);
  EXPECT_NE(map.error().find("leftUpperArm"), std::string::npos) << map.error();
  EXPECT_NE(map.error().find("Chassis"), std::string::npos) << map.error();
  EXPECT_FALSE(MapHumanoid(JointTree{}));
}

TEST(MapHumanoid, RefusesBrokenTrees) {
  JointTree tree;
  tree.joints.resize(3);
  tree.joints[1].parent = 2;
  EXPECT_FALSE(MapHumanoid(tree));
  tree.joints.assign(100000, {});
  EXPECT_FALSE(MapHumanoid(tree));
}

TEST(ReadJointName, TellsAmbiguousAndIgnoredNames) {
  EXPECT_EQ(ReadJointName("LeftArmTwist").role, NameRole::kIgnored);
  EXPECT_EQ(ReadJointName("IK-foot.l").role, NameRole::kIgnored);
  EXPECT_EQ(ReadJointName("PoleTarget.L").role, NameRole::kIgnored);
  EXPECT_EQ(ReadJointName("char:l_thighRoll").role, NameRole::kIgnored);
  EXPECT_EQ(ReadJointName("LeftEye").role, NameRole::kIgnored);
  EXPECT_TRUE(ReadJointName("RightToe_End").end);
  EXPECT_EQ(ReadJointName("LeftShoulder").role, NameRole::kShoulder);
  EXPECT_EQ(ReadJointName("LHipJoint").role, NameRole::kHip);
  EXPECT_EQ(ReadJointName("root").side, NameSide::kNone);
  EXPECT_EQ(ReadJointName("lradius").side, NameSide::kLeft);
  EXPECT_EQ(ReadJointName("lradius").role, NameRole::kForearm);
  EXPECT_EQ(ReadJointName("Armature").role, NameRole::kNone);
  EXPECT_EQ(ReadJointName("LowerLeg").side, NameSide::kNone);
  EXPECT_EQ(ReadJointName("").role, NameRole::kNone);
}

}  // namespace
}  // namespace ego
