// SPDX-License-Identifier: MIT
#include "assets/mesh/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "assets/mesh/half_edges.h"
#include "tests/support/capsule_person.h"

namespace ego {
namespace {

/// A character that is one mesh on one joint, places given.
Character Shape(const std::vector<glm::vec3>& positions,
                const std::vector<std::uint32_t>& triangles) {
  Character character;
  character.nodes.joints.emplace_back();
  character.palette.emplace_back();
  MeshPart& part = character.parts.emplace_back();
  part.positions = positions;
  part.influences.resize(positions.size());
  for (auto& influences : part.influences) influences.weight[0] = 1.0f;
  part.triangles = triangles;
  character.rig.node.fill(-1);
  character.rig.driver = {HumanoidJoint::kHips};
  character.rig.canonical_global = {Mat4{1.0}};
  return character;
}

/// A tube around the y axis, open at both ends, cut open along a seam whose vertices are double.
Character Tube(double radius, double height, std::uint32_t around, std::uint32_t up) {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t j = 0; j <= up; ++j) {
    for (std::uint32_t i = 0; i <= around; ++i) {  // the last column lies on the first
      const double angle = 2.0 * std::numbers::pi * (i % around) / around;
      positions.emplace_back(radius * std::cos(angle), height * j / up, radius * std::sin(angle));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (around + 1) + i; };
  for (std::uint32_t j = 0; j < up; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      triangles.insert(triangles.end(), {at(i, j), at(i, j + 1), at(i + 1, j)});
      triangles.insert(triangles.end(), {at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  return Shape(positions, triangles);
}

TEST(HalfEdges, JoinWhatCanBeJoinedWhateverTheWinding) {
  // Two triangles of a square, the second wound the other way; a third one on their edge.
  const HalfEdges edges({{0, 1, 2}, {0, 2, 3}, {0, 2, 4}, {1, 1, 2}}, 5);
  const auto across = edges.Across({0, 2});
  ASSERT_TRUE(across);
  EXPECT_EQ(across->face, 1u);
  EXPECT_FALSE(edges.Across({0, 0}));
  EXPECT_FALSE(edges.Across({2, 0}));  // a third at an edge stands alone
  EXPECT_FALSE(edges.Across({3, 0}));  // no triangle at all
  EXPECT_EQ(edges.Neighbours(0), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(edges.FacesAround(2), (std::vector<std::uint32_t>{0, 1, 2}));
  const HalfEdges against({{0, 1, 2}, {0, 3, 2}}, 4);
  ASSERT_TRUE(against.Across({0, 2}));
  EXPECT_EQ(against.Across({0, 2})->edge, 2);
}

TEST(SurfaceMesh, WeldsSeamsAndKnowsWhereTheSurfaceEnds) {
  const SurfaceMesh mesh(Tube(0.1, 1.0, 12, 5));
  EXPECT_EQ(mesh.VertexCount(), 12u * 6u);
  EXPECT_EQ(mesh.TriangleCount(), 12u * 5u * 2u);
  std::size_t boundary = 0;
  for (SurfaceMesh::Vertex v = 0; v < mesh.VertexCount(); ++v) {
    const double y = mesh.Position(v).y;
    EXPECT_EQ(mesh.OnBoundary(v), y < 0.01 || y > 0.99);
    boundary += mesh.OnBoundary(v);
    EXPECT_EQ(mesh.Neighbours(v).size(), mesh.OnBoundary(v) ? 4u : 6u);
    EXPECT_EQ(*mesh.VertexAt(mesh.PlaceOf(v)), v);
    EXPECT_EQ(*mesh.Nearest(mesh.Position(v) * 1.02), v);
    const Vec3 outward = glm::normalize(Vec3{mesh.Position(v).x, 0.0, mesh.Position(v).z});
    EXPECT_GT(glm::dot(mesh.Normal(v), outward), 0.8);
  }
  EXPECT_EQ(boundary, 24u);
}

TEST(SurfaceMesh, StepsFollowTheArrowAndStopAtTheEdge) {
  const Character tube = Tube(0.1, 1.0, 12, 5);
  const SurfaceMesh mesh(tube);
  const PosedMesh posed = CanonicalMesh(tube);
  MeshPoint place = mesh.PlaceOf(*mesh.Nearest({0.1, 0.0, 0.0}));
  for (int i = 1; i <= 5; ++i) {
    const auto next = mesh.Step(place, {0.3, 1.0, 0.0}, posed);  // outward does not count
    ASSERT_TRUE(next);
    place = *next;
    EXPECT_LT(glm::distance(mesh.Position(*mesh.VertexAt(place)), Vec3{0.1, 0.2 * i, 0.0}), 1e-6);
  }
  EXPECT_FALSE(mesh.Step(place, {0.0, 1.0, 0.0}, posed));
  EXPECT_FALSE(mesh.Step(place, {0.0, 0.0, 0.0}, posed));
  // Around the seam: as many steps as there are columns lead back.
  const MeshPoint start = place;
  for (int i = 0; i < 12; ++i) {
    const Vec3 at = mesh.Position(*mesh.VertexAt(place));
    const auto next = mesh.Step(place, {-at.z, 0.0, at.x}, posed);
    ASSERT_TRUE(next);
    place = *next;
  }
  EXPECT_EQ(mesh.VertexAt(place), mesh.VertexAt(start));
}

TEST(SurfaceMesh, AWalkIsStraightOnTheUnfoldedSurface) {
  // On a fine tube the straightest line is a helix.
  const double radius = 0.1;
  const Character tube = Tube(radius, 1.0, 96, 60);
  const SurfaceMesh mesh(tube);
  const PosedMesh posed = CanonicalMesh(tube);
  const MeshPoint start = mesh.PlaceOf(*mesh.Nearest({radius, 0.2, 0.0}));
  const MeshPoint end = mesh.Walk(start, {0.0, 0.4, 0.3}, posed);
  const Vec3 at = Position(tube, posed, end);
  EXPECT_NEAR(at.y, 0.6, 0.003);
  const double angle = 0.3 / radius;
  EXPECT_LT(glm::distance(at, Vec3{radius * std::cos(angle), at.y, radius * std::sin(angle)}),
            0.006);
  // Back by the way it came: the same way in the plane there, turned about.
  const Vec3 back = {0.3 * std::sin(angle), -0.4, -0.3 * std::cos(angle)};
  EXPECT_LT(
      glm::distance(Position(tube, posed, mesh.Walk(end, back, posed)), Vec3{radius, 0.2, 0.0}),
      0.006);
  // It ends at the edge of the mesh, and a way straight out leads nowhere.
  EXPECT_NEAR(Position(tube, posed, mesh.Walk(start, {0.0, 9.0, 0.0}, posed)).y, 1.0, 1e-6);
  EXPECT_LT(glm::distance(Position(tube, posed, mesh.Walk(start, {0.05, 0.0, 0.0}, posed)),
                          Vec3{radius, 0.2, 0.0}),
            0.01);
}

TEST(SurfaceMesh, WalksFromAnywhereStayOnTheSkinAndAreNoLongerThanAsked) {
  const Character person = test::MakeCapsulePerson();
  const SurfaceMesh mesh(person);
  const PosedMesh posed = CanonicalMesh(person);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.3, 0.3);
  for (int i = 0; i < 500; ++i) {
    const auto v = static_cast<SurfaceMesh::Vertex>(random() % mesh.VertexCount());
    MeshPoint place = mesh.PlaceOf(v);
    if (i % 2 == 0) place.barycentric = {0.2, 0.3, 0.5};
    const Vec3 way{unit(random), unit(random), unit(random)};
    const MeshPoint end = mesh.Walk(place, way, posed);
    ASSERT_TRUE(IsOn(person, end));
    EXPECT_LE(glm::distance(Position(person, posed, place), Position(person, posed, end)),
              glm::length(way) + 1e-9);
  }
}

TEST(SurfaceMesh, RingsMeasureATube) {
  const SurfaceMesh mesh(Tube(0.1, 1.0, 48, 5));
  const auto ring = mesh.Ring({0.02, 0.0, 0.0}, {0.02, 1.0, 0.0}, 0.37, 0.5);
  ASSERT_TRUE(ring);
  EXPECT_TRUE(ring->closed);
  EXPECT_DOUBLE_EQ(ring->covered, 1.0);
  EXPECT_NEAR(ring->radius, 0.1, 0.003);
  for (const Vec3& p : ring->position_ms) EXPECT_NEAR(p.y, 0.37, 1e-9);
  const Character tube = Tube(0.1, 1.0, 48, 5);
  const PosedMesh posed = CanonicalMesh(tube);
  std::vector<double> angles;
  for (const MeshPoint& p : ring->Even(8)) {
    ASSERT_TRUE(IsOn(tube, p));
    const Vec3 at = Position(tube, posed, p);
    EXPECT_NEAR(at.y, 0.37, 1e-6);
    angles.push_back(std::atan2(at.z, at.x));
  }
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 1; i < angles.size(); ++i) {
    EXPECT_NEAR(angles[i] - angles[i - 1], std::numbers::pi / 4.0, 0.01);
  }
  // A plane through vertices, a line outside, a plane beyond the end.
  EXPECT_TRUE(mesh.Ring({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.2, 0.5)->closed);
  EXPECT_FALSE(mesh.Ring({0.3, 0.0, 0.0}, {0.3, 1.0, 0.0}, 0.37, 0.5));
  EXPECT_FALSE(mesh.Ring({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1.2, 0.5));
}

TEST(SurfaceMesh, RingsOfAPersonHaveTheThicknessThatWasBuilt) {
  const SurfaceMesh mesh(test::MakeCapsulePerson({.left_arm = 1.4}));
  for (const double t : {0.3, 0.5, 0.7}) {
    EXPECT_NEAR(mesh.Ring(LimbSegment::kLeftUpperArm, t)->radius, 1.4 * 0.045, 0.001);
    EXPECT_NEAR(mesh.Ring(LimbSegment::kRightForearm, t)->radius, 0.045, 0.001);
    EXPECT_NEAR(mesh.Ring(LimbSegment::kLeftCalf, t)->radius, 0.065, 0.001);
  }
}

TEST(SurfaceMesh, MirrorsWhereThereIsAPartnerAndSaysWhereNot) {
  const Character person = test::MakeCapsulePerson();
  const SurfaceMesh mesh(person);
  EXPECT_NEAR(mesh.MiddleX(), 0.0, 1e-9);
  for (SurfaceMesh::Vertex v = 0; v < mesh.VertexCount(); ++v) {
    const auto mirror = mesh.MirrorOf(mesh.PlaceOf(v), 1e-4);
    ASSERT_TRUE(mirror) << v;
    const Vec3 p = mesh.Position(v);
    EXPECT_LT(glm::distance(mesh.Position(*mesh.VertexAt(*mirror)), Vec3{-p.x, p.y, p.z}), 1e-4);
  }
  const SurfaceMesh lopsided(test::MakeCapsulePerson({.left_arm = 1.4}));
  const auto arm = lopsided.Nearest({0.35, 1.5, 0.0});
  EXPECT_FALSE(lopsided.MirrorOf(lopsided.PlaceOf(*arm), 1e-3));
  EXPECT_TRUE(lopsided.MirrorOf(lopsided.PlaceOf(*arm), 0.1));
}

TEST(SurfaceMesh, GeodesicDistanceIsBetweenTheStraightLineAndALittleMoreThanTheTrueOne) {
  const double radius = 0.1;
  const Character tube = Tube(radius, 1.0, 48, 40);
  const SurfaceMesh mesh(tube);
  const auto place = [&](double angle, double y) {
    return mesh.PlaceOf(*mesh.Nearest({radius * std::cos(angle), y, radius * std::sin(angle)}));
  };
  const double across = mesh.GeodesicDistance(place(0.0, 0.5), place(std::numbers::pi, 0.5));
  EXPECT_GE(across, 2.0 * radius);
  EXPECT_NEAR(across, std::numbers::pi * radius, 0.02 * radius);
  const MeshPoint low = place(0.0, 0.0);
  MeshPoint inside = place(0.0, 1.0);
  inside.barycentric = {0.4, 0.3, 0.3};
  const double along = mesh.GeodesicDistance(low, inside);
  EXPECT_GT(along, 0.97);
  EXPECT_LT(along, 1.1);
  EXPECT_EQ(mesh.GeodesicDistance(low, inside, 0.5), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace ego
