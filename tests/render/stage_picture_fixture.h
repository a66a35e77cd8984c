// SPDX-License-Identifier: MIT
// Pictures drawn without a window. Where something must appear is computed with GLM's own camera
// functions, apart from the renderer's.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/model/rig.h"
#include "render/offscreen.h"
#include "render/stage_renderer.h"
#include "tests/support/capsule_person.h"

namespace ego::test {

inline constexpr int kWidth = 480;
inline constexpr int kHeight = 320;

inline glm::ivec3 PixelAt(const Image& image, int x, int y) {
  const std::size_t i = 4u * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
}

inline glm::ivec2 Where(const Vec3& point, const Camera& camera, int width, int height) {
  const Mat4 view = glm::lookAt(camera.Position(), camera.target_ws, kUp);
  const Mat4 projection =
      glm::perspective(camera.fov_y, static_cast<double>(width) / height, 0.1, 100.0);
  const Vec3 window = glm::project(point, view, projection, Vec4{0, 0, width, height});
  return {static_cast<int>(std::floor(window.x)), static_cast<int>(std::floor(height - window.y))};
}
inline glm::ivec3 PixelAt(const Image& image, const Vec3& point, const Camera& camera) {
  const glm::ivec2 at = Where(point, camera, image.width, image.height);
  return PixelAt(image, at.x, at.y);
}

inline int Difference(const glm::ivec3& a, const glm::ivec3& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// Calls for every pixel that differs by more than `least`; returns how many.
inline int Differing(const Image& a, const Image& b, int least,
                     const std::function<void(int, int)>& visit = {}) {
  int count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (Difference(PixelAt(a, x, y), PixelAt(b, x, y)) <= least) continue;
      ++count;
      if (visit) visit(x, y);
    }
  }
  return count;
}

class StagePictureTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Result<OffscreenContext> made = OffscreenContext::Create();
    if (!made) {
      reason_ = made.error();
      return;
    }
    context_ = std::make_unique<OffscreenContext>(std::move(*made));
    StageRenderer::Options options;
    options.shadow_map_size = 1024;
    Result<StageRenderer> renderer = StageRenderer::Create(options);
    ASSERT_TRUE(renderer) << renderer.error();
    renderer_ = std::make_unique<StageRenderer>(std::move(*renderer));
  }
  static void TearDownTestSuite() {
    renderer_.reset();
    context_.reset();
  }
  void SetUp() override {
    if (!context_) GTEST_SKIP() << reason_;
    body_ = TemplateBody();
    pose_ = ForwardKinematics(body_.skeleton, CanonicalPose(body_.skeleton));
    view_.camera.Look(StandardView::kFront);
    view_.camera.pitch = 0.15;
    view_.camera.distance = 4.0;
    renderer_->SetSamples(0);
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
  }

  Image Draw() {
    view_.figures = figures_;
    return renderer_->DrawImage(view_, kWidth, kHeight);
  }
  Figure& AddSurface(float opacity = 1.0f) {
    Figure& figure = figures_.emplace_back();
    figure.surface = SurfacePart{&body_, &pose_};
    figure.surface->opacity = opacity;
    return figure;
  }
  /// A character in one plain colour; `nodes_` holds its canonical pose.
  Character RedPerson() {
    Character person = test::MakeCapsulePerson();
    person.materials.push_back({});
    person.materials.back().base_color = {0.8f, 0.02f, 0.02f, 1.0f};
    for (MeshPart& part : person.parts) part.material = 0;
    nodes_.resize(person.nodes.joints.size());
    const Skeleton& skeleton = person.rig.skeleton;
    PoseNodes(person.rig, ForwardKinematics(skeleton, CanonicalPose(skeleton)), nodes_);
    return person;
  }

  inline static std::unique_ptr<OffscreenContext> context_;
  inline static std::unique_ptr<StageRenderer> renderer_;
  inline static std::string reason_;

  Body body_;
  ModelPose pose_;
  std::vector<Figure> figures_;
  std::vector<Mat4> nodes_;
  StageView view_;
};

inline bool IsRed(const glm::ivec3& p) { return p.x > 60 && p.x > 2 * p.y && p.x > 2 * p.z; }
inline bool IsAmber(const glm::ivec3& p) { return p.x > 70 && p.x > p.y + 10 && p.y > p.z + 15; }

}  // namespace ego::test
