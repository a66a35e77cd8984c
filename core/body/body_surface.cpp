// SPDX-License-Identifier: MIT
#include "core/body/body_surface.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

struct SampleInfo {
  std::string_view name;
  std::string_view description;
  Attachment attachment;
};

constexpr Attachment On(J joint) { return {{joint, joint, joint, joint}, {1.0, 0.0, 0.0, 0.0}}; }
constexpr Attachment Between(J a, J b, double weight_b) {
  return {{a, b, a, a}, {1.0 - weight_b, weight_b, 0.0, 0.0}};
}

const std::array<SampleInfo, kSampleCount> kInfo = {{
    {"collarNotch", "the notch between the collar bones", On(J::kUpperChest)},
    {"sternumBase", "the lower end of the breast bone", On(J::kChest)},
    {"navel", "the navel", Between(J::kHips, J::kSpine, 0.7)},
    {"pubis", "the front of the pelvis, where the legs part", On(J::kHips)},
    {"napeBase", "the bump where the neck meets the back", On(J::kUpperChest)},
    {"midBack", "the spine at the height of the lower ribs", On(J::kChest)},
    {"lowerBack", "the spine at the height of the navel", Between(J::kHips, J::kSpine, 0.7)},
    {"sacrum", "the back of the pelvis, above the cleft", On(J::kHips)},
    {"leftChest", "the left nipple", Between(J::kChest, J::kUpperChest, 0.7)},
    {"rightChest", "the right nipple", Between(J::kChest, J::kUpperChest, 0.7)},
    {"leftBellySide", "the belly, half-way from the navel to the left side",
     Between(J::kHips, J::kSpine, 0.7)},
    {"rightBellySide", "the belly, half-way from the navel to the right side",
     Between(J::kHips, J::kSpine, 0.7)},
    {"leftShoulderTop", "the top of the left shoulder, half-way from the neck to its end",
     Between(J::kUpperChest, J::kLeftShoulder, 0.5)},
    {"rightShoulderTop", "the top of the right shoulder, half-way from the neck to its end",
     Between(J::kUpperChest, J::kRightShoulder, 0.5)},
    {"leftShoulderBlade", "the middle of the left shoulder blade", On(J::kUpperChest)},
    {"rightShoulderBlade", "the middle of the right shoulder blade", On(J::kUpperChest)},
    {"leftRibs", "the ribs of the left side, a hand below the armpit",
     Between(J::kChest, J::kUpperChest, 0.5)},
    {"rightRibs", "the ribs of the right side, a hand below the armpit",
     Between(J::kChest, J::kUpperChest, 0.5)},
    {"leftWaistSide", "the left side of the waist, at its narrowest", On(J::kSpine)},
    {"rightWaistSide", "the right side of the waist, at its narrowest", On(J::kSpine)},
    {"leftHipSide", "the left side of the hip, at its widest", On(J::kHips)},
    {"rightHipSide", "the right side of the hip, at its widest", On(J::kHips)},
    {"forehead", "the middle of the forehead", On(J::kHead)},
    {"crown", "the top of the head", On(J::kHead)},
    {"backOfHead", "the back of the head, at its farthest", On(J::kHead)},
    {"noseTip", "the tip of the nose", On(J::kHead)},
    {"chin", "the tip of the chin", On(J::kHead)},
    {"throat", "under the chin, where the throat begins", On(J::kHead)},
    {"leftEar", "the left ear, at its opening", On(J::kHead)},
    {"rightEar", "the right ear, at its opening", On(J::kHead)},
    {"leftCheek", "the left cheek bone", On(J::kHead)},
    {"rightCheek", "the right cheek bone", On(J::kHead)},
}};

