// SPDX-License-Identifier: MIT
#include "core/solve/skeleton_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/body/body.h"
#include "core/solve/bundle.h"
#include "core/solve/skin_prior.h"
#include "core/solve/skin_slide.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kTemplateHeight = 1.78;
constexpr std::size_t kCandidates = 120;
// Fewer markers than this in a frame leave whole limbs unseen: no good posture to learn from.
constexpr std::size_t kMinVisible = 12;
// Before the markers' places are known, they are this far off.
constexpr double kTableSigma = 0.03;
// Wrists and ankles are this much freer in the fit than in a frame: held tightly, they would pull
// the estimated joint centres towards their markers.
constexpr double kEndSpread = 3.0;

/// A body outside these sizes is a wrong unit, not a performer: 0.55 m to 2.7 m of height.
constexpr double kMinScale = 0.31;
constexpr double kMaxScale = 1.52;

std::size_t CountVisible(const std::vector<FittedMarker>& markers, const MarkerFrame& frame) {
  std::size_t count = 0;
  for (const FittedMarker& marker : markers) count += frame.visible[marker.label] ? 1u : 0u;
  return count;
}

double Median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Evenly spaced frames that show at least 60 % of what the best of them shows.
std::vector<std::size_t> CandidateFrames(const MarkerTake& take,
                                         const std::vector<FittedMarker>& markers) {
  const std::size_t stride = std::max<std::size_t>(1, take.frame_count / (4 * kCandidates));
  std::vector<std::pair<std::size_t, std::size_t>> seen;  // frame, visible
  std::size_t most = 0;
  for (std::size_t f = 0; f < take.frame_count; f += stride) {
    seen.emplace_back(f, CountVisible(markers, take.Frame(f)));
    most = std::max(most, seen.back().second);
  }
  const std::size_t wanted = std::max(kMinVisible, (most * 6) / 10);
  std::vector<std::size_t> good;
  for (const auto& [frame, visible] : seen) {
    if (visible >= wanted) good.push_back(frame);
  }
  if (good.size() <= kCandidates) return good;
  std::vector<std::size_t> spread;
  for (std::size_t i = 0; i < kCandidates; ++i) {
    spread.push_back(good[i * (good.size() - 1) / (kCandidates - 1)]);
  }
  return spread;
}

/// Size of the performer relative to the template from distances that posture hardly changes:
/// between markers of one segment or of neighbours, where they vary little over the frames.
std::optional<double> EstimateScale(const MarkerTake& take,
                                    const std::vector<FittedMarker>& markers,
                                    const std::vector<std::size_t>& frames) {
  const std::array<Vec3, kJointCount> canonical =
      CanonicalPositions(TemplateSkeleton(kTemplateHeight));
  std::vector<std::pair<double, double>> ratios;  // ratio, weight
  std::vector<double> distances;
  for (std::size_t a = 0; a < markers.size(); ++a) {
    for (std::size_t b = a + 1; b < markers.size(); ++b) {
      const J ja = markers[a].joint;
      const J jb = markers[b].joint;
      if (ja != jb && Parent(ja) != jb && Parent(jb) != ja && Parent(ja) != Parent(jb)) continue;
      const double expected = glm::distance(canonical[Index(ja)] + markers[a].template_offset,
                                            canonical[Index(jb)] + markers[b].template_offset);
      const double blur = std::hypot(markers[a].sigma, markers[b].sigma);
      if (expected < 0.15 || expected < 4.0 * blur) continue;
      distances.clear();
      for (const std::size_t f : frames) {
        const MarkerFrame frame = take.Frame(f);
        if (!frame.visible[markers[a].label] || !frame.visible[markers[b].label]) continue;
        distances.push_back(glm::distance(frame.position_ws[markers[a].label],
                                          frame.position_ws[markers[b].label]));
      }
      if (distances.size() < 3 && distances.size() < frames.size()) continue;
      if (distances.empty()) continue;
      const double median = Median(distances);
      for (double& d : distances) d = std::abs(d - median);
      const double deviation = Median(distances);
      if (deviation > 0.04 * median) continue;
      ratios.emplace_back(median / expected, expected / blur);
    }
  }
  if (ratios.empty()) return std::nullopt;
  std::sort(ratios.begin(), ratios.end());
  double total = 0.0;
  for (const auto& [ratio, weight] : ratios) total += weight;
  double sum = 0.0;
  for (const auto& [ratio, weight] : ratios) {
    sum += weight;
    if (sum >= 0.5 * total) return ratio;
  }
  return ratios.back().first;
}

