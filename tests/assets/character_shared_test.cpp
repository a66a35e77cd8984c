// SPDX-License-Identifier: MIT
// Real characters, when they lie beside the project.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "assets/gltf/character_file.h"
#include "tests/support/shared_data.h"

namespace ego {
namespace {

using J = HumanoidJoint;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

struct Expected {
  const char* file;
  int missing;  // humanoid joints that the rig truly lacks
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.file; }

class SharedCharacter : public testing::TestWithParam<Expected> {};

/// A lively pose: every joint turned by up to 40 degrees, the body moved and turned.
Pose RandomPose(const Skeleton& skeleton, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Pose pose = CanonicalPose(skeleton);
  for (Quat& q : pose.rotation_ls) {
    const Vec3 axis(unit(random), unit(random), unit(random));
    if (glm::length(axis) > 0.1) q = glm::angleAxis(0.7 * unit(random), glm::normalize(axis));
  }
  pose.root_ws += Vec3(unit(random), 0.2 * unit(random), unit(random));
  return pose;
}

TEST_P(SharedCharacter, StandsInTPose) {
  EGO_SHARED_DATA_OR_SKIP(path, std::string("avatars/") + GetParam().file);
  const auto character = ReadCharacter(path);
  ASSERT_TRUE(character) << character.error();
  int missing = 0;
  for (const auto& entry : character->map.joint) {
    missing += entry.node < 0 ? 1 : 0;
    EXPECT_FALSE(entry.reason.empty());
  }
  EXPECT_EQ(missing, GetParam().missing);

  const Skeleton& skeleton = character->rig.skeleton;
  const auto at = CanonicalPositions(skeleton);
  const double height = at[Index(J::kHead)].y;
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    for (const J j : {joints.mid, joints.end}) {
      const Vec3& bone = skeleton.offset[Index(j)];
      EXPECT_GT(glm::length(bone), 0.02 * height) << Name(j);
      EXPECT_GT(glm::dot(bone, CanonicalDirection(limb)), 0.9994 * glm::length(bone)) << Name(j);
    }
    EXPECT_GT(at[Index(joints.base)].x * (IsLeft(limb) ? 1.0 : -1.0), 0.01 * height);
  }
  EXPECT_NEAR(at[0].x, 0.0, 1e-12);
  EXPECT_NEAR(at[0].z, 0.0, 1e-12);
  EXPECT_GT(at[Index(J::kLeftUpperArm)].y, at[Index(J::kLeftUpperLeg)].y);
  EXPECT_GT(height, at[Index(J::kLeftUpperArm)].y);

  // Left and right are the same to a few per cent.
  for (const J j : {J::kLeftLowerArm, J::kLeftHand, J::kLeftLowerLeg, J::kLeftFoot}) {
    EXPECT_NEAR(BoneLength(skeleton, j), BoneLength(skeleton, Mirror(j)), 0.03 * height) << Name(j);
  }
}

TEST_P(SharedCharacter, MeshFollowsTheBonesIntoTPose) {
  EGO_SHARED_DATA_OR_SKIP(path, std::string("avatars/") + GetParam().file);
  const auto character = ReadCharacter(path);
  ASSERT_TRUE(character) << character.error();
  std::vector<Mat4> node(character->nodes.joints.size());
  const Skeleton& skeleton = character->rig.skeleton;
  PoseNodes(character->rig, ForwardKinematics(skeleton, CanonicalPose(skeleton)), node);
  // Vertices that a forearm carries lie around the forearm; those of feet lie near the ground.
  const auto at = CanonicalPositions(skeleton);
  for (const Limb limb : {Limb::kLeftArm, Limb::kRightArm}) {
    const LimbJoints joints = JointsOf(limb);
    const Vec3 elbow = at[Index(joints.mid)];
    const double length = BoneLength(skeleton, joints.end);
    std::size_t count = 0;
    std::size_t near = 0;
    for (const MeshPart& part : character->parts) {
      for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const auto& influences = part.influences[v];
        Vec4 p(0.0);
        double forearm = 0.0;
        for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
          const PaletteEntry& entry = character->palette[influences.entry[k]];
          const auto weight = static_cast<double>(influences.weight[k]);
          p += weight *
               (node[At(entry.node)] * entry.inverse_bind * Vec4(Vec3(part.positions[v]), 1.0));
          if (character->rig.driver[At(entry.node)] == joints.mid) forearm += weight;
        }
        if (forearm < 0.9) continue;
        ++count;
        const Vec3 from = Vec3(p) - elbow;
        const double along = glm::dot(from, CanonicalDirection(limb)) / length;
        const double off = std::hypot(from.y, from.z) / length;
        near += along > -0.6 && along < 2.2 && off < 1.0 ? 1 : 0;
      }
    }
    // A rig without hands hangs fingers, and what they hold, on the forearm.
    const double share = character->rig.node[Index(joints.end)] >= 0 ? 0.95 : 0.75;
    EXPECT_GE(static_cast<double>(near), share * static_cast<double>(count)) << count;
  }
}

