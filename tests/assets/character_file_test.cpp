// SPDX-License-Identifier: MIT
#include "assets/gltf/character_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/sample_gltf.h"

namespace ego {
namespace {

using Json = nlohmann::json;
using J = HumanoidJoint;
using test::MakeSample;
using test::Sample;

Result<Character> Parse(Sample sample) { return ParseCharacter(sample.Glb(), "sample.glb"); }

/// The vertices in the canonical pose.
std::vector<Vec3> Placed(const Character& character) {
  std::vector<Mat4> node(character.nodes.joints.size());
  const Skeleton& skeleton = character.rig.skeleton;
  PoseNodes(character.rig, ForwardKinematics(skeleton, CanonicalPose(skeleton)), node);
  std::vector<Vec3> out;
  for (const MeshPart& part : character.parts) {
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      Vec4 p(0.0);
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        const PaletteEntry& entry = character.palette[part.influences[v].entry[k]];
        p += static_cast<double>(part.influences[v].weight[k]) *
             (node[static_cast<std::size_t>(entry.node)] * entry.inverse_bind *
              Vec4(Vec3(part.positions[v]), 1.0));
      }
      out.emplace_back(p);
    }
  }
  return out;
}

void ExpectSameShape(const Character& a, const Character& b) {
  const auto pa = Placed(a);
  const auto pb = Placed(b);
  ASSERT_EQ(pa.size(), pb.size());
  for (std::size_t i = 0; i < pa.size(); ++i) EXPECT_LT(glm::length(pa[i] - pb[i]), 1e-5) << i;
}

TEST(ReadCharacter, ReadsAPlainHumanoid) {
  const auto character = Parse(MakeSample());
  ASSERT_TRUE(character) << character.error();
  EXPECT_EQ(character->nodes.joints.size(), 16u);
  EXPECT_EQ(character->parts.at(0).triangles.size(), 90u);
  const auto at = CanonicalPositions(character->rig.skeleton);
  EXPECT_NEAR(at[Index(J::kHips)].y, 1.0 - 0.08, 1e-6);  // the lowest skin is at 0.08
  EXPECT_NEAR(at[Index(J::kLeftHand)].x, 0.75, 1e-6);
  for (const glm::vec3& normal : character->parts[0].normals) {
    EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
    EXPECT_NEAR(std::abs(normal.z), 1.0f, 1e-5f);  // computed: the squares face along z
  }
}

TEST(ReadCharacter, NodePoseThatDiffersFromTheBindPoseDoesNotMatter) {
  const auto plain = Parse(MakeSample());
  Sample posed = MakeSample();
  posed.root["nodes"][3]["rotation"] = {0.0, 0.0, -0.7071067811865476, 0.7071067811865476};
  posed.root["nodes"][10]["rotation"] = {0.5, 0.5, 0.5, 0.5};
  const auto character = Parse(posed);
  ASSERT_TRUE(plain && character) << character.error();
  ExpectSameShape(*plain, *character);
}

TEST(ReadCharacter, UnitsAndAxesOfTheNodeTreeDoNotMatter) {
  const auto plain = Parse(MakeSample());
  Sample turned = MakeSample(100.0);
  // An armature above the hips turns Z up to Y up and centimetres to metres; bones in Z up.
  turned.root["nodes"].push_back(
      {{"name", "Armature"}, {"scale", {0.01, 0.01, 0.01}}, {"children", {0}}});
  turned.root["scenes"][0]["nodes"] = {16, 15};
  const auto character = Parse(turned);
  ASSERT_TRUE(plain && character) << character.error();
  ExpectSameShape(*plain, *character);
  EXPECT_EQ(character->rig.metres_per_unit, 1.0);
}

TEST(ReadCharacter, CentimetresAreReadAsSuchWithANote) {
  const auto plain = Parse(MakeSample());
  const auto character = Parse(MakeSample(100.0));
  ASSERT_TRUE(plain && character) << character.error();
  EXPECT_NEAR(character->rig.metres_per_unit, 0.01, 1e-12);
  EXPECT_FALSE(character->notes.empty());
  ExpectSameShape(*plain, *character);
}

