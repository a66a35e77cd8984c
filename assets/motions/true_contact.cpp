// SPDX-License-Identifier: MIT
#include "assets/motions/true_contact.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "assets/motions/keyed_curve.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr std::array<std::string_view, 7> kFaceNames = {
    "palm", "fingertips", "back of the hand", "thumb side", "sole", "instep", "outer edge"};

std::string PartName(J joint) {
  switch (joint) {
    case J::kChest:
      return "trunk";
    case J::kHead:
      return "head";
    default:
      break;
  }
  const bool left = Mirror(joint) > joint;
  switch (left ? joint : Mirror(joint)) {
    case J::kLeftUpperArm:
      return left ? "left upper arm" : "right upper arm";
    case J::kLeftLowerArm:
      return left ? "left forearm" : "right forearm";
    case J::kLeftHand:
      return left ? "left hand" : "right hand";
    case J::kLeftUpperLeg:
      return left ? "left thigh" : "right thigh";
    case J::kLeftLowerLeg:
      return left ? "left calf" : "right calf";
    default:
      return left ? "left foot" : "right foot";
  }
}

/// "left belly side" of "leftBellySide".
std::string SpacedName(SamplePoint sample) {
  std::string spaced;
  for (const char c : Name(sample)) {
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital) spaced += ' ';
    spaced += capital ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return spaced;
}

}  // namespace

std::string TrueContact::Sentence() const {
  const bool sampled = !places.empty() && places.front().place.part == BodyPart::kSample;
  return std::string(side == 0 ? "left " : "right ") +
         std::string(kFaceNames[static_cast<std::size_t>(face)]) + " on the " +
         (plate_ws  ? "plate"
          : sampled ? SpacedName(places.front().place.sample)
                    : PartName(on));
}

bool TrueContact::Slides() const {
  return std::any_of(places.begin(), places.end(),
                     [&](const Instant& i) { return !(i.place == places.front().place); });
}

BodyPlace PlaceAt(const TrueContact& contact, double time) {
  const auto& places = contact.places;
  std::size_t k = 0;
  while (k + 2 < places.size() && time >= places[k + 1].time) ++k;
  const std::array<std::size_t, 4> index = {
      k > 0 ? k - 1 : k, k, std::min(k + 1, places.size() - 1), std::min(k + 2, places.size() - 1)};
  KeyedCurve curve;
  std::array<std::array<double, 4>, 4> values;
  for (std::size_t i = 0; i < 4; ++i) {
    const BodyPlace& place = places[index[i]].place;
    curve.time[i] = places[index[i]].time;
    values[i] = {place.along, place.toward.x, place.toward.y, place.toward.z};
  }
  curve.now = std::clamp(time, curve.time[1], curve.time[2]);
  const std::array<double, 4> now = curve.At(values);
  BodyPlace place = places[k].place;
  place.along = now[0];
  place.toward = {now[1], now[2], now[3]};
  return place;
}

}  // namespace ego
