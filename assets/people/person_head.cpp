// SPDX-License-Identifier: MIT
#include "assets/people/person_head.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

using field::Capsule;
using field::Ellipsoid;
using field::SmoothIntersection;
using field::SmoothStep;
using field::SmoothUnion;

/// Half the opening of the lids, in eyeball radii.
constexpr double kEyeHalfWidth = 0.90;
/// Lips: half the width as a share of half the head's, heights as shares of the head's.
constexpr double kMouthHalfWidth = 0.32;
constexpr double kMouthHeight = 0.212;
constexpr double kSmile = 0.030;

}  // namespace

PersonHead::PersonHead(const PersonParameters& parameters, double chin, double middle_z)
    : parameters_(parameters), chin_(chin), middle_z_(middle_z) {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  crown_ = m.height - (m.hair == Hair::kNone ? 0.0 : 0.05 * h);
  eye_radius_ = 0.074 * h * m.eye_size;
  // Where the features sit on the plain face.
  lips_ = {0.0, kMouthHeight * h, Front(0.0, kMouthHeight * h)};
  const double corner = kMouthHalfWidth * w;
  mouth_corner_ = {corner, (kMouthHeight + kSmile) * h, Front(corner, kMouthHeight * h)};
  const double eye_x = std::max(0.42 * w, 1.20 * eye_radius_);
  eye_ = {eye_x, 0.485 * h, 0.0};
  hair_drop_ = m.hair == Hair::kNone ? 0.0 : HairTop() - m.height;
  eye_.z = Front(eye_x, eye_.y) - 0.62 * eye_radius_;
}

double PersonHead::HairTop() const {
  const PersonParameters& m = parameters_;
  double top = 0.0;
  for (int i = 0; i <= 16; ++i) {
    for (int k = -16; k <= 16; ++k) {
      const double x = 0.5 * m.head_width * i / 16.0;
      const double z = middle_z_ + 0.5 * m.head_depth * k / 16.0;
      double low = crown_;
      double high = m.height + 0.2 * m.head_height;
      if (Hair({x, low, z}) >= 0.0) continue;
      for (int step = 0; step < 16; ++step) {
        const double y = 0.5 * (low + high);
        (Hair({x, y, z}) < 0.0 ? low : high) = y;
      }
      top = std::max(top, high);
    }
  }
  return std::max(top, crown_);
}

double PersonHead::Front(double x, double y) const {
  double low = 0.0;
  double high = parameters_.head_depth;
  for (int i = 0; i < 40; ++i) {
    const double z = 0.5 * (low + high);
    (Face({x, y, z}) < 0.0 ? low : high) = z;
  }
  return low;
}

double PersonHead::Face(const Vec3& q) const {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  const double top = crown_ - chin_;
  const double skull = 0.41 * h;
  double d = Ellipsoid(q, {0.0, top - skull, -0.04 * l}, {w, skull, 0.96 * l});
  d = SmoothUnion(d, Ellipsoid(q, {0.0, 0.32 * h, 0.30 * l}, {0.76 * w, 0.30 * h, 0.60 * l}),
                  0.16 * h);
  // Chin and the corner of the jaw.
  d = SmoothUnion(
      d, Ellipsoid(q, {0.0, 0.085 * h, 0.60 * l}, {(0.26 + 0.10 * m.jaw) * w, 0.08 * h, 0.25 * l}),
      0.10 * h);
  const double corner = (0.010 + 0.045 * m.jaw) * h;
  d = SmoothUnion(
      d,
      Capsule(q, {0.62 * w, 0.23 * h, 0.08 * l}, {0.20 * w, 0.075 * h, 0.58 * l}, corner, corner),
      0.09 * h);
  // Cheekbone.
  d = SmoothUnion(d, Ellipsoid(q, {0.52 * w, 0.35 * h, 0.56 * l}, {0.27 * w, 0.11 * h, 0.26 * l}),
                  0.10 * h);
  return d;
}

