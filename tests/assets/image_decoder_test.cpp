// SPDX-License-Identifier: MIT
#include "assets/gltf/image_decoder.h"

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>
#include <webp/encode.h>

#include <vector>

#include "assets/gltf/character_file.h"
#include "tests/support/sample_gltf.h"

namespace ego {
namespace {

constexpr int kWidth = 5;
constexpr int kHeight = 3;

std::vector<std::uint8_t> Pixels() {
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto step = static_cast<std::uint8_t>(16 * i);
    rgba.insert(rgba.end(), {step, static_cast<std::uint8_t>(255 - step), 40, 255});
  }
  return rgba;
}

std::vector<std::uint8_t> Webp() {
  std::uint8_t* encoded = nullptr;
  const std::size_t size =
      WebPEncodeLosslessRGBA(Pixels().data(), kWidth, kHeight, 4 * kWidth, &encoded);
  std::vector<std::uint8_t> bytes(encoded, encoded + size);
  WebPFree(encoded);
  return bytes;
}

void Append(void* to, void* data, int size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  static_cast<std::vector<std::uint8_t>*>(to)->insert(
      static_cast<std::vector<std::uint8_t>*>(to)->end(), bytes, bytes + size);
}

std::vector<std::uint8_t> Png() {
  std::vector<std::uint8_t> bytes;
  stbi_write_png_to_func(Append, &bytes, kWidth, kHeight, 4, Pixels().data(), 4 * kWidth);
  return bytes;
}

std::vector<std::uint8_t> Tga() {
  std::vector<std::uint8_t> bytes;
  stbi_write_tga_to_func(Append, &bytes, kWidth, kHeight, 4, Pixels().data());
  return bytes;
}

/// The sample with a material whose texture has a WebP image and, when given, another.
test::Sample Textured(const std::vector<std::uint8_t>& webp, const std::vector<std::uint8_t>& png) {
  test::Sample sample = test::MakeSample();
  nlohmann::json& root = sample.root;
  root["images"].push_back(
      {{"bufferView", sample.View(webp.data(), webp.size())}, {"mimeType", "image/webp"}});
  nlohmann::json texture;
  texture["extensions"]["EXT_texture_webp"]["source"] = 0;
  if (!png.empty()) {
    root["images"].push_back(
        {{"bufferView", sample.View(png.data(), png.size())}, {"mimeType", "image/png"}});
    texture["source"] = 1;
  }
  root["textures"] = {texture};
  root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  root["meshes"][0]["primitives"][0]["material"] = 0;
  root["extensionsUsed"] = {"EXT_texture_webp"};
  if (png.empty()) root["extensionsRequired"] = {"EXT_texture_webp"};
  return sample;
}

TEST(DecodeImage, ReadsWhatLosslessFormatsHold) {
  for (const auto& bytes : {Webp(), Png()}) {
    const auto image = DecodeImage(bytes, 15);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, kWidth);
    EXPECT_EQ(image->height, kHeight);
    EXPECT_EQ(image->rgba, Pixels());
  }
}

TEST(DecodeImage, RefusesDamagedLargeAndForeignImages) {
  for (const auto& bytes : {Webp(), Png()}) {
    EXPECT_FALSE(DecodeImage(bytes, 14));
    EXPECT_FALSE(DecodeImage(std::span(bytes).first(bytes.size() / 2), 15));
    EXPECT_FALSE(DecodeImage(std::span(bytes).first(3), 15));
  }
  EXPECT_FALSE(DecodeImage({}, 15));
  EXPECT_FALSE(DecodeImage(Tga(), 15));
}

TEST(ReadCharacter, PrefersTheWebpOfATexture) {
  for (const bool fallback : {false, true}) {
    const auto character = ParseCharacter(
        Textured(Webp(), fallback ? Png() : std::vector<std::uint8_t>()).Glb(), "a.glb");
    ASSERT_TRUE(character) << character.error();
    ASSERT_EQ(character->materials.at(0).base_color_image, 0);
    EXPECT_EQ(character->images.at(0).rgba, Pixels());
    if (fallback) {
      EXPECT_EQ(character->images.at(1).width, 0);  // not drawn, so not decoded
    }
  }
}

TEST(ReadCharacter, FallsBackWhereTheWebpIsDamaged) {
  std::vector<std::uint8_t> damaged = Webp();
  damaged.resize(damaged.size() / 2);
  const auto character = ParseCharacter(Textured(damaged, Png()).Glb(), "a.glb");
  ASSERT_TRUE(character) << character.error();
  EXPECT_EQ(character->materials.at(0).base_color_image, 1);
  const auto bare = ParseCharacter(Textured(damaged, {}).Glb(), "a.glb");
  ASSERT_TRUE(bare) << bare.error();
  EXPECT_EQ(bare->materials.at(0).base_color_image, -1);
  EXPECT_FALSE(bare->notes.empty());
}

}  // namespace
}  // namespace ego
