// SPDX-License-Identifier: MIT
#include "render/body_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr float kSmooth = 0.62f;  // of the crude meshes' normals; the rest is the facet's own
constexpr std::size_t kRing = 14;

glm::vec3 Normalized(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 1e-12f ? v / length : glm::vec3{0.0f, 1.0f, 0.0f};
}
Vec3 Normalized(const Vec3& v, const Vec3& fallback) {
  const double length = glm::length(v);
  return length > 1e-9 ? v / length : fallback;
}

/// A stretched skin over rings of equal count, closed at both ends. Seen from the start of the
/// loft the rings run counter-clockwise.
class Loft {
 public:
  explicit Loft(TriangleSink& sink) : sink_(sink), first_(sink.positions.size()) {}

  void AddRing(std::span<const Vec3> points) {
    for (const Vec3& p : points) sink_.positions.emplace_back(p);
    count_ = points.size();
    ++rings_;
  }

  void Close(const Vec3& start, const Vec3& end) {
    const auto id = [&](std::size_t ring, std::size_t i) {
      return static_cast<std::uint32_t>(first_ + ring * count_ + i % count_ - sink_.first_vertex);
    };
    const std::size_t first_index = sink_.indices.size();
    const auto start_id = sink_.Next();
    sink_.positions.emplace_back(start);
    sink_.positions.emplace_back(end);
    for (std::size_t i = 0; i < count_; ++i) {
      Add(start_id, id(0, i), id(0, i + 1));
      Add(start_id + 1, id(rings_ - 1, i + 1), id(rings_ - 1, i));
      for (std::size_t r = 0; r + 1 < rings_; ++r) {
        Add(id(r, i), id(r + 1, i), id(r, i + 1));
        Add(id(r, i + 1), id(r + 1, i), id(r + 1, i + 1));
      }
    }
    sink_.normals.resize(sink_.positions.size(), glm::vec3{0.0f});
    for (std::size_t i = first_index; i < sink_.indices.size(); i += 3) {
      const std::array<std::size_t, 3> v = {sink_.first_vertex + sink_.indices[i],
                                            sink_.first_vertex + sink_.indices[i + 1],
                                            sink_.first_vertex + sink_.indices[i + 2]};
      const glm::vec3 n = glm::cross(sink_.positions[v[1]] - sink_.positions[v[0]],
                                     sink_.positions[v[2]] - sink_.positions[v[0]]);
      for (const std::size_t k : v) sink_.normals[k] += n;
    }
    for (std::size_t k = first_; k < sink_.normals.size(); ++k) {
      sink_.normals[k] = Normalized(sink_.normals[k]);
    }
  }

 private:
  void Add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    sink_.indices.insert(sink_.indices.end(), {a, b, c});
  }
  TriangleSink& sink_;
  std::size_t first_;
  std::size_t count_ = 0;
  std::size_t rings_ = 0;
};

/// A triangle curved by the normals of its corners: a point-normal triangle (Vlachos et al., Curved
/// PN Triangles, 2001), cut into cuts^2 flat ones.
void AppendCurved(const std::array<glm::vec3, 3>& p, const std::array<glm::vec3, 3>& n, int cuts,
                  TriangleSink& sink) {
  const auto edge = [&](std::size_t i, std::size_t j) {
    return (2.0f * p[i] + p[j] - glm::dot(p[j] - p[i], n[i]) * n[i]) / 3.0f;
  };
  const glm::vec3 b210 = edge(0, 1), b120 = edge(1, 0), b021 = edge(1, 2), b012 = edge(2, 1),
                  b102 = edge(2, 0), b201 = edge(0, 2);
  const glm::vec3 e = (b210 + b120 + b021 + b012 + b102 + b201) / 6.0f;
  const glm::vec3 b111 = e + 0.5f * (e - (p[0] + p[1] + p[2]) / 3.0f);
  const std::uint32_t first = sink.Next();
  for (int row = 0; row <= cuts; ++row) {
    for (int k = 0; k <= row; ++k) {
      const float w = 1.0f - static_cast<float>(row) / static_cast<float>(cuts);
      const float v = static_cast<float>(k) / static_cast<float>(cuts);
      const float u = 1.0f - w - v;
      sink.positions.push_back(w * w * w * p[0] + u * u * u * p[1] + v * v * v * p[2] +
                               3.0f * (w * w * u * b210 + w * u * u * b120 + w * w * v * b201 +
                                       u * u * v * b021 + w * v * v * b102 + u * v * v * b012) +
                               6.0f * w * u * v * b111);
      sink.normals.push_back(Normalized(w * n[0] + u * n[1] + v * n[2]));
    }
  }
  const auto id = [&](int row, int k) {
    return first + static_cast<std::uint32_t>(row * (row + 1) / 2 + k);
  };
  for (int row = 0; row < cuts; ++row) {
    for (int k = 0; k <= row; ++k) {
      sink.indices.insert(sink.indices.end(), {id(row, k), id(row + 1, k), id(row + 1, k + 1)});
      if (k == row) continue;
      sink.indices.insert(sink.indices.end(), {id(row, k), id(row + 1, k + 1), id(row, k + 1)});
    }
  }
}