Vec3 PersonHead::InEye(const Vec3& q) const { return (q - eye_) / eye_radius_; }

double PersonHead::Skin(const Vec3& p, bool plain_ears) const {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  const Vec3 q{std::abs(p.x), p.y - chin_, p.z - middle_z_};
  double d = Face(q);

  // Ears, where no hair hides them: a shell around a hollow.
  const double e = m.ear_size;
  if (q.x > 0.7 * w && m.hair != Hair::kBob) {
    const Vec3 ear = Ear();
    // Turned outward and leaning back.
    Vec3 a = q - ear;
    a = {a.x + 0.30 * a.z, a.y, a.z + 0.22 * a.y - 0.30 * a.x};
    const double thick = plain_ears ? 1.6 : 1.0;
    double shell =
        Ellipsoid(a, {0.028 * h * e, 0.0, 0.0}, Vec3{0.046 * thick, 0.135, 0.088} * (h * e));
    const double hollow = Ellipsoid(a, {0.078 * h * e, 0.022 * h * e, 0.020 * h * e},
                                    {0.042 * h * e, 0.076 * h * e, 0.048 * h * e});
    if (!plain_ears) shell = SmoothIntersection(shell, -hollow, 0.018 * h * e);
    d = SmoothUnion(d, shell, 0.028 * h);
  }
  if (q.z < 0.3 * l || q.y < 0.0 || q.y > 0.75 * h) return d;

  // Brow, eye socket, eyeball behind its lids.
  const double r = eye_radius_;
  const double brow = eye_.y + 1.10 * r;
  d = SmoothUnion(d,
                  Capsule(q, {eye_.x - 0.75 * r, brow, eye_.z + 0.30 * r},
                          {eye_.x + 0.8 * r, brow, eye_.z + 0.02 * r}, 0.026 * h, 0.022 * h),
                  0.06 * h);
  const double socket =
      Ellipsoid(q, eye_ + Vec3{0.05 * r, 0.0, 1.02 * r}, {1.30 * r, 0.95 * r, 0.75 * r});
  d = SmoothIntersection(d, -socket, 0.055 * h);
  d = SmoothUnion(d, Ellipsoid(q, eye_, Vec3(r, r, 0.96 * r)), 0.022 * h);

  // Nose: bridge, tip, wings, with hollows beneath.
  const double n = m.nose_size;
  const double face = lips_.z;
  const Vec3 tip{0.0, 0.375 * h, face + 0.062 * h * n};
  d = SmoothUnion(
      d,
      SmoothUnion(Capsule(q, {0.0, 0.50 * h, face - 0.035 * h}, tip, 0.020 * h * n, 0.030 * h * n),
                  Capsule(q, tip - Vec3{0.0, 0.004 * h, 0.010 * h},
                          tip - Vec3{0.0, 0.006 * h, 0.02 * h}, 0.038 * h * n, 0.036 * h * n),
                  0.02 * h),
      0.045 * h);
  d = SmoothUnion(d,
                  Ellipsoid(q, tip + Vec3{0.043 * h * n, -0.014 * h, -0.036 * h},
                            Vec3{0.026, 0.028, 0.038} * (h * n)),
                  0.016 * h);

  // Lips, with a crease between them.
  const Vec3 corner = mouth_corner_ - Vec3{0.0, 0.0, 0.012 * h};
  const double upper =
      Capsule(q, lips_ + Vec3{0.014 * h, 0.014 * h, -0.010 * h}, corner, 0.022 * h, 0.010 * h);
  const double lower =
      Capsule(q, lips_ + Vec3{0.0, -0.020 * h, -0.010 * h}, corner, 0.026 * h, 0.010 * h);
  d = SmoothUnion(d, std::min(upper, lower), 0.020 * h);
  return d;
}

