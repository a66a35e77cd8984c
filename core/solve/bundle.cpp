// SPDX-License-Identifier: MIT
#include "core/solve/bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/solve/dense.h"

namespace ego {
namespace {

/// Change of the far end of a joint's bone that the lengths make, in the joint's frame.
Vec3 BoneEndShift(HumanoidJoint joint, const LengthValues& lengths) {
  const HumanoidJoint end = BoneEnd(joint);
  Vec3 shift{0.0};
  if (end == joint) return shift;
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    const LengthParameter& p = LengthParameters()[k];
    for (std::size_t s = 0; s < p.shift_count; ++s) {
      if (p.shifts[s].joint == end) shift += lengths[k] * p.shifts[s].per_metre;
    }
  }
  return shift;
}

Vec3 OffsetOf(const Bundle& bundle, const FittedMarker& marker) {
  return bundle.scale * marker.template_offset +
         marker.along * BoneEndShift(marker.joint, bundle.lengths) + marker.shift_ls;
}

/// The change of a marker per metre of one length.
struct LengthColumn {
  std::size_t parameter = 0;
  // Joints before it, in their parents' frames; `joint` is the frame.
  std::array<LengthParameter::Shift, 6> shifts{};
  std::size_t count = 0;
  Vec3 offset_ls{0.0};  // of the marker's own offset, where its bone's far end moves
  Vec3 child_ls{0.0};   // of the child's offset
};

std::vector<LengthColumn> LengthColumns(const FittedMarker& marker) {
  std::array<bool, kJointCount> on_path{};
  for (std::size_t j = Index(marker.joint); j != 0; j = Index(kParent[j])) on_path[j] = true;
  const HumanoidJoint end = BoneEnd(marker.joint);
  std::vector<LengthColumn> columns;
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    const LengthParameter& p = LengthParameters()[k];
    LengthColumn column;
    column.parameter = k;
    bool moves = false;
    for (std::size_t s = 0; s < p.shift_count; ++s) {
      const auto& [moved, per_metre] = p.shifts[s];
      if (on_path[Index(moved)]) column.shifts[column.count++] = {Parent(moved), per_metre};
      if (end != marker.joint && moved == end) column.offset_ls += marker.along * per_metre;
      if (moved == marker.child) column.child_ls += per_metre;
      moves = moves || on_path[Index(moved)] || moved == end || moved == marker.child;
    }
    if (moves) columns.push_back(column);
  }
  return columns;
}

// Unknowns of one marker: its place and, where they are estimated, its skin shares.
constexpr std::size_t kPlace = 3;

class Adjuster {
 public:
  Adjuster(Bundle& bundle, const BundleOptions& options)
      : bundle_(bundle),
        options_(options),
        share_index_(IndexShares(bundle, options)),
        shared_(CountShared()),
        frames_(bundle.frames.size()),
        h_ss_(shared_ * shared_),
        g_s_(shared_),
        schur_(shared_ * shared_),
        step_s_(shared_),
        h_fs_(frames_ * kPoseDof * shared_),
        coupling_(frames_ * kPoseDof * shared_),
        frame_equations_(frames_),
        factor_(frames_) {
    for (const FittedMarker& marker : bundle.markers) {
      length_columns_.push_back(LengthColumns(marker));
    }
  }

  double Run() {
    double damping = 1e-3;
    double cost = Linearise();
    for (int i = 0; i < options_.max_iterations; ++i) {
      SolveStep(damping);
      Bundle candidate = Stepped();
      const double next = Cost(candidate);
      if (next <= cost) {
        const bool converged = cost - next < 1e-4 * cost;
        std::swap(bundle_, candidate);
        damping = std::max(1e-6, 0.2 * damping);
        cost = next;
        if (converged) break;
        cost = Linearise();
      } else {
        damping *= 10.0;
        if (damping > 1e4) break;
      }
    }
    return cost;
  }

 private:
  using ShareIndex = std::array<std::size_t, kSkinShareCount>;
  static constexpr std::size_t kHeld = static_cast<std::size_t>(-1);

  /// Places of the skin shares among the shared unknowns, after lengths and marker places.
  static std::vector<ShareIndex> IndexShares(const Bundle& bundle, const BundleOptions& options) {
    std::vector<ShareIndex> all(bundle.markers.size());
    std::size_t next = kLengthCount + kPlace * bundle.markers.size();
    for (std::size_t m = 0; m < all.size(); ++m) {
      for (std::size_t i = 0; i < kSkinShareCount; ++i) {
        const bool free = options.skin && bundle.markers[m].share_sigma[i] > 0.0;
        all[m][i] = free ? next++ : kHeld;
      }
    }
    return all;
  }

