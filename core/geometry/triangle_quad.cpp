// SPDX-License-Identifier: MIT
#include "core/geometry/triangle_quad.h"

namespace ego {

TriangleQuad MakeTriangleQuad(const QuadVectors& a, const QuadVectors& b, const QuadVectors& c) {
  TriangleQuad quad;
  for (const std::size_t first : {0, 2}) {
    Store<Lanes>(
        MakeTriangles<Lanes>(Load<Lanes>(a, first), Load<Lanes>(b, first), Load<Lanes>(c, first)),
        quad, first);
  }
  return quad;
}

}  // namespace ego
