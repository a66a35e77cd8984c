// SPDX-License-Identifier: MIT
#include "assets/mesh/half_edges.h"

#include <algorithm>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace ego {
namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Whether a face with these corners in this order can be joined to the mesh.
bool CanJoin(const Mesh& mesh, const std::array<VertexHandle, 3>& corner) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!mesh.is_boundary(corner[k])) return false;
    const HalfedgeHandle edge = mesh.find_halfedge(corner[k], corner[(k + 1) % 3]);
    if (edge.is_valid() && !mesh.is_boundary(edge)) return false;
  }
  return true;
}

}  // namespace

struct HalfEdges::Impl {
  Mesh mesh;
  std::vector<std::array<VertexHandle, 3>> corner;  // per triangle, in its own order
  std::vector<FaceHandle> face;                     // per triangle; invalid when degenerate
  std::vector<std::uint32_t> triangle_of;           // per face
  std::vector<std::uint32_t> vertex_of;             // per mesh vertex, copies included
  std::vector<std::vector<VertexHandle>> copies;    // per vertex

  VertexHandle AddCopy(std::uint32_t vertex) {
    const VertexHandle handle = mesh.add_vertex({0.0f, 0.0f, 0.0f});
    vertex_of.push_back(vertex);
    copies[vertex].push_back(handle);
    return handle;
  }

  void Add(const std::array<std::uint32_t, 3>& triangle) {
    std::array<VertexHandle, 3>& at = corner.emplace_back();
    face.emplace_back();
    const auto& t = triangle;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    for (std::size_t k = 0; k < 3; ++k) at[k] = copies[t[k]].front();
    FaceHandle added;
    if (CanJoin(mesh, at)) {
      added = mesh.add_face(at[0], at[1], at[2]);
    } else if (CanJoin(mesh, {at[0], at[2], at[1]})) {
      added = mesh.add_face(at[0], at[2], at[1]);
    }
    if (!added.is_valid()) {
      for (std::size_t k = 0; k < 3; ++k) at[k] = AddCopy(t[k]);
      added = mesh.add_face(at[0], at[1], at[2]);
    }
    face.back() = added;
    triangle_of.push_back(static_cast<std::uint32_t>(corner.size() - 1));
  }
};

HalfEdges::HalfEdges(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                     std::size_t vertex_count)
    : impl_(std::make_unique<Impl>()) {
  // What cannot be joined is expected here, and no news for the terminal.
  static const bool quiet = (::omerr().disable(), true);
  static_cast<void>(quiet);
  impl_->mesh.reserve(vertex_count, 3 * vertex_count, triangles.size());
  impl_->copies.resize(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) impl_->AddCopy(v);
  impl_->corner.reserve(triangles.size());
  impl_->face.reserve(triangles.size());
  for (const auto& triangle : triangles) impl_->Add(triangle);
}
HalfEdges::~HalfEdges() = default;
HalfEdges::HalfEdges(HalfEdges&&) noexcept = default;
HalfEdges& HalfEdges::operator=(HalfEdges&&) noexcept = default;

std::optional<HalfEdges::FaceEdge> HalfEdges::Across(FaceEdge from) const {
  const FaceHandle face = impl_->face[from.face];
  if (!face.is_valid()) return std::nullopt;
  const Mesh& mesh = impl_->mesh;
  const VertexHandle a = impl_->corner[from.face][static_cast<std::size_t>(from.edge)];
  const VertexHandle b = impl_->corner[from.face][static_cast<std::size_t>((from.edge + 1) % 3)];
  HalfedgeHandle edge = mesh.find_halfedge(a, b);
  if (edge.is_valid() && mesh.face_handle(edge) == face) edge = mesh.opposite_halfedge_handle(edge);
  if (!edge.is_valid() || !mesh.face_handle(edge).is_valid()) return std::nullopt;
  FaceEdge to{impl_->triangle_of[static_cast<std::size_t>(mesh.face_handle(edge).idx())], 0};
  const auto& corner = impl_->corner[to.face];
  for (; to.edge < 3; ++to.edge) {
    const VertexHandle c = corner[static_cast<std::size_t>(to.edge)];
    const VertexHandle d = corner[static_cast<std::size_t>((to.edge + 1) % 3)];
    if ((c == a && d == b) || (c == b && d == a)) return to;
  }
  return std::nullopt;
}

std::vector<std::uint32_t> HalfEdges::Neighbours(std::uint32_t vertex) const {
  std::vector<std::uint32_t> all;
  for (const VertexHandle copy : impl_->copies[vertex]) {
    for (const VertexHandle other : impl_->mesh.vv_range(copy)) {
      all.push_back(impl_->vertex_of[static_cast<std::size_t>(other.idx())]);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::uint32_t> HalfEdges::FacesAround(std::uint32_t vertex) const {
  std::vector<std::uint32_t> all;
  for (const VertexHandle copy : impl_->copies[vertex]) {
    for (const FaceHandle face : impl_->mesh.vf_range(copy)) {
      all.push_back(impl_->triangle_of[static_cast<std::size_t>(face.idx())]);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool HalfEdges::OnBoundary(std::uint32_t vertex) const {
  for (const VertexHandle copy : impl_->copies[vertex]) {
    if (!impl_->mesh.is_isolated(copy) && impl_->mesh.is_boundary(copy)) return true;
  }
  return false;
}

}  // namespace ego
