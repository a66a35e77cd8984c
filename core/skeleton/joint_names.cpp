// SPDX-License-Identifier: MIT
#include "core/skeleton/joint_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

namespace ego {
namespace {

bool IsLower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool IsUpper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool IsAlpha(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
char ToLower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// "mixamorig:LeftForeArm_2" -> left, fore, arm.
std::vector<std::string> Words(std::string_view name) {
  if (const std::size_t cut = name.find_last_of(":|"); cut != std::string_view::npos) {
    if (cut + 1 < name.size()) name.remove_prefix(cut + 1);
  }
  std::vector<std::string> words;
  std::string word;
  const auto flush = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!IsAlpha(c)) {
      flush();
      continue;
    }
    const bool hump = IsUpper(c) && i > 0 && IsLower(name[i - 1]);
    const bool run_ends =
        IsUpper(c) && i > 0 && IsUpper(name[i - 1]) && i + 1 < name.size() && IsLower(name[i + 1]);
    if (hump || run_ends) flush();
    word.push_back(ToLower(c));
  }
  flush();
  return words;
}

struct Keyword {
  std::string_view text;
  NameRole role;
};

/// Found anywhere in the joined words; the first hit counts, so longer and rarer words come first.
constexpr std::array kKeywords = std::to_array<Keyword>({
    {"forehead", NameRole::kIgnored},
    {"headtop", NameRole::kIgnored},
    {"twist", NameRole::kIgnored},
    {"roll", NameRole::kIgnored},
    {"pole", NameRole::kIgnored},
    {"target", NameRole::kIgnored},
    {"control", NameRole::kIgnored},
    {"ctrl", NameRole::kIgnored},
    {"helper", NameRole::kIgnored},
    {"slot", NameRole::kIgnored},
    {"socket", NameRole::kIgnored},
    {"attach", NameRole::kIgnored},
    {"weapon", NameRole::kIgnored},
    {"prop", NameRole::kIgnored},
    {"holder", NameRole::kIgnored},
    {"brow", NameRole::kIgnored},
    {"eyelid", NameRole::kIgnored},
    {"cheek", NameRole::kIgnored},
    {"tongue", NameRole::kIgnored},
    {"teeth", NameRole::kIgnored},
    {"nose", NameRole::kIgnored},
    {"hair", NameRole::kIgnored},
    {"skirt", NameRole::kIgnored},
    {"breast", NameRole::kIgnored},
    {"buttock", NameRole::kIgnored},
    {"corrective", NameRole::kIgnored},
    {"muscle", NameRole::kIgnored},
    {"tail", NameRole::kIgnored},
    {"wing", NameRole::kIgnored},
    {"heel", NameRole::kIgnored},
    {"armature", NameRole::kNone},
    {"armor", NameRole::kIgnored},
    {"thumb", NameRole::kThumb},
    {"index", NameRole::kIndex},
    {"pinky", NameRole::kLittle},
    {"pinkie", NameRole::kLittle},
    {"little", NameRole::kLittle},
    {"middle", NameRole::kFinger},
    {"metacarp", NameRole::kFinger},
    {"carpal", NameRole::kFinger},
    {"finger", NameRole::kFinger},
    {"palm", NameRole::kFinger},
    {"toe", NameRole::kToes},
    {"ball", NameRole::kToes},
    {"foot", NameRole::kFoot},
    {"ankle", NameRole::kFoot},
    {"frontlegupper", NameRole::kUpperArm},
    {"frontleglower", NameRole::kForearm},
    {"frontlegshoulder", NameRole::kShoulder},
    {"upperarm", NameRole::kUpperArm},
    {"armupper", NameRole::kUpperArm},
    {"uparm", NameRole::kUpperArm},
    {"uarm", NameRole::kUpperArm},
    {"humerus", NameRole::kUpperArm},
    {"shldr", NameRole::kUpperArm},
    {"bicep", NameRole::kUpperArm},
    {"forearm", NameRole::kForearm},
    {"lowerarm", NameRole::kForearm},
    {"armlower", NameRole::kForearm},
    {"lowarm", NameRole::kForearm},
    {"farm", NameRole::kForearm},
    {"elbow", NameRole::kForearm},
    {"radius", NameRole::kForearm},
    {"ulna", NameRole::kForearm},
    {"upperleg", NameRole::kThigh},
    {"legupper", NameRole::kThigh},
    {"upleg", NameRole::kThigh},
    {"thigh", NameRole::kThigh},
    {"femur", NameRole::kThigh},
    {"lowerleg", NameRole::kShin},
    {"leglower", NameRole::kShin},
    {"lowleg", NameRole::kShin},
    {"knee", NameRole::kShin},
    {"shin", NameRole::kShin},
    {"calf", NameRole::kShin},
    {"tibia", NameRole::kShin},
    {"hand", NameRole::kHand},
    {"wrist", NameRole::kHand},
    {"fist", NameRole::kHand},
    {"clav", NameRole::kClavicle},
    {"collar", NameRole::kClavicle},
    {"scapula", NameRole::kClavicle},
    {"shoulder", NameRole::kShoulder},
    {"hipjoint", NameRole::kHip},
    {"pelvis", NameRole::kHips},
    {"hips", NameRole::kHips},
    {"hip", NameRole::kHip},
    {"leg", NameRole::kLeg},
    {"neck", NameRole::kNeck},
    {"head", NameRole::kHead},
    {"spine", NameRole::kSpine},
    {"chest", NameRole::kSpine},
    {"torso", NameRole::kSpine},
    {"abdomen", NameRole::kSpine},
    {"waist", NameRole::kSpine},
    {"lowerback", NameRole::kSpine},
    {"thorax", NameRole::kSpine},
    {"upperback", NameRole::kSpine},
    {"arm", NameRole::kArm},
});

/// Only as whole words.
constexpr std::array kWords = std::to_array<Keyword>({
    {"ik", NameRole::kIgnored},    {"fk", NameRole::kIgnored},   {"ear", NameRole::kIgnored},
    {"eye", NameRole::kIgnored},   {"eyes", NameRole::kIgnored}, {"jaw", NameRole::kIgnored},
    {"lip", NameRole::kIgnored},   {"lid", NameRole::kIgnored},  {"chin", NameRole::kIgnored},
    {"gaze", NameRole::kIgnored},  {"hat", NameRole::kIgnored},  {"cape", NameRole::kIgnored},
    {"sec", NameRole::kIgnored},   {"adj", NameRole::kIgnored},  {"butt", NameRole::kIgnored},
    {"face", NameRole::kIgnored},  {"ring", NameRole::kFinger},  {"mid", NameRole::kFinger},
    {"mouth", NameRole::kIgnored},
});

constexpr std::array<std::string_view, 8> kEndWords = {"end",  "nub",      "tip",     "leaf",
                                                       "site", "effector", "endsite", "null"};

NameRole RoleOf(std::string_view joined) {
  for (const Keyword& keyword : kKeywords) {
    if (joined.find(keyword.text) != std::string_view::npos) return keyword.role;
  }
  return NameRole::kNone;
}

/// A keyword at the very beginning: "radius", "lowerarm", but not "lradius".
bool BeginsWithKeyword(std::string_view word) {
  return word.starts_with("root") ||
         std::any_of(kKeywords.begin(), kKeywords.end(),
                     [&](const Keyword& k) { return word.starts_with(k.text); }) ||
         std::any_of(kWords.begin(), kWords.end(),
                     [&](const Keyword& k) { return word == k.text; });
}

NameSide SideWord(std::string_view word) {
  if (word == "l" || word == "left" || word == "lft") return NameSide::kLeft;
  if (word == "r" || word == "right" || word == "rgt") return NameSide::kRight;
  return NameSide::kNone;
}

/// Takes a side glued to a word ("leftarm", "armright", "lradius", "rf" before "arm") off it.
NameSide CutGluedSide(std::string& word) {
  if (word.size() > 4 && word.starts_with("left")) {
    word.erase(0, 4);
    return NameSide::kLeft;
  }
  if (word.size() > 5 && word.starts_with("right")) {
    word.erase(0, 5);
    return NameSide::kRight;
  }
  if (word.size() > 4 && word.ends_with("left")) {
    word.erase(word.size() - 4);
    return NameSide::kLeft;
  }
  if (word.size() > 5 && word.ends_with("right")) {
    word.erase(word.size() - 5);
    return NameSide::kRight;
  }
  const bool pair = word == "lu" || word == "lf" || word == "ru" || word == "rf";
  if (pair || (word.size() > 3 && (word[0] == 'l' || word[0] == 'r') && !BeginsWithKeyword(word) &&
               BeginsWithKeyword(word.substr(1)))) {
    const NameSide side = word[0] == 'l' ? NameSide::kLeft : NameSide::kRight;
    word.erase(0, 1);
    return side;
  }
  return NameSide::kNone;
}

}  // namespace

NameVote ReadJointName(std::string_view name) {
  NameVote vote;
  std::string joined;
  NameRole whole_word = NameRole::kNone;
  for (std::string& word : Words(name)) {
    NameSide side = SideWord(word);
    const bool only_side = side != NameSide::kNone;
    if (!only_side) side = CutGluedSide(word);
    if (vote.side == NameSide::kNone) vote.side = side;
    if (only_side) continue;
    if (std::find(kEndWords.begin(), kEndWords.end(), word) != kEndWords.end()) vote.end = true;
    for (const Keyword& keyword : kWords) {
      if (word == keyword.text) whole_word = keyword.role;
    }
    joined += word;
  }
  vote.role = RoleOf(joined);
  if (whole_word == NameRole::kIgnored) {
    vote.role = NameRole::kIgnored;
  } else if (whole_word != NameRole::kNone && vote.role == NameRole::kNone) {
    vote.role = whole_word;
  }
  // "Hip" of no side is the pelvis.
  if (vote.role == NameRole::kHip && vote.side == NameSide::kNone) vote.role = NameRole::kHips;
  return vote;
}

}  // namespace ego
