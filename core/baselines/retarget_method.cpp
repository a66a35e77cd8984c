// SPDX-License-Identifier: MIT
#include "core/baselines/retarget_method.h"

#include <array>

#include "core/adapt/adapt.h"
#include "core/base/check.h"
#include "core/baselines/copy_joint_angles.h"
#include "core/egocentric/normalize.h"

namespace ego {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"mdb", "paper", "copy"};

class CopyMethod : public RetargetMethod {
 public:
  std::string_view name() const override { return "copy"; }
  void SetPerformerPose(const Body& performer, const Pose& pose) override {
    performer_ = &performer;
    pose_ = pose;
  }
  void Adapt(const Body& avatar, Pose& out) const override {
    EGO_CHECK(performer_ != nullptr);
    CopyJointAngles(*performer_, pose_, avatar, out);
    out.hand = pose_.hand;
  }

 private:
  const Body* performer_ = nullptr;
  Pose pose_;
};

/// The paper's method: one normalisation serves any number of avatars.
class EgocentricMethod : public RetargetMethod {
 public:
  EgocentricMethod(std::string_view name, const NormalizeSettings& normalize,
                   const AdaptSettings& adapt)
      : name_(name), normalize_(normalize), adapt_(adapt) {}
  std::string_view name() const override { return name_; }
  void SetPerformerPose(const Body& performer, const Pose& pose) override {
    Normalize(performer, pose, normalize_, egocentric_);
    hand_ = pose.hand;
    ready_ = true;
  }
  void Adapt(const Body& avatar, Pose& out) const override {
    EGO_CHECK(ready_);
    ego::Adapt(avatar, egocentric_, adapt_, out);
    out.hand = hand_;
  }

 private:
  std::string_view name_;
  NormalizeSettings normalize_;
  AdaptSettings adapt_;
  EgocentricPose egocentric_;
  std::array<HandShape, 2> hand_{};
  bool ready_ = false;
};

}  // namespace

std::span<const std::string_view> RetargetMethodNames() { return kNames; }

std::unique_ptr<RetargetMethod> MakeRetargetMethod(std::string_view name) {
  if (name == "mdb") {
    return std::make_unique<EgocentricMethod>("mdb", NormalizeSettings{}, AdaptSettings{});
  }
  if (name == "paper") {
    return std::make_unique<EgocentricMethod>("paper", NormalizeSettings::Paper(),
                                              AdaptSettings::Paper());
  }
  if (name == "copy") return std::make_unique<CopyMethod>();
  return nullptr;
}

}  // namespace ego
