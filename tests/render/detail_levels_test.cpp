// SPDX-License-Identifier: MIT
#include "render/detail_levels.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/math.h"

namespace ego {
namespace {

using Point = std::array<float, 3>;

/// A unit sphere in two parts, above and below y = 0, that meet in vertices of equal position.
std::vector<MeshPart> SplitSphere(int slices, int rings) {
  const auto vertex = [&](int ring, int slice) {
    const double polar = kPi * ring / rings;
    const double turn = 2.0 * kPi * (slice % slices) / slices;
    const double radius = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
    return glm::vec3(radius * std::cos(turn), std::cos(polar), radius * std::sin(turn));
  };
  std::vector<MeshPart> parts(2);
  std::array<std::map<Point, std::uint32_t>, 2> ids;
  for (int r = 0; r < rings; ++r) {
    const std::size_t p = r < rings / 2 ? 0 : 1;
    const auto id = [&](int ring, int slice) {
      const glm::vec3 at = vertex(ring, slice);
      const auto next = static_cast<std::uint32_t>(parts[p].positions.size());
      const auto [it, is_new] = ids[p].try_emplace({at.x, at.y, at.z}, next);
      if (is_new) {
        parts[p].positions.push_back(at);
        parts[p].normals.push_back(glm::normalize(at));
      }
      return it->second;
    };
    for (int s = 0; s < slices; ++s) {
      const std::array<std::uint32_t, 4> q = {id(r, s), id(r, s + 1), id(r + 1, s),
                                              id(r + 1, s + 1)};
      auto& t = parts[p].triangles;
      if (r > 0) t.insert(t.end(), {q[0], q[1], q[2]});
      if (r + 1 < rings) t.insert(t.end(), {q[1], q[3], q[2]});
    }
  }
  return parts;
}

class DetailLevelsTest : public testing::Test {
 protected:
  glm::vec3 At(std::size_t part, std::uint32_t index) const {
    return parts_[part].positions[detail_.order[part][index]];
  }
  const std::vector<MeshPart> parts_ = SplitSphere(64, 48);
  const DetailLevels detail_ = MakeDetailLevels(parts_);
};

TEST_F(DetailLevelsTest, FinestHasEveryTriangleAndCoarserOnesFewer) {
  ASSERT_GE(detail_.levels.size(), 4u);
  EXPECT_EQ(detail_.levels[0].error, 0.0f);
  std::size_t before = 0;
  for (std::size_t k = 0; k < detail_.levels.size(); ++k) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      count += detail_.levels[k].parts[p].index_count;
    }
    if (k == 0) {
      EXPECT_EQ(count, parts_[0].triangles.size() + parts_[1].triangles.size());
    } else {
      EXPECT_LT(count, before * 9 / 10);
      EXPECT_GE(detail_.levels[k].error, detail_.levels[k - 1].error);
    }
    before = count;
  }
}

TEST_F(DetailLevelsTest, EveryLevelUsesTheFirstVerticesOnly) {
  for (const DetailLevel& level : detail_.levels) {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const DetailLevel::Part& part = level.parts[p];
      EXPECT_LE(part.vertex_count, parts_[p].positions.size());
      for (std::uint32_t i = 0; i < part.index_count; ++i) {
        ASSERT_LT(detail_.indices[part.first_index + i], part.vertex_count);
      }
      EXPECT_GT(part.shadow_index_count, 0u);
      for (std::uint32_t i = 0; i < part.shadow_index_count; ++i) {
        ASSERT_LT(detail_.indices[part.first_shadow_index + i], part.vertex_count);
      }
    }
  }
}

TEST_F(DetailLevelsTest, NoLevelGapesWherePartsMeet) {
  for (const DetailLevel& level : detail_.levels) {
    // On a closed surface every edge runs once in each direction.
    std::map<std::pair<Point, Point>, int> edges;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for (std::uint32_t i = 0; i < level.parts[p].index_count; i += 3) {
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t* triangle = &detail_.indices[level.parts[p].first_index + i];
          const glm::vec3 a = At(p, triangle[k]), b = At(p, triangle[(k + 1) % 3]);
          ++edges[{{a.x, a.y, a.z}, {b.x, b.y, b.z}}];
        }
      }
    }
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
  }
}

TEST_F(DetailLevelsTest, ErrorTellsHowFarTheSurfaceIsOff) {
  for (const DetailLevel& level : detail_.levels) {
    float worst = 0.0f;  // of the triangles' middles below the sphere, which the vertices lie on
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for (std::uint32_t i = 0; i < level.parts[p].index_count; i += 3) {
        const std::uint32_t* t = &detail_.indices[level.parts[p].first_index + i];
        const glm::vec3 middle = (At(p, t[0]) + At(p, t[1]) + At(p, t[2])) / 3.0f;
        worst = std::max(worst, 1.0f - glm::length(middle));
      }
    }
    EXPECT_LT(worst, 3.0f * level.error + 0.01f);
  }
}

TEST(DetailLevels, NothingAndPointsThatAreNoNumbersHaveOneLevel) {
  EXPECT_EQ(MakeDetailLevels({}).levels.size(), 1u);
  std::vector<MeshPart> parts = SplitSphere(32, 24);
  parts[0].positions[5].x = std::nanf("");
  const DetailLevels detail = MakeDetailLevels(parts);
  ASSERT_EQ(detail.levels.size(), 1u);
  EXPECT_EQ(detail.levels[0].parts[0].index_count, parts[0].triangles.size());
}

}  // namespace
}  // namespace ego