  std::size_t CountShared() const {
    std::size_t count = kLengthCount + kPlace * share_index_.size();
    for (const ShareIndex& index : share_index_) {
      for (const std::size_t i : index) count += i == kHeld ? 0 : 1;
    }
    return count;
  }

  double OffsetSigma(const FittedMarker& marker) const {
    return marker.sigma * bundle_.scale * options_.offset_sigma_scale;
  }

  double SharedPriorCost(const Bundle& bundle) const {
    double cost = 0.0;
    for (std::size_t k = 0; k < kLengthCount; ++k) {
      const LengthParameter& p = LengthParameters()[k];
      const double r = bundle.lengths[k] / (p.sigma * bundle.scale);
      cost += 0.5 * r * r;
      if (p.mirror > static_cast<int>(k)) {
        const double d = (bundle.lengths[k] - bundle.lengths[static_cast<std::size_t>(p.mirror)]) /
                         options_.symmetry_sigma;
        cost += 0.5 * d * d;
      }
    }
    for (const FittedMarker& marker : bundle.markers) {
      const double sigma = OffsetSigma(marker);
      cost += 0.5 * glm::dot(marker.shift_ls, marker.shift_ls) / (sigma * sigma);
      for (std::size_t i = 0; i < kSkinShareCount; ++i) {
        if (marker.share_sigma[i] <= 0.0) continue;
        const double r = marker.share[i] / marker.share_sigma[i];
        cost += 0.5 * std::log1p(r * r);
      }
    }
    return cost;
  }

  double Cost(const Bundle& bundle) const {
    const MarkerModel model = ModelOf(bundle);
    double cost = SharedPriorCost(bundle);
    for (std::size_t f = 0; f < frames_; ++f) {
      cost += PriorCost(bundle.postures[f], options_.priors) +
              MarkerCost(model, bundle.frames[f], Placed(model.skeleton, bundle.postures[f]),
                         options_.loss);
    }
    return cost;
  }