double PersonHead::Hair(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  if (m.hair == Hair::kNone) return 1e9;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  const Vec3 q{std::abs(p.x), p.y - chin_, p.z - middle_z_};
  const double top = m.height - chin_ - hair_drop_;
  const double half = 0.43 * h;
  double thick = 1.0;
  if (m.hair == Hair::kCrop) thick = 0.55;
  if (m.hair == Hair::kCurls) thick = 1.9;
  double d = Ellipsoid(q, {0.0, top - half, -0.05 * l},
                       {(1.0 + 0.075 * thick) * w, half, (0.99 + 0.045 * thick) * l});

  if (m.hair == Hair::kBob) {
    d = SmoothUnion(
        d, Ellipsoid(q, {0.52 * w, 0.34 * h, -0.26 * l}, {0.68 * w, 0.40 * h, 0.80 * l}), 0.10 * h);
    // Flared ends.
    d -= 0.020 * h * (1.0 - SmoothStep(0.02 * h, 0.22 * h, q.y));
  }
  switch (m.hair) {
    case Hair::kShort: {
      // A quiff that rises from the forehead and falls back.
      const Vec3 tuft{0.0, top - 0.140 * h, 0.46 * l};
      d = SmoothUnion(d, Ellipsoid(q, tuft, {0.70 * w, 0.135 * h, 0.62 * l}), 0.08 * h);
      d = SmoothUnion(
          d, Ellipsoid(q, {0.0, top - 0.16 * h, -0.10 * l}, {0.92 * w, 0.155 * h, 0.80 * l}),
          0.08 * h);
      break;
    }
    case Hair::kBun:
      d = SmoothUnion(d, Ellipsoid(q, {0.0, 0.74 * h, -1.10 * l}, {0.18 * h, 0.165 * h, 0.16 * h}),
                      0.025 * h);
      break;
    case Hair::kCurls: {
      // Bumps all over.
      const double k = 2.0 * kPi / (0.115 * h);
      const double bumps = std::sin(k * q.x + 0.7) * std::sin(k * q.y) +
                           std::sin(k * q.y + 1.3) * std::sin(k * q.z) +
                           std::sin(k * q.z + 2.1) * std::sin(k * q.x + 0.4);
      d -= 0.014 * h * bumps;
      break;
    }
    default:
      break;
  }
  const double above = AboveHairline(q);
  if (m.hair == Hair::kShort || m.hair == Hair::kBob || m.hair == Hair::kBun) {
    // Strands from the parting: ridges along the flow of the hair.
    const double strand =
        m.hair == Hair::kBob ? std::atan2(q.x, q.z + 0.4 * l) * 9.0 : 2.2 * kPi * q.x / (0.36 * w);
    d -= 0.0045 * h * SmoothStep(0.02 * h, 0.10 * h, above) *
         std::sin(strand + 1.2 * std::sin(9.0 * q.y / h));
  }
  // Towards its line the hair sinks into the skin: where they cross, no ledge looks down.
  d += 0.095 * h * (1.0 - SmoothStep(0.0, 0.11 * h, above));
  return SmoothIntersection(d, -0.9 * above, 0.022 * h);
}

double PersonHead::AboveHairline(const Vec3& q) const {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  // High over the forehead, down before the ears, low at the nape.
  const auto line = [&](double x, double z) {
    const double across = x / w;
    const double front = z / l;
    if (m.hair == Hair::kBob) {
      return (-0.03 + 0.62 * SmoothStep(0.24, 0.70, front - 0.16 * across + 0.04) -
              0.03 * SmoothStep(0.0, 1.0, across)) *
             h;
    }
    return (0.12 + 0.22 * SmoothStep(-0.80, -0.30, front) + 0.13 * SmoothStep(0.02, 0.30, front) +
            0.205 * SmoothStep(0.42, 0.80, front - 0.10 * across)) *
           h;
  };
  const double step = 0.01 * h;
  const double slope_x = (line(q.x + step, q.z) - line(q.x - step, q.z)) / (2.0 * step);
  const double slope_z = (line(q.x, q.z + step) - line(q.x, q.z - step)) / (2.0 * step);
  const double above =
      (q.y - line(q.x, q.z)) / std::sqrt(1.0 + slope_x * slope_x + slope_z * slope_z);
  if (m.hair == Hair::kBob || q.x < 0.5 * w) return above;
  // Around the ears.
  const Vec3 ear = Ear();
  const Vec2 from{q.z - ear.z + 0.22 * (q.y - ear.y), q.y - ear.y};
  const double e = m.ear_size * h;
  const Vec2 radius{0.078 * e, 0.108 * e};
  const double around = (glm::length(from / radius) - 1.0) * radius.x;
  return SmoothUnion(above, around, 0.03 * h);
}

