// SPDX-License-Identifier: MIT
#include "core/solve/standing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr std::array<J, 2> kFeet = {J::kLeftFoot, J::kRightFoot};

constexpr double kStandingSpeed = 0.15;  // metres per second
constexpr double kStandingRise = 0.03;   // above the lowest, metres
constexpr double kSpeedSpan = 0.04;      // seconds over which a speed is measured
constexpr double kMaxTilt = Radians(25.0);

std::vector<ModelPose> PlaceAll(const Skeleton& skeleton, std::span<const Pose> poses) {
  std::vector<ModelPose> placed;
  placed.reserve(poses.size());
  for (const Pose& pose : poses) placed.push_back(ForwardKinematics(skeleton, pose));
  return placed;
}

/// Speed of a path at a frame, from neighbours a little apart.
double SpeedAt(std::span<const Vec3> path, std::size_t frame, double rate_hz) {
  const auto span = static_cast<std::size_t>(std::max(1.0, std::round(kSpeedSpan * rate_hz)));
  const std::size_t a = frame > span ? frame - span : 0;
  const std::size_t b = std::min(path.size() - 1, frame + span);
  if (a == b) return 0.0;
  return glm::distance(path[a], path[b]) * rate_hz / static_cast<double>(b - a);
}

double Quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Quat ShortestTurn(const Vec3& from, const Vec3& to) {
  const Vec3 axis = glm::cross(from, to);
  return glm::normalize(Quat{1.0 + glm::dot(from, to), axis.x, axis.y, axis.z});
}

void LevelSole(J foot, const std::vector<ModelPose>& placed, double rate_hz, MarkerModel& model,
               std::span<Pose> poses) {
  const bool marked = std::any_of(model.markers.begin(), model.markers.end(),
                                  [&](const BoundMarker& m) { return m.joint == foot; });
  if (!marked) return;
  std::vector<Vec3> path;
  std::vector<double> heights;
  for (const ModelPose& pose : placed) {
    path.push_back(pose.Position(foot));
    heights.push_back(path.back().y);
  }
  const double lowest = Quantile(heights, 0.05);
  Vec3 up{0.0};
  std::size_t count = 0;
  for (std::size_t f = 0; f < placed.size(); ++f) {
    if (path[f].y > lowest + kStandingRise || SpeedAt(path, f, rate_hz) > kStandingSpeed) continue;
    const Vec3 local_up = glm::conjugate(placed[f].Rotation(foot)) * kUp;
    if (local_up.y < std::cos(2.0 * kMaxTilt)) continue;  // kneeling or lying, not standing
    up += local_up;
    ++count;
  }
  if (count < std::max<std::size_t>(5, placed.size() / 100)) return;
  up = glm::normalize(up);
  if (up.y < std::cos(kMaxTilt)) return;
  const Quat level = ShortestTurn(up, kUp);
  const J toes = foot == J::kLeftFoot ? J::kLeftToes : J::kRightToes;
  for (BoundMarker& marker : model.markers) TurnFootFrame(foot, level, marker);
  Vec3& to_toes = model.skeleton.offset[Index(toes)];
  to_toes = level * to_toes;
  for (Pose& pose : poses) {
    Quat& rotation = pose.rotation_ls[Index(foot)];
    rotation = glm::normalize(rotation * glm::conjugate(level));
    Quat& bend = pose.rotation_ls[Index(toes)];
    bend = glm::normalize(level * bend * glm::conjugate(level));
  }
}

/// Centre of the 1 cm neighbourhood that holds most values, the lower of near equals: a step or a
/// platform stood on longer than the ground would otherwise become the ground.
double LowestMode(std::vector<double> values) {
  constexpr double kWidth = 0.01;
  constexpr double kEnough = 0.5;  // of the fullest neighbourhood
  std::sort(values.begin(), values.end());
  std::vector<std::size_t> inside(values.size());
  std::size_t most = 0;
  std::size_t end = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (end < values.size() && values[end] <= values[i] + kWidth) ++end;
    inside[i] = end - i;
    most = std::max(most, inside[i]);
  }
  std::size_t first = 0;
  while (static_cast<double>(inside[first]) < kEnough * static_cast<double>(most)) ++first;
  // Climb to the top of this lowest hill.
  std::size_t best = first;
  for (std::size_t i = first; i < values.size() && values[i] < values[first] + kWidth; ++i) {
    if (inside[i] > inside[best]) best = i;
  }
  return values[best + inside[best] / 2];
}

}  // namespace

void LevelSoles(MarkerModel& model, std::span<Pose> poses, double rate_hz) {
  if (poses.empty()) return;
  const std::vector<ModelPose> placed = PlaceAll(model.skeleton, poses);
  for (const J foot : kFeet) LevelSole(foot, placed, rate_hz, model, poses);
}

double GroundHeight(const Body& performer, std::span<const Pose> poses, double rate_hz) {
  if (poses.empty()) return 0.0;
  const std::vector<ModelPose> placed = PlaceAll(performer.skeleton, poses);
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(performer.skeleton);
  std::vector<double> standing;
  std::vector<double> lowest(poses.size(), std::numeric_limits<double>::infinity());
  for (std::size_t side = 0; side < 2; ++side) {
    const FootSurface& surface = performer.surface.foot[side];
    for (const Vec3& point_ms : {surface.heel_ms, surface.ball_ms}) {
      std::vector<Vec3> path;
      for (const ModelPose& pose : placed) {
        path.push_back(PosePoint(canonical, pose, kFeet[side], point_ms));
      }
      for (std::size_t f = 0; f < path.size(); ++f) {
        lowest[f] = std::min(lowest[f], path[f].y);
        if (SpeedAt(path, f, rate_hz) < kStandingSpeed) standing.push_back(path[f].y);
      }
    }
  }
  if (standing.size() < 10) return Quantile(lowest, 0.05);
  return LowestMode(standing);
}

}  // namespace ego
