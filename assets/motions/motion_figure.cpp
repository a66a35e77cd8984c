// SPDX-License-Identifier: MIT
#include "assets/motions/motion_figure.h"

#include <algorithm>

#include "core/geometry/closest_point.h"
#include "core/model/mesh_point.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

// The body that numbers in scripts are written for, metres.
constexpr double kHipHeight = 0.92;
constexpr double kArmLength = 0.55;

J Sided(J left, std::size_t side) { return side == 0 ? left : Mirror(left); }
Vec3 Sided(const Vec3& v, std::size_t side) { return side == 0 ? v : Vec3{-v.x, v.y, v.z}; }

J StartOf(BodyPart part, std::size_t side) {
  switch (part) {
    case BodyPart::kTrunk:
      return J::kChest;
    case BodyPart::kHead:
      return J::kHead;
    case BodyPart::kUpperArm:
      return Sided(J::kLeftUpperArm, side);
    case BodyPart::kForearm:
      return Sided(J::kLeftLowerArm, side);
    case BodyPart::kHand:
      return Sided(J::kLeftHand, side);
    case BodyPart::kThigh:
      return Sided(J::kLeftUpperLeg, side);
    case BodyPart::kCalf:
      return Sided(J::kLeftLowerLeg, side);
    default:
      return Sided(J::kLeftFoot, side);
  }
}

double Lowest(const std::vector<Vec3>& points, const Quat& turn) {
  double lowest = 1e9;
  for (const Vec3& p : points) lowest = std::min(lowest, (turn * p).y);
  return lowest;
}

}  // namespace

FigureSurface SurfaceOf(const Character& character) {
  FigureSurface surface;
  for (const MeshPart& part : character.parts) {
    const auto base = static_cast<std::uint32_t>(surface.position_ms.size());
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      surface.position_ms.emplace_back(part.positions[v]);
      const std::array<double, kJointCount> shares = JointShares(character, part, v);
      Attachment attachment;
      std::array<std::size_t, kJointCount> order;
      for (std::size_t j = 0; j < kJointCount; ++j) order[j] = j;
      std::partial_sort(order.begin(), order.begin() + 4, order.end(),
                        [&](std::size_t a, std::size_t b) {
                          return shares[a] > shares[b] || (shares[a] == shares[b] && a < b);
                        });
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) sum += shares[order[k]];
      for (std::size_t k = 0; k < 4; ++k) {
        attachment.joint[k] = static_cast<J>(order[k]);
        attachment.weight[k] = shares[order[k]] / sum;
      }
      surface.attachment.push_back(attachment);
    }
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
      surface.triangles.push_back(
          {base + part.triangles[t], base + part.triangles[t + 1], base + part.triangles[t + 2]});
    }
  }
  return surface;
}

MotionFigure::MotionFigure(const Person& person)
    : person_(person),
      surface_(SurfaceOf(person.character)),
      rigid_skin_(person.character),
      canonical_(CanonicalPositions(person.body.skeleton)) {
  leg_scale_ = canonical_[Index(J::kLeftUpperLeg)].y / kHipHeight;
  arm_scale_ =
      (BoneLength(body().skeleton, J::kLeftLowerArm) + BoneLength(body().skeleton, J::kLeftHand)) /
      kArmLength;
  for (std::size_t side = 0; side < 2; ++side) {
    const HandSurface& hand = body().surface.hand[side];
    const double wrist = canonical_[Index(Sided(J::kLeftHand, side))].y;
    const Vec3 inside{hand.palm_ms.x, wrist, hand.palm_ms.z};
    const auto set = [&](TouchFace face, const Vec3& position, const Vec3& normal) {
      faces_[side][static_cast<std::size_t>(face)] = {position, normal};
    };
    const auto along = [&](const Vec3& origin, const Vec3& direction) {
      return PointAlong(surface_, origin, direction).position_ms;
    };
    const Vec3 front{0.0, 0.0, 1.0};
    set(TouchFace::kPalm, hand.palm_ms, -kUp);
    set(TouchFace::kFingertips, hand.fingertip_ms, -kUp);
    set(TouchFace::kBack, along(inside, kUp), kUp);
    set(TouchFace::kThumbSide, along(inside, front), front);
    const FootSurface& foot = body().surface.foot[side];
    const Vec3 ankle = canonical_[Index(Sided(J::kLeftFoot, side))];
    const Vec3 middle{foot.ball_ms.x, 0.35 * ankle.y, glm::mix(ankle.z, foot.ball_ms.z, 0.5)};
    set(TouchFace::kSole, along(middle, -kUp), -kUp);
    set(TouchFace::kInstep, along(middle, kUp), kUp);
    const Vec3 out = Sided(Vec3{1.0, 0.0, 0.0}, side);
    set(TouchFace::kOuterEdge, along(middle, out), out);
  }
  for (std::size_t v = 0; v < surface_.position_ms.size(); ++v) {
    const J joint = surface_.attachment[v].joint[0];
    const Vec3& p = surface_.position_ms[v];
    if (joint == J::kHips) seat_.push_back(p - canonical_[0]);
    for (std::size_t side = 0; side < 2; ++side) {
      const J ankle = Sided(J::kLeftFoot, side);
      const J toes = Sided(J::kLeftToes, side);
      if (joint == ankle) foot_skin_[side].push_back(p - canonical_[Index(ankle)]);
      if (joint == toes) toe_skin_[side].push_back(p - canonical_[Index(toes)]);
    }
  }
}

