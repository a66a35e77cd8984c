// SPDX-License-Identifier: MIT
#include "render/stage_meshes.h"

#include <cmath>

#include "core/base/math.h"

namespace ego {

CapsuleMesh MakeCapsuleMesh(int slices, int rings) {
  CapsuleMesh mesh;
  // Rings from the pole of end 0 over both equators to the pole of end 1; poles are rings too.
  for (int end = 0; end < 2; ++end) {
    for (int k = 0; k <= rings; ++k) {
      const double step = 0.5 * kPi * k / rings;
      const double angle = end == 0 ? step - 0.5 * kPi : step;
      for (int i = 0; i < slices; ++i) {
        const double turn = 2.0 * kPi * i / slices;
        mesh.points.emplace_back(std::cos(angle) * std::sin(turn), std::sin(angle),
                                 std::cos(angle) * std::cos(turn), end);
      }
    }
  }
  const int count = 2 * (rings + 1);
  for (int r = 0; r + 1 < count; ++r) {
    for (int i = 0; i < slices; ++i) {
      const auto id = [&](int ring, int slice) {
        return static_cast<std::uint16_t>(ring * slices + slice % slices);
      };
      const bool from_pole = r == 0;
      const bool to_pole = r + 2 == count;
      if (!from_pole) {
        mesh.indices.insert(mesh.indices.end(), {id(r, i), id(r, i + 1), id(r + 1, i)});
      }
      if (!to_pole) {
        mesh.indices.insert(mesh.indices.end(), {id(r, i + 1), id(r + 1, i + 1), id(r + 1, i)});
      }
    }
  }
  return mesh;
}

}  // namespace ego
