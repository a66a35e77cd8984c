// SPDX-License-Identifier: MIT
#include "core/skeleton/humanoid_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/skeleton/humanoid_search.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// Larger trees are no rigs; the bound keeps hostile files cheap.
constexpr std::size_t kMaxJoints = 4096;

constexpr double kByName = 0.9;
constexpr double kByShape = 0.6;

constexpr std::array kRequired = {
    J::kHips,          J::kHead,         J::kLeftUpperArm, J::kLeftLowerArm,  J::kRightUpperArm,
    J::kRightLowerArm, J::kLeftUpperLeg, J::kLeftLowerLeg, J::kRightUpperLeg, J::kRightLowerLeg};

constexpr std::array<J, kLimbCount> kClavicleOf = {J::kLeftShoulder, J::kRightShoulder, J::kHips,
                                                   J::kHips};
constexpr std::array<J, kLimbCount> kToesOf = {J::kHips, J::kHips, J::kLeftToes, J::kRightToes};

std::string Quoted(const HumanoidSearch& s, int node) { return "'" + s.NameOf(node) + "'"; }

void SetFound(HumanoidSearch& s, J j, int node, bool named) {
  s.Set(j, node, named ? kByName : kByShape,
        Quoted(s, node) + (named ? " by its name and place" : " by its place in the tree"));
}

/// Declared limbs, named ones, or all four by shape. False when a required joint is missing.
bool FindLimbs(HumanoidSearch& s, bool& named) {
  std::array<std::optional<FoundLimb>, kLimbCount> found;
  bool all = true;
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    const auto declared = [&](J j) { return s.hints.node[Index(j)]; };
    if (s.Declared(joints.base) && s.Declared(joints.mid)) {
      const J toes = kToesOf[Index(limb)];
      found[Index(limb)] = FoundLimb{declared(joints.base), declared(joints.mid),
                                     declared(joints.end), IsArm(limb) ? -1 : declared(toes), true};
    } else {
      found[Index(limb)] = LimbByName(s.body, limb);
    }
    all = all && found[Index(limb)].has_value();
  }
  named = all;
  if (!all) {
    if (const auto shaped = LimbsByShape(s.body)) {
      for (const Limb limb : kLimbs) found[Index(limb)] = (*shaped)[Index(limb)];
    }
  }
  bool complete = true;
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    const auto& one = found[Index(limb)];
    if (!one) {
      complete = false;
      continue;
    }
    SetFound(s, joints.base, one->base, one->named);
    SetFound(s, joints.mid, one->mid, one->named);
    if (one->end >= 0) {
      SetFound(s, joints.end, one->end, one->named);
      if (!s.Declared(joints.end) && !s.body.IsAncestor(one->mid, one->end)) {
        s.map.notes.push_back(Quoted(s, one->end) + " is not below " + Quoted(s, one->mid) +
                              " in the file: it is re-attached to it");
      }
    } else {
      s.Set(joints.end, -1, 0.0, "the rig has none below " + Quoted(s, one->mid));
    }
    if (IsArm(limb)) continue;
    const J toes = kToesOf[Index(limb)];
    if (one->tip >= 0) {
      SetFound(s, toes, one->tip, one->named);
    } else {
      s.Set(toes, -1, 0.0, "the rig has none");
    }
  }
  return complete;
}

/// Joints from `top` (excluded) down to `bottom` (included).
std::vector<int> PathDown(const BodyTree& body, int top, int bottom) {
  std::vector<int> path;
  for (int j = bottom; j >= 0 && j != top; j = body.Parent(j)) path.push_back(j);
  std::reverse(path.begin(), path.end());
  return path;
}

/// The hips: on the way from the chest to the root, near the middle of the thighs, carrying them,
/// by name.
void FindHips(HumanoidSearch& s, int chest, int fork) {
  if (s.Declared(J::kHips)) return;
  const Vec3 thighs = 0.5 * (s.At(J::kLeftUpperLeg) + s.At(J::kRightUpperLeg));
  const Vec3 shoulders = 0.5 * (s.At(J::kLeftUpperArm) + s.At(J::kRightUpperArm));
  const double trunk = std::max(1e-12, glm::length(shoulders - thighs));
  int best = -1;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int j = chest >= 0 ? chest : fork; j >= 0; j = s.body.Parent(j)) {
    const bool carries = j == fork || s.body.IsAncestor(j, fork);
    const bool by_name = s.body.Vote(j).role == NameRole::kHips;
    const double cost = glm::length(s.body.At(j) - thighs) / trunk - (carries ? 0.25 : 0.0) -
                        (by_name ? 0.3 : 0.0) - (j == fork ? 0.01 : 0.0);
    if (cost < best_cost) {
      best = j;
      best_cost = cost;
    }
  }
  if (best >= 0) SetFound(s, J::kHips, best, s.body.Vote(best).role == NameRole::kHips);
}