TEST(ReadCharacter, ReadsEveryWayToStoreTheSameSkin) {
  const auto plain = Parse(MakeSample());
  ASSERT_TRUE(plain);
  std::vector<std::pair<const char*, std::function<void(Sample&)>>> ways = {
      {"16-bit joints",
       [](Sample& s) {
         std::vector<std::uint16_t> joints;
         for (std::uint16_t b = 0; b < 15; ++b) {
           for (int i = 0; i < 4; ++i) joints.insert(joints.end(), {b, 0, 0, 0});
         }
         s.Attribute("JOINTS_0") = s.Accessor(joints, 5123, "VEC4", 4);
       }},
      {"normalised 8-bit weights",
       [](Sample& s) {
         std::vector<std::uint8_t> weights;
         for (int i = 0; i < 60; ++i) weights.insert(weights.end(), {255, 0, 0, 0});
         s.Attribute("WEIGHTS_0") = s.Accessor(weights, 5121, "VEC4", 4);
         s.AccessorOf("WEIGHTS_0")["normalized"] = true;
       }},
      {"eight influences",
       [](Sample& s) {
         s.Attribute("JOINTS_1") = s.Attribute("JOINTS_0");
         s.Attribute("WEIGHTS_1") = s.Attribute("WEIGHTS_0");
       }},
      {"weights that do not sum to one",
       [](Sample& s) {
         std::vector<float> weights;
         for (int i = 0; i < 60; ++i) weights.insert(weights.end(), {0.25f, 0.0f, 0.0f, 0.0f});
         s.Attribute("WEIGHTS_0") = s.Accessor(weights, 5126, "VEC4", 4);
       }},
      {"strided positions",
       [](Sample& s) {
         const auto view = s.AccessorOf("POSITION")["bufferView"].get<std::size_t>();
         const auto from = s.root["bufferViews"][view]["byteOffset"].get<std::size_t>();
         std::vector<float> wide;
         for (std::size_t v = 0; v < 60; ++v) {
           float p[3];
           std::memcpy(p, s.bin.data() + from + 12 * v, 12);
           wide.insert(wide.end(), {99.0f, p[0], p[1], p[2], 99.0f});
         }
         Json& accessor = s.AccessorOf("POSITION");
         const std::size_t at = s.View(wide.data(), wide.size() * 4);
         s.root["bufferViews"][at]["byteStride"] = 20;
         accessor["bufferView"] = at;
         accessor["byteOffset"] = 4;
       }},
      {"sparse positions",
       [](Sample& s) {
         // All of the positions as sparse values over zeros.
         const Json dense = s.AccessorOf("POSITION");
         std::vector<std::uint16_t> index;
         for (std::uint16_t v = 0; v < 60; ++v) index.push_back(v);
         const std::size_t at = s.View(index.data(), index.size() * 2);
         Json& accessor = s.AccessorOf("POSITION");
         accessor.erase("bufferView");
         accessor["sparse"] = {{"count", 60},
                               {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                               {"values", {{"bufferView", dense["bufferView"]}}}};
       }},
      {"several primitives and skins",
       [](Sample& s) {
         s.root["skins"].push_back(s.root["skins"][0]);
         s.root["nodes"][15]["skin"] = 1;
       }},
      {"a helper joint in the skin",
       [](Sample& s) {
         s.root["nodes"].push_back({{"name", "LeftArmTwist"}});
         s.root["nodes"][3]["children"].push_back(16);
       }},
  };
  for (auto& [what, change] : ways) {
    SCOPED_TRACE(what);
    Sample sample = MakeSample();
    change(sample);
    const auto character = Parse(sample);
    ASSERT_TRUE(character) << character.error();
    ExpectSameShape(*plain, *character);
  }
}

TEST(ReadCharacter, ReadsStripsFansAndPlainVertices) {
  for (const int mode : {4, 5, 6}) {
    Sample sample = MakeSample();
    Json& primitive = sample.root["meshes"][0]["primitives"][0];
    primitive["mode"] = mode;
    primitive.erase("indices");
    const auto character = Parse(sample);
    ASSERT_TRUE(character) << character.error();
    EXPECT_EQ(character->parts[0].triangles.size(), mode == 4 ? 60u : 58u * 3u);
  }
}

TEST(ReadCharacter, RigidMeshesHangOnTheirJoint) {
  Sample sample = MakeSample();
  sample.root["nodes"].push_back({{"name", "Cup"}, {"mesh", 1}, {"translation", {0.1, 0, 0}}});
  sample.root["nodes"][5]["children"].push_back(16);
  Json primitive;
  primitive["attributes"]["POSITION"] = sample.Attribute("POSITION");
  sample.root["meshes"].push_back({{"name", "Cup"}, {"primitives", {primitive}}});
  const auto character = Parse(sample);
  ASSERT_TRUE(character) << character.error();
  ASSERT_EQ(character->parts.size(), 2u);
  const auto placed = Placed(*character);
  // Parts come in the order of the nodes. First vertex of the cup: its own position, moved by the
  // hand and by the ground.
  EXPECT_NEAR(placed[0].x, -0.02 + 0.75 + 0.1, 1e-5);
  EXPECT_NEAR(placed[0].y, 0.98 + 1.4 - 0.08, 1e-5);
}

/// The sample with the skin of the left foot made a sole of this slope (toes down positive), and
/// how much lower its toes are than its heel in the canonical pose.
double ToesBelowHeel(double slope_degrees) {
  Sample sample = MakeSample();
  const auto view = sample.AccessorOf("POSITION")["bufferView"].get<std::size_t>();
  const auto from = sample.root["bufferViews"][view]["byteOffset"].get<std::size_t>();
  constexpr std::size_t kFoot = 11;
  const double s = std::sin(Radians(slope_degrees));
  const double c = std::cos(Radians(slope_degrees));
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double along = corner < 2 ? -0.05 : 0.15;
    const float p[3] = {corner % 2 == 0 ? 0.08f : 0.12f, static_cast<float>(0.1 - along * s),
                        static_cast<float>(along * c)};
    std::memcpy(sample.bin.data() + from + 12 * (4 * kFoot + corner), p, sizeof p);
  }
  const auto character = Parse(sample);
  EXPECT_TRUE(character) << character.error();
  const auto placed = Placed(*character);
  return placed[4 * kFoot].y - placed[4 * kFoot + 2].y;
}