  void AddSharedPriors() {
    const auto diagonal = [&](std::size_t i) -> double& { return h_ss_[i * shared_ + i]; };
    for (std::size_t k = 0; k < kLengthCount; ++k) {
      const LengthParameter& p = LengthParameters()[k];
      const double sigma = p.sigma * bundle_.scale;
      diagonal(k) += 1.0 / (sigma * sigma);
      g_s_[k] += bundle_.lengths[k] / (sigma * sigma);
      if (p.mirror <= static_cast<int>(k)) continue;
      const auto m = static_cast<std::size_t>(p.mirror);
      const double weight = 1.0 / (options_.symmetry_sigma * options_.symmetry_sigma);
      const double difference = bundle_.lengths[k] - bundle_.lengths[m];
      diagonal(k) += weight;
      diagonal(m) += weight;
      h_ss_[m * shared_ + k] -= weight;
      g_s_[k] += weight * difference;
      g_s_[m] -= weight * difference;
    }
    for (std::size_t m = 0; m < bundle_.markers.size(); ++m) {
      const double sigma = OffsetSigma(bundle_.markers[m]);
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t i = kLengthCount + kPlace * m + static_cast<std::size_t>(axis);
        diagonal(i) += 1.0 / (sigma * sigma);
        g_s_[i] += bundle_.markers[m].shift_ls[axis] / (sigma * sigma);
      }
      for (std::size_t i = 0; i < kSkinShareCount; ++i) {
        const std::size_t unknown = share_index_[m][i];
        if (unknown == kHeld) continue;
        const double share_sigma = bundle_.markers[m].share_sigma[i];
        const double r = bundle_.markers[m].share[i] / share_sigma;
        // Cauchy: skin that moves with its bone stays so, skin that does not is not held back.
        const double weight = 1.0 / (share_sigma * share_sigma * (1.0 + r * r));
        diagonal(unknown) += weight;
        g_s_[unknown] += weight * bundle_.markers[m].share[i];
      }
    }
  }

  /// The shared unknowns' part of one visible marker.
  void AddShared(std::size_t f, std::size_t m, const BoundMarker& marker,
                 const CarriedMarker& placed, const ModelPose& pose, const Vec3& error,
                 double weight, std::span<const Vec3> pose_column) {
    constexpr std::size_t kMost = kLengthCount + kPlace + kSkinShareCount;
    std::array<Vec3, kMost> column;
    std::array<std::size_t, kMost> index{};
    std::size_t n = 0;
    const Mat3 frame = OffsetJacobian(marker, placed, pose);
    const double child = marker.Share(SkinShare::kWithChild);
    for (const LengthColumn& length : length_columns_[m]) {
      Vec3 sum = frame * length.offset_ls;
      for (std::size_t s = 0; s < length.count; ++s) {
        sum += pose.Rotation(length.shifts[s].joint) * length.shifts[s].per_metre;
      }
      if (child != 0.0) {
        sum += child * (pose.Rotation(marker.joint) * length.child_ls -
                        pose.Rotation(marker.child) * length.child_ls);
      }
      column[n] = sum;
      index[n++] = length.parameter;
    }
    for (int axis = 0; axis < 3; ++axis) {
      column[n] = frame[axis];
      index[n++] = kLengthCount + kPlace * m + static_cast<std::size_t>(axis);
    }
    const std::array<Vec3, kSkinShareCount> by_share = ShareJacobian(marker, placed, pose);
    for (std::size_t i = 0; i < kSkinShareCount; ++i) {
      if (share_index_[m][i] == kHeld) continue;
      column[n] = by_share[i];
      index[n++] = share_index_[m][i];
    }
    const std::span<const std::uint8_t> chain = Chain(marker);
    double* h_fs = h_fs_.data() + f * kPoseDof * shared_;
    for (std::size_t a = 0; a < n; ++a) {
      const Vec3 weighted = weight * column[a];
      g_s_[index[a]] += glm::dot(weighted, error);
      for (std::size_t b = 0; b <= a; ++b) {
        h_ss_[index[a] * shared_ + index[b]] += glm::dot(weighted, column[b]);
      }
      for (std::size_t d = 0; d < chain.size(); ++d) {
        h_fs[chain[d] * shared_ + index[a]] += glm::dot(weighted, pose_column[d]);
      }
    }
  }

  double Linearise() {
    std::fill(h_ss_.begin(), h_ss_.end(), 0.0);
    std::fill(g_s_.begin(), g_s_.end(), 0.0);
    std::fill(h_fs_.begin(), h_fs_.end(), 0.0);
    AddSharedPriors();
    double cost = SharedPriorCost(bundle_);
    const MarkerModel model = ModelOf(bundle_);
    std::array<Vec3, kPoseDof> axis_ws;
    std::array<Vec3, kPoseDof> column;
    for (std::size_t f = 0; f < frames_; ++f) {
      NormalEquations& equations = frame_equations_[f];
      equations.h.fill(0.0);
      equations.g.fill(0.0);
      const Posture& posture = bundle_.postures[f];
      const MarkerFrame& frame = bundle_.frames[f];
      const ModelPose pose = Placed(model.skeleton, posture);
      cost += AddPriors(posture, options_.priors, equations) +
              AddMarkers(model, frame, pose, options_.loss, equations);
      DofAxes(pose, axis_ws);
      for (std::size_t m = 0; m < model.markers.size(); ++m) {
        const BoundMarker& marker = model.markers[m];
        if (!frame.visible[marker.label]) continue;
        const CarriedMarker placed = Carry(marker, pose);
        const Vec3 error = placed.point_ws - frame.position_ws[marker.label];
        MarkerJacobian(marker, placed, pose, axis_ws, column);
        AddShared(f, m, marker, placed, pose, error, options_.loss.Weight(glm::dot(error, error)),
                  column);
      }
    }
    return cost;
  }

  void SolveStep(double damping) {
    schur_ = h_ss_;
    for (std::size_t i = 0; i < shared_; ++i) {
      schur_[i * shared_ + i] *= 1.0 + damping;
      step_s_[i] = -g_s_[i];
    }
    for (std::size_t f = 0; f < frames_; ++f) {
      NormalEquations& factor = factor_[f];
      factor = frame_equations_[f];
      for (std::size_t d = 0; d < kPoseDof; ++d) {
        double& value = factor.h[d * kPoseDof + d];
        value += damping * value + 1e-6;
      }
      CholeskyInPlace(factor.h.data(), kPoseDof, kPoseDof);
      SolveLower(factor.h.data(), kPoseDof, kPoseDof, factor.g.data());
      double* y = coupling_.data() + f * kPoseDof * shared_;
      std::copy_n(h_fs_.data() + f * kPoseDof * shared_, kPoseDof * shared_, y);
      SolveLowerMany(factor.h.data(), kPoseDof, kPoseDof, y, shared_);
      SubtractGram(schur_.data(), shared_, y, kPoseDof, shared_);
      for (std::size_t r = 0; r < kPoseDof; ++r) {
        const double g = factor.g[r];
        for (std::size_t i = 0; i < shared_; ++i) step_s_[i] += y[r * shared_ + i] * g;
      }
    }
    CholeskyInPlace(schur_.data(), shared_, shared_);
    SolveLower(schur_.data(), shared_, shared_, step_s_.data());
    SolveLowerTransposed(schur_.data(), shared_, shared_, step_s_.data());
  }

  Bundle Stepped() const {
    Bundle next = bundle_;
    for (std::size_t k = 0; k < kLengthCount; ++k) next.lengths[k] += step_s_[k];
    for (std::size_t m = 0; m < next.markers.size(); ++m) {
      for (int axis = 0; axis < 3; ++axis) {
        next.markers[m].shift_ls[axis] +=
            step_s_[kLengthCount + kPlace * m + static_cast<std::size_t>(axis)];
      }
      for (std::size_t i = 0; i < kSkinShareCount; ++i) {
        if (share_index_[m][i] != kHeld) next.markers[m].share[i] += step_s_[share_index_[m][i]];
      }
    }
    for (std::size_t f = 0; f < frames_; ++f) {
      std::array<double, kPoseDof> step;
      const double* y = coupling_.data() + f * kPoseDof * shared_;
      for (std::size_t r = 0; r < kPoseDof; ++r) {
        double sum = -factor_[f].g[r];
        for (std::size_t i = 0; i < shared_; ++i) sum -= y[r * shared_ + i] * step_s_[i];
        step[r] = sum;
      }
      SolveLowerTransposed(factor_[f].h.data(), kPoseDof, kPoseDof, step.data());
      double largest = 0.6;  // radians: beyond it the linear model means nothing
      for (std::size_t d = 3; d < kPoseDof; ++d) largest = std::max(largest, std::abs(step[d]));
      for (double& s : step) s *= 0.6 / largest;
      next.postures[f] = Moved(bundle_.postures[f], step);
    }
    return next;
  }

  Bundle& bundle_;
  BundleOptions options_;
  std::vector<ShareIndex> share_index_;
  std::size_t shared_;
  std::size_t frames_;
  std::vector<double> h_ss_;
  std::vector<double> g_s_;
  std::vector<double> schur_;
  std::vector<double> step_s_;
  std::vector<double> h_fs_;
  std::vector<double> coupling_;
  std::vector<NormalEquations> frame_equations_;
  std::vector<NormalEquations> factor_;
  std::vector<std::vector<LengthColumn>> length_columns_;
};

}  // namespace

