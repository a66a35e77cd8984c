// SPDX-License-Identifier: MIT
#include "render/triangle_sink.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ego {
namespace {

/// A capsule of unit radius: xyz the direction from its end's centre, axis along y, w which end.
struct UnitCapsule {
  std::vector<glm::vec4> points;
  std::vector<std::uint32_t> indices;
};

/// `slices` around the axis, `rings` from each pole to its equator.
UnitCapsule MakeUnitCapsule(int slices, int rings) {
  UnitCapsule unit;
  // Rings from the pole of end 0 over both equators to the pole of end 1; poles are rings too.
  for (int end = 0; end < 2; ++end) {
    for (int k = 0; k <= rings; ++k) {
      const double step = 0.5 * kPi * k / rings;
      const double angle = end == 0 ? step - 0.5 * kPi : step;
      for (int i = 0; i < slices; ++i) {
        const double turn = 2.0 * kPi * i / slices;
        unit.points.emplace_back(std::cos(angle) * std::sin(turn), std::sin(angle),
                                 std::cos(angle) * std::cos(turn), end);
      }
    }
  }
  const int count = 2 * (rings + 1);
  const auto id = [&](int ring, int slice) {
    return static_cast<std::uint32_t>(ring * slices + slice % slices);
  };
  for (int r = 0; r + 1 < count; ++r) {
    for (int i = 0; i < slices; ++i) {
      const bool at_first_pole = r == 0;
      const bool at_last_pole = r + 2 == count;
      if (!at_first_pole) {
        unit.indices.insert(unit.indices.end(), {id(r, i), id(r, i + 1), id(r + 1, i)});
      }
      if (!at_last_pole) {
        unit.indices.insert(unit.indices.end(), {id(r, i + 1), id(r + 1, i + 1), id(r + 1, i)});
      }
    }
  }
  return unit;
}

/// The coarsest that is off by no more than `smallest`, at most as fine as its roundness wants.
const UnitCapsule& UnitFor(Roundness roundness, double radius, double smallest) {
  static const std::array<UnitCapsule, 5> kUnits = {MakeUnitCapsule(22, 5), MakeUnitCapsule(16, 4),
                                                    MakeUnitCapsule(12, 3), MakeUnitCapsule(8, 2),
                                                    MakeUnitCapsule(6, 2)};
  constexpr std::array<int, 5> kSlices = {22, 16, 12, 8, 6};
  std::size_t chosen = roundness == Roundness::kLimb ? 0 : 2;
  while (chosen + 1 < kUnits.size() &&
         radius * (1.0 - std::cos(kPi / kSlices[chosen + 1])) <= smallest) {
    ++chosen;
  }
  return kUnits[chosen];
}

}  // namespace

void AppendCapsule(const Vec3& end_a, double radius_a, const Vec3& end_b, double radius_b,
                   Roundness roundness, TriangleSink& sink) {
  const UnitCapsule& unit = UnitFor(roundness, std::max(radius_a, radius_b), sink.smallest);

  const Vec3 axis = end_b - end_a;
  const double length = glm::length(axis);
  const glm::vec3 y(length > 1e-6 ? axis / length : kUp);
  // A frame around the axis (Duff et al., Building an Orthonormal Basis, Revisited, 2017).
  const float sign = y.z >= 0.0f ? 1.0f : -1.0f;
  const float a = -1.0f / (sign + y.z);
  const float b = y.x * y.y * a;
  const glm::vec3 x(1.0f + sign * y.x * y.x * a, sign * b, -sign * y.x);
  const glm::vec3 z = glm::cross(x, y);
  // The side of a cone leans towards its thin end.
  const float lean = length > 1e-6
                         ? static_cast<float>(std::clamp((radius_a - radius_b) / length, -0.7, 0.7))
                         : 0.0f;

  const std::uint32_t first = sink.Next();
  for (const glm::vec4& point : unit.points) {
    const glm::vec3 direction = point.x * x + point.y * y + point.z * z;
    const bool is_b = point.w > 0.5f;
    sink.positions.push_back(glm::vec3(is_b ? end_b : end_a) +
                             static_cast<float>(is_b ? radius_b : radius_a) * direction);
    sink.normals.push_back(lean == 0.0f
                               ? direction
                               : glm::normalize(direction + lean * (1.0f - std::abs(point.y)) * y));
  }
  for (const std::uint32_t index : unit.indices) sink.indices.push_back(first + index);
}

}  // namespace ego
