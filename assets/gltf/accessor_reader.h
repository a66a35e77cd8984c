// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace tinygltf {
class Model;
}

namespace ego {

/// Largest number of elements of an accessor that is read.
inline constexpr std::size_t kMaxElements = std::size_t{1} << 24;

/// The numbers of an accessor, element by element, `components` each. Strides, sparse values and
/// normalised integers are resolved; integers that are not normalised keep their value. `what`
/// begins the sentence of an error ("mesh 'Body', POSITION"). Errors: no such accessor, another
/// number of components, data out of range, a number that is not finite.
Result<std::vector<float>> ReadNumbers(const tinygltf::Model& model, int accessor, int components,
                                       const std::string& what);

/// Unsigned integers (indices, joints) of an accessor; errors as above.
Result<std::vector<std::uint32_t>> ReadIntegers(const tinygltf::Model& model, int accessor,
                                                int components, const std::string& what);

}  // namespace ego
