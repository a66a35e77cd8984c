// SPDX-License-Identifier: MIT
#include "assets/motions/hand_form.h"

#include "core/base/math.h"

namespace ego {
namespace {

/// Degrees at knuckle and middle joint: thumb, index, middle, ring, little.
constexpr std::array<std::array<HandShape::Digit, HandShape::kDigits>, 7> kDegrees = {{
    {{{14, 12}, {16, 22}, {20, 27}, {23, 30}, {25, 30}}},  // relaxed
    {},                                                    // flat
    {},                                                    // laid
    {{{48, 55}, {82, 98}, {84, 98}, {84, 96}, {82, 94}}},  // fist
    {{{46, 50}, {4, 6}, {78, 96}, {82, 96}, {82, 94}}},    // point
    {{{34, 28}, {52, 62}, {58, 66}, {62, 66}, {64, 64}}},  // grip
    {{{30, 8}, {14, 34}, {62, 72}, {66, 72}, {68, 70}}},   // trigger
}};

}  // namespace

HandShape ShapeOf(HandForm form) {
  HandShape shape;
  for (std::size_t d = 0; d < HandShape::kDigits; ++d) {
    const HandShape::Digit& degrees = kDegrees[static_cast<std::size_t>(form)][d];
    shape.digit[d] = {Radians(degrees.bend), Radians(degrees.curl)};
  }
  return shape;
}

}  // namespace ego
