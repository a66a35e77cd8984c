// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <cstdio>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

std::string Number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

void ShowNotes(const std::vector<std::string>& notes) {
  if (notes.empty()) return;
  Section("Notes");
  for (const std::string& note : notes) Quiet(note);
}

void ShowLengths(const Skeleton& skeleton) {
  Section("Lengths");
  const auto length = [&](HumanoidJoint end) { return 100.0 * BoneLength(skeleton, end); };
  using J = HumanoidJoint;
  Fact("Upper arm", Number("%.1f", length(J::kLeftLowerArm)), "cm");
  Fact("Forearm", Number("%.1f", length(J::kLeftHand)), "cm");
  Fact("Thigh", Number("%.1f", length(J::kLeftLowerLeg)), "cm");
  Fact("Calf", Number("%.1f", length(J::kLeftFoot)), "cm");
}

void ShowTake(const TakeEntry& entry) {
  const LoadedTake& take = entry.take;
  const CapturedMotion& motion = *take.motion;
  Section(take.name.c_str());
  Fact("Frames", std::to_string(motion.poses.size()));
  Fact("Rate", Number("%g", motion.rate_hz), "Hz");
  Fact("Length", Number("%.2f", static_cast<double>(motion.poses.size()) / motion.rate_hz), "s");
  Fact("Performer", Number("%.2f", motion.performer.height), "m");
  if (take.solve) {
    const SolveReport& report = *take.solve;
    Section("Solve");
    Fact("Marker set", report.marker_set);
    Fact("Mean residual", Number("%.1f", report.mean_residual_mm), "mm");
    Fact("95 of 100 below", Number("%.1f", report.p95_residual_mm), "mm");
    Fact("Frames filled", std::to_string(report.frames_without_markers.size()));
    if (ImGui::CollapsingHeader("Markers")) {
      for (const MarkerResidual& marker : report.markers) {
        Fact(marker.label.c_str(), Number("%.1f", marker.mean_mm), "mm");
      }
    }
  }
  ShowLengths(motion.performer.skeleton);
  ShowNotes(take.notes);
}

void ShowCalibration(const LoadedAvatar& avatar) {
  Section("Calibration");
  if (avatar.path.empty()) {
    Quiet("Known exactly: made by the studio.");
    return;
  }
  Quiet(avatar.calibrated_by_file ? "From the file beside the avatar."
                                  : "Proposed by the studio from the mesh.");
  const CalibrationSummary& points = avatar.calibration;
  if (points.picked) Fact("Picked", std::to_string(points.picked));
  Fact("Proposed", std::to_string(points.proposed));
  if (points.doubtful) Fact("Doubtful", std::to_string(points.doubtful));
  if (points.missing) Fact("Missing", std::to_string(points.missing));
}

void ShowJointMap(const Character& character) {
  std::size_t mapped = 0;
  for (const auto& entry : character.map.joint) mapped += entry.node >= 0 ? 1 : 0;
  Section("Joints");
  Fact("Found", std::to_string(mapped) + " of " + std::to_string(kJointCount));
  if (!ImGui::CollapsingHeader("Map")) return;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const HumanoidMap::Entry& entry = character.map.joint[i];
    const std::string joint(Name(static_cast<HumanoidJoint>(i)));
    const bool known =
        entry.node >= 0 && static_cast<std::size_t>(entry.node) < character.nodes.joints.size();
    const std::string node =
        known ? character.nodes.joints[static_cast<std::size_t>(entry.node)].name : "none";
    Fact(joint.c_str(), node);
    if (!entry.reason.empty()) Tip(entry.reason.c_str());
  }
}

void ShowAvatar(Studio& studio, const AvatarEntry& entry) {
  const LoadedAvatar& avatar = entry.avatar;
  const Character& character = *avatar.character;
  Section(avatar.name.c_str());
  if (!avatar.path.empty()) Quiet(avatar.path.filename().string());
  std::size_t triangles = 0;
  for (const MeshPart& part : character.parts) triangles += part.triangles.size() / 3;
  Fact("Height", Number("%.2f", avatar.body->height), "m");
  Fact("Triangles", std::to_string(triangles));
  ShowCalibration(avatar);
  if (ImGui::Button("Calibrate")) studio.Calibrate(entry.id);
  Tip("See and mend its points in the Calibrate workspace (E)");
  ShowJointMap(character);
  ShowLengths(avatar.body->skeleton);
  ShowNotes(avatar.notes);
}

}  // namespace

void ShowInspector(Studio& studio) {
  if (BeginPanel("inspector", studio.layout().inspector, look::kPanel)) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {Px(8.0f), Px(4.0f)});
    if (const AvatarEntry* avatar = studio.selected_avatar()) {
      ShowAvatar(studio, *avatar);
    } else if (const TakeEntry* take = studio.current_take()) {
      ShowTake(*take);
    } else {
      Section("Nothing open");
      Quiet("What is selected is described here.");
    }
    ImGui::PopStyleVar();
  }
  EndPanel();
}

}  // namespace ego
