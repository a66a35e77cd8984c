// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "assets/motions/motion_script.h"
#include "assets/people/person.h"
#include "core/base/result.h"
#include "core/model/character.h"

namespace ego {

/// Draws motions as strips: one row for each person, one column for each of `columns` instants
/// spread over the motion, or over its touches where there are far more of them. The first person
/// performs, the others follow by `method`.
class MotionStrips {
 public:
  struct Look {
    int columns = 8;
    int cell_height = 150;  // pixels
    double yaw = 0.0;       // degrees that the camera stands to the performer's left
  };

  /// Fails where this machine cannot draw. Keeps references to the people.
  static Result<MotionStrips> Create(const std::vector<const Person*>& people,
                                     std::string_view method);
  MotionStrips(MotionStrips&&) noexcept;
  MotionStrips& operator=(MotionStrips&&) noexcept;
  ~MotionStrips();

  Result<Image> Draw(const MotionScript& script, const Look& look);

 private:
  struct Impl;
  explicit MotionStrips(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
