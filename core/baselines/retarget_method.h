// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// A way to bring a performer's posture to other bodies. One object serves one performer; the
/// posture is read once per frame and adapted to any number of avatars.
///
/// History-free: `Adapt` depends on the last `SetPerformerPose` and the avatar alone, bit for bit.
/// Neither call allocates after construction.
class RetargetMethod {
 public:
  virtual ~RetargetMethod() = default;
  virtual std::string_view name() const = 0;

  /// Reads one posture. `performer` must outlive the following `Adapt` calls.
  virtual void SetPerformerPose(const Body& performer, const Pose& pose) = 0;

  /// Writes the posture on `avatar`; fingers bend as the performer's. May be called from several
  /// threads at once for different outputs.
  virtual void Adapt(const Body& avatar, Pose& out) const = 0;
};

/// The names that `MakeRetargetMethod` knows, the default ("mdb") first.
std::span<const std::string_view> RetargetMethodNames();

/// "mdb": the egocentric method with the measured remedies; "paper": the closest reading of the
/// text; "copy": joint angles alone. Null for an unknown name.
std::unique_ptr<RetargetMethod> MakeRetargetMethod(std::string_view name);

}  // namespace ego
