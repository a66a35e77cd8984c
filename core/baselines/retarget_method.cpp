// SPDX-License-Identifier: MIT
#include "core/baselines/retarget_method.h"

#include <array>

#include "core/base/check.h"
#include "core/baselines/copy_joint_angles.h"

namespace ego {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"mdb", "paper", "copy"};

class CopyMethod : public RetargetMethod {
 public:
  explicit CopyMethod(std::string_view name) : name_(name) {}
  std::string_view name() const override { return name_; }
  void SetPerformerPose(const Body& performer, const Pose& pose) override {
    performer_ = &performer;
    pose_ = pose;
  }
  void Adapt(const Body& avatar, Pose& out) const override {
    EGO_CHECK(performer_ != nullptr);
    CopyJointAngles(*performer_, pose_, avatar, out);
  }

 private:
  std::string_view name_;
  const Body* performer_ = nullptr;
  Pose pose_;
};

}  // namespace

std::span<const std::string_view> RetargetMethodNames() { return kNames; }

std::unique_ptr<RetargetMethod> MakeRetargetMethod(std::string_view name) {
  for (const std::string_view known : kNames) {
    if (known == name) return std::make_unique<CopyMethod>(known);
  }
  return nullptr;
}

}  // namespace ego
