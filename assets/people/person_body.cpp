// SPDX-License-Identifier: MIT
#include "assets/people/person_body.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/check.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

struct Hit {
  double t = 0.0;
  std::size_t triangle = 0;
  Vec3 barycentric{0.0};
  bool leaves = false;
};

/// On which sides of two planes through the ray each vertex surely lies, as bits. A triangle whose
/// corners share a side is not hit.
std::vector<std::uint8_t> SidesOfRay(const FigureSurface& surface, const Vec3& origin,
                                     const Vec3& d) {
  constexpr double kMargin = 1e-7;
  const Vec3 across = glm::cross(d, std::abs(d.y) < 0.8 ? kUp : Vec3{1.0, 0.0, 0.0});
  const Vec3 normals[] = {across, glm::cross(d, across)};
  std::vector<std::uint8_t> sides(surface.position_ms.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec3 p = surface.position_ms[i] - origin;
    const double a = glm::dot(p, normals[0]);
    const double b = glm::dot(p, normals[1]);
    sides[i] = static_cast<std::uint8_t>((a > kMargin) | (a < -kMargin) << 1 | (b > kMargin) << 2 |
                                         (b < -kMargin) << 3);
  }
  return sides;
}

/// All crossings in front of the origin (Möller and Trumbore 1997), nearest first.
std::vector<Hit> Crossings(const FigureSurface& surface, const Vec3& origin, const Vec3& d) {
  // A ray through an edge hits both of its triangles rather than none; one of them is dropped.
  constexpr double kEdge = 1e-9;
  const std::vector<std::uint8_t> sides = SidesOfRay(surface, origin, d);
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    if ((sides[t[0]] & sides[t[1]] & sides[t[2]]) != 0) continue;
    const Vec3& a = surface.position_ms[t[0]];
    const Vec3 e1 = surface.position_ms[t[1]] - a;
    const Vec3 e2 = surface.position_ms[t[2]] - a;
    const Vec3 q = glm::cross(d, e2);
    const double det = glm::dot(e1, q);
    if (std::abs(det) < 1e-18) continue;
    const Vec3 s = origin - a;
    const double u = glm::dot(s, q) / det;
    if (u < -kEdge || u > 1.0 + kEdge) continue;
    const Vec3 r = glm::cross(s, e1);
    const double v = glm::dot(d, r) / det;
    if (v < -kEdge || u + v > 1.0 + kEdge) continue;
    const double along = glm::dot(e2, r) / det;
    if (along > 0.0) hits.push_back({along, i, {1.0 - u - v, u, v}, det < 0.0});
  }
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  const auto same = [](const Hit& a, const Hit& b) {
    return std::abs(a.t - b.t) < 1e-9 && a.leaves == b.leaves;
  };
  hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
  return hits;
}

Attachment Blend(const FigureSurface& surface, const Hit& hit) {
  std::array<double, kJointCount> sum{};
  for (int c = 0; c < 3; ++c) {
    const Attachment& a =
        surface.attachment[surface.triangles[hit.triangle][static_cast<std::size_t>(c)]];
    for (std::size_t k = 0; k < a.joint.size(); ++k) {
      sum[Index(a.joint[k])] += hit.barycentric[c] * a.weight[k];
    }
  }
  Attachment blend;
  double total = 0.0;
  for (std::size_t k = 0; k < blend.joint.size(); ++k) {
    const auto best = std::max_element(sum.begin(), sum.end());
    blend.joint[k] = *best > 0.0 ? static_cast<J>(best - sum.begin()) : blend.joint[0];
    blend.weight[k] = *best;
    total += *best;
    *best = 0.0;
  }
  for (double& w : blend.weight) w /= total;
  return blend;
}

/// The part of a surface near the middle of a segment, for rays across it.
FigureSurface Slice(const FigureSurface& surface, const Vec3& start, const Vec3& end) {
  const Vec3 bone = end - start;
  std::vector<double> along(surface.position_ms.size());
  for (std::size_t v = 0; v < along.size(); ++v) {
    along[v] = glm::dot(surface.position_ms[v] - start, bone) / glm::dot(bone, bone);
  }
  FigureSurface slice;
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> index(along.size(), kNone);
  for (auto t : surface.triangles) {
    if (std::max({along[t[0]], along[t[1]], along[t[2]]}) < 0.25) continue;
    if (std::min({along[t[0]], along[t[1]], along[t[2]]}) > 0.75) continue;
    for (std::uint32_t& v : t) {
      if (index[v] == kNone) {
        index[v] = static_cast<std::uint32_t>(slice.position_ms.size());
        slice.position_ms.push_back(surface.position_ms[v]);
        slice.attachment.push_back(surface.attachment[v]);
      }
      v = index[v];
    }
    slice.triangles.push_back(t);
  }
  return slice;
}

