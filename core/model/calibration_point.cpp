// SPDX-License-Identifier: MIT
#include "core/model/calibration_point.h"

#include <array>
#include <charconv>

namespace ego {
namespace {

using S = SamplePoint;
using Kind = PointId::Kind;

constexpr PointId Side(Kind kind, std::uint8_t side) { return {kind, side, 0}; }

constexpr std::array<PointId, kSampleCount + 12> kPickOrder = {{
    // trunk, front, from the top
    PointId::Of(S::kCollarNotch),
    PointId::Of(S::kLeftShoulderTop),
    PointId::Of(S::kRightShoulderTop),
    PointId::Of(S::kLeftChest),
    PointId::Of(S::kRightChest),
    PointId::Of(S::kSternumBase),
    PointId::Of(S::kNavel),
    PointId::Of(S::kLeftBellySide),
    PointId::Of(S::kRightBellySide),
    PointId::Of(S::kPubis),
    // sides
    PointId::Of(S::kLeftRibs),
    PointId::Of(S::kRightRibs),
    PointId::Of(S::kLeftWaistSide),
    PointId::Of(S::kRightWaistSide),
    PointId::Of(S::kLeftHipSide),
    PointId::Of(S::kRightHipSide),
    // back
    PointId::Of(S::kNapeBase),
    PointId::Of(S::kLeftShoulderBlade),
    PointId::Of(S::kRightShoulderBlade),
    PointId::Of(S::kMidBack),
    PointId::Of(S::kLowerBack),
    PointId::Of(S::kSacrum),
    // head
    PointId::Of(S::kCrown),
    PointId::Of(S::kForehead),
    PointId::Of(S::kNoseTip),
    PointId::Of(S::kLeftCheek),
    PointId::Of(S::kRightCheek),
    PointId::Of(S::kChin),
    PointId::Of(S::kThroat),
    PointId::Of(S::kLeftEar),
    PointId::Of(S::kRightEar),
    PointId::Of(S::kBackOfHead),
    // hands and feet
    Side(Kind::kPalm, 0),
    Side(Kind::kPalm, 1),
    Side(Kind::kBackOfHand, 0),
    Side(Kind::kBackOfHand, 1),
    Side(Kind::kFingertip, 0),
    Side(Kind::kFingertip, 1),
    Side(Kind::kHeel, 0),
    Side(Kind::kHeel, 1),
    Side(Kind::kBall, 0),
    Side(Kind::kBall, 1),
    Side(Kind::kToeTip, 0),
    Side(Kind::kToeTip, 1),
}};

struct Words {
  std::string_view title;
  std::string_view place;
};

/// By SamplePoint. "%" stands for the side.
constexpr std::array<Words, kSampleCount> kSampleWords = {{
    {"Collar notch", "the hollow between the collar bones, front of the neck's base"},
    {"Base of the breast bone", "where the ribs part, front of the trunk in the middle"},
    {"Navel", "the belly button, front of the trunk"},
    {"Pubis", "front of the pelvis, just above where the legs part"},
    {"Nape", "the bump where the neck meets the back"},
    {"Mid back", "on the spine, at the height of the lowest ribs"},
    {"Lower back", "on the spine, at the height of the navel"},
    {"Sacrum", "back of the pelvis in the middle, above the cleft"},
    {"% chest", "the % nipple, front of the trunk"},
    {"% chest", "the % nipple, front of the trunk"},
    {"% belly", "front of the belly, half-way from the navel to the % side"},
    {"% belly", "front of the belly, half-way from the navel to the % side"},
    {"% shoulder", "top of the % shoulder, half-way from the neck to its end"},
    {"% shoulder", "top of the % shoulder, half-way from the neck to its end"},
    {"% shoulder blade", "back of the trunk, middle of the % shoulder blade"},
    {"% shoulder blade", "back of the trunk, middle of the % shoulder blade"},
    {"% ribs", "% side of the trunk, a hand below the armpit"},
    {"% ribs", "% side of the trunk, a hand below the armpit"},
    {"% waist", "% side of the trunk, where the waist is narrowest"},
    {"% waist", "% side of the trunk, where the waist is narrowest"},
    {"% hip", "% side of the pelvis, where it is widest"},
    {"% hip", "% side of the pelvis, where it is widest"},
    {"Forehead", "middle of the forehead"},
    {"Crown", "top of the head, hair included"},
    {"Back of the head", "where the head reaches farthest back"},
    {"Nose", "tip of the nose"},
    {"Chin", "tip of the chin"},
    {"Throat", "under the chin, where the throat begins"},
    {"% ear", "opening of the % ear"},
    {"% ear", "opening of the % ear"},
    {"% cheek", "the % cheek bone, below the eye"},
    {"% cheek", "the % cheek bone, below the eye"},
}};

/// By kind, from kPalm on.
constexpr std::array<Words, 6> kExtremityWords = {{
    {"% palm", "middle of the % palm"},
    {"Back of the % hand", "opposite the middle of the % palm"},
    {"% fingertip", "tip of the % middle finger, palm side"},
    {"% heel", "lowest point of the % heel"},
    {"% ball of the foot", "lowest point under the ball of the % foot"},
    {"% toe tip", "front end of the % foot"},
}};
constexpr std::array<std::string_view, 6> kExtremityNames = {"Palm", "BackOfHand", "Fingertip",
                                                             "Heel", "Ball",       "ToeTip"};

constexpr std::array<std::string_view, kSegmentCount> kSegmentTitles = {
    "Left upper arm", "Left forearm", "Right upper arm", "Right forearm",
    "Left thigh",     "Left calf",    "Right thigh",     "Right calf"};

std::size_t ExtremityIndex(Kind kind) {
  return static_cast<std::size_t>(kind) - static_cast<std::size_t>(Kind::kPalm);
}

const Words& WordsOf(PointId id) {
  return id.kind == Kind::kSample ? kSampleWords[id.owner]
                                  : kExtremityWords[ExtremityIndex(id.kind)];
}

bool OnTheLeft(PointId id) {
  // Of a pair of samples the left one comes first, at an even index.
  return id.kind == Kind::kSample ? id.owner % 2 == 0 : id.owner == 0;
}

std::string WithSide(std::string_view words, bool left) {
  std::string out;
  for (const char c : words) {
    if (c != '%') {
      out += c;
    } else if (out.empty()) {
      out += left ? "Left" : "Right";
    } else {
      out += left ? "left" : "right";
    }
  }
  return out;
}

template <class Calibration>
auto FindIn(Calibration& calibration, PointId id) -> decltype(&calibration.sample[0]) {
  switch (id.kind) {
    case Kind::kSample:
      return id.owner < kSampleCount ? &calibration.sample[id.owner] : nullptr;
    case Kind::kDot: {
      if (id.owner >= kSegmentCount) return nullptr;
      auto& dots = calibration.segment[id.owner].dots;
      return id.dot < dots.size() ? &dots[id.dot] : nullptr;
    }
    default:
      break;
  }
  if (id.owner > 1) return nullptr;
  auto& hand = calibration.hand[id.owner];
  auto& foot = calibration.foot[id.owner];
  switch (id.kind) {
    case Kind::kPalm:
      return &hand.palm;
    case Kind::kBackOfHand:
      return &hand.back_of_hand;
    case Kind::kFingertip:
      return &hand.fingertip;
    case Kind::kHeel:
      return &foot.heel;
    case Kind::kBall:
      return &foot.ball;
    default:
      return &foot.toe_tip;
  }
}

}  // namespace

std::span<const PointId> PickOrder() { return kPickOrder; }

CalibrationPoint* Find(AvatarCalibration& calibration, PointId id) {
  return FindIn(calibration, id);
}
const CalibrationPoint* Find(const AvatarCalibration& calibration, PointId id) {
  return FindIn(calibration, id);
}

std::string Name(PointId id) {
  if (id.kind == Kind::kSample) return std::string(Name(static_cast<S>(id.owner)));
  if (id.kind == Kind::kDot) {
    return std::string(Name(static_cast<LimbSegment>(id.owner))) + "[" + std::to_string(id.dot) +
           "]";
  }
  return std::string(id.owner == 0 ? "left" : "right") +
         std::string(kExtremityNames[ExtremityIndex(id.kind)]);
}

std::optional<PointId> PointNamed(std::string_view name) {
  for (const PointId id : kPickOrder) {
    if (Name(id) == name) return id;
  }
  const std::size_t open = name.find('[');
  if (open == std::string_view::npos || name.back() != ']') return std::nullopt;
  const std::string_view digits = name.substr(open + 1, name.size() - open - 2);
  std::uint16_t dot = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), dot);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    if (Name(segment) == name.substr(0, open)) return PointId::Of(segment, dot);
  }
  return std::nullopt;
}

std::string Title(LimbSegment segment) { return std::string(kSegmentTitles[Index(segment)]); }

std::string Title(PointId id) {
  if (id.IsDot()) {
    return Title(static_cast<LimbSegment>(id.owner)) + ", dot " + std::to_string(id.dot + 1);
  }
  return WithSide(WordsOf(id).title, OnTheLeft(id));
}

std::string Place(PointId id) {
  if (id.IsDot()) return "on the skin around the " + Title(static_cast<LimbSegment>(id.owner));
  // A phrase begins small, also where the side is its first word.
  std::string place = WithSide(WordsOf(id).place, OnTheLeft(id));
  if (place[0] == 'L') place[0] = 'l';
  if (place[0] == 'R') place[0] = 'r';
  return place;
}

PointId Mirror(PointId id) {
  PointId other = id;
  if (id.kind == Kind::kSample) {
    other.owner = static_cast<std::uint8_t>(Mirror(static_cast<S>(id.owner)));
  } else if (id.IsDot()) {
    other.owner = static_cast<std::uint8_t>(Mirror(static_cast<LimbSegment>(id.owner)));
  } else {
    other.owner ^= 1u;
  }
  return other;
}

}  // namespace ego