/// What tells postures apart: bone directions seen from the hips.
using Descriptor = std::array<Vec3, 10>;

Descriptor Describe(const Posture& posture) {
  static const Skeleton kSkeleton = TemplateSkeleton(kTemplateHeight);
  const ModelPose pose = Placed(kSkeleton, posture);
  const Quat from_hips = glm::conjugate(pose.rotation_ws[0]);
  Descriptor descriptor;
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    descriptor[s] = from_hips * glm::normalize(pose.Position(EndJoint(segment)) -
                                               pose.Position(StartJoint(segment)));
  }
  descriptor[8] = from_hips * (pose.Rotation(J::kUpperChest) * kUp);
  descriptor[9] = from_hips * (pose.Rotation(J::kHead) * Vec3{0.0, 0.0, 1.0});
  return descriptor;
}

double SquaredDistance(const Descriptor& a, const Descriptor& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return sum;
}

/// Indices of postures as different as possible: farthest-point sampling, begun at the first.
std::vector<std::size_t> DiverseSubset(const std::vector<Posture>& postures, std::size_t count) {
  std::vector<Descriptor> descriptors;
  for (const Posture& posture : postures) descriptors.push_back(Describe(posture));
  std::vector<double> distance(postures.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> chosen;
  std::size_t next = 0;
  while (chosen.size() < std::min(count, postures.size())) {
    chosen.push_back(next);
    distance[next] = -1.0;
    for (std::size_t i = 0; i < postures.size(); ++i) {
      if (distance[i] < 0.0) continue;
      distance[i] = std::min(distance[i], SquaredDistance(descriptors[i], descriptors[next]));
    }
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                    distance.begin());
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Postures and slides by turns; leaves the postures of the frames `solved`. All candidate frames
/// are used, not only those of the bundle: a regression on many frames learns less that is not
/// there.
void LearnSlides(const MarkerTake& take, const std::vector<std::size_t>& solved,
                 std::vector<Posture>& postures, Bundle& bundle) {
  constexpr int kRounds = 4;
  PoseSolverOptions options;
  options.step_per_frame = 0.0;
  std::vector<MarkerFrame> frames;
  for (const std::size_t f : solved) frames.push_back(take.Frame(f));
  for (int round = 0; round < kRounds; ++round) {
    const PoseSolver solver(ModelOf(bundle), options);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      PoseSolver::State state{PoseFromPosture(postures[i]), true};
      solver.Solve(frames[i], state);
      postures[i] = PostureFromPose(state.pose);
    }
    FitSlides(frames, postures, bundle);
  }
}

double MeanResidual(const Bundle& bundle) {
  const MarkerModel model = ModelOf(bundle);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < bundle.frames.size(); ++f) {
    const ModelPose pose = Placed(model.skeleton, bundle.postures[f]);
    for (const BoundMarker& marker : model.markers) {
      if (!bundle.frames[f].visible[marker.label]) continue;
      const Vec3 point = MarkerPosition(marker, pose);
      sum += glm::distance(point, bundle.frames[f].position_ws[marker.label]);
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

Result<SkeletonFit> FitSkeleton(const MarkerTake& take, const MarkerSet& set,
                                const SkeletonFitOptions& options, const Progress& progress) {
  const std::array<Vec3, kJointCount> canonical =
      CanonicalPositions(TemplateSkeleton(kTemplateHeight));
  const std::vector<std::optional<std::size_t>> match = MatchLabels(set, take.labels);
  SkeletonFit fit;
  Bundle bundle;
  for (std::size_t i = 0; i < match.size(); ++i) {
    if (!match[i]) continue;
    bool seen = false;
    for (std::size_t f = 0; f < take.frame_count && !seen; ++f)
      seen = take.Frame(f).visible[i] != 0;
    if (!seen) continue;
    const SetMarker& place = set.markers[*match[i]];
    FittedMarker marker;
    marker.label = i;
    marker.joint = place.joint;
    marker.template_offset = place.position_ms - canonical[Index(place.joint)];
    marker.along = AlongBone(place.joint, marker.template_offset);
    marker.sigma = place.sigma;
    const SkinPrior skin = SkinPriorOf(place);
    marker.child = skin.child;
    marker.share_sigma = skin.sigma;
    bundle.markers.push_back(marker);
    fit.set_marker.push_back(*match[i]);
  }
  if (bundle.markers.size() < kMinVisible) {
    return Error{take.name + ": only " + std::to_string(bundle.markers.size()) +
                 " markers of the set \"" + set.name + "\" are ever seen, at least " +
                 std::to_string(kMinVisible) + " are needed"};
  }
  const std::vector<std::size_t> candidates = CandidateFrames(take, bundle.markers);
  if (candidates.empty()) {
    return Error{take.name + ": no frame shows " + std::to_string(kMinVisible) +
                 " markers of the set \"" + set.name + "\" at once"};
  }
  const std::optional<double> scale = EstimateScale(take, bundle.markers, candidates);
  if (!scale || *scale < kMinScale || *scale > kMaxScale) {
    return Error{take.name + ": the distances between the markers of the set \"" + set.name +
                 "\" are not those of a human body" +
                 (scale ? " (height " + std::to_string(*scale * kTemplateHeight) + " m)" : "") +
                 ": check the file's unit and its labels"};
  }
  bundle.scale = *scale;

  // First postures with the table's places alone.
  PoseSolverOptions table_options;
  table_options.sigma = kTableSigma;
  table_options.restart_residual = 0.14;
  table_options.max_iterations = 30;
  table_options.step_per_frame = 0.0;
  const PoseSolver table_solver(ModelOf(bundle), table_options);
  std::vector<Posture> postures;
  std::vector<std::size_t> solved;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!Report(progress, 0.4 * static_cast<double>(i) / static_cast<double>(candidates.size()),
                "guessing postures")) {
      return Error{"cancelled"};
    }
    PoseSolver::State state;
    if (!table_solver.SolveCold(take.Frame(candidates[i]), state).solved) continue;
    postures.push_back(PostureFromPose(state.pose));
    solved.push_back(candidates[i]);
  }
  if (solved.empty()) return Error{take.name + ": no frame could be solved"};

  for (const std::size_t i : DiverseSubset(postures, options.frames)) {
    bundle.frames.push_back(take.Frame(solved[i]));
    bundle.postures.push_back(postures[i]);
    fit.frames.push_back(solved[i]);
  }
  BundleOptions stage;
  stage.priors.end_spread = kEndSpread;
  stage.symmetry_sigma = options.symmetry_sigma;
  stage.offset_sigma_scale = options.offset_sigma_scale;
  constexpr std::array<std::pair<double, int>, 5> kStages = {
      {{0.030, 8}, {0.020, 8}, {0.012, 10}, {0.008, 12}, {0.008, 20}}};
  constexpr std::size_t kFirstSkinStage = 3;
  for (std::size_t s = 0; s < kStages.size(); ++s) {
    if (!Report(progress, 0.4 + 0.6 * static_cast<double>(s) / kStages.size(),
                "fitting the skeleton")) {
      return Error{"cancelled"};
    }
    stage.loss.sigma = kStages[s].first;
    stage.skin = s >= kFirstSkinStage;
    stage.max_iterations = kStages[s].second;
    if (s + 1 == kStages.size()) {  // places are known: ghosts need not pull any longer
      stage.loss.kind = MarkerLoss::Kind::kGemanMcClure;
      stage.loss.outlier_factor *= 2.0;
    }
    AdjustBundle(bundle, stage);
    Rescale(bundle);
  }
  LearnSlides(take, solved, postures, bundle);
  fit.model = ModelOf(bundle);
  std::vector<MarkerFrame> learnt;
  std::vector<ModelPose> poses;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    learnt.push_back(take.Frame(solved[i]));
    poses.push_back(Placed(fit.model.skeleton, postures[i]));
  }
  fit.model.predictors = LearnPredictors(fit.model.markers, learnt, poses);
  fit.scale = bundle.scale;
  fit.mean_residual = MeanResidual(bundle);
  for (const FittedMarker& marker : bundle.markers) {
    fit.offset_sigma.push_back(marker.sigma * bundle.scale * options.offset_sigma_scale);
  }
  return fit;
}

}  // namespace ego