// The left half of both meshes; the right half is its mirror image with the winding restored.
constexpr std::array<SampleTriangle, kTriangleCount / 2> kLeftHalf = {{
    // trunk, front
    {S::kCollarNotch, S::kSternumBase, S::kLeftChest},
    {S::kSternumBase, S::kLeftBellySide, S::kLeftChest},
    {S::kSternumBase, S::kNavel, S::kLeftBellySide},
    {S::kNavel, S::kPubis, S::kLeftBellySide},
    {S::kPubis, S::kLeftHipSide, S::kLeftBellySide},
    {S::kLeftBellySide, S::kLeftHipSide, S::kLeftWaistSide},
    {S::kLeftBellySide, S::kLeftWaistSide, S::kLeftRibs},
    {S::kLeftChest, S::kLeftBellySide, S::kLeftRibs},
    // trunk, back
    {S::kNapeBase, S::kLeftShoulderBlade, S::kMidBack},
    {S::kMidBack, S::kLeftWaistSide, S::kLowerBack},
    {S::kMidBack, S::kLeftShoulderBlade, S::kLeftWaistSide},
    {S::kLeftShoulderBlade, S::kLeftRibs, S::kLeftWaistSide},
    {S::kLowerBack, S::kLeftHipSide, S::kSacrum},
    {S::kLowerBack, S::kLeftWaistSide, S::kLeftHipSide},
    // trunk, bottom
    {S::kPubis, S::kSacrum, S::kLeftHipSide},
    // trunk, shoulder
    {S::kCollarNotch, S::kLeftChest, S::kLeftShoulderTop},
    {S::kLeftChest, S::kLeftRibs, S::kLeftShoulderTop},
    {S::kLeftRibs, S::kLeftShoulderBlade, S::kLeftShoulderTop},
    {S::kLeftShoulderBlade, S::kNapeBase, S::kLeftShoulderTop},
    {S::kNapeBase, S::kCollarNotch, S::kLeftShoulderTop},
    // head
    {S::kCrown, S::kForehead, S::kLeftEar},
    {S::kForehead, S::kLeftCheek, S::kLeftEar},
    {S::kForehead, S::kNoseTip, S::kLeftCheek},
    {S::kNoseTip, S::kChin, S::kLeftCheek},
    {S::kChin, S::kThroat, S::kLeftCheek},
    {S::kThroat, S::kLeftEar, S::kLeftCheek},
    {S::kThroat, S::kBackOfHead, S::kLeftEar},
    {S::kBackOfHead, S::kCrown, S::kLeftEar},
}};

constexpr S MirrorOf(S point) {
  const std::size_t i = Index(point);
  constexpr std::size_t kTrunkPairs = Index(S::kLeftChest);
  constexpr std::size_t kHeadPairs = Index(S::kLeftEar);
  const bool paired = (i >= kTrunkPairs && i < kTrunkSampleCount) || i >= kHeadPairs;
  return paired ? static_cast<S>(i ^ 1u) : point;  // both runs of pairs start at an even index
}
static_assert(Index(S::kLeftChest) % 2 == 0 && Index(S::kLeftEar) % 2 == 0);

constexpr std::array<SampleTriangle, kTriangleCount> BothHalves() {
  std::array<SampleTriangle, kTriangleCount> all{};
  for (std::size_t i = 0; i < kLeftHalf.size(); ++i) {
    const SampleTriangle& left = kLeftHalf[i];
    all[2 * i] = left;
    all[2 * i + 1] = {MirrorOf(left[0]), MirrorOf(left[2]), MirrorOf(left[1])};
  }
  return all;
}
constexpr std::array<SampleTriangle, kTriangleCount> kTriangles = BothHalves();

HumanoidJoint DominantJoint(const SampleTriangle& triangle) {
  std::array<double, kJointCount> sum{};
  for (const S point : triangle) {
    const Attachment& a = kInfo[Index(point)].attachment;
    for (std::size_t k = 0; k < a.joint.size(); ++k) sum[Index(a.joint[k])] += a.weight[k];
  }
  std::size_t best = 0;
  for (std::size_t j = 1; j < kJointCount; ++j) {
    if (sum[j] > sum[best] + 1e-9) best = j;
  }
  return static_cast<HumanoidJoint>(best);
}

}  // namespace

std::string_view Name(SamplePoint point) { return kInfo[Index(point)].name; }

std::optional<SamplePoint> SamplePointNamed(std::string_view name) {
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    if (kInfo[i].name == name) return static_cast<SamplePoint>(i);
  }
  return std::nullopt;
}

std::string_view Description(SamplePoint point) { return kInfo[Index(point)].description; }
SamplePoint Mirror(SamplePoint point) { return MirrorOf(point); }
const std::array<SampleTriangle, kTriangleCount>& SampleTriangles() { return kTriangles; }

HumanoidJoint ParentJoint(std::size_t triangle) {
  static const std::array<HumanoidJoint, kTriangleCount> kParentOf = [] {
    std::array<HumanoidJoint, kTriangleCount> all{};
    for (std::size_t t = 0; t < kTriangleCount; ++t) all[t] = DominantJoint(kTriangles[t]);
    return all;
  }();
  return kParentOf[triangle];
}

const Attachment& TemplateAttachment(SamplePoint point) { return kInfo[Index(point)].attachment; }

void PoseSamples(const Skeleton& skeleton, const BodySurface& surface, const ModelPose& pose,
                 std::array<Vec3, kSampleCount>& sample_ws) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(skeleton);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const Attachment& a = surface.attachment[i];
    Vec3 sum{0.0};
    for (std::size_t k = 0; k < a.joint.size(); ++k) {
      if (a.weight[k] == 0.0) continue;
      sum += a.weight[k] * PosePoint(canonical, pose, a.joint[k], surface.sample_ms[i]);
    }
    sample_ws[i] = sum;
  }
}

}  // namespace ego
