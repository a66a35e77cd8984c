// SPDX-License-Identifier: MIT
#include "render/detail_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/check.h"
#include "render/shadow_mesh.h"

namespace ego {
namespace {

constexpr std::size_t kFewestTriangles = 160;
constexpr float kLargestError = 0.04f;  // shares of the extent
constexpr float kShadowError = 0.006f;  // the same, of what a shadow may be off
constexpr float kShadowCells = 56.0f;   // over the largest extent
constexpr double kWorthwhile = 0.8;     // a level must have fewer than so many of the finer one's

/// All parts as one mesh, as the edges between them must collapse alike on both sides.
struct Whole {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> part_of;  // per vertex
  std::vector<std::uint32_t> first;    // vertex, per part
  std::vector<unsigned> triangles;
};

Whole Join(std::span<const MeshPart> parts) {
  Whole whole;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    whole.first.push_back(first);
    whole.positions.insert(whole.positions.end(), parts[p].positions.begin(),
                           parts[p].positions.end());
    whole.part_of.resize(whole.positions.size(), static_cast<std::uint32_t>(p));
    const std::size_t count = parts[p].triangles.size() / 3 * 3;
    for (std::size_t i = 0; i < count; ++i) {
      whole.triangles.push_back(first + parts[p].triangles[i]);
    }
  }
  return whole;
}

float LargestExtent(std::span<const glm::vec3> positions) {
  glm::vec3 low{1e30f}, high{-1e30f};
  for (const glm::vec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 extent = high - low;
  return positions.empty() ? 0.0f : std::max({extent.x, extent.y, extent.z});
}

bool IsFinite(std::span<const glm::vec3> positions) {
  return std::all_of(positions.begin(), positions.end(), [](const glm::vec3& p) {
    return !glm::any(glm::isnan(p)) && !glm::any(glm::isinf(p));
  });
}

struct Step {
  std::vector<unsigned> triangles;
  float error = 0.0f;
};

std::vector<Step> Coarsen(const Whole& whole) {
  std::vector<Step> steps{{whole.triangles, 0.0f}};
  if (!IsFinite(whole.positions)) return steps;
  const float* xyz = &whole.positions.data()->x;
  const std::size_t vertices = whole.positions.size();
  const float scale = meshopt_simplifyScale(xyz, vertices, sizeof(glm::vec3));
  while (steps.back().triangles.size() / 3 > kFewestTriangles) {
    const Step& finer = steps.back();
    Step step;
    step.triangles.resize(finer.triangles.size());
    float error = 0.0f;
    step.triangles.resize(meshopt_simplify(
        step.triangles.data(), finer.triangles.data(), finer.triangles.size(), xyz, vertices,
        sizeof(glm::vec3), finer.triangles.size() / 6 * 3, kLargestError, 0, &error));
    if (static_cast<double>(step.triangles.size()) >
        kWorthwhile * static_cast<double>(finer.triangles.size())) {
      break;
    }
    step.error = std::hypot(finer.error, error * scale);  // independent of each other
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace

DetailLevels MakeDetailLevels(std::span<const MeshPart> parts) {
  DetailLevels out;
  const Whole whole = Join(parts);
  const std::vector<Step> steps = Coarsen(whole);

  // Vertices that coarser levels use come first.
  std::vector<int> last_used(whole.positions.size(), -1);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    for (const unsigned v : steps[k].triangles) last_used[v] = static_cast<int>(k);
  }
  std::vector<std::uint32_t> place(whole.positions.size());  // within its part
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<std::uint32_t>& order = out.order.emplace_back(parts[p].positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::uint32_t first = whole.first[p];
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return last_used[first + a] > last_used[first + b];
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) place[first + order[i]] = i;
  }

  const float extent = LargestExtent(whole.positions);
  const float cell = extent / kShadowCells;
  std::vector<std::vector<std::uint32_t>> split(parts.size());
  const auto sort_into_parts = [&](const std::vector<unsigned>& triangles) {
    for (auto& part : split) part.clear();
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      const std::uint32_t part = whole.part_of[triangles[i]];
      for (std::size_t k = i; k < i + 3; ++k) {
        EGO_CHECK(whole.part_of[triangles[k]] == part);  // edges never join two parts
        split[part].push_back(place[triangles[k]]);
      }
    }
  };
  const auto append = [&](const std::vector<std::uint32_t>& indices) {
    out.indices.insert(out.indices.end(), indices.begin(), indices.end());
  };
  const auto size = [&] { return static_cast<std::uint32_t>(out.indices.size()); };

  std::size_t shadow_step = 0;
  while (shadow_step + 1 < steps.size() && steps[shadow_step + 1].error < kShadowError * extent) {
    ++shadow_step;
  }
  std::vector<std::vector<glm::vec3>> positions(parts.size()), normals(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const std::uint32_t v : out.order[p]) {
      positions[p].push_back(parts[p].positions[v]);
      if (v < parts[p].normals.size()) normals[p].push_back(parts[p].normals[v]);
    }
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    DetailLevel& level = out.levels.emplace_back();
    level.error = steps[k].error;
    level.parts.resize(parts.size());
    sort_into_parts(steps[k].triangles);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      DetailLevel::Part& part = level.parts[p];
      std::uint32_t used = 0;
      for (const std::uint32_t v : split[p]) used = std::max(used, v + 1);
      part.vertex_count = used;
      part.first_index = size();
      part.index_count = static_cast<std::uint32_t>(split[p].size());
      if (split[p].empty()) continue;
      // Drivers keep a few transformed vertices: neighbours in space become so in order.
      meshopt_optimizeVertexCache(split[p].data(), split[p].data(), split[p].size(), used);
      append(split[p]);
    }
    if (k > 0 && k <= shadow_step) {
      for (std::size_t p = 0; p < parts.size(); ++p) {
        level.parts[p].first_shadow_index = out.levels[0].parts[p].first_shadow_index;
        level.parts[p].shadow_index_count = out.levels[0].parts[p].shadow_index_count;
      }
      continue;
    }
    sort_into_parts(steps[std::max(k, shadow_step)].triangles);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      level.parts[p].first_shadow_index = size();
      append(ClusterTriangles(positions[p], normals[p], split[p], cell));
      level.parts[p].shadow_index_count = size() - level.parts[p].first_shadow_index;
    }
  }
  return out;
}

}  // namespace ego
