// SPDX-License-Identifier: MIT
#include "assets/gltf/meshopt_view.h"

#include <meshoptimizer.h>

namespace ego {

std::optional<std::vector<std::uint8_t>> DecodeMeshopt(const MeshoptView& view,
                                                       std::span<const std::uint8_t> data) {
  // A byte of data can describe many elements, but not arbitrarily many.
  constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
  if (view.count == 0 || view.stride == 0 || view.stride > 256 ||
      view.count > kMaxBytes / view.stride || view.count / 4096 > data.size()) {
    return {};
  }
  std::vector<std::uint8_t> out(view.count * view.stride);
  int failed = 1;
  // The library asserts what is checked here.
  if (view.mode == "ATTRIBUTES" && view.stride % 4 == 0) {
    failed =
        meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, data.data(), data.size());
  } else if (view.mode == "TRIANGLES" && view.count % 3 == 0 &&
             (view.stride == 2 || view.stride == 4)) {
    failed =
        meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, data.data(), data.size());
  } else if (view.mode == "INDICES" && (view.stride == 2 || view.stride == 4)) {
    failed =
        meshopt_decodeIndexSequence(out.data(), view.count, view.stride, data.data(), data.size());
  }
  if (failed != 0) return {};
  if (view.filter.empty() || view.filter == "NONE") return out;
  if (view.mode != "ATTRIBUTES") return {};
  if (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) {
    meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  } else if (view.filter == "QUATERNION" && view.stride == 8) {
    meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL" && view.stride % 4 == 0) {
    meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  } else {
    return {};
  }
  return out;
}

}  // namespace ego
