// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_file.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/calibration/propose_calibration.h"
#include "assets/files/file_io.h"
#include "core/model/mesh_bvh.h"

namespace ego {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "egostudio avatar calibration";
constexpr int kVersion = 1;
/// More dots on one segment than any person clicks.
constexpr std::size_t kMostDots = 10000;
/// A point carried over to a changed mesh and moved by more than this share of the character's
/// height is doubtful.
constexpr double kFarMove = 0.01;

constexpr std::array<std::string_view, 4> kHandAndFootKeys = {"leftHand", "rightHand", "leftFoot",
                                                              "rightFoot"};

/// Thrown inside this file only, caught at its border.
struct FormatError {
  std::string message;
};

std::string Hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

// ---------------------------------------------------------------------------------------------
// Writing

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

// ---------------------------------------------------------------------------------------------
// Reading

class Reader {
 public:
  Reader(const std::string& name, const Character& character)
      : name_(name), character_(character) {}

  LoadedCalibration Read(const Json& root);

 private:
  [[noreturn]] void Fail(const std::string& where, const std::string& expectation) const {
    throw FormatError{name_ + ": " + where + " " + expectation};
  }
  const Json& Member(const Json& object, const std::string& where, const char* key) const;
  double Number(const Json& json, const std::string& where) const;
  double Fraction(const Json& json, const std::string& where) const;
  Vec3 Triple(const Json& json, const std::string& where) const;
  std::string Text(const Json& json, const std::string& where) const;
  PickState State(const Json& object, const std::string& where) const;
  std::string Reason(const Json& object, const std::string& where) const;
  CalibrationPoint Point(const Json& object, const std::string& where);
  SegmentCalibration Segment(const Json& object, const std::string& where);
  void CarryOver(CalibrationPoint& point, const Vec3& position_ms);
  double OptionalLength(const Json& object, const std::string& where, const char* key) const;