/// The head by name, else the end of the branch that leaves the trunk away from the hips.
void FindHead(HumanoidSearch& s, int chest, int fork) {
  if (s.Declared(J::kHead)) return;
  const auto in_limb = [&](int j) {
    for (const Limb limb : kLimbs) {
      const int base = s.Node(JointsOf(limb).base);
      if (j == base || s.body.IsAncestor(base, j)) return true;
    }
    return false;
  };
  const auto leads_to_limb = [&](int j) {
    for (const Limb limb : kLimbs) {
      const int base = s.Node(JointsOf(limb).base);
      if (j == base || s.body.IsAncestor(j, base)) return true;
    }
    return false;
  };
  int named = -1;
  for (int j = 0; j < static_cast<int>(s.tree.joints.size()); ++j) {
    const NameVote& vote = s.body.Vote(j);
    if (!s.body.kept[static_cast<std::size_t>(j)] || vote.role != NameRole::kHead || vote.end ||
        vote.side != NameSide::kNone || in_limb(j) || leads_to_limb(j)) {
      continue;
    }
    const bool better = named < 0 || (chest >= 0 && s.body.IsAncestor(chest, j) &&
                                      !s.body.IsAncestor(chest, named));
    if (better) named = j;
  }
  if (named >= 0) {
    SetFound(s, J::kHead, named, true);
    return;
  }
  const Vec3 thighs = 0.5 * (s.At(J::kLeftUpperLeg) + s.At(J::kRightUpperLeg));
  const Vec3 shoulders = 0.5 * (s.At(J::kLeftUpperArm) + s.At(J::kRightUpperArm));
  const Vec3 up = shoulders - thighs;
  for (int from = chest; from >= 0; from = from == fork ? -1 : s.body.Parent(from)) {
    int top = -1;
    double highest = 0.0;
    for (const int child : s.body.Children(from)) {
      if (leads_to_limb(child)) continue;
      const double height = glm::dot(s.body.At(child) - shoulders, up) / glm::dot(up, up) +
                            s.body.reach[static_cast<std::size_t>(child)] / glm::length(up);
      if (height > highest) {
        highest = height;
        top = child;
      }
    }
    if (top < 0) continue;
    std::vector<int> chain{top};
    while (s.body.Children(chain.back()).size() == 1) {
      chain.push_back(s.body.Children(chain.back())[0]);
    }
    const bool ends = s.body.Children(chain.back()).empty();
    const std::size_t pick = chain.size() >= 3 && ends ? chain.size() - 2 : chain.size() - 1;
    SetFound(s, J::kHead, chain[pick], false);
    return;
  }
}

void FindNeck(HumanoidSearch& s, int chest) {
  const std::vector<int> path = PathDown(s.body, chest, s.body.Parent(s.Node(J::kHead)));
  int neck = -1;
  for (const int j : path) {
    if (neck < 0 && s.body.Vote(j).role == NameRole::kNeck) neck = j;
  }
  if (neck < 0 && !path.empty() && s.body.Vote(path.back()).role == NameRole::kNone) {
    neck = path.back();
  }
  const bool below = chest >= 0 && s.body.IsAncestor(chest, s.Node(J::kHead));
  if (neck >= 0 && below) {
    SetFound(s, J::kNeck, neck, s.body.Vote(neck).role == NameRole::kNeck);
  } else {
    s.Set(J::kNeck, -1, 0.0, "no joint between trunk and head");
  }
}

/// Chooses up to three joints of the trunk for 1/4, 1/2 and 3/4 of the way from hips to shoulders.
void FindSpine(HumanoidSearch& s, int chest) {
  constexpr std::array<J, 3> kSlots = {J::kSpine, J::kChest, J::kUpperChest};
  constexpr std::array<double, 3> kHeights = {0.25, 0.5, 0.75};
  if (s.Declared(J::kSpine)) {
    for (const J j : kSlots) s.Set(j, -1, 0.0, "the file declares none");
    return;
  }
  for (const J j : kSlots) s.Set(j, -1, 0.0, "the rig has too few spine joints");
  const int hips = s.Node(J::kHips);
  if (chest < 0 || (chest != hips && !s.body.IsAncestor(hips, chest))) return;
  const std::vector<int> path = PathDown(s.body, hips, chest);
  const Vec3 low = s.body.At(hips);
  const Vec3 up = 0.5 * (s.At(J::kLeftUpperArm) + s.At(J::kRightUpperArm)) - low;
  const double square = std::max(1e-300, glm::dot(up, up));
  const auto cost = [&](std::size_t joint, std::size_t slot) {
    return std::abs(glm::dot(s.body.At(path[joint]) - low, up) / square - kHeights[slot]);
  };
  // Best monotone choice of min(3, joints) pairs, by exhaustion over slots and joints.
  const std::size_t count = std::min<std::size_t>(3, path.size());
  double best = std::numeric_limits<double>::infinity();
  std::array<int, 3> choice{-1, -1, -1};
  const int joints = static_cast<int>(std::min<std::size_t>(path.size(), 64));
  for (int a = -1; a < joints; ++a) {
    for (int b = -1; b < joints; ++b) {
      for (int c = -1; c < joints; ++c) {
        const std::array<int, 3> trial{a, b, c};
        std::size_t used = 0;
        int last = -1;
        bool rising = true;
        double sum = 0.0;
        for (std::size_t slot = 0; slot < 3; ++slot) {
          if (trial[slot] < 0) continue;
          rising = rising && trial[slot] > last;
          last = trial[slot];
          sum += cost(static_cast<std::size_t>(trial[slot]), slot);
          ++used;
        }
        if (!rising || used != count || sum >= best) continue;
        best = sum;
        choice = trial;
      }
    }
  }
  for (std::size_t slot = 0; slot < 3; ++slot) {
    if (choice[slot] < 0) continue;
    const int node = path[static_cast<std::size_t>(choice[slot])];
    s.Set(kSlots[slot], node, 0.8, Quoted(s, node) + " by its height on the trunk");
  }
  if (path.size() > 3) {
    s.map.notes.push_back(std::to_string(path.size() - 3) +
                          " of the spine joints ride rigidly on those below them");
  }
}

