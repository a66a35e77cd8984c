// SPDX-License-Identifier: MIT
#include "assets/motions/motion_check.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

using J = HumanoidJoint;

Vec3 RotationVector(const Quat& q) {
  const Quat p = q.w < 0.0 ? -q : q;
  const Vec3 v{p.x, p.y, p.z};
  const double sine = glm::length(v);
  return sine < 1e-12 ? 2.0 * v : v * (2.0 * std::atan2(sine, p.w) / sine);
}

Limb LimbThatTouches(const TrueContact& contact) {
  return static_cast<Limb>((contact.foot ? 2 : 0) + contact.side);
}

void MeasureSpeeds(const MotionPlayer& player, double duration, MotionCheck& check) {
  constexpr double kStep = 1.0 / 60.0;
  std::array<Vec3, kJointCount> last_speed{};
  Pose last = player.At(0.0);
  bool have_speed = false;
  for (double time = kStep; time <= duration; time += kStep) {
    const Pose pose = player.At(time);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Vec3 speed =
          RotationVector(glm::conjugate(last.rotation_ls[j]) * pose.rotation_ls[j]) / kStep;
      const double fast = Degrees(glm::length(speed));
      if (fast > check.largest_speed) {
        check.largest_speed = fast;
        check.largest_speed_at_s = time;
      }
      const double change = Degrees(glm::distance(speed, last_speed[j])) / kStep;
      if (have_speed && change > check.largest_acceleration) {
        check.largest_acceleration = change;
        check.largest_acceleration_at_s = time;
      }
      last_speed[j] = speed;
    }
    for (const J hand : {J::kLeftHand, J::kRightHand}) {
      const double wrist = Degrees(glm::length(RotationVector(pose.rotation_ls[Index(hand)])));
      if (wrist > check.largest_wrist) {
        check.largest_wrist = wrist;
        check.largest_wrist_at_s = time;
      }
    }
    have_speed = true;
    last = pose;
  }
}

}  // namespace

void MeasureContact(const MotionFigure& figure, const TrueContact& contact, double time,
                    const ModelPose& model, const SkinMeasure& probe, ContactGap& gap) {
  const Vec3 face = PosePoint(figure.canonical(), model, contact.of,
                              figure.FaceOf(contact.face, contact.side).position_ms);
  double distance = 0.0;
  double off_place = 0.0;
  if (contact.plate_ws) {
    distance = face.y - *contact.plate_ws;
    off_place = std::abs(distance);
  } else {
    const Vec3 place =
        figure.Posed(figure.At(PlaceAt(contact, time), contact.side), model).position_ms;
    distance = probe.Gap(face, LimbThatTouches(contact));
    off_place = glm::distance(face, place);
  }
  const auto n = static_cast<double>(gap.samples);
  gap.mean_abs = (n * gap.mean_abs + std::abs(distance)) / (n + 1.0);
  gap.off_place = (n * gap.off_place + off_place) / (n + 1.0);
  gap.widest = std::max(gap.widest, distance);
  gap.deepest = std::max(gap.deepest, -distance);
  ++gap.samples;
}

MotionCheck CheckMotion(const MotionFigure& figure, const MotionScript& script, double step_s) {
  const MotionPlayer player(figure, script);
  SkinMeasure probe(figure.person().character);
  MotionCheck check;
  check.contacts.resize(player.contacts().size());
  std::vector<double> times;
  for (double time = 0.0; time <= script.Duration(); time += step_s) times.push_back(time);
  for (const TrueContact& contact : player.contacts()) {
    times.push_back(contact.from_s);
    times.push_back(contact.to_s);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const double time : times) {
    const Pose pose = player.At(time);
    const ModelPose model = ForwardKinematics(figure.body().skeleton, pose);
    probe.SetPose(pose);
    const SkinMeasure::Sinking sinking = probe.Deepest();
    if (sinking.depth > check.sinking.depth) {
      check.sinking = sinking;
      check.sinking_at_s = time;
    }
    for (std::size_t c = 0; c < check.contacts.size(); ++c) {
      const TrueContact& contact = player.contacts()[c];
      if (time < contact.from_s || time > contact.to_s) continue;
      MeasureContact(figure, contact, time, model, probe, check.contacts[c]);
    }
  }
  MeasureSpeeds(player, script.Duration(), check);
  return check;
}

}  // namespace ego
