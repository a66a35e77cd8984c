// SPDX-License-Identifier: MIT
#include "assets/people/person_face.h"

#include <cmath>
#include <vector>

#include "assets/people/closed_shapes.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// A closed tube along points that thins towards both ends.
ClosedMesh Stroke(const std::vector<Vec3>& points, double radius) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double u = 2.0 * static_cast<double>(i) / static_cast<double>(points.size() - 1) - 1.0;
    radii.push_back(radius * (1.0 - 0.55 * u * u));
  }
  return Tube(points, radii, 8);
}

}  // namespace

void AddFace(const PersonShape& shape, FigureBuilder& figure) {
  const PersonParameters& m = shape.parameters();
  const PersonHead& head = shape.head();
  const double h = m.head_height;
  const auto on_face = [&](double x, double y) {
    return PointAlong(figure.surface(), {x, y, shape.HeadDepth()}, {0.0, 0.0, 1.0}).position_ms;
  };
  const Vec3 iris = head.IrisFront();
  const double r = head.EyeRadius();
  const glm::vec3 brow_color = m.hair == Hair::kNone ? 0.45f * m.skin_color : 0.8f * m.hair_color;
  for (const double sign : {1.0, -1.0}) {
    // The light in the eye is on the same side of both.
    const Vec3 shine = iris + r * Vec3{0.0, 0.20, -0.06};
    figure.AddDetail(
        "Shine",
        Ball({sign * shine.x - 0.17 * r, shine.y, shine.z}, r * Vec3{0.12, 0.12, 0.07}, 10),
        J::kHead, {1.0f, 1.0f, 1.0f});
    std::vector<Vec3> brow;
    for (int i = 0; i <= 8; ++i) {
      const double u = i / 8.0;
      const double arc = 0.034 * h * (std::sin(kPi * (0.20 + 0.66 * u)) - 0.6);
      const Vec3 p = on_face(sign * (iris.x + (1.70 * u - 0.90) * r), iris.y + 1.05 * r + arc);
      brow.push_back(p - Vec3{0.0, 0.0, 0.004 * h});
    }
    figure.AddDetail("Brows", Stroke(brow, 0.017 * h), J::kHead, brow_color);
  }
  std::vector<Vec3> mouth;
  for (int i = 0; i <= 12; ++i) {
    const double u = i / 6.0 - 1.0;
    const Vec3 at = head.OnMouth(u);
    mouth.push_back(on_face(at.x, at.y) - Vec3{0.0, 0.0, 0.002 * h});
  }
  figure.AddDetail("Mouth", Stroke(mouth, 0.0062 * h), J::kHead,
                   m.skin_color * glm::vec3{0.40f, 0.22f, 0.22f});
}

}  // namespace ego