/// Global transforms of a file's nodes at key `frame`, by tinygltf alone.
std::vector<Mat4> PlayedBack(const tinygltf::Model& model, std::size_t frame) {
  struct Local {
    Vec3 t{0.0};
    Quat r = kIdentity;
    Vec3 s{1.0};
  };
  std::vector<Local> local(model.nodes.size());
  std::vector<int> parent(model.nodes.size(), -1);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    EXPECT_TRUE(node.matrix.empty() || node.mesh >= 0 || node.children.empty());
    if (node.translation.size() == 3) {
      local[n].t = {node.translation[0], node.translation[1], node.translation[2]};
    }
    if (node.rotation.size() == 4) {
      local[n].r = Quat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    }
    if (node.scale.size() == 3) local[n].s = {node.scale[0], node.scale[1], node.scale[2]};
    for (const int child : node.children) parent[At(child)] = static_cast<int>(n);
  }
  const tinygltf::Animation& animation = model.animations.at(0);
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    const auto& accessor = model.accessors[At(animation.samplers[At(channel.sampler)].output)];
    const auto& view = model.bufferViews[At(accessor.bufferView)];
    const std::size_t width = channel.target_path == "rotation" ? 4 : 3;
    EXPECT_NE(channel.target_path, "scale");
    std::array<float, 4> value{};
    std::memcpy(value.data(),
                model.buffers[0].data.data() + view.byteOffset + accessor.byteOffset +
                    frame * width * sizeof(float),
                width * sizeof(float));
    Local& l = local[At(channel.target_node)];
    if (width == 4) {
      l.r = Quat(value[3], value[0], value[1], value[2]);
    } else {
      l.t = {value[0], value[1], value[2]};
    }
  }
  std::vector<Mat4> global(model.nodes.size());
  std::vector<bool> done(model.nodes.size(), false);
  const auto matrix = [&](std::size_t n) {
    Mat4 m = glm::mat4_cast(local[n].r);
    for (int c = 0; c < 3; ++c) m[c] *= local[n].s[c];
    m[3] = Vec4(local[n].t, 1.0);
    return m;
  };
  for (std::size_t n = 0; n < global.size(); ++n) {
    Mat4 m = matrix(n);
    for (int p = parent[n]; p >= 0; p = parent[At(p)]) m = matrix(At(p)) * m;
    global[n] = m;
  }
  return global;
}

TEST_P(SharedCharacter, ExportedAnimationPlaysThePoses) {
  EGO_SHARED_DATA_OR_SKIP(path, std::string("avatars/") + GetParam().file);
  const auto character = ReadCharacter(path);
  ASSERT_TRUE(character) << character.error();
  const Skeleton& skeleton = character->rig.skeleton;
  std::mt19937 random(7);
  std::vector<Pose> poses{CanonicalPose(skeleton)};
  for (int i = 0; i < 5; ++i) poses.push_back(RandomPose(skeleton, random));

  const std::filesystem::path out = std::filesystem::path(testing::TempDir()) /
                                    (std::string("export_") + GetParam().file + ".glb");
  const auto written = WriteRetargeted(out, *character, poses, 30.0, "take");
  ASSERT_TRUE(written) << written.error();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  ASSERT_TRUE(loader.LoadBinaryFromFile(&model, &error, &warning, out.string())) << error;
  ASSERT_EQ(model.animations.size(), 1u);
  EXPECT_EQ(model.animations[0].name, "take");

  // The nodes of the file by name; names are unique enough for humanoid joints in one file.
  const double scale = CanonicalPositions(skeleton)[Index(J::kHead)].y;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    const ModelPose expected = ForwardKinematics(skeleton, poses[f]);
    const std::vector<Mat4> played = PlayedBack(model, f);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const int node = character->rig.node[j];
      if (node < 0) continue;
      const std::string& name = character->nodes.joints[At(node)].name;
      double nearest = 1e9;
      for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        if (model.nodes[n].name != name) continue;
        nearest = std::min(nearest, glm::length(Vec3(played[n][3]) - expected.position_ws[j]));
      }
      EXPECT_LT(nearest, 1e-4 * scale) << Name(static_cast<J>(j)) << ", frame " << f;
    }
  }

  // What was written is a character again, of the same proportions.
  const auto again = ReadCharacter(out);
  ASSERT_TRUE(again) << again.error();
  for (std::size_t j = 1; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    EXPECT_NEAR(BoneLength(again->rig.skeleton, joint), BoneLength(skeleton, joint), 0.01 * scale)
        << Name(joint);
  }
  std::filesystem::remove(out);
}

INSTANTIATE_TEST_SUITE_P(
    Avatars, SharedCharacter,
    testing::Values(
        Expected{"makehuman_child_female.glb", 0}, Expected{"makehuman_man_obese.glb", 0},
        Expected{"makehuman_woman_average.glb", 0}, Expected{"makehuman_man_muscular_tall.glb", 0},
        Expected{"valid_Asian_F_1_Casual.glb", 0}, Expected{"valid_Black_M_1_Casual.glb", 0},
        Expected{"valid_Asian_F_1_Busi.meshopt.glb", 0}, Expected{"m2m_human-male.glb", 0},
        Expected{"m2m_human-bunny.glb", 0}, Expected{"m2m_human-zombie.glb", 0},
        Expected{"m2m_kaiju-t-rex.glb", 3}, Expected{"kaykit_Barbarian.glb", 4},
        Expected{"quaternius_Witch.glb", 2}, Expected{"quaternius_BigEars_HumanoidRig.glb", 3},
        Expected{"quaternius_Suit_man.glb", 2}, Expected{"quaternius_Astronaut_RedPanda.glb", 4},
        Expected{"sumerian_alien.glb", 0}, Expected{"three_RobotExpressive.glb", 5},
        Expected{"cryptovoxels_vrm0.vrm", 1}),
    [](const auto& param) {
      std::string name = param.param.file;
      for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      }
      return name;
    });

}  // namespace
}  // namespace ego
