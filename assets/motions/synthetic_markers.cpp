// SPDX-License-Identifier: MIT
#include "assets/motions/synthetic_markers.h"

#include <cmath>
#include <random>
#include <string>

#include "assets/markers/marker_set_file.h"
#include "core/base/check.h"
#include "core/body/body.h"
#include "core/model/mesh_bvh.h"
#include "core/model/rig.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kTissueHz = 5.0;
constexpr double kTissueDamping = 0.25;

/// The joint at which the bone of a joint ends; the joint itself where it has none.
J BoneEndOf(J joint) {
  const auto next = static_cast<J>(Index(joint) + 1);
  return Index(joint) + 1 < kJointCount && Parent(next) == joint && joint != J::kHips ? next
                                                                                      : joint;
}

std::vector<Mat4> NodesOf(const Character& character, const Pose& pose) {
  std::vector<Mat4> nodes(character.nodes.joints.size());
  PoseNodes(character.rig, pose, nodes);
  return nodes;
}

Vec3 NormalAt(const Character& character, std::span<const Mat4> skin, const MeshPoint& point) {
  const MeshPart& part = character.parts[static_cast<std::size_t>(point.part)];
  const std::uint32_t* corner = &part.triangles[std::size_t{3} * point.triangle];
  const Vec3 a = SkinVertex(part, skin, corner[0]);
  return glm::normalize(
      glm::cross(SkinVertex(part, skin, corner[1]) - a, SkinVertex(part, skin, corner[2]) - a));
}

/// Masses on springs, carried along: their displacement from where they hang.
class SoftTissue {
 public:
  explicit SoftTissue(std::size_t count) : last_(count), speed_(count), sag_(count), rate_(count) {}

  /// Moves one mass on by a frame; the anchor is where it would be if it were rigid.
  Vec3 Step(std::size_t i, const Vec3& anchor, double seconds, bool first) {
    constexpr int kSubsteps = 4;
    if (first) {
      last_[i] = anchor;
      return Vec3{0.0};
    }
    const Vec3 speed = (anchor - last_[i]) / seconds;
    const Vec3 acceleration = started_ ? (speed - speed_[i]) / seconds : Vec3{0.0};
    speed_[i] = speed;
    last_[i] = anchor;
    const double w = 2.0 * kPi * kTissueHz;
    const double h = seconds / kSubsteps;
    for (int s = 0; s < kSubsteps; ++s) {
      rate_[i] -= h * (w * w * sag_[i] + 2.0 * kTissueDamping * w * rate_[i] + acceleration);
      sag_[i] += h * rate_[i];
    }
    return sag_[i];
  }
  void FrameDone(bool first) { started_ = started_ || !first; }

 private:
  std::vector<Vec3> last_, speed_, sag_, rate_;
  bool started_ = false;
};

}  // namespace

const MarkerSet& StudioMarkerSet() {
  static const MarkerSet* const kSet = [] {
    for (const MarkerSet& set : ShippedMarkerSets()) {
      if (set.name == "Studio 38") return &set;
    }
    return static_cast<const MarkerSet*>(nullptr);
  }();
  EGO_CHECK(kSet != nullptr);
  return *kSet;
}

WornMarkers WearMarkers(const Person& person, const MarkerSet& set,
                        const SyntheticMarkerOptions& options) {
  const Skeleton model = TemplateSkeleton(1.78);
  const std::array<Vec3, kJointCount> from = CanonicalPositions(model);
  const std::array<Vec3, kJointCount> to = CanonicalPositions(person.body.skeleton);
  const MeshBvh skin(person.character, CanonicalMesh(person.character));
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double scale = person.body.height / 1.78;
  WornMarkers worn;
  for (const SetMarker& marker : set.markers) {
    const J joint = marker.joint;
    const J end = BoneEndOf(joint);
    Vec3 offset = marker.position_ms - from[Index(joint)];
    // Along the bone in shares of its length, across it by the body's size.
    Vec3 along{0.0};
    const Vec3 bone = from[Index(end)] - from[Index(joint)];
    if (glm::length(bone) > 1e-9) {
      const double share = glm::dot(offset, bone) / glm::dot(bone, bone);
      along = share * (to[Index(end)] - to[Index(joint)]);
      offset -= share * bone;
    }
    const Vec3 stray{normal(random), normal(random), normal(random)};
    const Vec3 place = to[Index(joint)] + along + scale * offset +
                       options.placement_spread * scale * marker.sigma * stray;
    worn.labels.push_back(marker.label);
    worn.places.push_back(skin.Nearest(place)->place);
    worn.regions.push_back(marker.region);
  }
  return worn;
}