MarkerModel ModelOf(const Bundle& bundle) {
  MarkerModel model;
  model.skeleton = SkeletonOf(bundle.scale, bundle.lengths);
  model.markers.reserve(bundle.markers.size());
  for (const FittedMarker& marker : bundle.markers) {
    const bool slides = std::any_of(marker.slide.begin(), marker.slide.end(),
                                    [](const Vec3& slide) { return slide != Vec3{0.0}; });
    model.markers.push_back({marker.label, marker.joint, OffsetOf(bundle, marker), marker.child,
                             marker.share, marker.slide, slides});
  }
  return model;
}

double AdjustBundle(Bundle& bundle, const BundleOptions& options) {
  return Adjuster(bundle, options).Run();
}

void Rescale(Bundle& bundle) {
  double length = 0.0;
  double weight = 0.0;
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    const LengthParameter& p = LengthParameters()[k];
    if (!p.sizes_body) continue;
    length += p.template_length * (bundle.scale * p.template_length + bundle.lengths[k]);
    weight += p.template_length * p.template_length;
  }
  const Bundle before = bundle;
  bundle.scale = length / weight;
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    bundle.lengths[k] += (before.scale - bundle.scale) * LengthParameters()[k].template_length;
  }
  for (std::size_t m = 0; m < bundle.markers.size(); ++m) {
    bundle.markers[m].shift_ls +=
        OffsetOf(before, before.markers[m]) - OffsetOf(bundle, bundle.markers[m]);
  }
}

}  // namespace ego
