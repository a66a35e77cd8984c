// SPDX-License-Identifier: MIT
#include "assets/people/polygonise.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/check.h"

namespace ego {
namespace {

using Quad = std::array<std::uint32_t, 4>;

class Samples {
 public:
  Samples(const ImplicitSurface& surface, const SampleLattice& lattice)
      : lattice_(lattice),
        size_{lattice.x.size(), lattice.y.size(), lattice.z.size()},
        value_(size_[0] * size_[1] * size_[2], 1.0) {
    EGO_CHECK(size_[0] > 2 && size_[1] > 2 && size_[2] > 2);
    Fill(surface);
    MakeWellComposed();
  }

  std::size_t size(std::size_t axis) const { return size_[axis]; }
  std::size_t At(std::size_t i, std::size_t j, std::size_t k) const {
    return (i * size_[1] + j) * size_[2] + k;
  }
  double value(std::size_t at) const { return value_[at]; }
  bool Inside(std::size_t at) const { return value_[at] < 0.0; }
  Vec3 Place(std::size_t i, std::size_t j, std::size_t k) const {
    return lattice_.place({lattice_.x[i], lattice_.y[j], lattice_.z[k]});
  }
  /// The eight corners of a cell; corner c is at (c & 1, c >> 1 & 1, c >> 2).
  std::array<std::size_t, 8> Corners(std::size_t i, std::size_t j, std::size_t k) const {
    std::array<std::size_t, 8> at{};
    for (std::size_t c = 0; c < 8; ++c) at[c] = At(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    return at;
  }

 private:
  void Fill(const ImplicitSurface& surface) {
    constexpr std::size_t kBlock = 4;
    // The surface functions overestimate distances by less than this.
    constexpr double kSlack = 2.2;
    for (std::size_t i = 0; i < size_[0]; i += kBlock) {
      for (std::size_t j = 0; j < size_[1]; j += kBlock) {
        for (std::size_t k = 0; k < size_[2]; k += kBlock) {
          const std::size_t i1 = std::min(i + kBlock, size_[0]);
          const std::size_t j1 = std::min(j + kBlock, size_[1]);
          const std::size_t k1 = std::min(k + kBlock, size_[2]);
          const Vec3 low = Place(i, j, k);
          const Vec3 high = Place(i1 - 1, j1 - 1, k1 - 1);
          const double middle = surface(0.5 * (low + high));
          const bool near = std::abs(middle) < kSlack * 0.5 * glm::distance(low, high);
          for (std::size_t a = i; a < i1; ++a) {
            for (std::size_t b = j; b < j1; ++b) {
              for (std::size_t c = k; c < k1; ++c) {
                const bool rim = OnRim(At(a, b, c));
                const double value = near ? surface(Place(a, b, c)) : middle;
                value_[At(a, b, c)] = rim ? std::max(value, 1e-9) : value;
              }
            }
          }
        }
      }
    }
  }

  void MakeWellComposed() {
    constexpr std::array<std::array<std::size_t, 4>, 6> kFaces = {
        {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
    bool changed = true;
    while (changed) {
      changed = false;
      for (std::size_t i = 0; i + 1 < size_[0]; ++i) {
        for (std::size_t j = 0; j + 1 < size_[1]; ++j) {
          for (std::size_t k = 0; k + 1 < size_[2]; ++k) {
            const std::array<std::size_t, 8> at = Corners(i, j, k);
            unsigned inside = 0;
            for (std::size_t c = 0; c < 8; ++c) inside |= Inside(at[c]) ? 1u << c : 0u;
            if (inside == 0u || inside == 255u) continue;
            for (const auto& f : kFaces) {
              const bool a = inside >> f[0] & 1u;
              const bool b = inside >> f[1] & 1u;
              if (a == b || a != (inside >> f[2] & 1u) || b != (inside >> f[3] & 1u)) continue;
              TurnInside(at[a ? f[1] : f[0]], at[a ? f[3] : f[2]]);
              changed = true;
              break;
            }
            if (changed) continue;
            const unsigned few = std::popcount(inside) == 2 ? inside : ~inside & 255u;
            if (std::popcount(few) == 2 && std::countr_zero(few) + std::bit_width(few) - 1 == 7) {
              const std::size_t c = static_cast<std::size_t>(std::countr_zero(few));
              TurnInside(at[few == inside ? c ^ 1u : c], at[few == inside ? c ^ 2u : c ^ 7u]);
              changed = true;
            }
          }
        }
      }
    }
  }

  /// The outermost two layers: always outside, so that the surface ends within the lattice.
  bool OnRim(std::size_t at) const {
    const std::size_t k = at % size_[2];
    const std::size_t j = at / size_[2] % size_[1];
    const std::size_t i = at / size_[2] / size_[1];
    return i < 2 || j < 2 || k < 2 || i + 2 >= size_[0] || j + 2 >= size_[1] || k + 2 >= size_[2];
  }

  /// Turns the one of two outside samples that is closer to the surface, never one of the rim.
  void TurnInside(std::size_t a, std::size_t b) {
    const bool first = OnRim(b) || (value_[a] <= value_[b] && !OnRim(a));
    value_[first ? a : b] = -1e-9;
  }

  const SampleLattice& lattice_;
  std::array<std::size_t, 3> size_;
  std::vector<double> value_;
};

/// Gradient at a point whose value is known, by forward differences.
Vec3 Gradient(const ImplicitSurface& f, const Vec3& p, double value) {
  constexpr double h = 2e-5;
  return Vec3{f(p + Vec3{h, 0, 0}) - value, f(p + Vec3{0, h, 0}) - value,
              f(p + Vec3{0, 0, h}) - value} /
         h;
}

struct Net {
  std::vector<Vec3> vertices;
  std::vector<Quad> quads;
};

Net NetOf(const Samples& samples) {
  Net net;
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> cell(samples.size(0) * samples.size(1) * samples.size(2), kNone);
  constexpr std::array<std::array<std::size_t, 2>, 12> kEdges = {{{0, 1},
                                                                  {2, 3},
                                                                  {4, 5},
                                                                  {6, 7},
                                                                  {0, 2},
                                                                  {1, 3},
                                                                  {4, 6},
                                                                  {5, 7},
                                                                  {0, 4},
                                                                  {1, 5},
                                                                  {2, 6},
                                                                  {3, 7}}};
  for (std::size_t i = 0; i + 1 < samples.size(0); ++i) {
    for (std::size_t j = 0; j + 1 < samples.size(1); ++j) {
      for (std::size_t k = 0; k + 1 < samples.size(2); ++k) {
        const std::array<std::size_t, 8> at = samples.Corners(i, j, k);
        Vec3 sum{0.0};
        int crossings = 0;
        for (const auto& [a, b] : kEdges) {
          if (samples.Inside(at[a]) == samples.Inside(at[b])) continue;
          const double va = samples.value(at[a]);
          const double t = std::clamp(va / (va - samples.value(at[b])), 0.05, 0.95);
          const Vec3 pa = samples.Place(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
          const Vec3 pb = samples.Place(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2));
          sum += pa + t * (pb - pa);
          ++crossings;
        }
        if (crossings == 0) continue;
        cell[at[0]] = static_cast<std::uint32_t>(net.vertices.size());
        net.vertices.push_back(sum / static_cast<double>(crossings));
      }
    }
  }
  // One quad around each lattice edge that the surface crosses.
  const std::array<std::size_t, 3> stride = {samples.size(1) * samples.size(2), samples.size(2), 1};
  for (std::size_t i = 1; i + 1 < samples.size(0); ++i) {
    for (std::size_t j = 1; j + 1 < samples.size(1); ++j) {
      for (std::size_t k = 1; k + 1 < samples.size(2); ++k) {
        const std::size_t at = samples.At(i, j, k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool inside = samples.Inside(at);
          if (inside == samples.Inside(at + stride[axis])) continue;
          const std::size_t u = stride[(axis + 1) % 3];
          const std::size_t v = stride[(axis + 2) % 3];
          Quad quad = {cell[at - u - v], cell[at - v], cell[at], cell[at - u]};
          if (!inside) std::swap(quad[1], quad[3]);
          net.quads.push_back(quad);
        }
      }
    }
  }
  return net;
}

/// Moves vertices along the surface towards the middle of their neighbours.
void EvenOut(const ImplicitSurface& surface, Net& net, int rounds) {
  std::vector<Vec3> sum(net.vertices.size());
  std::vector<double> count(net.vertices.size());
  for (int round = 0; round < rounds; ++round) {
    std::fill(sum.begin(), sum.end(), Vec3(0.0));
    std::fill(count.begin(), count.end(), 0.0);
    for (const Quad& q : net.quads) {
      for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t a = q[c];
        const std::uint32_t b = q[(c + 1) % 4];
        sum[a] += net.vertices[b];
        sum[b] += net.vertices[a];
        count[a] += 1.0;
        count[b] += 1.0;
      }
    }
    for (std::size_t v = 0; v < net.vertices.size(); ++v) {
      Vec3& p = net.vertices[v];
      const Vec3 g = Gradient(surface, p, surface(p));
      const double size = glm::length(g);
      const Vec3 normal = size > 1e-9 ? g / size : kUp;
      Vec3 move = sum[v] / count[v] - p;
      const double bound = glm::length(move);
      move -= normal * glm::dot(normal, move);
      p = DrawOnto(surface, p + 0.5 * move, bound + 1e-4, 1);
    }
  }
}

/// How far a triangle is from degenerate: twice its area over its longest edge squared.
double Shape(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest =
      std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a), 1e-12});
  return glm::length(glm::cross(b - a, c - a)) / (longest * longest);
}

}  // namespace