TEST(ReadCharacter, LevelsFeetThatHangAndKeepASlightSlope) {
  for (const double slope : {-40.0, 15.0, 30.0, 60.0}) {
    EXPECT_NEAR(ToesBelowHeel(slope), 0.0, 1e-6) << slope;
  }
  for (const double slope : {-4.0, 0.0, 5.0}) {
    EXPECT_NEAR(ToesBelowHeel(slope), 0.2 * std::sin(Radians(slope)), 1e-6) << slope;
  }
}

TEST(ReadCharacter, TakesVrmBonesOverNames) {
  for (const bool old : {true, false}) {
    Sample sample = MakeSample();
    constexpr std::array kBones = {
        "hips",         "spine",         "head",          "leftUpperArm",  "leftLowerArm",
        "leftHand",     "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",
        "leftLowerLeg", "leftFoot",      "rightUpperLeg", "rightLowerLeg", "rightFoot"};
    Json bones = old ? Json::array() : Json::object();
    for (std::size_t b = 0; b < kBones.size(); ++b) {
      sample.root["nodes"][b]["name"] = "x";
      if (old) {
        bones.push_back({{"bone", kBones[b]}, {"node", b}});
      } else {
        bones[kBones[b]] = {{"node", b}};
      }
    }
    sample.root["extensions"][old ? "VRM" : "VRMC_vrm"] = {{"humanoid", {{"humanBones", bones}}}};
    const auto character = Parse(sample);
    ASSERT_TRUE(character) << character.error();
    EXPECT_EQ(character->map.Node(J::kRightFoot), 14);
    EXPECT_EQ(character->map.joint[Index(J::kHead)].confidence, 1.0);
    EXPECT_NEAR(CanonicalPositions(character->rig.skeleton)[Index(J::kLeftHand)].x, 0.75, 1e-5);
  }
}

TEST(ReadCharacter, StopsWhenAsked) {
  const auto glb = MakeSample().Glb();
  const auto character = ParseCharacter(
      glb, "a.glb", [](double fraction, std::string_view) { return fraction < 0.5; });
  ASSERT_FALSE(character);
  EXPECT_EQ(character.error(), "cancelled");
}

TEST(WriteCharacter, WritesWhatItReadsBack) {
  const auto character = Parse(MakeSample());
  ASSERT_TRUE(character) << character.error();
  const auto path = std::filesystem::path(testing::TempDir()) / "ego_written.glb";
  const auto written = WriteCharacter(path, *character);
  ASSERT_TRUE(written) << written.error();
  const auto again = ReadCharacter(path);
  ASSERT_TRUE(again) << again.error();
  ExpectSameShape(*character, *again);
  EXPECT_EQ(again->map.joint[Index(J::kHips)].confidence, 1.0);  // declared by VRMC_vrm
  std::filesystem::remove(path);
}

TEST(WriteRetargeted, RefusesNothingToWriteAndChangedSources) {
  auto character = Parse(MakeSample());
  ASSERT_TRUE(character);
  const auto path = std::filesystem::path(testing::TempDir()) / "ego_refused.glb";
  EXPECT_FALSE(WriteRetargeted(path, *character, {}, 30.0, "take"));
  const std::vector<Pose> poses{CanonicalPose(character->rig.skeleton)};
  EXPECT_FALSE(WriteRetargeted(path, *character, poses, 0.0, "take"));
  character->source_path = "/nowhere/absent.glb";
  const auto written = WriteRetargeted(path, *character, poses, 30.0, "take");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().find("absent.glb"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace ego
