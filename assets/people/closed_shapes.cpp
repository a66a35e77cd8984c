// SPDX-License-Identifier: MIT
#include "assets/people/closed_shapes.h"

#include <array>
#include <cmath>
#include <map>

namespace ego {

ClosedMesh Ball(const Vec3& centre, const Vec3& radius, int segments) {
  ClosedMesh mesh;
  const int rings = segments / 2;
  const auto at = [&](int ring, int segment) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * segments + segment % segments);
  };
  mesh.positions.push_back(centre + Vec3{0.0, radius.y, 0.0});
  for (int r = 1; r < rings; ++r) {
    const double polar = kPi * r / rings;
    for (int s = 0; s < segments; ++s) {
      const double angle = 2.0 * kPi * s / segments;
      mesh.positions.push_back(centre + radius * Vec3{std::sin(polar) * std::cos(angle),
                                                      std::cos(polar),
                                                      -std::sin(polar) * std::sin(angle)});
    }
  }
  const auto south = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(centre - Vec3{0.0, radius.y, 0.0});
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0u, at(1, s), at(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, s), south, at(rings - 1, s + 1)});
  }
  return mesh;
}

ClosedMesh RoundBox(const Vec3& centre, const Vec3& half, double round, int cuts) {
  ClosedMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> index;
  const Vec3 inner = half - Vec3(round);
  // Lattice points of the cube's surface, denser where the rounding is.
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [it, fresh] = index.try_emplace(at, static_cast<std::uint32_t>(index.size()));
    if (fresh) {
      Vec3 direction{0.0};
      Vec3 core{0.0};
      for (int axis = 0; axis < 3; ++axis) {
        const double share = 2.0 * at[static_cast<std::size_t>(axis)] / cuts - 1.0;
        direction[axis] = std::tan(0.25 * kPi * share);
        core[axis] = std::abs(share) < 1e-9 ? 0.0 : std::copysign(inner[axis], share);
      }
      mesh.positions.push_back(centre + core + round * glm::normalize(direction));
    }
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (const int face : {0, cuts}) {
      for (int i = 0; i < cuts; ++i) {
        for (int k = 0; k < cuts; ++k) {
          const auto corner = [&](int du, int dv) {
            std::array<int, 3> at{};
            at[axis] = face;
            at[u] = i + du;
            at[v] = k + dv;
            return vertex(at);
          };
          std::array<std::uint32_t, 4> quad = {corner(0, 0), corner(1, 0), corner(1, 1),
                                               corner(0, 1)};
          if (face == 0) std::swap(quad[1], quad[3]);
          mesh.triangles.push_back({quad[0], quad[1], quad[2]});
          mesh.triangles.push_back({quad[0], quad[2], quad[3]});
        }
      }
    }
  }
  return mesh;
}

ClosedMesh Tube(const std::vector<Vec3>& points, const std::vector<double>& radius, int segments) {
  constexpr int kCap = 4;  // rings of each end's half ball
  struct Ring {
    Vec3 centre;
    Vec3 along;
    double radius;
  };
  std::vector<Ring> rings;
  const std::size_t n = points.size();
  const auto direction = [&](std::size_t i) {
    return glm::normalize(points[std::min(i + 1, n - 1)] - points[i == 0 ? 0 : i - 1]);
  };
  for (int k = 1; k < kCap; ++k) {
    const double a = 0.5 * kPi * k / kCap;
    rings.push_back({points[0] - std::cos(a) * radius[0] * direction(0), direction(0),
                     std::sin(a) * radius[0]});
  }
  for (std::size_t i = 0; i < n; ++i) rings.push_back({points[i], direction(i), radius[i]});
  for (int k = kCap - 1; k > 0; --k) {
    const double a = 0.5 * kPi * k / kCap;
    rings.push_back({points[n - 1] + std::cos(a) * radius[n - 1] * direction(n - 1),
                     direction(n - 1), std::sin(a) * radius[n - 1]});
  }
  ClosedMesh mesh;
  mesh.positions.push_back(points[0] - radius[0] * direction(0));
  Vec3 u = glm::cross(rings[0].along, std::abs(rings[0].along.y) < 0.8 ? kUp : Vec3{1, 0, 0});
  for (const Ring& ring : rings) {
    u = glm::normalize(u - ring.along * glm::dot(u, ring.along));
    const Vec3 v = glm::cross(ring.along, u);
    for (int s = 0; s < segments; ++s) {
      const double a = 2.0 * kPi * s / segments;
      mesh.positions.push_back(ring.centre + ring.radius * (std::cos(a) * u + std::sin(a) * v));
    }
  }
  const auto last = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(points[n - 1] + radius[n - 1] * direction(n - 1));
  const auto at = [&](std::size_t ring, int s) {
    return static_cast<std::uint32_t>(1 + ring * static_cast<std::size_t>(segments) +
                                      static_cast<std::size_t>(s % segments));
  };
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0u, at(0, s + 1), at(0, s)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      mesh.triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
    }
    mesh.triangles.push_back({at(rings.size() - 1, s), at(rings.size() - 1, s + 1), last});
  }
  return mesh;
}

}  // namespace ego
