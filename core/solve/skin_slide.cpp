// SPDX-License-Identifier: MIT
#include "core/solve/skin_slide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/solve/dense.h"

namespace ego {
namespace {

constexpr double kSigma = 0.008;       // of a marker's error, one axis, metres
constexpr double kOutlier = 0.05;      // errors beyond lose their say, metres
constexpr double kSlideSigma = 0.006;  // scale of the slides' prior, metres per radian
constexpr double kPlaceSigma = 0.002;  // how far a place may follow at once, metres
constexpr double kHeldSigma = 1e-5;    // as good as not at all
// Neighbouring frames say the same: all together count for no more than this many.
constexpr double kFrames = 40.0;
constexpr int kReweightings = 5;  // of the prior
constexpr std::size_t kUnknowns = kSlideCount + 1;

struct Seen {
  std::array<double, kUnknowns> row{};  // turns, then one for the place
  Vec3 error{0.0};                      // of the marker as bound now, bone's frame
};

/// One axis of a marker's slides and the change of its place.
using Column = std::array<double, kUnknowns>;

/// On skin or shoe over a stiff part: it has no shares, and its place stays where the fit put it.
bool IsOnFoot(const FittedMarker& marker) {
  return marker.joint == HumanoidJoint::kLeftFoot || marker.joint == HumanoidJoint::kRightFoot;
}

bool Slides(const FittedMarker& marker) {
  return IsOnFoot(marker) || std::any_of(marker.share_sigma.begin(), marker.share_sigma.end(),
                                         [](double sigma) { return sigma > 0.0; });
}

/// The mean turns, by which all rows become deviations: a joint that is bent all the time shows no
/// slide, and the place of the mean posture is known already.
Column Centre(std::vector<Seen>& seen) {
  Column mean{};
  for (const Seen& s : seen) {
    for (std::size_t i = 0; i < kSlideCount; ++i) {
      mean[i] += s.row[i] / static_cast<double>(seen.size());
    }
  }
  for (Seen& s : seen) {
    for (std::size_t i = 0; i < kSlideCount; ++i) s.row[i] -= mean[i];
  }
  return mean;
}

void FitMarker(std::vector<Seen>& seen, FittedMarker& marker) {
  const Column mean = Centre(seen);
  const SkinSlides before = marker.slide;
  const double share = std::min(1.0, kFrames / static_cast<double>(seen.size()));
  std::array<double, kUnknowns * kUnknowns> gram{};
  std::array<Column, 3> right{};
  for (const Seen& s : seen) {
    const double far = glm::dot(s.error, s.error) / (kOutlier * kOutlier);
    const double weight = share / (kSigma * kSigma * (1.0 + far) * (1.0 + far));
    // The target is the slide as a whole, so that the prior holds the whole and not its last
    // change.
    Vec3 target = s.error;
    for (std::size_t i = 0; i < kSlideCount; ++i) target += s.row[i] * marker.slide[i];
    for (std::size_t r = 0; r < kUnknowns; ++r) {
      for (std::size_t c = 0; c <= r; ++c) gram[r * kUnknowns + c] += weight * s.row[r] * s.row[c];
      for (int axis = 0; axis < 3; ++axis) {
        right[static_cast<std::size_t>(axis)][r] += weight * s.row[r] * target[axis];
      }
    }
  }
  const double place_sigma = IsOnFoot(marker) ? kHeldSigma : kPlaceSigma;
  gram[kUnknowns * kUnknowns - 1] += 1.0 / (place_sigma * place_sigma);
  Vec3 place{0.0};
  for (int iteration = 0; iteration < kReweightings; ++iteration) {
    std::array<double, kUnknowns* kUnknowns> factor = gram;
    for (std::size_t i = 0; i < kSlideCount; ++i) {
      const double r2 = glm::dot(marker.slide[i], marker.slide[i]) / (kSlideSigma * kSlideSigma);
      factor[i * kUnknowns + i] += 1.0 / (kSlideSigma * kSlideSigma * (1.0 + r2));
    }
    CholeskyInPlace(factor.data(), kUnknowns, kUnknowns);
    for (int axis = 0; axis < 3; ++axis) {
      Column x = right[static_cast<std::size_t>(axis)];
      SolveLower(factor.data(), kUnknowns, kUnknowns, x.data());
      SolveLowerTransposed(factor.data(), kUnknowns, kUnknowns, x.data());
      for (std::size_t i = 0; i < kSlideCount; ++i) marker.slide[i][axis] = x[i];
      place[axis] = x[kSlideCount];
    }
  }
  marker.shift_ls += place;
  for (std::size_t i = 0; i < kSlideCount; ++i) {
    marker.shift_ls += mean[i] * (before[i] - marker.slide[i]);
  }
}

}  // namespace

void FitSlides(std::span<const MarkerFrame> frames, std::span<const Posture> postures,
               Bundle& bundle) {
  const MarkerModel model = ModelOf(bundle);
  std::vector<ModelPose> poses;
  poses.reserve(postures.size());
  for (const Posture& posture : postures) poses.push_back(Placed(model.skeleton, posture));
  std::vector<Seen> seen;
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    if (!Slides(bundle.markers[m])) continue;
    const BoundMarker& marker = model.markers[m];
    seen.clear();
    for (std::size_t f = 0; f < frames.size(); ++f) {
      if (!frames[f].visible[marker.label]) continue;
      Seen s;
      const std::array<double, kSlideCount> turns = SlideTurns(marker, poses[f]);
      std::copy(turns.begin(), turns.end(), s.row.begin());
      s.row[kSlideCount] = 1.0;
      s.error = glm::conjugate(poses[f].Rotation(marker.joint)) *
                (frames[f].position_ws[marker.label] - MarkerPosition(marker, poses[f]));
      seen.push_back(s);
    }
    if (!seen.empty()) FitMarker(seen, bundle.markers[m]);
  }
}

}  // namespace ego