Vec3 PersonHead::Ear() const {
  const PersonParameters& m = parameters_;
  return {0.5 * m.head_width + 0.004 * m.head_height, (0.36 + 0.10 * m.ear_size) * m.head_height,
          -0.05 * m.head_depth};
}

Region PersonHead::FaceRegion(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const Vec3 q{std::abs(p.x), p.y - chin_, p.z - middle_z_};
  if (q.z < 0.3 * (m.head_depth / 2.0)) return Region::kSkin;

  const Vec3 e = InEye(q);
  if (e.z > 0.0 && std::abs(e.x) < kEyeHalfWidth) {
    const double u = e.x / kEyeHalfWidth;
    const double arch = 1.0 - u * u;
    const double tilt = 0.08 * u;
    if (e.y < tilt + 0.56 * std::pow(arch, 0.70) && e.y > tilt - 0.50 * std::pow(arch, 0.85)) {
      const double from_middle = std::hypot(e.x + 0.04, e.y - 0.03);
      constexpr double iris = 0.58;
      if (from_middle < 0.56 * iris) return Region::kPupil;
      return from_middle < iris ? Region::kIris : Region::kEyeWhite;
    }
  }
  const double u = q.x / mouth_corner_.x;
  if (u < 1.0) {
    const double arch = 1.0 - u * u;
    const double middle = lips_.y + kSmile * h * u * u;
    const double bow = 0.008 * h * std::exp(-u * u / 0.02);
    if (q.y < middle + 0.029 * h * std::pow(arch, 0.8) - bow && q.y > middle - 0.040 * h * arch) {
      return Region::kLips;
    }
  }
  return Region::kSkin;
}

double PersonHead::LongestEdge(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  const Vec3 q{std::abs(p.x), p.y - chin_, p.z - middle_z_};
  const double head = 0.095 * h;
  if (q.x > 0.85 * w && q.y > 0.2 * h && q.y < 0.7 * h && std::abs(q.z + 0.1 * l) < 0.3 * l) {
    return 0.034 * h;
  }
  if (q.z < 0.45 * l || q.y > 0.72 * h) return head;
  const double eye = glm::length(InEye(q));
  if (eye < 1.12) return 0.25 * eye_radius_;
  const double mouth = std::hypot(q.x / (1.1 * mouth_corner_.x), (q.y - lips_.y) / (0.065 * h));
  if (mouth < 1.0) return 0.026 * h;
  if (q.x < 0.12 * h && q.y < 0.5 * h && q.y > 0.3 * h) return 0.034 * h;
  return eye < 1.9 ? 0.036 * h : 0.060 * h;
}

Vec3 PersonHead::OnMouth(double share) const {
  const double height =
      lips_.y - 0.003 * parameters_.head_height + kSmile * parameters_.head_height * share * share;
  return {share * mouth_corner_.x, chin_ + height, middle_z_ + lips_.z};
}

Vec3 PersonHead::IrisFront() const {
  return eye_ +
         Vec3{-0.04 * eye_radius_, chin_ + 0.04 * eye_radius_, middle_z_ + 0.96 * eye_radius_};
}

}  // namespace ego