double MotionFigure::SeatHeight(const Quat& hips) const { return -Lowest(seat_, hips); }

double MotionFigure::AnkleHeight(std::size_t side, const Quat& foot, const Quat& toes) const {
  const Vec3 to_toes = foot * body().skeleton.offset[Index(Sided(J::kLeftToes, side))];
  return -std::min(Lowest(foot_skin_[side], foot),
                   to_toes.y + Lowest(toe_skin_[side], foot * toes));
}

HumanoidJoint MotionFigure::JointOf(const BodyPlace& place, std::size_t side) {
  if (place.part == BodyPart::kSample) return IsHead(place.sample) ? J::kHead : J::kChest;
  return StartOf(place.part, place.other ? 1 - side : side);
}

MotionFigure::Ray MotionFigure::RayTo(const BodyPlace& place, std::size_t side) const {
  const std::size_t on = place.other ? 1 - side : side;
  // Rays begin safely inside.
  const double along = std::clamp(place.along, place.part == BodyPart::kTrunk ? -0.1 : 0.05,
                                  place.part == BodyPart::kHand ? 0.6 : 0.95);
  const auto sample = [&](S s) { return body().surface.sample_ms[Index(s)]; };
  const Vec3 direction = glm::normalize(Sided(place.toward, side));
  switch (place.part) {
    case BodyPart::kTrunk: {
      const double hip = canonical_[Index(J::kLeftUpperLeg)].y;
      const double length = canonical_[Index(J::kNeck)].y - hip;
      return {{0.0, hip + along * length, -0.035 * length}, direction};
    }
    case BodyPart::kHead: {
      // Chin and forehead were found 0.10 and 0.64 of the way from chin to crown.
      const double height = (sample(S::kForehead).y - sample(S::kChin).y) / 0.54;
      const double chin = sample(S::kChin).y - 0.10 * height;
      return {{0.0, chin + along * height, sample(S::kCrown).z}, direction};
    }
    case BodyPart::kHand: {
      const Vec3 wrist = canonical_[Index(StartOf(place.part, on))];
      const double tip = body().surface.hand[on].fingertip_ms.x;
      return {{glm::mix(wrist.x, tip, along), wrist.y, wrist.z}, direction};
    }
    case BodyPart::kFoot: {
      const Vec3 ankle = canonical_[Index(StartOf(place.part, on))];
      const Vec3 ball = body().surface.foot[on].ball_ms;
      return {{glm::mix(ankle.x, ball.x, along), 0.45 * ankle.y, glm::mix(ankle.z, ball.z, along)},
              direction};
    }
    default: {
      const J start = StartOf(place.part, on);
      const J end = static_cast<J>(Index(start) + 1);  // limbs are stored joint after joint
      return {glm::mix(canonical_[Index(start)], canonical_[Index(end)], along), direction};
    }
  }
}

SkinPoint MotionFigure::SampleSkin(SamplePoint sample) const {
  const Vec3& p = body().surface.sample_ms[Index(sample)];
  SkinPoint point{p, kUp, body().surface.attachment[Index(sample)]};
  // Of the skin about the point: a single triangle may be the edge of a hem.
  constexpr double kAbout = 0.02;
  Vec3 normal{0.0};
  for (const auto& t : surface_.triangles) {
    const Vec3& a = surface_.position_ms[t[0]];
    if (glm::distance(a, p) > 0.1) continue;
    const Triangle triangle =
        Triangle::Of(a, surface_.position_ms[t[1]], surface_.position_ms[t[2]]);
    const double distance =
        glm::distance(p, AtBarycentric(triangle, ClosestOnTriangle(triangle, p)));
    if (distance < kAbout) normal += (1.0 - distance / kAbout) * triangle.area * triangle.normal;
  }
  if (glm::length(normal) > 0.0) point.normal_ms = glm::normalize(normal);
  return point;
}

SkinPoint MotionFigure::At(const BodyPlace& place, std::size_t side) const {
  if (place.part == BodyPart::kSample) return SampleSkin(place.sample);
  const Ray ray = RayTo(place, side);
  return PointAlong(surface_, ray.origin, ray.direction);
}

SkinPoint MotionFigure::Posed(const SkinPoint& skin, const ModelPose& pose) const {
  SkinPoint posed = skin;
  posed.position_ms = Vec3(0.0);
  posed.normal_ms = Vec3(0.0);
  const Attachment& a = skin.attachment;
  for (std::size_t k = 0; k < a.joint.size(); ++k) {
    posed.position_ms += a.weight[k] * PosePoint(canonical_, pose, a.joint[k], skin.position_ms);
    posed.normal_ms += a.weight[k] * (pose.Rotation(a.joint[k]) * skin.normal_ms);
  }
  posed.normal_ms = glm::normalize(posed.normal_ms);
  return posed;
}

}  // namespace ego
