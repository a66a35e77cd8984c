// SPDX-License-Identifier: MIT
#include "assets/people/person_face.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ego {
namespace {

using J = HumanoidJoint;

/// A thin closed tube along points.
ClosedMesh Tube(const std::vector<Vec3>& points, double radius) {
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto surface = [&](const Vec3& p) {
    double d = 1e9;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double taper = [&](std::size_t k) {
        const double u =
            2.0 * static_cast<double>(k) / static_cast<double>(points.size() - 1) - 1.0;
        return radius * (1.0 - 0.45 * u * u);
      }(i);
      d = field::SmoothUnion(d, field::Capsule(p, points[i], points[i + 1], taper, taper),
                             0.5 * radius);
    }
    return d;
  };
  return Polygonise(
      surface, UniformLattice(low - Vec3(1.2 * radius), high + Vec3(1.2 * radius), 0.75 * radius));
}

}  // namespace

void AddFace(const PersonShape& shape, FigureBuilder& figure) {
  const PersonParameters& m = shape.parameters();
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double chin = shape.ChinHeight();
  const auto on_face = [&](double x, double y) {
    return PointAlong(figure.surface(), {x, chin + y, shape.HeadDepth()}, {0.0, 0.0, 1.0})
        .position_ms;
  };
  constexpr glm::vec3 kWhite{0.93f, 0.93f, 0.91f};
  constexpr glm::vec3 kPupil{0.07f, 0.06f, 0.06f};
  const double eye = 0.062 * h * m.eye_size;
  for (const double sign : {1.0, -1.0}) {
    const Vec3 p = on_face(sign * 0.42 * w, 0.49 * h);
    const Vec3 white{0.98 * eye, 0.92 * eye, 0.62 * eye};
    const Vec3 centre = p + Vec3{0.0, 0.0, -0.22 * eye};
    figure.AddDetail("Eyes", Ball(centre, white, 20), J::kHead, kWhite);
    figure.AddDetail(
        "Pupils",
        Ball(centre + eye * Vec3{-0.06 * sign, 0.0, 0.40}, eye * Vec3{0.56, 0.60, 0.30}, 16),
        J::kHead, kPupil);
    std::vector<Vec3> brow;
    for (int i = 0; i <= 6; ++i) {
      const double u = i / 6.0;
      const double arc = 0.022 * h * std::sin(kPi * (0.25 + 0.6 * u));
      brow.push_back(
          on_face(sign * (0.20 + 0.48 * u) * w, 0.575 * h + 0.5 * (eye - 0.062 * h) + arc));
    }
    const glm::vec3 brow_color = m.hair == Hair::kNone ? 0.45f * m.skin_color : 0.9f * m.hair_color;
    figure.AddDetail("Brows", Tube(brow, 0.015 * h), J::kHead, brow_color);
  }
  std::vector<Vec3> mouth;
  for (int i = 0; i <= 8; ++i) {
    const double u = i / 4.0 - 1.0;
    mouth.push_back(on_face(0.36 * w * u, (0.215 + 0.028 * u * u) * h));
  }
  figure.AddDetail("Mouth", Tube(mouth, 0.0115 * h), J::kHead,
                   m.skin_color * glm::vec3{0.62f, 0.42f, 0.42f});
}

}  // namespace ego
