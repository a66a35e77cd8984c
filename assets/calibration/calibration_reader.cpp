// SPDX-License-Identifier: MIT
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/calibration/calibration_file.h"
#include "assets/calibration/calibration_format.h"
#include "core/model/mesh_bvh.h"

namespace ego {
namespace {

using Json = nlohmann::ordered_json;

/// More dots on one segment than any person clicks.
constexpr std::size_t kMostDots = 10000;
/// A point carried over to a changed mesh and moved by more than this share of the character's
/// height is doubtful.
constexpr double kFarMove = 0.01;

/// Thrown inside this file only, caught at its border.
struct FormatError {
  std::string message;
};

class Reader {
 public:
  Reader(const std::string& name, const Character& character)
      : name_(name), character_(character) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

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
  JointOverrides Joints(const Json& root);
  void CarryOver(CalibrationPoint& point, const Vec3& position_ms);
  double OptionalLength(const Json& object, const std::string& where, const char* key) const;

  const std::string& name_;
  const Character& character_;
  std::optional<Character> mended_;  // where the file mends the joint map
  std::vector<std::string> warnings_;
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
  for (const PickState state : {PickState::kMissing, PickState::kProposed, PickState::kDoubtful,
                                PickState::kPicked, PickState::kConfirmed}) {
    if (text == Name(state)) return state;
  }
  Fail(where + ".state",
       "must be \"missing\", \"proposed\", \"doubtful\", \"picked\" or \"confirmed\"");
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
  const Character& character = mended_ ? *mended_ : character_;
  if (!bvh_) bvh_.emplace(character, CanonicalMesh(character));
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

JointOverrides Reader::Joints(const Json& root) {
  JointOverrides overrides;
  const auto joints = root.find("joints");
  if (joints == root.end()) return overrides;  // version 1
  if (!joints->is_object()) Fail("\"joints\"", "must be an object");
  const std::vector<JointTree::Joint>& nodes = character_.nodes.joints;
  bool any = false;
  for (const auto& [key, entry] : joints->items()) {
    const std::string where = "joints." + key;
    const auto joint = JointNamed(key);
    if (!joint) Fail(where, "is no joint of a humanoid");
    const Json& number = Member(entry, where, "node");
    if (!number.is_null() && !number.is_number_unsigned()) {
      Fail(where + ".node", "must be a whole number or null");
    }
    std::optional<int>& node = overrides[Index(*joint)];
    any = true;
    if (number.is_null()) {
      node = -1;
      continue;
    }
    // The name counts: numbers move when a character is exported again.
    const auto at = number.get<std::uint64_t>();
    const auto named = entry.find("name");
    const std::string name = named == entry.end() ? std::string() : Text(*named, where + ".name");
    if (at < nodes.size() && (name.empty() || nodes[at].name == name)) {
      node = static_cast<int>(at);
      continue;
    }
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (nodes[n].name == name && !node) node = static_cast<int>(n);
    }
    if (!node) {
      warnings_.push_back(name_ + ": the character has no node '" + name + "' any more for " + key +
                          "; the studio's own choice stands in");
    }
  }
  if (!any) return overrides;
  Result<Character> mended = WithJointOverrides(character_, overrides);
  if (mended) {
    mended_ = *std::move(mended);
    return overrides;
  }
  warnings_.push_back(name_ + ": its joint map does not fit the character (" + mended.error() +
                      "); the studio's own map stands in");
  return {};
}

LoadedCalibration Reader::Read(const Json& root) {
  const Json& format = Member(root, "the file", "format");
  if (!format.is_string() || format.get<std::string>() != kCalibrationFormat) {
    Fail("\"format\"", "must be \"" + std::string(kCalibrationFormat) + "\"");
  }
  const Json& version = Member(root, "the file", "version");
  if (!version.is_number_integer() || version.get<std::int64_t>() < 1 ||
      version.get<std::int64_t>() > kCalibrationVersion) {
    Fail("\"version\"", "must be at most " + std::to_string(kCalibrationVersion) +
                            ", the newest one this program reads");
  }
  const std::string hash = Text(Member(root, "the file", "meshHash"), "\"meshHash\"");
  LoadedCalibration loaded;
  loaded.from_file = true;
  AvatarCalibration& calibration = loaded.calibration;
  calibration.mesh_hash = MeshHash(character_);
  changed_ = hash != HashText(calibration.mesh_hash);
  calibration.joint_override = Joints(root);
  const Character& character = mended_ ? *mended_ : character_;
  height_ = CanonicalPositions(character.rig.skeleton)[Index(HumanoidJoint::kHead)].y;

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
    UpdateThickness(character, calibration);
    std::string warning = name_ + ": the mesh of " + character_.name +
                          " has changed since it was calibrated; the points were carried over to "
                          "the nearest skin";
    if (moved_far_ > 0) warning += ", " + std::to_string(moved_far_) + " of them far";
    warnings_.push_back(warning);
  }
  loaded.warnings = std::move(warnings_);
  return loaded;
}

}  // namespace

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

}  // namespace ego
