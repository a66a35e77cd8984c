// SPDX-License-Identifier: MIT
#include "core/skeleton/limb_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ego {
namespace {

std::size_t At(int joint) { return static_cast<std::size_t>(joint); }

NameSide SideOf(Limb limb) { return IsLeft(limb) ? NameSide::kLeft : NameSide::kRight; }

bool Has(const BodyTree& tree, int joint, NameSide side, std::initializer_list<NameRole> roles) {
  const NameVote& vote = tree.Vote(joint);
  return tree.kept[At(joint)] && !vote.end && vote.side == side &&
         std::find(roles.begin(), roles.end(), vote.role) != roles.end();
}

/// Nearest ancestor of these roles, -1 when there is none.
int AncestorOf(const BodyTree& tree, int joint, NameSide side,
               std::initializer_list<NameRole> roles) {
  for (int a = tree.Parent(joint); a >= 0; a = tree.Parent(a)) {
    if (Has(tree, a, side, roles)) return a;
  }
  return -1;
}

/// Topmost joint of these roles below `joint` (the first in breadth-first order), -1 if none.
int DescendantOf(const BodyTree& tree, int joint, NameSide side,
                 std::initializer_list<NameRole> roles) {
  std::vector<int> queue = tree.Children(joint);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (Has(tree, queue[i], side, roles) || Has(tree, queue[i], NameSide::kNone, roles)) {
      return queue[i];
    }
    for (const int child : tree.Children(queue[i])) queue.push_back(child);
  }
  return -1;
}

bool IsFinger(NameRole role) {
  return role == NameRole::kThumb || role == NameRole::kIndex || role == NameRole::kLittle ||
         role == NameRole::kFinger;
}

/// The only child that may be the limb's unnamed end: no finger, no end site.
int UnnamedEnd(const BodyTree& tree, int mid) {
  int found = -1;
  for (const int child : tree.Children(mid)) {
    const NameVote& vote = tree.Vote(child);
    if (vote.end || vote.role != NameRole::kNone) continue;
    if (found >= 0) return -1;
    found = child;
  }
  return found;
}

/// An end joint that hangs elsewhere (IK rigs): the joint of that name nearest to the mid joint.
int DetachedEnd(const BodyTree& tree, int mid, NameSide side, NameRole role) {
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int j = 0; j < static_cast<int>(tree.kept.size()); ++j) {
    if (!Has(tree, j, side, {role}) || tree.IsAncestor(j, mid)) continue;
    const double distance = glm::length(tree.At(j) - tree.At(mid));
    if (distance < best_distance) {
      best = j;
      best_distance = distance;
    }
  }
  return best;
}

// ---- by shape ------------------------------------------------------------------------------

/// Joints from `top` downwards, always to the child that reaches farthest. Stops at a hand: a
/// joint with three or more branches.
std::vector<int> MainChain(const BodyTree& tree, int top) {
  std::vector<int> chain{top};
  for (int joint = top; !tree.Children(joint).empty();) {
    const std::vector<int>& children = tree.Children(joint);
    if (children.size() >= 3 && chain.size() > 1) break;
    const auto length = [&](int child) {
      return tree.reach[At(child)] + glm::length(tree.At(child) - tree.At(joint));
    };
    joint = *std::max_element(children.begin(), children.end(),
                              [&](int a, int b) { return length(a) < length(b); });
    chain.push_back(joint);
  }
  return chain;
}

/// How much three consecutive joints look like base, mid and end of a limb: two long segments, the
/// second running on from the first (a foot turns off the shin, a clavicle often off the arm).
double LimbLikeness(const BodyTree& tree, const std::vector<int>& chain, std::size_t i) {
  const Vec3 upper = tree.At(chain[i + 1]) - tree.At(chain[i]);
  const Vec3 lower = tree.At(chain[i + 2]) - tree.At(chain[i + 1]);
  const double product = glm::length(upper) * glm::length(lower);
  return 0.25 * product + 0.75 * std::max(0.0, glm::dot(upper, lower));
}

/// The base, mid and end joint in a chain: the three consecutive joints most like them. A chain
/// that ends in a joint with fingers ends there, or one before where that is a mere knuckle.
FoundLimb SplitChain(const BodyTree& tree, const std::vector<int>& chain) {
  FoundLimb limb;
  const std::size_t count = chain.size();
  if (count < 2) return limb;
  if (count == 2) {
    limb.base = chain[0];
    limb.mid = chain[1];
    return limb;
  }
  std::size_t best = count - 3;
  if (tree.Children(chain.back()).size() >= 3) {
    if (count > 3 &&
        LimbLikeness(tree, chain, count - 3) < 0.3 * LimbLikeness(tree, chain, count - 4)) {
      best = count - 4;
    }
  } else {
    for (std::size_t i = count - 2; i-- > 0;) {
      if (LimbLikeness(tree, chain, i) >= 0.999 * LimbLikeness(tree, chain, best)) best = i;
    }
  }
  limb.base = chain[best];
  limb.mid = chain[best + 1];
  limb.end = chain[best + 2];
  if (best + 3 < count) limb.tip = chain[best + 3];
  return limb;
}

