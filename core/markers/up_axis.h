// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/math.h"

namespace ego {

/// An axis of a file's coordinate system, with its sense.
enum class SignedAxis : std::uint8_t { kPlusX, kMinusX, kPlusY, kMinusY, kPlusZ, kMinusZ };

Vec3 Direction(SignedAxis axis);
/// "+Z".
std::string_view Name(SignedAxis axis);
/// Reads "+Z", "Z", "-y"; nothing for anything else.
std::optional<SignedAxis> SignedAxisNamed(std::string_view name);

/// The rotation (determinant +1, whole quarter turns) that brings `up` to +Y. For +Z it is
/// (x, y, z) -> (x, z, -y).
Mat3 RotationToYUp(SignedAxis up);

/// A label as marker sets compare it: without the subject's prefix (up to the last colon), upper
/// case, letters and digits only: "Nick01:LFHD" -> "LFHD", "R.Heel" -> "RHEEL".
std::string PlainLabel(std::string_view label);

/// Which way is up, as the markers themselves tell it.
struct UpEvidence {
  SignedAxis axis = SignedAxis::kPlusY;
  double agreement = 0.0;  // mean cosine between the axis and (upper body - feet), 0 to 1
};

/// Looks for markers of the head and trunk (else the pelvis) and of the feet by their usual labels
/// and takes the axis along which the former lie above the latter over the take. Nothing when the
/// labels do not tell both groups apart or they are never visible together. `position` and
/// `visible` hold frame after frame, one entry per label.
std::optional<UpEvidence> UpFromMarkers(std::span<const std::string> labels,
                                        std::span<const Vec3> position,
                                        std::span<const std::uint8_t> visible);

}  // namespace ego