SkinPoint NearestVertex(const FigureSurface& surface, const Vec3& point) {
  EGO_CHECK(!surface.triangles.empty());
  SkinPoint nearest;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : surface.triangles) {
    const Vec3& a = surface.position_ms[t[0]];
    const double distance = glm::distance(a, point);
    const Vec3 normal = glm::cross(surface.position_ms[t[1]] - a, surface.position_ms[t[2]] - a);
    if (distance >= best || glm::length(normal) == 0.0) continue;
    best = distance;
    nearest = {a, glm::normalize(normal), surface.attachment[t[0]]};
  }
  return nearest;
}

}  // namespace

SkinPoint PointAlong(const FigureSurface& surface, const Vec3& origin_ms, const Vec3& direction) {
  // How many closed pieces the origin lies in.
  const auto depth_at_origin = [](const std::vector<Hit>& crossings) {
    int depth = 0;
    for (const Hit& hit : crossings) depth += hit.leaves ? 1 : -1;
    return depth;
  };
  std::vector<Hit> hits = Crossings(surface, origin_ms, direction);
  int depth = depth_at_origin(hits);
  if (depth < 1) {
    // A ray through a vertex may slip between its triangles: a hair beside it none does.
    hits = Crossings(surface, origin_ms + 1e-6 * Vec3{0.3, 0.5, 0.8}, direction);
    depth = depth_at_origin(hits);
  }
  if (hits.empty()) return NearestVertex(surface, origin_ms);
  const Hit* found = &hits.back();
  for (const Hit& hit : hits) {
    depth -= hit.leaves ? 1 : -1;
    if (hit.leaves && depth <= 0) {
      found = &hit;
      break;
    }
  }
  const auto& t = surface.triangles[found->triangle];
  const Vec3& a = surface.position_ms[t[0]];
  SkinPoint point;
  point.position_ms = origin_ms + found->t * direction;
  point.normal_ms =
      glm::normalize(glm::cross(surface.position_ms[t[1]] - a, surface.position_ms[t[2]] - a));
  point.attachment = Blend(surface, *found);
  return point;
}

SampleRay RayOf(const PersonShape& shape, SamplePoint point) {
  const S left = Mirror(point) < point ? Mirror(point) : point;
  if (left != point) {
    SampleRay ray = RayOf(shape, left);
    ray.origin_ms.x = -ray.origin_ms.x;
    ray.direction.x = -ray.direction.x;
    return ray;
  }
  const PersonParameters& m = shape.parameters();
  const double depth = -0.035 * shape.TrunkLength();
  const Vec3 front{0.0, 0.0, 1.0};
  const Vec3 back{0.0, 0.0, -1.0};
  const Vec3 side{1.0, 0.0, 0.0};
  const auto trunk = [&](double share, double x = 0.0) {
    return Vec3{x, shape.HipHeight() + share * shape.TrunkLength(), depth};
  };
  const auto head = [&](double share) {
    return Vec3{0.0, shape.ChinHeight() + share * m.head_height, shape.HeadDepth()};
  };
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  switch (left) {
    case S::kCollarNotch:
      return {trunk(0.90), front};
    case S::kSternumBase:
      return {trunk(0.55), front};
    case S::kNavel:
      return {trunk(0.27), front};
    case S::kPubis:
      return {trunk(-0.06), front};
    case S::kNapeBase:
      return {trunk(0.98), back};
    case S::kMidBack:
      return {trunk(0.55), back};
    case S::kLowerBack:
      return {trunk(0.25), back};
    case S::kSacrum:
      return {trunk(0.06), back};
    case S::kLeftChest:
      return {trunk(0.68, 0.29 * m.chest_width), front};
    case S::kLeftBellySide:
      return {trunk(0.25),
              glm::normalize(Vec3{0.36 * m.waist_width, 0.0, 0.45 * m.belly_thickness})};
    case S::kLeftShoulderTop:
      return {Vec3{0.34 * m.shoulder_width, trunk(0.80).y, depth}, kUp};
    case S::kLeftShoulderBlade:
      return {trunk(0.75, 0.30 * m.chest_width), back};
    case S::kLeftRibs:
      return {trunk(0.60), side};
    case S::kLeftWaistSide:
      return {trunk(0.30), side};
    case S::kLeftHipSide:
      return {trunk(-0.01), side};
    case S::kForehead:
      return {head(0.64), front};
    case S::kCrown:
      return {head(0.5), kUp};
    case S::kBackOfHead:
      return {head(0.55), back};
    case S::kNoseTip:
      return {head(0.385), front};
    case S::kChin:
      return {head(0.10), front};
    case S::kThroat: {
      // Down from inside the jaw; where a thick neck fills the place below, forward out of it.
      const Vec3 jaw = head(0.16) + Vec3{0.0, 0.0, 0.40 * l};
      const Vec3 down = glm::normalize(Vec3{0.0, -1.0, -0.15});
      const double free_below = 0.26 * m.head_height;
      for (int i = 1; i <= 8; ++i) {
        if (shape(jaw + free_below * (i / 8.0) * down) > 0.0) return {jaw, down};
      }
      return {head(-0.10), front};
    }
    case S::kLeftEar:
      return {head(0.44) + Vec3{0.0, 0.0, -0.08 * l}, side};
    case S::kLeftCheek:
    default:
      return {head(0.38), glm::normalize(Vec3{0.62 * w, 0.0, 0.72 * l})};
  }
}

