// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_report.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "assets/calibration/calibration_format.h"
#include "assets/calibration/test_postures.h"
#include "core/model/avatar_body.h"

namespace ego {
namespace {

using Json = nlohmann::ordered_json;

// A tenth of a millimetre is all that anybody can use.
double Rounded(double value) { return std::round(value * 1e4) / 1e4; }
Json Triple(const Vec3& p) { return {Rounded(p.x), Rounded(p.y), Rounded(p.z)}; }

Json PointFacts(const CalibrationDocument& document, std::span<const Mat4> skin, PointId id) {
  const CalibrationPoint& point = *Find(document.calibration, id);
  Json json = {{"name", Name(id)},
               {"title", Title(id)},
               {"state", Name(point.state)},
               {"confidence", Rounded(point.confidence)}};
  if (!point.reason.empty()) json["reason"] = point.reason;
  if (point.state != PickState::kMissing && IsOn(*document.character, point.place)) {
    json["position"] = Triple(PosePoint(*document.character, skin, point.place));
  }
  return json;
}

Json FindingFacts(const CalibrationFinding& finding) {
  Json json = {{"severity", Name(finding.severity)},
               {"kind", Name(finding.kind)},
               {"sentence", finding.sentence}};
  for (const PointId id : finding.points) json["points"].push_back(Name(id));
  if (finding.segment) json["segment"] = Name(*finding.segment);
  if (finding.joint) json["joint"] = Name(*finding.joint);
  json["position"] = Triple(finding.position_ms);
  return json;
}

}  // namespace

std::string FormatCalibrationReport(const CalibrationDocument& document,
                                    const std::vector<CalibrationFinding>& findings) {
  const Character& character = *document.character;
  const AvatarCalibration& calibration = document.calibration;
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  const Body body = MakeAvatarBody(character, calibration);
  const CalibrationSummary summary = Summarize(calibration);
  Json root;
  root["avatar"] = document.avatar.string();
  root["character"] = character.name;
  root["meshHash"] = HashText(calibration.mesh_hash);
  root["height"] = Rounded(body.height);
  root["aPersonShouldLook"] = NeedsAPerson(findings);
  root["summary"] = {{"picked", summary.picked},
                     {"proposed", summary.proposed},
                     {"doubtful", summary.doubtful},
                     {"missing", summary.missing},
                     {"lowestConfidence", Rounded(summary.lowest_confidence)}};
  root["findings"] = Json::array();
  for (const CalibrationFinding& finding : findings) {
    root["findings"].push_back(FindingFacts(finding));
  }
  for (const PointId id : PickOrder()) root["points"].push_back(PointFacts(document, skin, id));
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const SegmentCalibration& segment = calibration.segment[s];
    Json json = {{"name", Name(static_cast<LimbSegment>(s))},
                 {"state", Name(segment.state)},
                 {"confidence", Rounded(segment.confidence)},
                 {"radius", Rounded(segment.radius)},
                 {"dots", segment.dots.size()}};
    if (!segment.reason.empty()) json["reason"] = segment.reason;
    root["segments"].push_back(std::move(json));
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const HumanoidMap::Entry& entry = character.map.joint[j];
    Json json = {{"name", Name(static_cast<HumanoidJoint>(j))}, {"node", nullptr}};
    if (entry.node >= 0) {
      json["node"] = character.nodes.joints[static_cast<std::size_t>(entry.node)].name;
    }
    json["confidence"] = Rounded(entry.confidence);
    json["reason"] = entry.reason;
    root["joints"].push_back(std::move(json));
  }
  TestPostures postures;
  for (std::size_t i = 0; i < kTestPostureCount; ++i) {
    const auto posture = static_cast<TestPosture>(i);
    root["testPostures"].push_back(
        {{"title", Title(posture)},
         {"contactGap", Rounded(postures.Apply(body, posture, 1.0).contact_gap)}});
  }
  root["notes"] = document.warnings;
  // Names come from files and may hold anything.
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ego
