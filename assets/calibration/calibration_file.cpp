// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_file.h"

#include <cstdio>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/calibration/calibration_format.h"
#include "assets/calibration/propose_calibration.h"
#include "assets/files/file_io.h"

namespace ego {
namespace {

using Json = nlohmann::ordered_json;

Json PointToJson(const Character& character, std::span<const Mat4> skin,
                 const CalibrationPoint& point) {
  Json json;
  json["state"] = Name(point.state);
  if (point.state == PickState::kMissing || !IsOn(character, point.place)) {
    json["state"] = Name(PickState::kMissing);
    if (!point.reason.empty()) json["reason"] = point.reason;
    return json;
  }
  json["confidence"] = point.confidence;
  if (!point.reason.empty()) json["reason"] = point.reason;
  const MeshPoint& place = point.place;
  json["part"] = place.part;
  json["partName"] = character.parts[static_cast<std::size_t>(place.part)].name;
  json["triangle"] = place.triangle;
  json["barycentric"] = {place.barycentric.x, place.barycentric.y, place.barycentric.z};
  const Vec3 p = PosePoint(character, skin, place);
  json["position"] = {p.x, p.y, p.z};
  return json;
}

Json JointsToJson(const Character& character, const JointOverrides& overrides) {
  Json json = Json::object();
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (!overrides[j]) continue;
    Json& entry = json[std::string(Name(static_cast<HumanoidJoint>(j)))];
    entry["node"] = nullptr;
    if (*overrides[j] < 0) continue;
    const auto node = static_cast<std::size_t>(*overrides[j]);
    entry["node"] = node;
    if (node < character.nodes.joints.size()) entry["name"] = character.nodes.joints[node].name;
  }
  return json;
}

}  // namespace

std::string HashText(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

std::filesystem::path CalibrationPathFor(const std::filesystem::path& avatar) {
  std::filesystem::path path = avatar;
  path += ".calib.json";
  return path;
}

std::string FormatCalibration(const Character& character, const AvatarCalibration& calibration) {
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  Json root;
  root["format"] = kCalibrationFormat;
  root["version"] = kCalibrationVersion;
  root["character"] = character.name;
  root["meshHash"] = HashText(calibration.mesh_hash);
  root["joints"] = JointsToJson(character, calibration.joint_override);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    root["samples"][std::string(Name(static_cast<SamplePoint>(i)))] =
        PointToJson(character, skin, calibration.sample[i]);
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const SegmentCalibration& segment = calibration.segment[s];
    Json json;
    json["state"] = Name(segment.state);
    if (segment.state != PickState::kMissing) json["confidence"] = segment.confidence;
    if (!segment.reason.empty()) json["reason"] = segment.reason;
    json["radius"] = segment.radius;
    json["dots"] = Json::array();
    for (const CalibrationPoint& dot : segment.dots) {
      json["dots"].push_back(PointToJson(character, skin, dot));
    }
    root["segments"][std::string(Name(static_cast<LimbSegment>(s)))] = std::move(json);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const HandCalibration& hand = calibration.hand[side];
    root[std::string(kHandAndFootKeys[side])] = {
        {"palm", PointToJson(character, skin, hand.palm)},
        {"backOfHand", PointToJson(character, skin, hand.back_of_hand)},
        {"fingertip", PointToJson(character, skin, hand.fingertip)},
        {"halfThickness", hand.half_thickness}};
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const FootCalibration& foot = calibration.foot[side];
    root[std::string(kHandAndFootKeys[2 + side])] = {
        {"heel", PointToJson(character, skin, foot.heel)},
        {"ball", PointToJson(character, skin, foot.ball)},
        {"toeTip", PointToJson(character, skin, foot.toe_tip)}};
  }
  // Names come from files and may hold anything; bytes that are no UTF-8 are replaced.
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<LoadedCalibration> ReadCalibration(const std::filesystem::path& path,
                                          const Character& character) {
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  return ParseCalibration(*text, path.string(), character);
}

Result<void> WriteCalibration(const std::filesystem::path& path, const Character& character,
                              const AvatarCalibration& calibration) {
  return WriteFileAtomically(path, FormatCalibration(character, calibration));
}

Result<LoadedCalibration> LoadOrProposeCalibration(const Character& character,
                                                   const Progress& progress) {
  std::vector<std::string> warnings;
  if (!character.source_path.empty()) {
    const std::filesystem::path path = CalibrationPathFor(character.source_path);
    std::error_code code;
    if (std::filesystem::exists(path, code)) {
      Result<LoadedCalibration> loaded = ReadCalibration(path, character);
      if (loaded) return loaded;
      warnings.push_back(loaded.error() + "; a proposal is used instead");
    }
  }
  Result<AvatarCalibration> proposal = ProposeCalibration(character, progress);
  if (!proposal) return Error{proposal.error()};
  return LoadedCalibration{*std::move(proposal), std::move(warnings), false};
}

}  // namespace ego