double MeasureRadius(const FigureSurface& surface, const Vec3& start, const Vec3& end) {
  const FigureSurface slice = Slice(surface, start, end);
  const Vec3 axis = glm::normalize(end - start);
  const Vec3 u = glm::normalize(glm::cross(axis, std::abs(axis.y) > 0.5 ? Vec3{0, 0, 1} : kUp));
  const Vec3 v = glm::cross(axis, u);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i <= 8; ++i) {
    const Vec3 origin = start + (0.3 + 0.05 * i) * (end - start);
    for (int k = 0; k < 12; ++k) {
      const double angle = 2.0 * kPi * (k + 0.5) / 12.0;
      const Vec3 d = std::cos(angle) * u + std::sin(angle) * v;
      sum += glm::distance(origin, PointAlong(slice, origin, d).position_ms);
      ++count;
    }
  }
  return sum / count;
}

Body MeasureBody(const PersonShape& shape, const FigureSurface& surface) {
  const PersonParameters& m = shape.parameters();
  Body body;
  body.name = m.name;
  body.skeleton = shape.skeleton();
  body.standing_root_height = body.skeleton.offset[0].y;
  for (const Vec3& p : surface.position_ms) body.height = std::max(body.height, p.y);

  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const SampleRay ray = RayOf(shape, static_cast<S>(i));
    const SkinPoint point = PointAlong(surface, ray.origin_ms, ray.direction);
    body.surface.sample_ms[i] = point.position_ms;
    body.surface.attachment[i] = point.attachment;
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    body.surface.limb_radius[s] =
        MeasureRadius(surface, shape.Joint(StartJoint(segment)), shape.Joint(EndJoint(segment)));
  }
  const Vec3 down{0.0, -1.0, 0.0};
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vec3& wrist = shape.Joint(side == 0 ? J::kLeftHand : J::kRightHand);
    const double reach = m.hand_length;
    HandSurface& hand = body.surface.hand[side];
    const Vec3 middle = wrist + Vec3{sign * 0.36 * reach, 0.0, 0.0};
    hand.palm_ms = PointAlong(surface, middle, down).position_ms;
    hand.palm_normal_ms = down;
    const Vec3 back = PointAlong(surface, middle, kUp).position_ms;
    hand.half_thickness = 0.5 * glm::distance(hand.palm_ms, back);
    // Just short of the tip, where a finger pad is.
    hand.fingertip_ms =
        PointAlong(surface, wrist + reach * Vec3{sign * 0.955, -0.045, 0.068}, down).position_ms;

    const Vec3& ankle = shape.Joint(side == 0 ? J::kLeftFoot : J::kRightFoot);
    FootSurface& foot = body.surface.foot[side];
    const double sole = 0.06 * m.foot_length;
    foot.heel_ms =
        PointAlong(surface, {ankle.x, sole, ankle.z - 0.12 * m.foot_length}, down).position_ms;
    foot.ball_ms =
        PointAlong(surface, {ankle.x, sole, ankle.z + 0.46 * m.foot_length}, down).position_ms;
    foot.toe_tip_ms =
        PointAlong(surface, {ankle.x, sole, ankle.z + 0.46 * m.foot_length}, {0.0, 0.0, 1.0})
            .position_ms;
  }
  return body;
}

}  // namespace ego
