// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/triangle_mesh.h"

#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "meshes.h"

namespace vesiflow::vesicle::triangle_mesh_test {
namespace {

using testing::joined;
using testing::mesh_of;
using testing::octasphere;
using testing::torus;

std::string complaint(const TriangleMesh& mesh) {
  try {
    check_closed_genus_zero(mesh);
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "accepted";
}

/// Removes vertex `from` by giving its triangles vertex `to`.
void merge(TriangleMesh& mesh, int from, int to) {
  mesh.triangles = (mesh.triangles == from).select(to, mesh.triangles);
  const Eigen::Index last = mesh.vertices.rows() - 1;
  mesh.vertices.row(from) = mesh.vertices.row(last);
  mesh.triangles = (mesh.triangles == static_cast<int>(last)).select(from, mesh.triangles);
  mesh.vertices.conservativeResize(last, 3);
}

TEST(TriangleMesh, ClosedSurfacesOfGenusZeroPassWhicheverWayTheyTurn) {
  TriangleMesh mesh = octasphere(2);
  EXPECT_EQ(complaint(mesh), "accepted");
  mesh.triangles.col(0).swap(mesh.triangles.col(1));
  EXPECT_EQ(complaint(mesh), "accepted");
}

TEST(TriangleMesh, EnclosedVolumeOfAPolyhedronIsExact) {
  // The octahedron with vertices at distance 1 has the volume 4/3.
  TriangleMesh mesh = octasphere(0);
  mesh.vertices.rowwise() += Eigen::Array3d(5, -3, 100).transpose();
  EXPECT_NEAR(enclosed_volume(mesh).volume, 4.0 / 3, 1e-13);
  EXPECT_LT((enclosed_volume(mesh).centroid - Vector3(5, -3, 100)).norm(), 1e-12);
  // A tetrahedron, whose centroid is the mean of its corners; turned inward its volume is negative.
  const TriangleMesh tetrahedron =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  EXPECT_NEAR(enclosed_volume(tetrahedron).volume, -1.0 / 6, 1e-15);
  EXPECT_LT((enclosed_volume(tetrahedron).centroid - Vector3::Constant(0.25)).norm(), 1e-15);
}

TEST(TriangleMesh, DefectsOfVerticesAreNamed) {
  TriangleMesh mesh = octasphere(1);
  mesh.vertices(7, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(mesh), "triangle mesh: vertex 7 is not finite");

  EXPECT_EQ(complaint(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}})),
            "triangle mesh: 3 vertices: a closed surface needs at least 4");

  mesh = octasphere(1);
  mesh.triangles(4, 2) = 18;
  EXPECT_EQ(complaint(mesh), "triangle mesh: triangle 4 has vertex 18: must be in [0, 17]");
  mesh.triangles(4, 2) = -1;
  EXPECT_EQ(complaint(mesh), "triangle mesh: triangle 4 has vertex -1: must be in [0, 17]");
  mesh.triangles(4, 2) = mesh.triangles(4, 0);
  EXPECT_EQ(complaint(mesh), "triangle mesh: triangle 4 has a vertex twice");

  mesh = octasphere(1);
  mesh.vertices.conservativeResize(19, 3);
  mesh.vertices.row(18) << 3, 3, 3;
  EXPECT_EQ(complaint(mesh), "triangle mesh: vertex 18 belongs to no triangle");
  mesh.vertices.row(18) = mesh.vertices.row(5);
  EXPECT_NE(complaint(mesh).find("vertices 5 and 18 are at the same point"), std::string::npos) << complaint(mesh);
}

TEST(TriangleMesh, DefectsOfEdgesAreNamed) {
  TriangleMesh mesh = octasphere(1);
  const int a = mesh.triangles(31, 0), b = mesh.triangles(31, 1), c = mesh.triangles(31, 2);
  mesh.triangles.conservativeResize(31, 3);
  EXPECT_NE(complaint(mesh).find("is open: only triangle"), std::string::npos) << complaint(mesh);

  // A tetrahedron on top of a face that is still there: its three edges belong to three triangles.
  mesh = octasphere(1);
  mesh.vertices.conservativeResize(19, 3);
  mesh.vertices.row(18) << 3, 3, 3;
  mesh.triangles.conservativeResize(35, 3);
  mesh.triangles.row(32) << a, b, 18;
  mesh.triangles.row(33) << b, c, 18;
  mesh.triangles.row(34) << c, a, 18;
  EXPECT_NE(complaint(mesh).find("belongs to 3 triangles: must be two"), std::string::npos) << complaint(mesh);

  for (int inside_out : {0, 13}) {
    mesh = octasphere(1);
    std::swap(mesh.triangles(inside_out, 1), mesh.triangles(inside_out, 2));
    EXPECT_EQ(complaint(mesh), "triangle mesh: triangle " + std::to_string(inside_out) +
                                   " is inside out: it turns the other way than most (1 of 32 do); exchange two of its "
                                   "vertices");
  }
}

TEST(TriangleMesh, OtherTopologiesAreNamed) {
  EXPECT_NE(complaint(torus(8, 6)).find("V - E + F = 0: must be 2; the surface has 1 handle(s)"), std::string::npos);

  TriangleMesh other = octasphere(1);
  other.vertices += 5;
  EXPECT_NE(complaint(joined(octasphere(0), other)).find("more than one component: only 8 of 40"), std::string::npos);

  // Two octahedra that share one vertex.
  other = octasphere(0);
  other.vertices.col(0) += 2;
  TriangleMesh touching = joined(octasphere(0), other);
  EXPECT_NE(complaint(touching).find("are at the same point"), std::string::npos) << complaint(touching);
  merge(touching, 8, 0);
  EXPECT_NE(complaint(touching).find("more than one component"), std::string::npos) << complaint(touching);

  // A sphere whose poles are pulled into one point: connected across edges, but pinched there.
  TriangleMesh pinched = octasphere(2);
  pinched.vertices.row(4).setZero();
  merge(pinched, 5, 4);
  EXPECT_EQ(complaint(pinched),
            "triangle mesh: the surface touches itself in vertex 4: its triangles form more than one fan");

  // Six-vertex projective plane: closed and one-sided.
  const TriangleMesh plane = mesh_of(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}, {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}});
  EXPECT_NE(complaint(plane).find("one-sided"), std::string::npos) << complaint(plane);
}

}  // namespace
}  // namespace vesiflow::vesicle::triangle_mesh_test