Vec3 DrawOnto(const ImplicitSurface& f, Vec3 p, double bound, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double value = f(p);
    if (std::abs(value) < 1e-6) break;
    const Vec3 g = Gradient(f, p, value);
    const Vec3 step = g * (value / std::max(glm::dot(g, g), 0.05));
    p -= step * std::min(1.0, bound / std::max(glm::length(step), 1e-12));
  }
  return p;
}

SampleLattice UniformLattice(const Vec3& low, const Vec3& high, double cell) {
  SampleLattice lattice;
  const std::array<std::vector<double>*, 3> planes = {&lattice.x, &lattice.y, &lattice.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double length = high[axis] - low[axis];
    const int count = std::max(3, static_cast<int>(std::ceil(length / cell)));
    for (int i = -2; i <= count + 2; ++i) {
      planes[static_cast<std::size_t>(axis)]->push_back(low[axis] + length * i / count);
    }
  }
  return lattice;
}

ClosedMesh Polygonise(const ImplicitSurface& surface, const SampleLattice& lattice) {
  const Samples samples(surface, lattice);
  Net net = NetOf(samples);
  EvenOut(surface, net, 4);
  for (Vec3& p : net.vertices) p = DrawOnto(surface, p, 2e-3, 3);

  ClosedMesh mesh;
  mesh.positions = std::move(net.vertices);
  mesh.triangles.reserve(2 * net.quads.size());
  for (const Quad& q : net.quads) {
    const auto p = [&](std::size_t c) { return mesh.positions[q[c]]; };
    const double along02 = std::min(Shape(p(0), p(1), p(2)), Shape(p(0), p(2), p(3)));
    const double along13 = std::min(Shape(p(0), p(1), p(3)), Shape(p(1), p(2), p(3)));
    if (along02 >= along13) {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh.triangles.push_back({q[0], q[1], q[3]});
      mesh.triangles.push_back({q[1], q[2], q[3]});
    }
  }
  return mesh;
}

}  // namespace ego