void AppendTrunkAndHead(const Body& body, const ModelPose& pose, const Vec3& offset_ws,
                        CrudeLook look, TriangleSink& sink) {
  std::array<Vec3, kSampleCount> sample_ws;
  PoseSamples(body.skeleton, body.surface, pose, sample_ws);
  std::array<glm::vec3, kSampleCount> at;
  for (std::size_t i = 0; i < kSampleCount; ++i) at[i] = glm::vec3(sample_ws[i] + offset_ws);
  std::array<glm::vec3, kSampleCount> smooth{};
  const auto face_normal = [&](const SampleTriangle& t) {
    return Normalized(
        glm::cross(at[Index(t[1])] - at[Index(t[0])], at[Index(t[2])] - at[Index(t[0])]));
  };
  // Weighted by the corner's angle, so that the cut of the triangles does not show.
  for (const SampleTriangle& t : SampleTriangles()) {
    const glm::vec3 n = face_normal(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3& corner = at[Index(t[k])];
      const float cosine = glm::dot(Normalized(at[Index(t[(k + 1) % 3])] - corner),
                                    Normalized(at[Index(t[(k + 2) % 3])] - corner));
      smooth[Index(t[k])] += std::acos(glm::clamp(cosine, -1.0f, 1.0f)) * n;
    }
  }
  for (glm::vec3& n : smooth) n = Normalized(n);
  // A trunk's triangles bulge by about 32 mm: cut in two, four times less, and so on.
  const int cuts = sink.smallest > 0.008 ? 2 : sink.smallest > 0.0036 ? 3 : 4;
  for (const SampleTriangle& t : SampleTriangles()) {
    const std::array<std::size_t, 3> v = {Index(t[0]), Index(t[1]), Index(t[2])};
    if (look == CrudeLook::kRounded) {
      AppendCurved({at[v[0]], at[v[1]], at[v[2]]}, {smooth[v[0]], smooth[v[1]], smooth[v[2]]}, cuts,
                   sink);
      continue;
    }
    const glm::vec3 flat = face_normal(t);
    for (const std::size_t corner : v) {
      sink.indices.push_back(sink.Next());
      sink.positions.push_back(at[corner]);
      sink.normals.push_back(Normalized(glm::mix(flat, smooth[corner], kSmooth)));
    }
  }
}

void AppendHand(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                const ModelPose& pose, const Vec3& offset_ws, std::size_t side,
                TriangleSink& sink) {
  const J joint = side == 0 ? J::kLeftHand : J::kRightHand;
  const HandSurface& hand = body.surface.hand[side];
  const Vec3& wrist = canonical[Index(joint)];
  const double length = glm::length(hand.fingertip_ms - wrist);
  if (length < 1e-6) return;
  const Vec3 along = (hand.fingertip_ms - wrist) / length;
  const Vec3 across = Normalized(glm::cross(along, hand.palm_normal_ms), {0.0, 0.0, 1.0});
  const Vec3 up = glm::cross(across, along);
  // Place along the hand, half width and half thickness, as shares of the length and thickness.
  constexpr std::array<std::array<double, 3>, 6> kSections = {{{-0.02, 0.135, 1.25},
                                                               {0.16, 0.17, 1.10},
                                                               {0.36, 0.215, 1.00},
                                                               {0.54, 0.215, 0.90},
                                                               {0.80, 0.17, 0.70},
                                                               {0.96, 0.10, 0.45}}};
  Loft loft(sink);
  std::array<Vec3, kRing> ring;
  const auto place = [&](const Vec3& p) {
    return PosePoint(canonical, pose, joint, p) + offset_ws;
  };
  for (const auto& [at, half_width, half_thickness] : kSections) {
    for (std::size_t i = 0; i < kRing; ++i) {
      const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(kRing);
      ring[i] = place(wrist + length * at * along + length * half_width * std::cos(angle) * across +
                      hand.half_thickness * half_thickness * std::sin(angle) * up);
    }
    loft.AddRing(ring);
  }
  loft.Close(place(wrist - 0.04 * length * along), place(hand.fingertip_ms));
  const Vec3 thumb = (side == 0 ? 1.0 : -1.0) * glm::cross(hand.palm_normal_ms, along);
  AppendCapsule(place(wrist + length * (0.20 * along + 0.10 * thumb)), 0.078 * length,
                place(wrist + length * (0.50 * along + 0.31 * thumb)), 0.055 * length,
                Roundness::kBone, sink);
}