struct Pair {
  int attach = -1;
  std::array<std::vector<int>, 2> chain;
  double length = 0.0;
  Vec3 lateral{0.0};  // from second to first, unit
  Vec3 start{0.0};    // middle of the two bases
  Vec3 run{0.0};      // mean direction base -> end, unit
  std::array<FoundLimb, 2> limb;
};

double ChainLength(const BodyTree& tree, const std::vector<int>& chain) {
  double length = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    length += glm::length(tree.At(chain[i]) - tree.At(chain[i - 1]));
  }
  return length;
}

Vec3 UnitOrZero(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0);
}

std::optional<Pair> MakePair(const BodyTree& tree, int attach, int a, int b) {
  Pair pair;
  pair.attach = attach;
  pair.chain = {MainChain(tree, a), MainChain(tree, b)};
  if (pair.chain[0].size() < 2 || pair.chain[0].size() != pair.chain[1].size()) return {};
  const double la = ChainLength(tree, pair.chain[0]);
  const double lb = ChainLength(tree, pair.chain[1]);
  if (la <= 0.0 || std::abs(la - lb) > 0.1 * (la + lb)) return {};
  for (std::size_t s = 0; s < 2; ++s) pair.limb[s] = SplitChain(tree, pair.chain[s]);
  const Vec3 apart = tree.At(pair.limb[0].base) - tree.At(pair.limb[1].base);
  pair.lateral = UnitOrZero(apart);
  if (pair.lateral == Vec3(0.0)) return {};
  pair.start = 0.5 * (tree.At(pair.limb[0].base) + tree.At(pair.limb[1].base));
  Vec3 run(0.0);
  for (const FoundLimb& limb : pair.limb) {
    const int end = limb.end >= 0 ? limb.end : limb.mid;
    run += UnitOrZero(tree.At(end) - tree.At(limb.base));
  }
  pair.run = UnitOrZero(run);
  pair.length = la + lb;
  return pair;
}

}  // namespace

bool BodyTree::IsAncestor(int ancestor, int joint) const {
  if (joint < 0) return false;  // branches of different roots have no common joint
  for (int a = Parent(joint); a >= 0; a = Parent(a)) {
    if (a == ancestor) return true;
  }
  return false;
}

int BodyTree::CommonAncestor(int a, int b) const {
  for (int x = a; x >= 0; x = Parent(x)) {
    if (x == b || IsAncestor(x, b)) return x;
  }
  return -1;
}

BodyTree MakeBodyTree(const JointTree& tree, const std::vector<bool>& deforms,
                      const std::array<int, kJointCount>& declared) {
  const std::size_t count = tree.joints.size();
  BodyTree body;
  const std::vector<Mat4> global = tree.RestGlobal();
  body.position.resize(count);
  body.vote.resize(count);
  body.kept.assign(count, true);
  std::vector<bool> moves(count, deforms.empty());
  for (std::size_t i = count; i-- > 0;) {
    body.position[i] = Vec3(global[i][3]);
    body.vote[i] = ReadJointName(tree.joints[i].name);
    if (!deforms.empty() && deforms[i]) moves[i] = true;
    if (moves[i] && tree.joints[i].parent >= 0) moves[At(tree.joints[i].parent)] = true;
    if (body.vote[i].role == NameRole::kIgnored || !moves[i]) body.kept[i] = false;
  }
  for (const int node : declared) {
    if (node >= 0) body.kept[At(node)] = true;
  }
  body.parent.assign(count, -1);
  body.children.resize(count);
  body.reach.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const int parent = tree.joints[i].parent;
    if (parent >= 0) body.parent[i] = body.kept[At(parent)] ? parent : body.parent[At(parent)];
    if (body.kept[i] && body.parent[i] >= 0) {
      body.children[At(body.parent[i])].push_back(static_cast<int>(i));
    }
  }
  for (std::size_t i = count; i-- > 0;) {
    if (!body.kept[i] || body.parent[i] < 0) continue;
    const std::size_t parent = At(body.parent[i]);
    body.reach[parent] = std::max(
        body.reach[parent], body.reach[i] + glm::length(body.position[i] - body.position[parent]));
  }
  return body;
}

