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

/// For each joint and length, the change of a point carried by the joint (its own bone's far end
/// counted by `along`) per metre: a list of (joint whose parent frame turns it, direction).
struct LengthColumn {
  std::size_t parameter = 0;
  std::array<LengthParameter::Shift, 6> shifts{};  // joint: the frame that carries the shift
  std::size_t count = 0;
};

std::vector<LengthColumn> LengthColumns(HumanoidJoint joint, double along) {
  std::array<bool, kJointCount> on_path{};
  for (std::size_t j = Index(joint); j != 0; j = Index(kParent[j])) on_path[j] = true;
  const HumanoidJoint end = BoneEnd(joint);
  std::vector<LengthColumn> columns;
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    const LengthParameter& p = LengthParameters()[k];
    LengthColumn column;
    column.parameter = k;
    for (std::size_t s = 0; s < p.shift_count; ++s) {
      const HumanoidJoint moved = p.shifts[s].joint;
      if (on_path[Index(moved)]) {
        column.shifts[column.count++] = {Parent(moved), p.shifts[s].per_metre};
      } else if (end != joint && moved == end && along > 0.0) {
        column.shifts[column.count++] = {joint, along * p.shifts[s].per_metre};
      }
    }
    if (column.count > 0) columns.push_back(column);
  }
  return columns;
}

class Adjuster {
 public:
  Adjuster(Bundle& bundle, const BundleOptions& options)
      : bundle_(bundle),
        options_(options),
        shared_(kLengthCount + 3 * bundle.markers.size()),
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
      length_columns_.push_back(LengthColumns(marker.joint, marker.along));
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
        const std::size_t i = kLengthCount + 3 * m + static_cast<std::size_t>(axis);
        diagonal(i) += 1.0 / (sigma * sigma);
        g_s_[i] += bundle_.markers[m].shift_ls[axis] / (sigma * sigma);
      }
    }
  }

  /// The shared unknowns' part of one visible marker.
  void AddShared(std::size_t f, std::size_t m, const ModelPose& pose, const Vec3& error,
                 double weight, std::span<const Vec3> pose_column) {
    std::array<Vec3, kLengthCount + 3> column;
    std::array<std::size_t, kLengthCount + 3> index{};
    std::size_t n = 0;
    for (const LengthColumn& length : length_columns_[m]) {
      Vec3 sum{0.0};
      for (std::size_t s = 0; s < length.count; ++s) {
        sum += pose.Rotation(length.shifts[s].joint) * length.shifts[s].per_metre;
      }
      column[n] = sum;
      index[n++] = length.parameter;
    }
    const Mat3 frame = glm::mat3_cast(pose.Rotation(bundle_.markers[m].joint));
    for (int axis = 0; axis < 3; ++axis) {
      column[n] = frame[axis];
      index[n++] = kLengthCount + 3 * m + static_cast<std::size_t>(axis);
    }
    const std::span<const std::uint8_t> chain = Chain(bundle_.markers[m].joint);
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
        const Vec3 point =
            pose.Position(marker.joint) + pose.Rotation(marker.joint) * marker.offset_ls;
        const Vec3 error = point - frame.position_ws[marker.label];
        PointJacobian(marker.joint, point, pose, axis_ws, column);
        AddShared(f, m, pose, error, options_.loss.Weight(glm::dot(error, error)), column);
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
            step_s_[kLengthCount + 3 * m + static_cast<std::size_t>(axis)];
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
    model.markers.push_back({marker.label, marker.joint, OffsetOf(bundle, marker)});
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
