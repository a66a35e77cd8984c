// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/markers/marker_take.h"
#include "core/solve/body_parameters.h"
#include "core/solve/posture.h"
#include "core/solve/posture_cost.h"

namespace ego {

/// A marker whose place on the body is being estimated.
struct FittedMarker {
  std::size_t label = 0;
  HumanoidJoint joint = HumanoidJoint::kHips;
  Vec3 template_offset{0.0};                   // from the joint, template size
  double along = 0.0;                          // AlongBone of it
  double sigma = 0.02;                         // spread of real placements, template size
  Vec3 shift_ls{0.0};                          // found so far: beyond the scaled template, metres
  HumanoidJoint child = HumanoidJoint::kHips;  // whose bone may draw its skin along; hips: none
  SkinShares share{};                          // found so far
  SkinShares share_sigma{};                    // scale of their prior (Cauchy); 0: held at zero
  SkinSlides slide{};                          // found so far (FitSlides)
};

/// Unknowns of the global fit: lengths and marker places shared by all frames, one posture each.
struct Bundle {
  double scale = 1.0;
  LengthValues lengths{};
  std::vector<FittedMarker> markers;
  std::vector<MarkerFrame> frames;
  std::vector<Posture> postures;  // one per frame
};

struct BundleOptions {
  MarkerLoss loss;
  Priors priors;  // of each posture
  double symmetry_sigma = 0.002;
  double offset_sigma_scale = 1.0;
  bool skin = false;  // whether the markers' skin shares are estimated
  int max_iterations = 10;
};

/// The model that the shared unknowns describe.
MarkerModel ModelOf(const Bundle& bundle);

/// Minimises over all unknowns at once: Levenberg-Marquardt, the postures eliminated frame by frame
/// (Schur complement). Returns the final cost.
double AdjustBundle(Bundle& bundle, const BundleOptions& options);

/// Takes up in `scale` what the lengths have in common; the model stays the same. Afterwards the
/// priors are centred on a body of the right size.
void Rescale(Bundle& bundle);

}  // namespace ego