void AppendFoot(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                const ModelPose& pose, const Vec3& offset_ws, std::size_t side,
                TriangleSink& sink) {
  const J joint = side == 0 ? J::kLeftFoot : J::kRightFoot;
  const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
  const FootSurface& foot = body.surface.foot[side];
  const double length = glm::length(foot.toe_tip_ms - foot.heel_ms);
  if (length < 1e-6) return;
  const Vec3 up = -foot.sole_normal_ms;
  const Vec3 along = Normalized(foot.toe_tip_ms - foot.heel_ms, {0.0, 0.0, 1.0});
  const Vec3 across = Normalized(glm::cross(up, along), {1.0, 0.0, 0.0});
  const double rise =
      std::clamp(glm::dot(canonical[Index(joint)] - foot.heel_ms, up), 0.1 * length, 0.42 * length);
  const double ball = std::clamp(glm::dot(foot.ball_ms - foot.heel_ms, along) / length, 0.5, 0.85);
  // Place, half width (shares of the length) and height (share of the ankle's).
  const std::array<std::array<double, 3>, 6> sections = {{{0.01, 0.09, 0.62},
                                                          {0.10, 0.13, 1.02},
                                                          {0.34, 0.135, 1.06},
                                                          {ball, 0.175, 0.62},
                                                          {0.5 * (1.0 + ball), 0.16, 0.44},
                                                          {0.97, 0.10, 0.28}}};
  Loft loft(sink);
  std::array<Vec3, kRing> ring;
  const auto place = [&](const Vec3& p, bool toe) {
    return PosePoint(canonical, pose, toe ? toes : joint, p) + offset_ws;
  };
  for (const auto& [at, half_width, height] : sections) {
    const Vec3 base = glm::mix(foot.heel_ms, foot.toe_tip_ms, at);
    for (std::size_t i = 0; i < kRing; ++i) {
      const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(kRing);
      const double lift = std::sin(angle) > 0.0 ? std::sin(angle) : 0.06 * std::sin(angle);
      // Mirrored from the hand's ring: here the loft runs forward with `across` to the left.
      ring[i] = place(base - length * half_width * std::cos(angle) * across +
                          (rise * height * lift + 0.02 * length) * up,
                      at > ball + 1e-9);
    }
    loft.AddRing(ring);
  }
  loft.Close(place(foot.heel_ms + 0.2 * rise * up, false),
             place(foot.toe_tip_ms + 0.1 * rise * up, true));
}

}  // namespace

void AppendBody(const Body& body, const ModelPose& pose, const Vec3& offset_ws, CrudeLook look,
                TriangleSink& sink) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  AppendTrunkAndHead(body, pose, offset_ws, look, sink);
  const auto at = [&](J joint) { return pose.Position(joint) + offset_ws; };
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const double radius = body.surface.limb_radius[s];
    AppendCapsule(at(StartJoint(segment)), radius, at(EndJoint(segment)), radius, Roundness::kLimb,
                  sink);
  }
  const auto& sample = body.surface.sample_ms;
  const double ears =
      glm::length(sample[Index(SamplePoint::kLeftEar)] - sample[Index(SamplePoint::kRightEar)]);
  const double throat =
      glm::length(sample[Index(SamplePoint::kCollarNotch)] - sample[Index(SamplePoint::kNapeBase)]);
  const double neck = std::min(0.36 * ears, 0.4 * throat);
  AppendCapsule(at(J::kNeck), neck, at(J::kHead), 0.95 * neck, Roundness::kLimb, sink);
  for (std::size_t side = 0; side < 2; ++side) {
    AppendHand(body, canonical, pose, offset_ws, side, sink);
    AppendFoot(body, canonical, pose, offset_ws, side, sink);
  }
}

void AppendSkeleton(const Skeleton& skeleton, const ModelPose& pose, const Vec3& offset_ws,
                    TriangleSink& sink) {
  // Thickness follows the body's size: a child's bones are thin ones.
  const double leg = BoneLength(skeleton, J::kLeftLowerLeg) + BoneLength(skeleton, J::kLeftFoot);
  const double size = std::clamp(leg / 0.84, 0.2, 3.0);
  const auto at = [&](J joint) { return pose.Position(joint) + offset_ws; };
  const auto bone = [&](const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
    AppendCapsule(a, size * radius_a, b, size * radius_b, Roundness::kBone, sink);
  };
  const auto stub = [&](J joint, const Vec3& direction, double length) {
    bone(at(joint), 0.016, at(joint) + pose.Rotation(joint) * (size * length * direction), 0.008);
  };
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    if (j != 0 && BoneLength(skeleton, joint) < 1e-6) continue;
    bone(at(joint), 0.022, at(joint), 0.022);
    if (j != 0) bone(at(Parent(joint)), 0.017, at(joint), 0.010);
  }
  stub(J::kHead, {0.0, 1.0, 0.1}, 0.16);
  stub(J::kLeftHand, CanonicalDirection(Limb::kLeftArm), 0.12);
  stub(J::kRightHand, CanonicalDirection(Limb::kRightArm), 0.12);
}

}  // namespace ego
