// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "assets/calibration/proposal_draft.h"

namespace ego {
namespace {

using S = SamplePoint;

void Lower(CalibrationPoint& point, double factor, const char* reason) {
  if (point.state == PickState::kMissing || factor >= 1.0) return;
  point.confidence *= factor;
  if (factor < 0.8) point.reason = reason;
  if (point.confidence < kDoubtBelow) point.state = PickState::kDoubtful;
}

/// From 1 below `from` falling to `least` at `to`.
double Fall(double value, double from, double to, double least) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return 1.0 - (1.0 - least) * t;
}

/// Where the other points of a mesh say that a point is: the affine map of the template that fits
/// them best, each as much as it is believed, drawn towards the template itself where they say
/// little (a ridge on the linear part).
class Others {
 public:
  Others(const ProposalDraft& draft, std::size_t begin, std::size_t end)
      : draft_(draft), begin_(begin), end_(end) {
    for (std::size_t i = begin; i < end; ++i) {
      middle_ += draft.TemplateAt(static_cast<S>(i)) / static_cast<double>(end - begin);
    }
  }

  Vec3 Expect(std::size_t point) const {
    const double height = draft_.template_body.height;
    Mat4 normal{0.0};
    std::array<Vec4, 3> right{};
    for (std::size_t i = begin_; i < end_; ++i) {
      if (i == point) continue;
      const auto p = static_cast<S>(i);
      const double confidence = draft_.calibration.sample[i].confidence;
      const double weight = confidence * confidence;
      const Vec4 x = Basis(p);
      const Vec3 shift = (draft_.At(p) - draft_.TemplateAt(p)) / height;
      normal += weight * glm::outerProduct(x, x);
      for (int axis = 0; axis < 3; ++axis) {
        right[static_cast<std::size_t>(axis)] += weight * shift[axis] * x;
      }
    }
    constexpr double kRidge = 0.02;
    for (int k = 0; k < 3; ++k) normal[k][k] += kRidge;
    normal[3][3] += 1e-9;
    const Mat4 inverse = glm::inverse(normal);
    const Vec4 x = Basis(static_cast<S>(point));
    Vec3 shift;
    for (int axis = 0; axis < 3; ++axis) {
      shift[axis] = glm::dot(inverse * right[static_cast<std::size_t>(axis)], x);
    }
    return draft_.TemplateAt(static_cast<S>(point)) + height * shift;
  }

 private:
  Vec4 Basis(S p) const {
    return Vec4((draft_.TemplateAt(p) - middle_) / (0.2 * draft_.template_body.height), 1.0);
  }
  const ProposalDraft& draft_;
  std::size_t begin_;
  std::size_t end_;
  Vec3 middle_{0.0};
};

/// How much of a point's place the skin itself decides: a heel is where it is lowest, an ear's
/// opening is a share of the head's height. 1 for what can be seen, less for what is measured off.
double Definition(S point) {
  switch (point) {
    case S::kNavel:
    case S::kPubis:
    case S::kNapeBase:
    case S::kSacrum:
    case S::kLeftHipSide:
    case S::kRightHipSide:
    case S::kLeftEar:
    case S::kRightEar:
    case S::kLeftCheek:
    case S::kRightCheek:
    case S::kChin:
    case S::kLeftBellySide:
    case S::kRightBellySide:
    case S::kLeftWaistSide:
    case S::kRightWaistSide:
    case S::kLeftShoulderTop:
    case S::kRightShoulderTop:
      return 0.6;
    case S::kLeftChest:
    case S::kRightChest:
    case S::kLeftRibs:
    case S::kRightRibs:
    case S::kLeftShoulderBlade:
    case S::kRightShoulderBlade:
    case S::kLowerBack:
    case S::kCrown:
      return 0.85;
    default:
      return 1.0;
  }
}

void Temper(CalibrationPoint& point, double definition) {
  // Only what is believed is believed less: definition alone makes nothing doubtful.
  if (point.confidence > kDoubtBelow) {
    point.confidence = kDoubtBelow + (point.confidence - kDoubtBelow) * definition;
  }
}

}  // namespace

void JudgeAgainstOthers(ProposalDraft& draft) {
  const double height = draft.template_body.height;
  std::array<double, kSampleCount> off{};
  for (const auto& [begin, end] :
       {std::pair(std::size_t{0}, kTrunkSampleCount), std::pair(kTrunkSampleCount, kSampleCount)}) {
    const Others others(draft, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      off[i] = glm::distance(others.Expect(i), draft.At(static_cast<S>(i))) / height;
    }
  }
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    Lower(draft.calibration.sample[i], Fall(off[i], 0.035, 0.11, 0.4),
          "it lies away from where the other points say");
  }
  for (FootCalibration& foot : draft.calibration.foot) {
    for (CalibrationPoint* point : {&foot.heel, &foot.ball}) {
      if (point->state == PickState::kMissing) continue;
      const double rise = draft.probe.PositionOf(point->place).y / height;
      Lower(*point, Fall(rise, 0.01, 0.03, 0.4), "it lies above the ground");
    }
  }
}

void TemperConfidence(ProposalDraft& draft) {
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    Temper(draft.calibration.sample[i], Definition(static_cast<S>(i)));
  }
  for (HandCalibration& hand : draft.calibration.hand) {
    Temper(hand.palm, 0.6);
    Temper(hand.back_of_hand, 0.6);
  }
}

}  // namespace ego
