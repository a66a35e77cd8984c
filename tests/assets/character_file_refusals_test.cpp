// SPDX-License-Identifier: MIT
// What the reader of characters refuses, each with one sentence.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "assets/gltf/character_file.h"
#include "tests/support/sample_gltf.h"

namespace ego {
namespace {

using Json = nlohmann::json;
using test::MakeSample;
using test::Sample;

Result<Character> Parse(Sample sample) { return ParseCharacter(sample.Glb(), "sample.glb"); }

TEST(ReadCharacter, RefusesBrokenFilesWithOneSentence) {
  const std::vector<std::pair<const char*, std::function<void(Sample&)>>> breaks = {
      {"child", [](Sample& s) { s.root["nodes"][5]["children"] = {77}; }},
      {"ancestor",
       [](Sample& s) {
         s.root["nodes"].push_back({{"name", "a"}, {"children", {17}}});
         s.root["nodes"].push_back({{"name", "b"}, {"children", {16}}});
       }},
      {"two parents", [](Sample& s) { s.root["nodes"][5]["children"] = {2}; }},
      {"scene refers", [](Sample& s) { s.root["scenes"][0]["nodes"] = {1000}; }},
      {"skin", [](Sample& s) { s.root["nodes"][15]["skin"] = 4; }},
      {"mesh", [](Sample& s) { s.root["nodes"][15]["mesh"] = 4; }},
      {"skin 0 refers", [](Sample& s) { s.root["skins"][0]["joints"][3] = 99; }},
      {"inverse bind matrices", [](Sample& s) { s.root["accessors"][0]["count"] = 3; }},
      {"POSITION refers", [](Sample& s) { s.Attribute("POSITION") = 1000; }},
      {"POSITION", [](Sample& s) { s.AccessorOf("POSITION")["count"] = 4000; }},
      {"elements", [](Sample& s) { s.AccessorOf("POSITION")["count"] = 4000000000u; }},
      {"runs past the end of its buffer view",
       [](Sample& s) { s.AccessorOf("POSITION")["count"] = 16000000u; }},
      {"no buffer view",  // zeros that nothing in the file stands for
       [](Sample& s) {
         s.AccessorOf("POSITION").erase("bufferView");
         s.AccessorOf("POSITION")["count"] = 16000000u;
       }},
      {"no buffer view",
       [](Sample& s) {
         Json& accessor = s.AccessorOf("POSITION");
         accessor.erase("bufferView");
         accessor["count"] = 16000000u;
         accessor["sparse"] = {{"count", 16000000u},
                               {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                               {"values", {{"bufferView", 0}}}};
       }},
      {"shape", [](Sample& s) { s.AccessorOf("POSITION")["type"] = "VEC2"; }},
      {"sparse",
       [](Sample& s) {
         s.AccessorOf("POSITION")["sparse"] = {
             {"count", 60},
             {"indices", {{"bufferView", 0}, {"byteOffset", 0}, {"componentType", 5125}}},
             {"values", {{"bufferView", 99}}}};
       }},
      {"skin joint",
       [](Sample& s) {
         std::vector<std::uint8_t> joints(240, 200);
         s.Attribute("JOINTS_0") = s.Accessor(joints, 5121, "VEC4", 4);
       }},
      {"vertex index",
       [](Sample& s) {
         std::vector<std::uint16_t> indices{0, 1, 60000};
         s.root["meshes"][0]["primitives"][0]["indices"] = s.Accessor(indices, 5123, "SCALAR", 1);
       }},
      {"finite",
       [](Sample& s) {
         std::vector<float> positions(180, std::nanf(""));
         s.Attribute("POSITION") = s.Accessor(positions, 5126, "VEC3", 3);
       }},
      {"material", [](Sample& s) { s.root["meshes"][0]["primitives"][0]["material"] = 3; }},
      {"past the end", [](Sample& s) { s.root["bufferViews"][1]["byteLength"] = 1000000; }},
      {"buffer", [](Sample& s) { s.root["bufferViews"][1]["buffer"] = 3; }},
      {"byteOffset", [](Sample& s) { s.root["bufferViews"][1]["byteOffset"] = -5; }},
      {"Draco", [](Sample& s) { s.root["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
      {"ACME_unknown", [](Sample& s) { s.root["extensionsRequired"] = {"ACME_unknown"}; }},
      {"version", [](Sample& s) { s.root["asset"]["version"] = "1.0"; }},
      {"VRM bone",
       [](Sample& s) {
         s.root["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"]["hips"]["node"] = 500;
       }},
      {"missing", [](Sample& s) { s.root["nodes"][9].erase("children"); }},
      {"meshopt",
       [](Sample& s) {
         s.root["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0},      {"byteOffset", 0},   {"byteLength", 16},
             {"byteStride", 12}, {"count", 1u << 30}, {"mode", "ATTRIBUTES"}};
       }},
  };
  for (const auto& [word, change] : breaks) {
    SCOPED_TRACE(word);
    Sample sample = MakeSample();
    change(sample);
    const auto character = Parse(sample);
    ASSERT_FALSE(character);
    EXPECT_TRUE(character.error().starts_with("sample.glb: ")) << character.error();
    EXPECT_NE(character.error().find(word), std::string::npos) << character.error();
    EXPECT_EQ(character.error().find('\n'), std::string::npos) << character.error();
  }
}

TEST(ReadCharacter, RefusesWhatIsNoGltf) {
  const std::vector<std::uint8_t> glb = MakeSample().Glb();
  const auto sentence = [](std::span<const std::uint8_t> bytes) {
    return ParseCharacter(bytes, "x.glb").error();
  };
  EXPECT_FALSE(sentence({}).empty());
  for (const std::size_t size : {3u, 4u, 11u, 19u, 20u, 100u, 4000u}) {
    EXPECT_FALSE(sentence(std::span(glb).first(size)).empty()) << size;
  }
  const std::string text = "solid teapot";
  EXPECT_NE(sentence(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()))
                .find("glTF"),
            std::string::npos);
  std::string deep = "{\"asset\":{\"version\":\"2.0\"},\"extras\":";
  deep.append(100000, '[');
  EXPECT_NE(sentence(std::span(reinterpret_cast<const std::uint8_t*>(deep.data()), deep.size()))
                .find("nested"),
            std::string::npos);
}

TEST(ReadCharacter, NamesInTheFileDoNotBreakTheSentence) {
  Sample sample = MakeSample();
  sample.root["nodes"][5]["name"] = "first\nsecond" + std::string(5000, 'x');
  sample.root["nodes"][5]["children"] = {2};
  sample.root["nodes"][2]["name"] = "first\nsecond" + std::string(5000, 'x');
  const auto character = Parse(sample);
  ASSERT_FALSE(character);
  EXPECT_LT(character.error().size(), 600u);
  EXPECT_EQ(character.error().find('\n'), std::string::npos);
}

TEST(ReadCharacter, NeverReadsOutsideItsFolder) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "ego_character_files";
  std::filesystem::create_directories(folder / "inner");
  Sample sample = MakeSample();
  const auto write = [](const std::filesystem::path& path, const auto& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  };
  write(folder / "secret.bin", sample.bin);
  write(folder / "inner" / "own data.bin", sample.bin);
  const auto read = [&](const std::string& uri) {
    sample.root["buffers"] = {{{"byteLength", sample.bin.size()}, {"uri", uri}}};
    write(folder / "inner" / "a.gltf", sample.root.dump());
    return ReadCharacter(folder / "inner" / "a.gltf");
  };
  EXPECT_TRUE(read("own%20data.bin")) << read("own%20data.bin").error();
  for (const std::string& uri :
       std::vector<std::string>{"../secret.bin", "%2e%2e/secret.bin", "x/../../secret.bin",
                                (folder / "secret.bin").string(),
                                "file://" + (folder / "secret.bin").string(), "..\\secret.bin"}) {
    const auto character = read(uri);
    ASSERT_FALSE(character) << uri;
    EXPECT_NE(character.error().find("beside it"), std::string::npos) << character.error();
  }
  EXPECT_NE(read("absent.bin").error().find("absent.bin"), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace ego
