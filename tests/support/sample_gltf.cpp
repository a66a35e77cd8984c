// SPDX-License-Identifier: MIT
#include "tests/support/sample_gltf.h"

#include "assets/gltf/glb_container.h"
#include "core/base/math.h"

namespace ego::test {
namespace {

std::string Base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : std::uint8_t{0});
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out.push_back(i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63u]);
    }
  }
  return out;
}

struct Bone {
  const char* name;
  int parent;
  Vec3 at;
};

const std::vector<Bone>& Bones() {
  static const std::vector<Bone> bones = {
      {"Hips", -1, {0, 1, 0}},          {"Spine", 0, {0, 1.2, 0}},
      {"Head", 1, {0, 1.6, 0}},         {"LeftArm", 1, {.2, 1.4, 0}},
      {"LeftForeArm", 3, {.5, 1.4, 0}}, {"LeftHand", 4, {.75, 1.4, 0}},
      {"RightArm", 1, {-.2, 1.4, 0}},   {"RightForeArm", 6, {-.5, 1.4, 0}},
      {"RightHand", 7, {-.75, 1.4, 0}}, {"LeftUpLeg", 0, {.1, .95, 0}},
      {"LeftLeg", 9, {.1, .5, 0}},      {"LeftFoot", 10, {.1, .1, 0}},
      {"RightUpLeg", 0, {-.1, .95, 0}}, {"RightLeg", 12, {-.1, .5, 0}},
      {"RightFoot", 13, {-.1, .1, 0}}};
  return bones;
}

}  // namespace

std::vector<std::uint8_t> Sample::Glb() {
  root["buffers"] = {{{"byteLength", bin.size()}}};
  return PackGlb(root.dump(), bin);
}

std::string Sample::GltfText() {
  root["buffers"] = {
      {{"byteLength", bin.size()}, {"uri", "data:application/octet-stream;base64," + Base64(bin)}}};
  return root.dump();
}

Sample MakeSample(double unit) {
  Sample s;
  s.root["asset"] = {{"version", "2.0"}};
  s.root["scenes"] = {{{"nodes", {0, 15}}}};
  std::vector<float> bind;
  std::vector<float> positions;
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  std::vector<std::uint16_t> indices;
  for (std::size_t b = 0; b < Bones().size(); ++b) {
    const Bone& bone = Bones()[b];
    const Vec3 from =
        bone.parent < 0 ? Vec3(0.0) : Bones()[static_cast<std::size_t>(bone.parent)].at;
    const Vec3 t = unit * (bone.at - from);
    s.root["nodes"].push_back({{"name", bone.name}, {"translation", {t.x, t.y, t.z}}});
    if (bone.parent >= 0) {
      s.root["nodes"][static_cast<std::size_t>(bone.parent)]["children"].push_back(b);
    }
    for (int c = 0; c < 16; ++c) bind.push_back(c % 5 == 0 ? 1.0f : 0.0f);
    for (int c = 0; c < 3; ++c) {
      bind[b * 16 + 12 + static_cast<std::size_t>(c)] = static_cast<float>(-unit * bone.at[c]);
    }
    for (int corner = 0; corner < 4; ++corner) {
      positions.push_back(static_cast<float>(unit * (bone.at.x + (corner % 2 == 0 ? -.02 : .02))));
      positions.push_back(static_cast<float>(unit * (bone.at.y + (corner < 2 ? -.02 : .02))));
      positions.push_back(static_cast<float>(unit * bone.at.z));
      joints.insert(joints.end(), {static_cast<std::uint8_t>(b), 0, 0, 0});
      weights.insert(weights.end(), {1.0f, 0.0f, 0.0f, 0.0f});
    }
    const auto first = static_cast<std::uint16_t>(4 * b);
    for (const int corner : {0, 1, 2, 2, 1, 3}) {
      indices.push_back(static_cast<std::uint16_t>(first + corner));
    }
  }
  s.root["nodes"].push_back({{"name", "Skin"}, {"mesh", 0}, {"skin", 0}});
  std::vector<int> all;
  for (int b = 0; b < 15; ++b) all.push_back(b);
  s.root["skins"] = {
      {{"joints", all}, {"inverseBindMatrices", s.Accessor(bind, 5126, "MAT4", 16)}}};
  nlohmann::json attributes;
  attributes["POSITION"] = s.Accessor(positions, 5126, "VEC3", 3);
  attributes["JOINTS_0"] = s.Accessor(joints, 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = s.Accessor(weights, 5126, "VEC4", 4);
  s.root["meshes"] = {
      {{"name", "Skin"},
       {"primitives",
        {{{"attributes", attributes}, {"indices", s.Accessor(indices, 5123, "SCALAR", 1)}}}}}};
  return s;
}

}  // namespace ego::test
