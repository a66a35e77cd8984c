// SPDX-License-Identifier: MIT
#include "assets/calibration/propose_calibration.h"

#include "assets/calibration/proposal_draft.h"
#include "assets/calibration/skin_probe.h"

namespace ego {

Result<AvatarCalibration> ProposeCalibration(const Character& character, const Progress& progress) {
  const Error cancelled{"cancelled"};
  if (!Report(progress, 0.0, "looking at the skin")) return cancelled;
  const SkinProbe probe(character);
  if (probe.Empty()) {
    return Error{character.name + ": the character has no triangles to calibrate"};
  }
  ProposalDraft draft(character, probe);
  if (!Report(progress, 0.4, "placing points on the trunk")) return cancelled;
  ProposeTrunk(draft);
  if (!Report(progress, 0.6, "placing points on the head")) return cancelled;
  ProposeHead(draft);
  if (!Report(progress, 0.8, "measuring limbs, hands and feet")) return cancelled;
  ProposeSegments(draft);
  ProposeHands(draft);
  ProposeFeet(draft);
  ReconcileSides(draft);
  JudgeAgainstOthers(draft);
  MendTriangles(draft);
  TemperConfidence(draft);
  UpdateThickness(character, draft.calibration);
  if (!Report(progress, 1.0, "calibration proposed")) return cancelled;
  return draft.calibration;
}

}  // namespace ego
