// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "assets/motions/motion_figure.h"
#include "assets/motions/motion_script.h"
#include "assets/motions/posture_solver.h"
#include "assets/motions/true_contact.h"
#include "core/skeleton/pose.h"

namespace ego {

/// One figure doing one script: the pose at any instant, contacts held on the figure's own skin.
/// Between keys every channel moves on a quintic that is smooth in its second derivative; head,
/// spine and hips go a little before the hands; the performer breathes and sways. Elbows that would
/// lie in this figure's trunk, head or legs at a key turn aside about the line from shoulder to
/// wrist.
class MotionPlayer {
 public:
  /// Keeps references to both.
  MotionPlayer(const MotionFigure& figure, const MotionScript& script);

  /// 0 <= time <= the script's duration.
  Pose At(double time) const;

  /// In order of time.
  const std::vector<TrueContact>& contacts() const { return contacts_; }

 private:
  struct Key {
    double time = 0.0;
    BodyGoals posture;
    Vec3 root_ws{0.0};
    std::array<SkinPoint, 2> hand_skin;
    std::array<SkinPoint, 2> foot_skin;
  };
  /// Four keys around an instant; equal neighbours where a channel comes to rest.
  struct Span {
    std::array<const Key*, 4> key;
    double time = 0.0;
  };
  Span SpanAt(double time) const;
  BodyGoals BodyAt(double time, Vec3& root_ws) const;
  LegTarget LegAt(const Span& span, std::size_t side, const ModelPose& model) const;
  ArmTarget ArmAt(const Span& span, std::size_t side, const ModelPose& model) const;
  Pose BodyPose(const BodyGoals& body, const Vec3& root_ws) const;
  void ClearElbows();
  void FindContacts();

  const MotionFigure& figure_;
  const MotionScript& script_;
  PostureSolver solver_;
  std::vector<Key> keys_;
  std::vector<TrueContact> contacts_;
};

}  // namespace ego
