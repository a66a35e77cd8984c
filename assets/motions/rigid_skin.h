// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/model/character.h"
#include "core/model/mesh_bvh.h"
#include "core/skeleton/pose.h"

namespace ego {

/// A character's skin cut into pieces, each rigid on the node that carries most of it: tells a few
/// thousand times a second how deep a limb lies in the rest of the body, to a millimetre or two
/// where skin bends. What makes motions uses it; what measures them uses SkinMeasure, which is
/// exact.
class RigidSkin {
 public:
  /// Keeps a reference.
  explicit RigidSkin(const Character& character);

  struct Depth {
    double deepest = 0.0;  // metres
    double sum = 0.0;      // of all probes
    /// The way out, metres: mean over what lies deep of hand and forearm (foot and shin), and of
    /// the upper arm (thigh).
    Vec3 out_ws{0.0};
    Vec3 upper_out_ws{0.0};
    double Cost() const { return deepest + 0.02 * sum; }
  };
  /// Of hand, forearm and the far half of the upper arm (or of the leg likewise) in the body
  /// without that limb; `absent`: without this one either.
  Depth Of(Limb limb, const Pose& pose, std::optional<Limb> absent = {}) const;
  /// Of one finger in the body without that arm. `gap`: how far its nearest point is from the
  /// skin where none lies deep.
  Depth OfFinger(std::size_t side, std::size_t digit, const Pose& pose, std::optional<Limb> absent,
                 double& gap) const;

 private:
  struct Probe {
    std::array<int, 4> node{};
    std::array<double, 4> weight{};
    Vec3 position_ms{0.0};
    int digit = -1;
    bool upper = false;  // on upper arm or thigh
  };
  struct Piece {
    int node = 0;
    int limb = -1;  // as Limb, -1: none
    MeshBvh skin;
    Vec3 low{0.0}, high{0.0};  // canonical pose
    Vec3 Middle() const { return 0.5 * (low + high); }
    double Radius() const { return 0.5 * glm::distance(low, high); }
  };
  struct Posed {
    std::vector<Mat4> motion;   // per node, away from the canonical pose
    std::vector<Mat4> inverse;  // per piece
  };
  Posed PosedAs(const Pose& pose) const;
  static Vec3 At(const Probe& probe, const Posed& posed);
  /// The pieces that are no part of these limbs and come near to a box of probes.
  std::vector<std::size_t> Near(std::span<const Vec3> probes, const Posed& posed, int limb,
                                int absent, double reach) const;
  /// Signed distance to the nearest of these pieces, negative inside; nothing when farther than
  /// `reach`.
  std::optional<double> Distance(const Vec3& p, const Posed& posed,
                                 std::span<const std::size_t> pieces, double reach,
                                 Vec3& out_ws) const;

  const Character& character_;
  std::vector<Mat4> from_canonical_;  // per node: inverse of where it is in the canonical pose
  std::vector<Piece> pieces_;
  std::array<std::vector<Probe>, kLimbCount> probes_;
};

}  // namespace ego
