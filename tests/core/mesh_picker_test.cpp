// SPDX-License-Identifier: MIT
#include "core/model/mesh_picker.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "core/model/rig.h"
#include "tests/support/capsule_person.h"
#include "tests/support/skin_oracle.h"

namespace ego {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

class MeshPickerTest : public ::testing::Test {
 protected:
  const std::shared_ptr<const Character> character_ =
      std::make_shared<const Character>(test::MakeCapsulePerson({.belly = 0.1, .left_arm = 1.3}));
  MeshPicker picker_{character_};
  std::mt19937 random_{11};

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 RandomDirection() {
    Vec3 d;
    do {
      d = {Uniform(-1.0, 1.0), Uniform(-1.0, 1.0), Uniform(-1.0, 1.0)};
    } while (glm::length(d) < 0.1);
    return glm::normalize(d);
  }
  /// Bent everywhere, far from the canonical pose that the tree was built in.
  ModelPose RandomPose() {
    Pose pose = CanonicalPose(character_->rig.skeleton);
    for (Quat& q : pose.rotation_ls) q = glm::angleAxis(Uniform(-1.2, 1.2), RandomDirection());
    pose.root_ws += Vec3{Uniform(-1.0, 1.0), Uniform(0.0, 0.5), Uniform(-1.0, 1.0)};
    return ForwardKinematics(character_->rig.skeleton, pose);
  }
  template <class Visit>
  void EachTriangle(const Visit& visit) const {
    for (std::size_t p = 0; p < character_->parts.size(); ++p) {
      const auto& index = character_->parts[p].triangles;
      const auto& at = picker_.Mesh().position_ws[p];
      for (std::size_t t = 0; t < index.size(); t += 3) {
        visit(at[index[t]], at[index[t + 1]], at[index[t + 2]]);
      }
    }
  }
  /// Oracle: distance along the ray to the nearest triangle, by planes and sides of edges.
  double FirstCrossing(const Vec3& origin, const Vec3& direction) const {
    double first = kNone;
    EachTriangle([&](const Vec3& a, const Vec3& b, const Vec3& c) {
      if (const auto t = test::CrossingOf(origin, direction, a, b, c)) first = std::min(first, *t);
    });
    return first;
  }
};

TEST_F(MeshPickerTest, FindsInEveryPoseWhatBruteForceFinds) {
  int hits = 0;
  for (int p = 0; p < 6; ++p) {
    picker_.SetPose(RandomPose());
    const Vec3 middle = picker_.Mesh().position_ws[0][0];
    for (int i = 0; i < 60; ++i) {
      const Vec3 origin = middle + 3.0 * RandomDirection();
      const Vec3 target = middle + Uniform(0.0, 0.6) * RandomDirection();
      const Vec3 direction = glm::normalize(target - origin);
      const double expected = FirstCrossing(origin, direction);
      const auto hit = picker_.Pick(origin, direction);
      ASSERT_EQ(hit.has_value(), expected < kNone) << "pose " << p << " ray " << i;
      if (!hit) continue;
      ++hits;
      EXPECT_NEAR(hit->distance, expected, 1e-9);
      EXPECT_LT(glm::distance(picker_.Position(hit->place), hit->position_ws), 1e-9);
      EXPECT_NEAR(glm::dot(picker_.Normal(hit->place), hit->normal_ws), 1.0, 1e-9);
    }
  }
  EXPECT_GT(hits, 100);
}

TEST_F(MeshPickerTest, SnapsToTheVisibleVertexNearestToTheCursor) {
  int snapped = 0;
  for (const double slope : {0.012, 0.0}) {
    for (int p = 0; p < 4; ++p) {
      picker_.SetPose(RandomPose());
      const Vec3 middle = picker_.Mesh().position_ws[0][0];
      for (int i = 0; i < 12; ++i) {
        PickCone cone{middle + 3.0 * RandomDirection(), {}, slope > 0.0 ? 0.0 : 0.03, slope};
        cone.direction =
            glm::normalize(middle + Uniform(0.0, 0.4) * RandomDirection() - cone.origin_ws);
        // Oracle: every vertex of every part, seen when no triangle is nearer on its own ray.
        double least = 1.0;
        for (const auto& part : picker_.Mesh().position_ws) {
          for (const Vec3& at : part) {
            const double along = glm::dot(at - cone.origin_ws, cone.direction);
            const double width = cone.radius + cone.slope * along;
            const double off = glm::length(at - cone.origin_ws - along * cone.direction) / width;
            if (along <= 0.0 || off >= least) continue;
            const Vec3 eye = slope > 0.0 ? cone.origin_ws : at - along * cone.direction;
            const double far = glm::distance(eye, at);
            if (FirstCrossing(eye, (at - eye) / far) < far * (1.0 - 2e-6)) continue;
            least = off;
          }
        }
        const auto vertex = picker_.NearestVertex(cone);
        if (least == 1.0) continue;  // none inside the cursor: other laws
        ASSERT_TRUE(vertex);
        ++snapped;
        EXPECT_NEAR(vertex->off_axis, least, 1e-9);
        EXPECT_LT(glm::distance(vertex->position_ws, picker_.Position(vertex->place)), 1e-12);
      }
    }
  }
  EXPECT_GT(snapped, 30);
}

TEST_F(MeshPickerTest, WhereNoVertexIsNearItTakesACornerOfTheTriangleUnderTheCursor) {
  const Vec3 origin{0.01, 1.2, 4.0};
  const Vec3 direction{0.0, 0.0, -1.0};
  const auto hit = picker_.Pick(origin, direction);
  const auto vertex = picker_.NearestVertex({origin, direction, 1e-9, 0.0});
  ASSERT_TRUE(hit && vertex);
  EXPECT_EQ(vertex->place.part, hit->place.part);
  EXPECT_EQ(vertex->place.triangle, hit->place.triangle);
  EXPECT_FALSE(picker_.NearestVertex({{5.0, 1.2, 4.0}, direction, 1e-9, 0.0}));
}

TEST_F(MeshPickerTest, WhatTheBodyHidesIsNotVisible) {
  const Vec3 front = picker_.Pick({0.0, 1.2, 4.0}, {0.0, 0.0, -1.0})->position_ws;
  EXPECT_TRUE(picker_.Visible({0.0, 1.2, 4.0}, front));
  EXPECT_FALSE(picker_.Visible({0.0, 1.2, -4.0}, front));
}

}  // namespace
}  // namespace ego
