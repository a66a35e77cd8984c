// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "assets/calibration/skin_probe.h"
#include "assets/mesh/surface_mesh.h"
#include "core/body/body.h"
#include "core/model/avatar_calibration.h"

namespace ego {

/// Below this a point is doubtful: a person should look.
inline constexpr double kDoubtBelow = 0.5;

/// A calibration in the making, with what every step needs to know of the body.
struct ProposalDraft {
  ProposalDraft(const Character& character, const SkinProbe& skin);

  const SkinProbe& probe;
  Body template_body;  // the template on this skeleton: what is tried first and believed last
  AvatarCalibration calibration;

  // Measures of the skeleton, metres.
  double hip_height = 0.0;
  double shoulder_height = 0.0;
  double trunk_length = 0.0;         // hip joints to shoulder joints
  double shoulder_half_width = 0.0;  // of the joints
  double hip_half_width = 0.0;
  double middle_x = 0.0;

  /// The skin's connectivity, made when it is first asked for.
  const SurfaceMesh& Surface() {
    if (!surface_) surface_.emplace(probe.TheCharacter());
    return *surface_;
  }

  /// Layers closer to each other than this are one body.
  double Gap() const { return 0.06 * trunk_length; }

  const Vec3& TemplateAt(SamplePoint p) const { return template_body.surface.sample_ms[Index(p)]; }
  Vec3 At(SamplePoint p) const;

  /// Enters a place; the state follows the confidence.
  static void Put(CalibrationPoint& point, const SkinHit& hit, double confidence,
                  std::string reason);
  /// Enters the skin of `region` nearest to `wanted`, or of the whole character where that has
  /// none, with little confidence.
  void PutNearest(CalibrationPoint& point, SkinRegion region, const Vec3& wanted,
                  std::string reason) const;

 private:
  std::optional<SurfaceMesh> surface_;
};

/// The steps of a proposal, in order. Each fills its part of the draft.
void ProposeTrunk(ProposalDraft& draft);
void ProposeHead(ProposalDraft& draft);
void ProposeSegments(ProposalDraft& draft);
void ProposeHands(ProposalDraft& draft);
void ProposeFeet(ProposalDraft& draft);
/// Lets each side speak for the other where one has failed, and lowers the confidence of pairs
/// that disagree.
void ReconcileSides(ProposalDraft& draft);
/// Lowers the confidence of points that lie away from where the others of their mesh, and the
/// ground, say that they are.
void JudgeAgainstOthers(ProposalDraft& draft);
/// Moves points whose crude triangles face inward or have collapsed until the meshes are sound.
void MendTriangles(ProposalDraft& draft);
/// Makes confidences comparable between points: places that proportions alone define are never as
/// sure as those that the skin shows.
void TemperConfidence(ProposalDraft& draft);

}  // namespace ego
