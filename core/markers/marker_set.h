// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/base/result.h"
#include "core/skeleton/humanoid.h"

namespace ego {

/// What a marker lies on. Trunk, head and limb markers also measure the performer's surface.
enum class MarkerRegion : std::uint8_t { kTrunk, kHead, kLimb, kHand, kFoot };

std::string_view Name(MarkerRegion region);
std::optional<MarkerRegion> MarkerRegionNamed(std::string_view name);

/// One place on the body that a marker set marks.
struct SetMarker {
  std::string label;                           // clean, see CleanLabel
  std::vector<std::string> aliases;            // other labels of the same place, clean
  HumanoidJoint joint = HumanoidJoint::kHips;  // carries the marker rigidly
  /// Centre of the marker on the canonical pose of the template body of 1.78 m, model space,
  /// metres: free of the performer's size, the solver scales it.
  Vec3 position_ms{0.0};
  double sigma = 0.02;  // how far real placements stray from there, one axis, metres, template size
  std::string mirror;   // label of the partner on the other side, clean; empty in the middle
  MarkerRegion region = MarkerRegion::kTrunk;
};

/// A named arrangement of markers on a body: what a session's labels mean.
struct MarkerSet {
  std::string name;
  std::string description;
  std::vector<SetMarker> markers;
};

/// A label reduced to what names the place: the part after the last ':', upper case, letters,
/// digits and '*' only ("Subject:L_fhd " -> "LFHD").
std::string CleanLabel(std::string_view label);

/// `CleanLabel` of each, less a prefix that nearly all labels share up to their first '_'
/// ("Skeleton_Hip1" -> "HIP1", where a session writes its subject's name that way).
std::vector<std::string> CleanLabels(std::span<const std::string> labels);

/// Which marker of the set each label is; nothing for unknown labels and for the second of two
/// equal ones. Same length as `labels`.
std::vector<std::optional<std::size_t>> MatchLabels(const MarkerSet& set,
                                                    std::span<const std::string> labels);

/// The set among `known` that explains most labels (ties: the one with fewest markers missing),
/// completed with labels that only other sets know, where these agree what the label means.
/// Error: too few labels are known to solve a body; the sentence says which sets there are and,
/// where the take looks unlabelled, that labels are needed.
Result<MarkerSet> ChooseMarkerSet(std::span<const MarkerSet> known,
                                  std::span<const std::string> labels);

/// Whether the set is usable: unique labels, finite places within 3 m, sigmas in (0, 1 m],
/// mirror partners that exist and name each other. Error: the first fault, as a sentence that
/// starts with the set's name.
Result<void> Validate(const MarkerSet& set);

}  // namespace ego