void FindClavicles(HumanoidSearch& s, int chest) {
  for (const Limb limb : {Limb::kLeftArm, Limb::kRightArm}) {
    const J clavicle = kClavicleOf[Index(limb)];
    const int base = s.Node(JointsOf(limb).base);
    const std::vector<int> path = PathDown(s.body, chest, s.body.Parent(base));
    int found = -1;
    for (const int j : path) {
      const NameRole role = s.body.Vote(j).role;
      if (role == NameRole::kClavicle || role == NameRole::kShoulder) found = j;
    }
    if (found < 0 && !path.empty() && chest >= 0) found = path.back();
    if (found >= 0 && found != chest) {
      SetFound(s, clavicle, found, s.body.Vote(found).role != NameRole::kNone);
    } else {
      s.Set(clavicle, -1, 0.0, "no joint between trunk and upper arm");
    }
  }
}

std::string MissingSentence(const HumanoidSearch& s) {
  std::string missing;
  for (const J j : kRequired) {
    if (s.Node(j) >= 0) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(Name(j));
  }
  std::string seen;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < s.tree.joints.size() && shown < 6; ++i) {
    if (!s.body.kept[i]) continue;
    seen += (seen.empty() ? "'" : ", '") + s.tree.joints[i].name.substr(0, 40) + "'";
    ++shown;
  }
  return "no humanoid found: " + missing + " missing among " +
         std::to_string(s.tree.joints.size()) + " joints (" + (seen.empty() ? "none" : seen) +
         (s.tree.joints.size() > shown ? ", ..." : "") + ")";
}

}  // namespace

Result<HumanoidMap> MapHumanoid(const JointTree& tree, const HumanoidHints& hints) {
  const std::size_t count = tree.joints.size();
  if (count > kMaxJoints) {
    return Error{"no humanoid found: " + std::to_string(count) +
                 " joints are more than a rig has (at most " + std::to_string(kMaxJoints) + ")"};
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (tree.joints[i].parent >= static_cast<int>(i)) {
      return Error{"no humanoid found: joint '" + tree.joints[i].name +
                   "' comes before its parent"};
    }
  }
  for (const int node : hints.node) {
    if (node >= static_cast<int>(count)) {
      return Error{"no humanoid found: a declared bone names joint " + std::to_string(node) +
                   " of " + std::to_string(count)};
    }
  }
  HumanoidSearch s{tree, hints, MakeBodyTree(tree, hints.deforms, hints.node), {}};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (hints.node[j] >= 0) {
      s.map.joint[j] = {hints.node[j], 1.0, Quoted(s, hints.node[j]) + " is declared by the file"};
    }
  }
  bool named = false;
  if (!FindLimbs(s, named)) return Error{MissingSentence(s)};
  const int chest = s.body.CommonAncestor(s.Node(J::kLeftUpperArm), s.Node(J::kRightUpperArm));
  const int fork = s.body.CommonAncestor(s.Node(J::kLeftUpperLeg), s.Node(J::kRightUpperLeg));
  FindHips(s, chest, fork);
  FindHead(s, chest, fork);
  if (s.Node(J::kHips) < 0 || s.Node(J::kHead) < 0) return Error{MissingSentence(s)};
  FindSpine(s, chest);
  FindNeck(s, chest);
  FindClavicles(s, chest);
  for (std::size_t a = 0; a < kJointCount; ++a) {
    for (std::size_t b = a + 1; b < kJointCount; ++b) {
      if (s.map.joint[a].node >= 0 && s.map.joint[a].node == s.map.joint[b].node) {
        return Error{"no humanoid found: joint " + Quoted(s, s.map.joint[a].node) +
                     " would be both " + std::string(Name(static_cast<J>(a))) + " and " +
                     std::string(Name(static_cast<J>(b)))};
      }
    }
  }
  FindTips(s);
  SettleSides(s, named);
  return std::move(s.map);
}

}  // namespace ego