std::optional<FoundLimb> LimbByName(const BodyTree& tree, Limb limb) {
  using R = NameRole;
  const NameSide side = SideOf(limb);
  const bool arm = IsArm(limb);
  FoundLimb best;
  int best_rank = -1;
  for (int j = 0; j < static_cast<int>(tree.kept.size()); ++j) {
    const bool sure = Has(tree, j, side, {arm ? R::kForearm : R::kShin});
    if (!sure && !Has(tree, j, side, {arm ? R::kArm : R::kLeg})) continue;
    FoundLimb found;
    found.mid = j;
    found.base = arm ? AncestorOf(tree, j, side, {R::kUpperArm, R::kArm, R::kShoulder})
                     : AncestorOf(tree, j, side, {R::kThigh, R::kHip, R::kLeg, R::kHips});
    if (found.base < 0) continue;
    // "Arm" under "Shoulder" alone is the upper arm, not the forearm.
    if (!sure && arm && Has(tree, found.base, side, {R::kShoulder})) continue;
    found.end = DescendantOf(tree, j, side, {arm ? R::kHand : R::kFoot});
    bool fingers = false;
    for (const int child : tree.Children(j)) fingers |= IsFinger(tree.Vote(child).role);
    if (found.end < 0 && !fingers) found.end = UnnamedEnd(tree, j);
    // A single palm or knuckle joint carries all fingers: it is the hand.
    if (found.end < 0 && fingers && tree.Children(j).size() == 1) found.end = tree.Children(j)[0];
    if (found.end < 0 && !arm) found.end = DetachedEnd(tree, j, side, R::kFoot);
    if (found.end < 0 && arm && !fingers) found.end = DetachedEnd(tree, j, side, R::kHand);
    if (!arm && found.end >= 0) {
      found.tip = DescendantOf(tree, found.end, side, {R::kToes});
      if (found.tip < 0) found.tip = UnnamedEnd(tree, found.end);
      if (found.tip < 0) found.tip = DetachedEnd(tree, found.end, side, R::kToes);
    }
    found.named = true;
    const int rank = (sure ? 4 : 0) + (found.end >= 0 ? 2 : 0);
    if (rank > best_rank) {
      best = found;
      best_rank = rank;
    }
  }
  if (best_rank < 0) return {};
  return best;
}

std::optional<FoundLimbs> LimbsByShape(const BodyTree& tree) {
  std::vector<Pair> pairs;
  for (int v = 0; v < static_cast<int>(tree.kept.size()); ++v) {
    const std::vector<int>& children = tree.Children(v);
    // Hands and heads full of joints have many children; a trunk has few.
    if (!tree.kept[At(v)] || children.size() < 2 || children.size() > 12) continue;
    for (std::size_t a = 0; a < children.size(); ++a) {
      for (std::size_t b = a + 1; b < children.size(); ++b) {
        if (auto pair = MakePair(tree, v, children[a], children[b])) {
          pairs.push_back(*std::move(pair));
        }
      }
    }
  }
  // Hostile trees could have any number of pairs; a body's are among the longest.
  constexpr std::size_t kMaxPairs = 200;
  if (pairs.size() > kMaxPairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.length > b.length; });
    pairs.resize(kMaxPairs);
  }
  // The best two pairs on one trunk: long, side by side in the same direction, and the legs
  // running on where the trunk ends.
  const Pair* legs = nullptr;
  const Pair* arms = nullptr;
  double best = 0.0;
  const auto within = [&](int joint, const Pair& pair) {
    return joint == pair.chain[0][0] || joint == pair.chain[1][0] ||
           tree.IsAncestor(pair.chain[0][0], joint) || tree.IsAncestor(pair.chain[1][0], joint);
  };
  for (const Pair& low : pairs) {
    for (const Pair& high : pairs) {
      if (&low == &high || within(high.attach, low) || within(low.attach, high)) continue;
      if (low.chain[0][0] == high.chain[0][0] || low.chain[1][0] == high.chain[1][0] ||
          low.chain[0][0] == high.chain[1][0] || low.chain[1][0] == high.chain[0][0]) {
        continue;
      }
      const Vec3 trunk = UnitOrZero(high.start - low.start);
      const double side = std::abs(glm::dot(low.lateral, high.lateral));
      const double down = -glm::dot(low.run, trunk);
      const double not_down = 1.0 - std::max(0.0, glm::dot(high.run, trunk));
      if (side < 0.8 || down < 0.5) continue;
      if (low.limb[0].mid < 0 || high.limb[0].mid < 0) continue;
      const double score = std::min(low.length, high.length) * side * down * not_down +
                           0.25 * (low.length + high.length);
      if (score > best) {
        best = score;
        legs = &low;
        arms = &high;
      }
    }
  }
  if (legs == nullptr) return {};
  FoundLimbs limbs;
  const bool same = glm::dot(legs->lateral, arms->lateral) > 0.0;
  limbs[Index(Limb::kLeftLeg)] = legs->limb[0];
  limbs[Index(Limb::kRightLeg)] = legs->limb[1];
  limbs[Index(Limb::kLeftArm)] = arms->limb[same ? 0 : 1];
  limbs[Index(Limb::kRightArm)] = arms->limb[same ? 1 : 0];
  return limbs;
}

}  // namespace ego
