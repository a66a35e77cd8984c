// SPDX-License-Identifier: MIT
#include "app/view/stage_layout.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace ego {
namespace {

constexpr double kStaysWithin = 1.0;  // metres: a way shorter than this is no travel
constexpr double kSmoothingSeconds = 1.0;
constexpr double kGap = 0.06;            // metres between neighbours' reach
constexpr double kSmallestReach = 0.25;  // shares of height
constexpr double kLargestReach = 0.42;

Vec2 Ground(const Vec3& p) { return {p.x, p.z}; }

// Moving average over 2 * radius + 1 entries, fewer at the ends.
std::vector<Vec2> Averaged(const std::vector<Vec2>& path, std::size_t radius) {
  std::vector<Vec2> sum(path.size() + 1, Vec2(0.0));
  for (std::size_t i = 0; i < path.size(); ++i) sum[i + 1] = sum[i] + path[i];
  std::vector<Vec2> averaged(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    // The window shrinks on both sides at once: a straight walk stays where it is.
    const std::size_t r = std::min({radius, i, path.size() - 1 - i});
    averaged[i] = (sum[i + r + 1] - sum[i - r]) / static_cast<double>(2 * r + 1);
  }
  return averaged;
}

// What the hips face, on the ground; shorter the more they are tilted.
Vec2 Facing(const Pose& pose) { return Ground(pose.rotation_ls[0] * Vec3(0.0, 0.0, 1.0)); }

double MeanHeading(const std::vector<Pose>& poses) {
  constexpr double kTurnsAround = 0.3;  // mean resultant length below which no way is the main one
  if (poses.empty()) return 0.0;
  Vec2 mean(0.0);
  for (const Pose& pose : poses) mean += Facing(pose);
  mean /= static_cast<double>(poses.size());
  if (glm::length(mean) < kTurnsAround) mean = Facing(poses.front());
  return glm::length(mean) > 1e-9 ? std::atan2(mean.x, mean.y) : 0.0;
}

double Percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

}  // namespace

StageLayout::StageLayout(const CapturedMotion& motion) {
  std::vector<Vec2> path;
  path.reserve(motion.poses.size());
  for (const Pose& pose : motion.poses) path.push_back(Ground(pose.root_ws));
  if (path.empty()) path.push_back(Vec2(0.0));
  Vec2 low = path.front();
  Vec2 high = path.front();
  for (const Vec2& p : path) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  if (glm::length(high - low) <= kStaysWithin) {
    anchor_ = {0.5 * (low + high)};
  } else {
    const auto radius = static_cast<std::size_t>(kSmoothingSeconds * 0.5 * motion.rate_hz);
    anchor_ = Averaged(Averaged(path, radius), radius);
  }

  heading_ = MeanHeading(motion.poses);
  const Vec3 right{std::cos(heading_), 0.0, -std::sin(heading_)};
  const Vec3 forward{std::sin(heading_), 0.0, std::cos(heading_)};
  std::vector<double> sideways;
  std::vector<double> depthwise;
  const std::size_t stride = std::max<std::size_t>(1, motion.poses.size() / 400);
  for (std::size_t frame = 0; frame < motion.poses.size(); frame += stride) {
    const ModelPose posed = ForwardKinematics(motion.performer.skeleton, motion.poses[frame]);
    const Vec3 anchor = Anchor(frame);
    Vec2 farthest(0.0);
    for (const Vec3& p : posed.position_ws) {
      const Vec3 arm = p - anchor;
      farthest = glm::max(farthest,
                          Vec2(std::abs(glm::dot(arm, right)), std::abs(glm::dot(arm, forward))));
    }
    sideways.push_back(farthest.x);
    depthwise.push_back(farthest.y);
  }
  const auto reach = [&](const std::vector<double>& metres) {
    const double height = std::max(motion.performer.height, 0.1);
    return std::clamp(Percentile(metres, 0.8) / height + 0.04, kSmallestReach, kLargestReach);
  };
  reach_sideways_ = reach(sideways);
  reach_depthwise_ = reach(depthwise);
}

Vec3 StageLayout::Anchor(std::size_t frame) const {
  const Vec2& p = anchor_[std::min(frame, anchor_.size() - 1)];
  return {p.x, 0.0, p.y};
}

void StageLayout::Place(std::size_t frame, Line line, std::span<const Member> members,
                        std::span<Vec3> offset_ws) const {
  EGO_CHECK(members.size() == offset_ws.size());
  const bool sideways = line == Line::kSideways;
  const double reach = sideways ? reach_sideways_ : reach_depthwise_;
  double length = 0.0;
  for (const Member& member : members)
    length += 2.0 * (reach * member.height + member.girth) + kGap;
  const double turn = sideways ? heading_ : heading_ + 0.5 * kPi;
  const Vec3 along{std::cos(turn), 0.0, -std::sin(turn)};
  const Vec3 anchor = Anchor(frame);
  double at = -0.5 * length;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const double half = reach * members[i].height + members[i].girth + 0.5 * kGap;
    at += half;
    offset_ws[i] = along * at + anchor * (1.0 - members[i].scale);
    at += half;
  }
}

}  // namespace ego
