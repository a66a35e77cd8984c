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

  void Close(const Vec3& start, const Vec3& end, std::size_t mesh_first) {
    const auto id = [&](std::size_t ring, std::size_t i) {
      return static_cast<std::uint32_t>(first_ + ring * count_ + i % count_ - mesh_first);
    };
    const std::size_t first_index = sink_.indices.size();
    const auto start_id = static_cast<std::uint32_t>(sink_.positions.size() - mesh_first);
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
      const std::array<std::size_t, 3> v = {mesh_first + sink_.indices[i],
                                            mesh_first + sink_.indices[i + 1],
                                            mesh_first + sink_.indices[i + 2]};
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

void AppendTrunkAndHead(const Body& body, const ModelPose& pose, const Vec3& offset_ws,
                        TriangleSink& sink, std::size_t mesh_first) {
  std::array<Vec3, kSampleCount> sample_ws;
  PoseSamples(body.skeleton, body.surface, pose, sample_ws);
  std::array<Vec3, kSampleCount> smooth{};
  const auto face_normal = [&](const SampleTriangle& t) {
    const Vec3& a = sample_ws[Index(t[0])];
    return glm::cross(sample_ws[Index(t[1])] - a, sample_ws[Index(t[2])] - a);
  };
  for (const SampleTriangle& t : SampleTriangles()) {
    const Vec3 n = face_normal(t);
    for (const SamplePoint s : t) smooth[Index(s)] += n;
  }
  for (const SampleTriangle& t : SampleTriangles()) {
    const glm::vec3 flat = Normalized(glm::vec3(face_normal(t)));
    for (const SamplePoint s : t) {
      sink.indices.push_back(static_cast<std::uint32_t>(sink.positions.size() - mesh_first));
      sink.positions.emplace_back(sample_ws[Index(s)] + offset_ws);
      sink.normals.push_back(
          Normalized(glm::mix(flat, Normalized(glm::vec3(smooth[Index(s)])), kSmooth)));
    }
  }
}

void AppendHand(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                const ModelPose& pose, const Vec3& offset_ws, std::size_t side, TriangleSink& sink,
                std::size_t mesh_first) {
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
  loft.Close(place(wrist - 0.04 * length * along), place(hand.fingertip_ms), mesh_first);
}

void AppendFoot(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                const ModelPose& pose, const Vec3& offset_ws, std::size_t side, TriangleSink& sink,
                std::size_t mesh_first) {
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
             place(foot.toe_tip_ms + 0.1 * rise * up, true), mesh_first);
}

CapsuleInstance Between(const Vec3& a, double radius_a, const Vec3& b, double radius_b,
                        const glm::vec4& color) {
  return {glm::vec4(glm::vec3(a), static_cast<float>(radius_a)),
          glm::vec4(glm::vec3(b), static_cast<float>(radius_b)), color};
}

}  // namespace

void AppendBodyMesh(const Body& body, const ModelPose& pose, const Vec3& offset_ws,
                    TriangleSink& sink) {
  const std::size_t mesh_first = sink.positions.size();
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  AppendTrunkAndHead(body, pose, offset_ws, sink, mesh_first);
  for (std::size_t side = 0; side < 2; ++side) {
    AppendHand(body, canonical, pose, offset_ws, side, sink, mesh_first);
    AppendFoot(body, canonical, pose, offset_ws, side, sink, mesh_first);
  }
}

void AppendBodyCapsules(const Body& body, const ModelPose& pose, const Vec3& offset_ws,
                        const glm::vec4& color, std::vector<CapsuleInstance>& out) {
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const double radius = body.surface.limb_radius[s];
    out.push_back(Between(pose.Position(StartJoint(segment)) + offset_ws, radius,
                          pose.Position(EndJoint(segment)) + offset_ws, radius, color));
  }
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  const auto& sample = body.surface.sample_ms;
  const double ears =
      glm::length(sample[Index(SamplePoint::kLeftEar)] - sample[Index(SamplePoint::kRightEar)]);
  out.push_back(Between(pose.Position(J::kNeck) + offset_ws, 0.36 * ears,
                        pose.Position(J::kHead) + offset_ws, 0.34 * ears, color));
  for (std::size_t side = 0; side < 2; ++side) {
    const J joint = side == 0 ? J::kLeftHand : J::kRightHand;
    const HandSurface& hand = body.surface.hand[side];
    const Vec3& wrist = canonical[Index(joint)];
    const Vec3 finger = hand.fingertip_ms - wrist;
    const double length = glm::length(finger);
    if (length < 1e-6) continue;
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vec3 thumb = sign * glm::cross(hand.palm_normal_ms, finger) / length;
    const Vec3 root = wrist + 0.20 * finger + 0.10 * length * thumb;
    const Vec3 tip = wrist + 0.50 * finger + 0.31 * length * thumb;
    out.push_back(Between(PosePoint(canonical, pose, joint, root) + offset_ws, 0.078 * length,
                          PosePoint(canonical, pose, joint, tip) + offset_ws, 0.055 * length,
                          color));
  }
}

void AppendSkeletonCapsules(const Skeleton& skeleton, const ModelPose& pose, const Vec3& offset_ws,
                            const glm::vec4& color, std::vector<CapsuleInstance>& out) {
  // Thickness follows the body's size: a child's bones are thin ones.
  const double leg = BoneLength(skeleton, J::kLeftLowerLeg) + BoneLength(skeleton, J::kLeftFoot);
  const double size = std::clamp(leg / 0.84, 0.2, 3.0);
  const auto at = [&](J joint) { return pose.Position(joint) + offset_ws; };
  const auto stub = [&](J joint, const Vec3& direction, double length) {
    out.push_back(Between(at(joint), 0.016 * size,
                          at(joint) + pose.Rotation(joint) * (size * length * direction),
                          0.008 * size, color));
  };
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    if (j != 0 && BoneLength(skeleton, joint) < 1e-6) continue;  // a virtual joint
    out.push_back(Between(at(joint), 0.022 * size, at(joint), 0.022 * size, color));
    if (j != 0) {
      out.push_back(Between(at(Parent(joint)), 0.017 * size, at(joint), 0.010 * size, color));
    }
  }
  stub(J::kHead, {0.0, 1.0, 0.1}, 0.16);
  stub(J::kLeftHand, CanonicalDirection(Limb::kLeftArm), 0.12);
  stub(J::kRightHand, CanonicalDirection(Limb::kRightArm), 0.12);
}

}  // namespace ego
