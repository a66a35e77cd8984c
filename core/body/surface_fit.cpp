// SPDX-License-Identifier: MIT
#include "core/body/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/closest_point.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr std::size_t kFrames = 300;
constexpr int kRounds = 6;
constexpr double kTolerance = 0.003;  // metres: skin gives way
constexpr double kDeep = 0.010;       // metres
constexpr double kShare = 0.05;       // of the frames: what counts as again and again
constexpr double kQuantile = 0.75;    // of the depths
constexpr double kLeast = 0.80;       // of the original size

/// A ball on an arm, at one instant.
struct Probe {
  LimbSegment segment = LimbSegment::kLeftUpperArm;  // whose radius it has
  bool hand = false;                                 // has the hand's thickness instead
  Vec3 center_ws{0.0};
  double radius = 0.0;
};
constexpr std::size_t kProbesPerArm = 7;
using Probes = std::array<Probe, 2 * kProbesPerArm>;

/// One frame with the joints placed once; samples and radii change from round to round.
struct Frame {
  ModelPose pose;
  Probes probes;
};

Probes PlaceProbes(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                   const ModelPose& pose) {
  Probes probes;
  std::size_t next = 0;
  for (const Limb limb : {Limb::kLeftArm, Limb::kRightArm}) {
    const std::size_t side = IsLeft(limb) ? 0 : 1;
    const LimbJoints joints = JointsOf(limb);
    const Vec3& base = pose.Position(joints.base);
    const Vec3& mid = pose.Position(joints.mid);
    const Vec3& end = pose.Position(joints.end);
    const auto upper = static_cast<LimbSegment>(2 * Index(limb));
    const auto lower = static_cast<LimbSegment>(2 * Index(limb) + 1);
    probes[next++] = {upper, false, glm::mix(base, mid, 0.6), 0.0};
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      probes[next++] = {lower, false, glm::mix(mid, end, t), 0.0};
    }
    const HandSurface& hand = body.surface.hand[side];
    const Vec3 middle = hand.palm_ms - hand.half_thickness * hand.palm_normal_ms;
    probes[next++] = {lower, true, PosePoint(canonical, pose, joints.end, middle),
                      hand.half_thickness};
  }
  return probes;
}

double Radius(const Probe& probe, const BodySurface& surface) {
  return probe.hand ? probe.radius : surface.limb_radius[Index(probe.segment)];
}

/// Solid angle of a triangle seen from a point, signed (van Oosterom and Strackee 1983). The sum
/// over a closed mesh is 4 pi inside and 0 outside.
double SolidAngle(const Triangle& triangle, const Vec3& p) {
  const Vec3 a = triangle.a - p;
  const Vec3 b = triangle.b - p;
  const Vec3 c = triangle.c - p;
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  const double rest =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(volume, rest);
}

/// Where a probe is deepest in (or nearest to) a mesh.
struct MeshContact {
  double depth = 0.0;  // how far the ball reaches into the mesh, metres; negative: free
  std::size_t triangle = 0;
  Vec3 weight{0.0};
};

using Mesh = std::array<Triangle, kTriangleCount>;

MeshContact FindContact(const Mesh& mesh, std::size_t begin, std::size_t end, const Vec3& center,
                        double radius) {
  double nearest = 1e300;
  double angle = 0.0;
  MeshContact contact;
  for (std::size_t t = begin; t < end; ++t) {
    const Vec3 weight = ClosestOnTriangle(mesh[t], center);
    const Vec3 gap = center - AtBarycentric(mesh[t], weight);
    const double squared = glm::dot(gap, gap);
    angle += SolidAngle(mesh[t], center);
    if (squared >= nearest) continue;
    nearest = squared;
    contact.triangle = t;
    contact.weight = weight;
  }
  const double distance = std::sqrt(nearest);
  contact.depth = radius - (std::abs(angle) > 2.0 * kPi ? -distance : distance);
  return contact;
}

/// The depths that one place asks to be moved by, one per frame.
class Demand {
 public:
  explicit Demand(std::size_t frames) : depths_(frames, 0.0) {}