std::vector<std::uint8_t> SeenByCameras(const Character& character, const PosedMesh& mesh,
                                        std::span<const Vec3> points_ws, const Vec3& center_ws,
                                        const CameraRing& cameras) {
  const MeshBvh skin(character, mesh);
  std::vector<std::uint8_t> seen(points_ws.size(), 0);
  for (std::size_t i = 0; i < points_ws.size(); ++i) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < cameras.count && count < cameras.seen_by; ++c) {
      const double angle =
          2.0 * kPi * (static_cast<double>(c) + 0.5) / static_cast<double>(cameras.count);
      const Vec3 camera = Vec3{center_ws.x, cameras.height, center_ws.z} +
                          cameras.radius * Vec3{std::sin(angle), 0.0, std::cos(angle)};
      const Vec3 to = camera - points_ws[i];
      const double distance = glm::length(to);
      if (!skin.FirstHit(points_ws[i], to / distance, distance)) ++count;
    }
    seen[i] = count >= cameras.seen_by ? 1 : 0;
  }
  return seen;
}

std::shared_ptr<const MarkerTake> RecordMarkers(const Person& person, const WornMarkers& markers,
                                                const CapturedMotion& motion,
                                                const SyntheticMarkerOptions& options) {
  const Character& character = person.character;
  const std::size_t count = markers.labels.size();
  auto take = std::make_shared<MarkerTake>();
  take->name = motion.name;
  take->labels = markers.labels;
  take->rate_hz = motion.rate_hz;
  take->frame_count = motion.poses.size();
  take->position_ws.reserve(count * motion.poses.size());
  take->visible.assign(count * motion.poses.size(), 1);
  Vec3 center{0.0};
  for (const Pose& pose : motion.poses) {
    center += pose.root_ws / static_cast<double>(motion.poses.size());
  }
  std::mt19937 random(options.seed + 1);
  std::normal_distribution<double> normal(0.0, 1.0);
  SoftTissue tissue(count);
  std::vector<Vec3> clean(count);
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const std::vector<Mat4> nodes = NodesOf(character, motion.poses[f]);
    const std::vector<Mat4> skin = SkinMatrices(character, nodes);
    for (std::size_t m = 0; m < count; ++m) {
      const Vec3 normal_ws = NormalAt(character, skin, markers.places[m]);
      Vec3 p = PosePoint(character, skin, markers.places[m]) + options.stand_off * normal_ws;
      const bool soft =
          markers.regions[m] == MarkerRegion::kTrunk || markers.regions[m] == MarkerRegion::kLimb;
      if (options.wobble > 0.0 && soft) {
        // Skin slides, it does not leave the flesh.
        Vec3 sag = options.wobble * tissue.Step(m, p, 1.0 / motion.rate_hz, f == 0);
        sag -= normal_ws * glm::dot(sag, normal_ws);
        p += sag;
      }
      clean[m] = p;
      if (options.noise > 0.0) {
        p += options.noise * Vec3{normal(random), normal(random), normal(random)};
      }
      take->position_ws.push_back(p);
    }
    tissue.FrameDone(f == 0);
    if (options.occlusion) {
      const std::vector<std::uint8_t> seen =
          SeenByCameras(character, PoseMesh(character, nodes), clean, center, options.cameras);
      std::copy(seen.begin(), seen.end(),
                take->visible.begin() + static_cast<std::ptrdiff_t>(f * count));
    }
  }
  return take;
}

}  // namespace ego
