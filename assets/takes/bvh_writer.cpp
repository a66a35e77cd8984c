// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "assets/files/file_io.h"
#include "assets/takes/bvh.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kCentimetres = 100.0;

void AppendNumber(std::string& text, double value, int digits) {
  std::array<char, 64> buffer{};
  const double step = std::pow(10.0, -digits);
  if (std::abs(value) < 0.5 * step) value = 0.0;  // no "-0.000000"
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, digits);
  text.append(buffer.data(), end.ptr);
}

void AppendOffset(std::string& text, std::size_t depth, const Vec3& offset) {
  text.append(depth, '\t').append("OFFSET");
  for (int axis = 0; axis < 3; ++axis) {
    text += ' ';
    AppendNumber(text, kCentimetres * offset[axis], 6);
  }
  text += '\n';
}

/// What ends a chain: crown, fingertips, toe tips; from the joint, canonical pose, metres.
std::optional<Vec3> EndSite(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                            J joint) {
  const Vec3& at = canonical[Index(joint)];
  switch (joint) {
    case J::kHead:
      return Vec3{0.0, std::max(0.0, body.height - at.y), 0.0};
    case J::kLeftHand:
      return body.surface.hand[0].fingertip_ms - at;
    case J::kRightHand:
      return body.surface.hand[1].fingertip_ms - at;
    case J::kLeftToes:
      return body.surface.foot[0].toe_tip_ms - at;
    case J::kRightToes:
      return body.surface.foot[1].toe_tip_ms - at;
    default:
      return std::nullopt;
  }
}

void AppendJoint(const Body& body, const std::array<Vec3, kJointCount>& canonical, J joint,
                 std::size_t depth, std::string& text, std::vector<J>& order) {
  const bool root = joint == J::kHips;
  order.push_back(joint);
  text.append(depth, '\t').append(root ? "ROOT " : "JOINT ").append(Name(joint)) += '\n';
  text.append(depth, '\t').append("{\n");
  // Programs differ in whether a root's position replaces its offset or adds to it: zero suits
  // both.
  AppendOffset(text, depth + 1, root ? Vec3{0.0} : body.skeleton.offset[Index(joint)]);
  text.append(depth + 1, '\t');
  text += root ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
               : "CHANNELS 3 Zrotation Xrotation Yrotation\n";
  for (std::size_t child = 1; child < kJointCount; ++child) {
    if (kParent[child] != joint) continue;
    AppendJoint(body, canonical, static_cast<J>(child), depth + 1, text, order);
  }
  if (const std::optional<Vec3> end = EndSite(body, canonical, joint)) {
    text.append(depth + 1, '\t').append("End Site\n");
    text.append(depth + 1, '\t').append("{\n");
    AppendOffset(text, depth + 2, *end);
    text.append(depth + 1, '\t').append("}\n");
  }
  text.append(depth, '\t').append("}\n");
}

/// Angles (z, x, y) in degrees with R = Rz Rx Ry. Of the two solutions, and of all whole turns,
/// the one nearest to `before`, so that the curves of an editor have no jumps.
/// Singular at x = +-90 degrees: there y keeps its last value.
Vec3 EulerZxy(const Quat& rotation, const Vec3& before) {
  const Mat3 m = glm::mat3_cast(rotation);  // m[column][row]
  const double sine = std::clamp(m[1][2], -1.0, 1.0);
  const double cosine = std::hypot(m[0][2], m[2][2]);
  Vec3 angles{0.0};
  if (cosine > 1e-9) {
    // atan2 keeps all digits near 90 degrees, where asin loses half of them.
    angles = {std::atan2(-m[1][0], m[1][1]), std::atan2(sine, cosine),
              std::atan2(-m[0][2], m[2][2])};
  } else {
    const double y = Radians(before.z);
    const double sum = std::atan2(m[0][1], m[0][0]);  // z + y for sine = 1, z - y for -1
    angles = {sine > 0.0 ? sum - y : sum + y, sine > 0.0 ? 0.5 * kPi : -0.5 * kPi, y};
  }
  const auto nearest = [&](Vec3 candidate) {
    for (int axis = 0; axis < 3; ++axis) {
      candidate[axis] = Degrees(candidate[axis]);
      candidate[axis] += 360.0 * std::round((before[axis] - candidate[axis]) / 360.0);
    }
    return candidate;
  };
  const Vec3 first = nearest(angles);
  const Vec3 second = nearest({angles.x + kPi, kPi - angles.y, angles.z + kPi});
  const auto distance = [&](const Vec3& a) {
    return std::abs(a.x - before.x) + std::abs(a.y - before.y) + std::abs(a.z - before.z);
  };
  return distance(first) <= distance(second) ? first : second;
}

}  // namespace

Result<void> WriteBvh(const std::filesystem::path& path, const Body& body,
                      std::span<const Pose> poses, double rate_hz) {
  if (poses.empty() || !(rate_hz > 0.0) || !std::isfinite(rate_hz)) {
    return Error{path.string() + ": a BVH needs at least one frame and a frame rate above zero"};
  }
  std::string text = "HIERARCHY\n";
  std::vector<J> order;
  AppendJoint(body, CanonicalPositions(body.skeleton), J::kHips, 0, text, order);
  text += "MOTION\nFrames: " + std::to_string(poses.size()) + "\nFrame Time: ";
  AppendNumber(text, 1.0 / rate_hz, 10);
  text += '\n';

  std::array<Vec3, kJointCount> angles{};
  for (const Pose& pose : poses) {
    for (const J joint : order) {
      if (joint == J::kHips) {
        for (int axis = 0; axis < 3; ++axis) {
          AppendNumber(text, kCentimetres * pose.root_ws[axis], 6);
          text += ' ';
        }
      }
      const std::size_t j = Index(joint);
      const Quat rotation = body.skeleton.locked[j] ? kIdentity : pose.rotation_ls[j];
      angles[j] = EulerZxy(rotation, angles[j]);
      for (int axis = 0; axis < 3; ++axis) {
        AppendNumber(text, angles[j][axis], 6);
        text += ' ';
      }
    }
    text.back() = '\n';
  }
  return WriteFileAtomically(path, text);
}

}  // namespace ego