  void Raise(std::size_t frame, double depth) { depths_[frame] = std::max(depths_[frame], depth); }
  /// The upper quartile of those that ask at all, or 0 when too few frames do.
  double Answer() const {
    std::vector<double> asked;
    for (const double depth : depths_) {
      if (depth > 0.0) asked.push_back(depth);
    }
    const auto count = static_cast<double>(asked.size());
    if (asked.empty() || count < kShare * static_cast<double>(depths_.size())) return 0.0;
    const auto at = asked.begin() + static_cast<std::ptrdiff_t>(kQuantile * (count - 1.0));
    std::nth_element(asked.begin(), at, asked.end());
    return *at;
  }

 private:
  std::vector<double> depths_;
};

class Fitter {
 public:
  Fitter(Body& body, std::span<const Pose> poses) : body_(body) {
    original_ = body.surface;
    fit_.sample.fill(1.0);
    fit_.limb_radius.fill(1.0);
    const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
    const std::size_t count = std::min(poses.size(), kFrames);
    for (std::size_t k = 0; k < count; ++k) {
      Frame frame;
      frame.pose = ForwardKinematics(body.skeleton, poses[k * poses.size() / count]);
      frame.probes = PlaceProbes(body, canonical, frame.pose);
      frames_.push_back(frame);
    }
    FindMiddles();
  }

  SurfaceFit Run() {
    if (frames_.empty()) return fit_;
    fit_.deep_before = DeepShare();
    for (int round = 0; round < kRounds && PullSamples(); ++round) {
    }
    for (int round = 0; round < kRounds && ThinLimbs(); ++round) {
    }
    fit_.deep_after = DeepShare();
    return fit_;
  }

