// SPDX-License-Identifier: MIT
#pragma once

#include "assets/people/figure_builder.h"
#include "assets/people/person_shape.h"

namespace ego {

/// Eyes, brows and mouth, set on the finished skin of the head.
void AddFace(const PersonShape& shape, FigureBuilder& figure);

}  // namespace ego
