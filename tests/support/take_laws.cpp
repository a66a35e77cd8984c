// SPDX-License-Identifier: MIT
#include "tests/support/take_laws.h"

#include <cmath>
#include <unordered_set>

#include "core/base/check.h"
#include "tests/support/sentence_law.h"

namespace ego::test {
namespace {

bool IsFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void CheckTake(const Result<MarkerTake>& take, std::string_view file) {
  if (!take) return CheckSentence(take.error(), file);
  EGO_CHECK(take->frame_count > 0 && !take->labels.empty());
  EGO_CHECK(std::isfinite(take->rate_hz) && take->rate_hz > 0.0);
  EGO_CHECK(take->position_ws.size() == take->frame_count * take->labels.size());
  EGO_CHECK(take->visible.size() == take->position_ws.size());
  for (std::size_t i = 0; i < take->visible.size(); ++i) {
    EGO_CHECK(take->visible[i] <= 1 && IsFinite(take->position_ws[i]));
    EGO_CHECK(glm::length(take->position_ws[i]) < 2000.0);
  }
  std::unordered_set<std::string> names;
  for (const auto* list : {&take->labels, &take->ignored}) {
    for (const std::string& label : *list) {
      EGO_CHECK(!label.empty() && names.insert(label).second);
    }
  }
}

void CheckMotion(const Result<JointMotion>& motion, std::string_view file) {
  if (!motion) return CheckSentence(motion.error(), file);
  const std::size_t n = motion->tree.joints.size();
  EGO_CHECK(motion->frame_count > 0 && n > 0);
  EGO_CHECK(std::isfinite(motion->rate_hz) && motion->rate_hz > 0.0);
  EGO_CHECK(motion->rotation_ls.size() == motion->frame_count * n);
  EGO_CHECK(motion->translation_ls.size() == motion->rotation_ls.size());
  for (std::size_t j = 0; j < n; ++j) {
    const JointTree::Joint& joint = motion->tree.joints[j];
    EGO_CHECK(!joint.name.empty());
    EGO_CHECK(joint.parent >= -1 && joint.parent < static_cast<int>(j));
  }
  for (std::size_t i = 0; i < motion->rotation_ls.size(); ++i) {
    const Quat& q = motion->rotation_ls[i];
    EGO_CHECK(std::abs(glm::length(q) - 1.0) < 1e-9 && IsFinite(motion->translation_ls[i]));
    if (i >= n) EGO_CHECK(glm::dot(q, motion->rotation_ls[i - n]) >= 0.0);
  }
}

void CheckCapture(const Result<CapturedMotion>& captured, const JointMotion& motion) {
  if (!captured) return CheckSentence(captured.error(), "");
  EGO_CHECK(captured->poses.size() == motion.frame_count);
  EGO_CHECK(captured->performer.height > 0.1 && captured->performer.height < 10.0);
  for (const Vec3& sample : captured->performer.surface.sample_ms) EGO_CHECK(IsFinite(sample));
  for (const Pose& pose : captured->poses) {
    EGO_CHECK(IsFinite(pose.root_ws));
    for (const Quat& q : pose.rotation_ls) EGO_CHECK(std::abs(glm::length(q) - 1.0) < 1e-9);
  }
}

}  // namespace ego::test