 private:
  /// Depth of the middle of trunk and head: the mean of their samples.
  void FindMiddles() {
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t begin = part == 0 ? 0 : kTrunkSampleCount;
      const std::size_t end = part == 0 ? kTrunkSampleCount : kSampleCount;
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) sum += original_.sample_ms[i].z;
      middle_z_[part] = sum / static_cast<double>(end - begin);
    }
  }

  Vec3 Middle(std::size_t sample) const {
    const std::size_t part = IsHead(static_cast<SamplePoint>(sample)) ? 1 : 0;
    return {0.0, original_.sample_ms[sample].y, middle_z_[part]};
  }

  Mesh PoseMesh(const Frame& frame) const {
    std::array<Vec3, kSampleCount> sample_ws{};
    PoseSamples(body_.skeleton, body_.surface, frame.pose, sample_ws);
    Mesh mesh;
    for (std::size_t t = 0; t < kTriangleCount; ++t) {
      const SampleTriangle& corners = SampleTriangles()[t];
      mesh[t] = Triangle::Of(sample_ws[Index(corners[0])], sample_ws[Index(corners[1])],
                             sample_ws[Index(corners[2])]);
    }
    return mesh;
  }

  /// Calls visit(frame index, probe, contact) for every contact deeper than the tolerance.
  template <class Visit>
  void ForMeshContacts(const Visit& visit) const {
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const Mesh mesh = PoseMesh(frames_[f]);
      for (const Probe& probe : frames_[f].probes) {
        const double radius = Radius(probe, body_.surface);
        for (const bool head : {false, true}) {
          const std::size_t begin = head ? kTrunkTriangleCount : 0;
          const std::size_t end = head ? kTriangleCount : kTrunkTriangleCount;
          const MeshContact contact = FindContact(mesh, begin, end, probe.center_ws, radius);
          if (contact.depth > kTolerance) visit(f, probe, contact);
        }
      }
    }
  }

  /// Calls visit(frame index, probe, segment, depth) where a probe lies in a capsule of another
  /// limb by more than the tolerance.
  template <class Visit>
  void ForLimbContacts(const Visit& visit) const {
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const ModelPose& pose = frames_[f].pose;
      for (const Probe& probe : frames_[f].probes) {
        const double radius = Radius(probe, body_.surface);
        for (std::size_t s = 0; s < kSegmentCount; ++s) {
          const auto segment = static_cast<LimbSegment>(s);
          if (LimbOf(segment) == LimbOf(probe.segment)) continue;
          const Vec3& a = pose.Position(StartJoint(segment));
          const Vec3& b = pose.Position(EndJoint(segment));
          const double t = ClosestOnSegment(probe.center_ws, a, b);
          const double depth = radius + body_.surface.limb_radius[s] -
                               glm::length(probe.center_ws - glm::mix(a, b, t));
          if (depth > kTolerance) visit(f, probe, segment, depth);
        }
      }
    }
  }

  double DeepShare() const {
    std::vector<bool> deep(frames_.size(), false);
    ForMeshContacts([&](std::size_t f, const Probe&, const MeshContact& contact) {
      if (contact.depth > kDeep) deep[f] = true;
    });
    ForLimbContacts([&](std::size_t f, const Probe&, LimbSegment, double depth) {
      if (depth > kDeep) deep[f] = true;
    });
    return static_cast<double>(std::count(deep.begin(), deep.end(), true)) /
           static_cast<double>(deep.size());
  }

  /// One round of moving samples; false when nothing moved by more than half a millimetre.
  bool PullSamples() {
    std::vector<Demand> demand(kSampleCount, Demand(frames_.size()));
    ForMeshContacts([&](std::size_t f, const Probe&, const MeshContact& contact) {
      // The corners share the way so that the touched point of the triangle moves by the depth.
      const Vec3& w = contact.weight;
      const double squares = glm::dot(w, w);
      for (int corner = 0; corner < 3; ++corner) {
        const SamplePoint sample =
            SampleTriangles()[contact.triangle][static_cast<std::size_t>(corner)];
        if (w[corner] > 0.05) {
          demand[Index(sample)].Raise(f, contact.depth * w[corner] / squares);
        }
      }
    });
    bool moved = false;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      const std::size_t partner = Index(Mirror(static_cast<SamplePoint>(i)));
      if (partner < i) continue;
      const double way = std::max(demand[i].Answer(), demand[partner].Answer());
      const double reach = glm::length(original_.sample_ms[i] - Middle(i));
      if (way <= 0.0 || reach <= 0.0) continue;
      const double before = fit_.sample[i];
      const double after = std::max(kLeast, before - way / reach);
      moved = moved || (before - after) * reach > 5e-4;
      for (const std::size_t k : {i, partner}) {
        fit_.sample[k] = after;
        body_.surface.sample_ms[k] = Middle(k) + after * (original_.sample_ms[k] - Middle(k));
      }
    }
    return moved;
  }

  /// One round of thinning capsules: arms that still lie in the trunk or head, and pairs of limbs,
  /// which share what is asked.
  bool ThinLimbs() {
    std::vector<Demand> demand(kSegmentCount, Demand(frames_.size()));
    ForMeshContacts([&](std::size_t f, const Probe& probe, const MeshContact& contact) {
      if (!probe.hand) demand[Index(probe.segment)].Raise(f, contact.depth);
    });
    ForLimbContacts([&](std::size_t f, const Probe& probe, LimbSegment other, double depth) {
      demand[Index(other)].Raise(f, probe.hand ? depth : 0.5 * depth);
      if (!probe.hand) demand[Index(probe.segment)].Raise(f, 0.5 * depth);
    });
    bool moved = false;
    for (const Limb limb : {Limb::kLeftArm, Limb::kLeftLeg}) {
      for (std::size_t part = 0; part < 2; ++part) {
        const std::size_t left = 2 * Index(limb) + part;
        const std::size_t right = 2 * Index(Mirror(limb)) + part;
        const double way = std::max(demand[left].Answer(), demand[right].Answer());
        const double radius = original_.limb_radius[left];
        if (way <= 0.0 || radius <= 0.0) continue;
        const double before = fit_.limb_radius[left];
        const double after = std::max(kLeast, before - way / radius);
        moved = moved || (before - after) * radius > 5e-4;
        for (const std::size_t s : {left, right}) {
          fit_.limb_radius[s] = after;
          body_.surface.limb_radius[s] = after * original_.limb_radius[s];
        }
      }
    }
    return moved;
  }

  Body& body_;
  BodySurface original_;
  std::array<double, 2> middle_z_{};
  std::vector<Frame> frames_;
  SurfaceFit fit_;
};

}  // namespace

SurfaceFit FitSurfaceToMotion(Body& body, std::span<const Pose> poses) {
  return Fitter(body, poses).Run();
}

}  // namespace ego