  const std::string& name_;
  const Character& character_;
  bool changed_ = false;  // the mesh is not the one the file was made on
  std::optional<MeshBvh> bvh_;
  double height_ = 0.0;
  std::size_t moved_far_ = 0;
};

const Json& Reader::Member(const Json& object, const std::string& where, const char* key) const {
  if (!object.is_object()) Fail(where, "must be an object");
  const auto found = object.find(key);
  if (found == object.end()) Fail(where, std::string("lacks \"") + key + "\"");
  return *found;
}

double Reader::Number(const Json& json, const std::string& where) const {
  if (!json.is_number()) Fail(where, "must be a number");
  const double value = json.get<double>();
  if (!std::isfinite(value)) Fail(where, "must be a finite number");
  return value;
}

double Reader::Fraction(const Json& json, const std::string& where) const {
  const double value = Number(json, where);
  if (value < 0.0 || value > 1.0) Fail(where, "must lie between 0 and 1");
  return value;
}

Vec3 Reader::Triple(const Json& json, const std::string& where) const {
  if (!json.is_array() || json.size() != 3) Fail(where, "must be a list of three numbers");
  return {Number(json[0], where), Number(json[1], where), Number(json[2], where)};
}

std::string Reader::Text(const Json& json, const std::string& where) const {
  if (!json.is_string()) Fail(where, "must be a text");
  return json.get<std::string>();
}

PickState Reader::State(const Json& object, const std::string& where) const {
  const std::string text = Text(Member(object, where, "state"), where + ".state");
  for (const PickState state :
       {PickState::kMissing, PickState::kProposed, PickState::kDoubtful, PickState::kPicked}) {
    if (text == Name(state)) return state;
  }
  Fail(where + ".state", "must be \"missing\", \"proposed\", \"doubtful\" or \"picked\"");
}

std::string Reader::Reason(const Json& object, const std::string& where) const {
  const auto found = object.find("reason");
  return found == object.end() ? std::string() : Text(*found, where + ".reason");
}

double Reader::OptionalLength(const Json& object, const std::string& where, const char* key) const {
  if (!object.is_object()) Fail(where, "must be an object");
  const auto found = object.find(key);
  if (found == object.end()) return 0.0;
  const double value = Number(*found, where + "." + key);
  if (value < 0.0 || value > 1e4) Fail(where + "." + key, "must be a length in metres");
  return value;
}

void Reader::CarryOver(CalibrationPoint& point, const Vec3& position_ms) {
  if (!bvh_) bvh_.emplace(character_, CanonicalMesh(character_));
  const auto hit = bvh_->Nearest(position_ms);
  if (!hit) {
    point = {};
    point.reason = "the mesh has changed and has no skin";
    return;
  }
  point.place = hit->place;
  if (hit->distance <= kFarMove * height_) return;
  ++moved_far_;
  point.state = PickState::kDoubtful;
  point.confidence = std::min(point.confidence, 0.3);
  point.reason = "the mesh has changed and the point had to move far";
}

CalibrationPoint Reader::Point(const Json& object, const std::string& where) {
  CalibrationPoint point;
  point.state = State(object, where);
  point.reason = Reason(object, where);
  if (point.state == PickState::kMissing) return point;
  point.confidence = Fraction(Member(object, where, "confidence"), where + ".confidence");
  const Json& part = Member(object, where, "part");
  const Json& triangle = Member(object, where, "triangle");
  if (!part.is_number_integer()) Fail(where + ".part", "must be a whole number");
  if (!triangle.is_number_integer()) Fail(where + ".triangle", "must be a whole number");
  const auto part_number = part.get<std::int64_t>();
  const auto triangle_number = triangle.get<std::int64_t>();
  point.place.barycentric = Triple(Member(object, where, "barycentric"), where + ".barycentric");
  const Vec3 position = Triple(Member(object, where, "position"), where + ".position");
  if (changed_) {
    CarryOver(point, position);
    return point;
  }
  if (part_number < 0 || part_number >= static_cast<std::int64_t>(character_.parts.size())) {
    Fail(where + ".part", "names part " + std::to_string(part_number) +
                              " of a character that has " +
                              std::to_string(character_.parts.size()));
  }
  const std::size_t triangles =
      character_.parts[static_cast<std::size_t>(part_number)].triangles.size() / 3;
  if (triangle_number < 0 || triangle_number >= static_cast<std::int64_t>(triangles)) {
    Fail(where + ".triangle", "names triangle " + std::to_string(triangle_number) +
                                  " of a part that has " + std::to_string(triangles));
  }
  point.place.part = static_cast<int>(part_number);
  point.place.triangle = static_cast<std::uint32_t>(triangle_number);
  if (!IsOn(character_, point.place)) {
    Fail(where + ".barycentric", "must be three weights from 0 to 1 whose sum is 1");
  }
  return point;
}

SegmentCalibration Reader::Segment(const Json& object, const std::string& where) {
  SegmentCalibration segment;
  segment.state = State(object, where);
  segment.reason = Reason(object, where);
  segment.radius = OptionalLength(object, where, "radius");
  if (segment.state != PickState::kMissing) {
    segment.confidence = Fraction(Member(object, where, "confidence"), where + ".confidence");
  }
  const Json& dots = Member(object, where, "dots");
  if (!dots.is_array() || dots.size() > kMostDots) {
    Fail(where + ".dots", "must be a list of at most " + std::to_string(kMostDots) + " points");
  }
  for (std::size_t i = 0; i < dots.size(); ++i) {
    segment.dots.push_back(Point(dots[i], where + ".dots[" + std::to_string(i) + "]"));
  }
  return segment;
}

LoadedCalibration Reader::Read(const Json& root) {
  const Json& format = Member(root, "the file", "format");
  if (!format.is_string() || format.get<std::string>() != kFormat) {
    Fail("\"format\"", "must be \"" + std::string(kFormat) + "\"");
  }
  const Json& version = Member(root, "the file", "version");
  if (!version.is_number_integer() || version.get<std::int64_t>() != kVersion) {
    Fail("\"version\"",
         "must be " + std::to_string(kVersion) + ", the only one this program reads");
  }
  const std::string hash = Text(Member(root, "the file", "meshHash"), "\"meshHash\"");
  LoadedCalibration loaded;
  loaded.from_file = true;
  AvatarCalibration& calibration = loaded.calibration;
  calibration.mesh_hash = MeshHash(character_);
  changed_ = hash != Hex(calibration.mesh_hash);
  height_ = CanonicalPositions(character_.rig.skeleton)[Index(HumanoidJoint::kHead)].y;

  const Json& samples = Member(root, "the file", "samples");
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const std::string name(Name(static_cast<SamplePoint>(i)));
    calibration.sample[i] = Point(Member(samples, "\"samples\"", name.c_str()), "samples." + name);
  }
  const Json& segments = Member(root, "the file", "segments");
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const std::string name(Name(static_cast<LimbSegment>(s)));
    calibration.segment[s] =
        Segment(Member(segments, "\"segments\"", name.c_str()), "segments." + name);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string hand_name(kHandAndFootKeys[side]);
    const Json& hand = Member(root, "the file", hand_name.c_str());
    HandCalibration& h = calibration.hand[side];
    h.palm = Point(Member(hand, hand_name, "palm"), hand_name + ".palm");
    h.back_of_hand = Point(Member(hand, hand_name, "backOfHand"), hand_name + ".backOfHand");
    h.fingertip = Point(Member(hand, hand_name, "fingertip"), hand_name + ".fingertip");
    h.half_thickness = OptionalLength(hand, hand_name, "halfThickness");
    const std::string foot_name(kHandAndFootKeys[2 + side]);
    const Json& foot = Member(root, "the file", foot_name.c_str());
    FootCalibration& f = calibration.foot[side];
    f.heel = Point(Member(foot, foot_name, "heel"), foot_name + ".heel");
    f.ball = Point(Member(foot, foot_name, "ball"), foot_name + ".ball");
    f.toe_tip = Point(Member(foot, foot_name, "toeTip"), foot_name + ".toeTip");
  }
  if (changed_) {
    UpdateThickness(character_, calibration);
    std::string warning = name_ + ": the mesh of " + character_.name +
                          " has changed since it was calibrated; the points were carried over to "
                          "the nearest skin";
    if (moved_far_ > 0) warning += ", " + std::to_string(moved_far_) + " of them far";
    loaded.warnings.push_back(warning);
  }
  return loaded;
}

}  // namespace

std::filesystem::path CalibrationPathFor(const std::filesystem::path& avatar) {
  std::filesystem::path path = avatar;
  path += ".calib.json";
  return path;
}

std::string FormatCalibration(const Character& character, const AvatarCalibration& calibration) {
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  Json root;
  root["format"] = kFormat;
  root["version"] = kVersion;
  root["character"] = character.name;
  root["meshHash"] = Hex(calibration.mesh_hash);
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

Result<LoadedCalibration> ParseCalibration(std::string_view json, const std::string& name,
                                           const Character& character) {
  try {
    const Json root = Json::parse(json);
    return Reader(name, character).Read(root);
  } catch (const FormatError& error) {
    return Error{error.message};
  } catch (const nlohmann::json::parse_error& error) {
    return Error{name + ": is no valid JSON at byte " + std::to_string(error.byte)};
  } catch (const std::exception& error) {
    return Error{name + ": cannot be read: " + error.what()};
  }
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
