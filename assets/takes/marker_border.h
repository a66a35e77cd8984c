// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/markers/marker_take.h"
#include "core/markers/up_axis.h"

namespace ego {

/// The border that every marker file crosses: which of its points are markers, and from its units
/// and axes to metres with Y up.

/// Length of a unit by its name ("mm", "MM", "meters", "inch"); nothing when it is unknown.
std::optional<double> MetresPerUnit(std::string_view unit);

/// One flag per label: 1 where the point is a model output and no marker: angles, forces, moments,
/// powers, virtual joint centres, projected points, bone axes (the same name with the endings O,
/// A, L, P, or 0 to 3 in files that hold other outputs). `declared` lists labels that the file
/// itself names as outputs.
std::vector<std::uint8_t> FindModelOutputs(std::span<const std::string> labels,
                                           std::span<const std::string> declared);

/// Makes labels fit for use: cleans their text, calls nameless points "*1", "*2", ... after their
/// place in the file, and adds "#2", "#3", ... to repeated ones so that a label names one point.
void MakeLabelsUnique(std::vector<std::string>& labels, std::vector<std::string>& warnings);

/// Turns a take from file units and axes into metres and Y up, in place. Points that are not
/// finite, lie farther than 1 km or exactly at the origin become not visible; points that are not
/// visible get the position zero. `declared_up` is the file's own word, believed only where the
/// labels tell nothing; `usual_up` is the format's habit, used when nobody knows.
void ConvertToStage(MarkerTake& take, std::string_view unit, std::optional<SignedAxis> declared_up,
                    SignedAxis usual_up);

}  // namespace ego
