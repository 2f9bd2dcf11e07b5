// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// SharpTransfer in boxes with mirror planes, against that in the whole box.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/allocation_counter.h"
#include "transfer/sharp_body.h"
#include "transfer/transfer_support.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling::sharp_mirror_test {
namespace {

using test::SharpBody;
using vesicle::VectorField;
using Vector = Eigen::Vector3d;
using Planes = std::array<bool, 3>;

const std::array<Planes, 4> all_planes{
    {{true, false, false}, {false, true, false}, {false, true, true}, {true, true, true}}};
const vesicle::SphereGrid mesh(20);
// On the planes of symmetry, in the middle of a box that is nowhere else symmetric.
const fluid::Vector3 plane{0.25, -0.5, 0.125};

fluid::Grid whole_box() {
  return {{plane[0] - 2, plane[1] - 2, plane[2] - 2.25}, {plane[0] + 2, plane[1] + 2, plane[2] + 2.25}, {32, 36, 34}};
}
fluid::Grid part_of(const fluid::Grid& whole, const Planes& mirror) {
  fluid::Vector3 lower = whole.lower;
  std::array<int, 3> cells = whole.cells;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (mirror[axis]) {
      lower[axis] = plane[axis];
      cells[axis] /= 2;
    }
  return {lower, whole.upper, cells, {.periodic = {}, .mirror = mirror}};
}

VectorField markers_about(const Vector& centre) {
  return vesicle::ellipsoid(mesh, {0.8, 1.0, 1.25}, {.rotation = Eigen::Matrix3d::Identity(), .centre = centre});
}
Vector centre_of_planes() {
  return {plane[0], plane[1], plane[2]};
}

/// Symmetric about the three planes through the centre, or mirrored with it.
VectorField some_force(const VectorField& positions, const Vector& centre, const Vector& mirrored = {1, 1, 1}) {
  VectorField force(positions.rows(), 3);
  for (Eigen::Index m = 0; m < force.rows(); ++m) {
    const Vector x = mirrored.cwiseProduct(Vector(positions.row(m).transpose()) - centre), s = x.cwiseAbs2();
    const Vector f(x[0] * (1 + s[1]), x[1] * (0.3 - s[0]), x[2] * (s[1] - 2 * s[2]));
    force.row(m) = mirrored.cwiseProduct(f).transpose();
  }
  return force;
}
VectorField without_flux(VectorField jump, const vesicle::Surface& surface) {
  jump -= surface.normal() * (surface.flux(jump) / surface.area());
  return jump;
}

struct OnGrid {
  explicit OnGrid(const fluid::Grid& grid) : density(grid), source(grid) {}

  bool is_zero() const {
    const auto all_zero = [](const auto& field) {
      return std::all_of(field.data(), field.data() + field.size(), [](double value) { return value == 0.0; });
    };
    return all_zero(density.x) && all_zero(density.y) && all_zero(density.z) && all_zero(source);
  }
  fluid::FaceVector density;
  fluid::Field<fluid::Cell> source;
};

/// The largest difference at the points of the part that are not on a plane of symmetry along that axis.
double difference(const fluid::ConstView& whole, const fluid::ConstView& part, int normal = -1) {
  double largest = 0.0;
  std::array<int, 3> shift{}, first{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    shift[axis] = whole.extent[axis] - part.extent[axis];
    if (static_cast<int>(axis) == normal && shift[axis] > 0) first[axis] = 1;
  }
  for (int k = first[2]; k < part.extent[2]; ++k)
    for (int j = first[1]; j < part.extent[1]; ++j)
      for (int i = first[0]; i < part.extent[0]; ++i)
        largest = std::max(largest, std::abs(part(i, j, k) - whole(i + shift[0], j + shift[1], k + shift[2])));
  return largest;
}
double difference(const OnGrid& whole, const OnGrid& part) {
  double largest = difference(whole.source.points(), part.source.points());
  for (int c = 0; c < 3; ++c)
    largest = std::max(largest, difference(whole.density.points()[c], part.density.points()[c], c));
  return largest;
}

/// A velocity of the part, continued to the whole.
fluid::FaceVector continued(const fluid::FaceVector& part, const fluid::Grid& whole) {
  fluid::FaceVector result(whole);
  for (int c = 0; c < 3; ++c) {
    const fluid::ConstView from = part.points()[c];
    const fluid::View to = result.points()[c];
    std::array<int, 3> shift{};
    for (int axis = 0; axis < 3; ++axis) shift[axis] = to.extent[axis] - from.extent[axis];
    for (int k = 0; k < to.extent[2]; ++k)
      for (int j = 0; j < to.extent[1]; ++j)
        for (int i = 0; i < to.extent[0]; ++i) {
          std::array<int, 3> at{i, j, k};
          double sign = 1.0;
          for (int axis = 0; axis < 3; ++axis) {
            if (shift[axis] == 0) continue;
            at[axis] -= shift[axis];
            if (axis == c) sign *= at[axis] < 0 ? -1.0 : at[axis] == 0 ? 0.0 : 1.0;
            if (at[axis] < 0) at[axis] = (axis == c ? 0 : -1) - at[axis];
          }
          to(i, j, k) = sign * from(at[0], at[1], at[2]);
        }
  }
  return result;
}

// Distances and jumps at the points that both know, readers' too. What is normal to a plane vanishes on it.
void expect_same_bands(const SharpTransfer& whole, const SharpTransfer& part, const fluid::Grid& some) {
  for (int c = 0; c < 3; ++c) {
    const GridBand &all = whole.band(c), &few = part.band(c);
    double distance = 0.0, jump = 0.0;
    for (const GridBand::Point& point : few.points()) {
      std::array<int, 3> index = point.index;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_GE(index[axis], some.mirror[axis] ? -2 : -100);
        if (some.mirror[axis]) index[axis] += some.cells[axis];
      }
      ASSERT_TRUE(all.contains(index[0], index[1], index[2]));
      const auto at = all.offset(index[0], index[1], index[2]);
      // What readers beyond the plane read is in the whole's band besides.
      if (point.distance() == GridBand::far || all.distance(at) == GridBand::far) continue;
      distance = std::max(distance, std::abs(point.distance() - all.distance(at)));
      if (some.mirror[static_cast<std::size_t>(c)] && point.index[static_cast<std::size_t>(c)] == 0)
        EXPECT_EQ(few.jump(point.at), 0.0);
      else
        jump = std::max(jump, std::abs(few.jump(point.at) - all.jump(at)));
    }
    EXPECT_LT(distance, 1e-14);
    EXPECT_LT(jump, 1e-12);
    EXPECT_LT(few.count(), 0.75 * static_cast<double>(all.count()));
  }
}

/// In the whole, points and their mirror images find their feet by steps of single precision: that much it is not symmetric
/// itself, of densities up to 40. Across the equator of the mesh it is not by the error of Newton's method.
double tolerance(const Planes& planes) {
  return planes[2] ? 1e-7 : 2e-9;
}

TEST(SharpMirror, AMembraneAcrossPlanesIsThatOfTheWhole) {
  for (const Planes& planes : all_planes)
    for (const bool has_jump : {false, true}) {
      const fluid::Grid all = whole_box(), some = part_of(all, planes);
      SharpBody whole(all, mesh, markers_about(centre_of_planes()), {.degrees = 8});
      SharpBody part(some, mesh, markers_about(centre_of_planes()), {.degrees = 8});
      const VectorField& x = whole.surface.positions();
      VectorField force = some_force(x, centre_of_planes());
      const VectorField jump = without_flux(0.5 * force, whole.surface);
      for (int axis = 0; axis < 3; ++axis)  // a total, which has a torque about the origin
        if (!planes[axis]) force.col(axis) += 0.4;
      OnGrid in_whole(all), in_part(some);
      whole.put(force, in_whole.density, in_whole.source, has_jump ? &jump : nullptr);
      part.put(force, in_part.density, in_part.source, has_jump ? &jump : nullptr);
      expect_same_bands(whole.sharp, part.sharp, some);
      EXPECT_LT(difference(in_whole, in_part), tolerance(planes));
      for (int c = 0; c < 3; ++c) {  // none normal to a plane on it
        const fluid::ConstView f = std::as_const(in_part.density).points()[c];
        for (int b = 0; planes[c] && b < f.extent[(c + 2) % 3]; ++b)
          for (int a = 0; a < f.extent[(c + 1) % 3]; ++a) {
            std::array<int, 3> at{};
            at[(c + 1) % 3] = a;
            at[(c + 2) % 3] = b;
            EXPECT_EQ(f(at[0], at[1], at[2]), 0.0);
          }
      }

      const fluid::FaceVector velocity = test::random_field(some);
      const VectorField u = whole.read(continued(velocity, all)), v = part.read(velocity);
      double difference_here = 0.0, difference_there = 0.0;
      for (Eigen::Index m = 0; m < x.rows(); ++m) {
        bool is_here = true;
        for (int axis = 0; axis < 3; ++axis) is_here = is_here && !(planes[axis] && x(m, axis) < plane[axis]);
        double& largest = is_here ? difference_here : difference_there;
        largest = std::max(largest, (u.row(m) - v.row(m)).abs().maxCoeff());
      }
      EXPECT_LT(difference_here, 1e-11);
      EXPECT_LT(difference_there, tolerance(planes));
      EXPECT_GT(v.abs().maxCoeff(), 0.5);
    }
}

// A third of a spacing from the planes, whose images are as near, on one side of one or two of them, and across the third.
TEST(SharpMirror, AMembraneOnOneSideIsOneOfTwoInTheWhole) {
  for (const Planes& aside : {Planes{true, false, false}, {false, true, false}, {true, true, false}})
    for (const bool across_z : {false, true}) {
      const Planes planes{aside[0], aside[1], across_z};
      const fluid::Grid all({plane[0] - 3, plane[1] - 3, plane[2] - 2.25},
                            {plane[0] + 3, plane[1] + 3, plane[2] + 2.25}, {48, 54, 34});
      const fluid::Grid some = part_of(all, planes);
      std::vector<Vector> signs;
      for (const double x : {1.0, -1.0})
        for (const double y : {1.0, -1.0})
          if ((aside[0] || x > 0) && (aside[1] || y > 0)) signs.push_back({x, y, 1.0});
      const double radius = std::cbrt(0.8 * 1.0 * 1.25);  // what ellipsoid() divides by
      Vector from_plane(0.8 / radius + 0.3 * all.spacing(0), 1.0 / radius + 0.3 * all.spacing(1), 0.0);
      for (int axis = 0; axis < 2; ++axis)
        if (!aside[axis]) from_plane[axis] = 0.3;
      const auto put = [&](SharpBody& body, const Vector& centre, const Vector& sign) {
        body.sharp.update(body.surface, true);
        VectorField force = some_force(body.surface.positions(), centre, sign);
        force.rowwise() += 0.3 * sign.cwiseProduct(Vector(1, 2, 0)).transpose().array();
        const VectorField jump = without_flux(0.5 * force, body.surface);
        body.sharp.set_force(force, &jump);
      };
      std::vector<SharpBody> bodies;
      std::vector<Vector> centres;
      for (const Vector& sign : signs) {
        centres.push_back(centre_of_planes() + sign.cwiseProduct(from_plane));
        bodies.emplace_back(all, mesh, markers_about(centres.back()), SharpTransfer::Parameters{.degrees = 8});
      }
      SharpBody part(some, mesh, markers_about(centres[0]), {.degrees = 8, .across = {false, false, true}});
      OnGrid in_whole(all), in_part(some);
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        put(bodies[b], centres[b], signs[b]);
        bodies[b].sharp.add_to(in_whole.density, in_whole.source, bodies[b].delta);
      }
      put(part, centres[0], signs[0]);
      part.sharp.add_to(in_part.density, in_part.source, part.delta);
      EXPECT_LT(difference(in_whole, in_part), tolerance(planes));

      const fluid::FaceVector velocity = test::random_field(some), everywhere = continued(velocity, all);
      const VectorField uncorrected = part.read(velocity);
      for (std::size_t b = 1; b < bodies.size(); ++b) bodies[0].sharp.read_past(bodies[b].sharp);
      part.sharp.read_past(part.sharp);
      EXPECT_GT((part.read(velocity) - uncorrected).abs().maxCoeff(), 0.01);
      EXPECT_LT((part.read(velocity) - bodies[0].read(everywhere)).abs().maxCoeff(), tolerance(planes));
    }
}

// One across the plane and one on a side of it, near each other: what lies beyond the plane is read past as well.
TEST(SharpMirror, MembranesReadPastEachOtherAndTheirImages) {
  const Planes planes{false, true, false};
  const fluid::Grid all({plane[0] - 2, plane[1] - 3, plane[2] - 2.25}, {plane[0] + 4, plane[1] + 3, plane[2] + 2.25},
                        {48, 54, 34});
  const fluid::Grid some = part_of(all, planes);
  const Vector middle = centre_of_planes(), aside = middle + Vector(1.42, 1.02, 0.1),
               image = middle + Vector(1.42, -1.02, 0.1);
  SharpBody first(all, mesh, markers_about(middle)), second(all, mesh, markers_about(aside)),
      third(all, mesh, markers_about(image));
  SharpBody across(some, mesh, markers_about(middle)),
      on_side(some, mesh, markers_about(aside), {.across = {false, false, false}});
  const auto set = [](SharpBody& body, const Vector& centre, const Vector& sign) {
    body.sharp.update(body.surface, true);
    const VectorField force = some_force(body.surface.positions(), centre, sign);
    const VectorField jump = without_flux(force, body.surface);
    body.sharp.set_force(force, &jump);
  };
  for (SharpBody* body : {&first, &across}) set(*body, middle, {1, 1, 1});
  for (SharpBody* body : {&second, &on_side}) set(*body, aside, {1, 1, 1});
  set(third, image, {1, -1, 1});
  first.sharp.read_past(second.sharp);
  first.sharp.read_past(third.sharp);
  second.sharp.read_past(first.sharp);
  second.sharp.read_past(third.sharp);
  const fluid::FaceVector velocity = test::random_field(some), everywhere = continued(velocity, all);
  const VectorField of_across = across.read(velocity), of_side = on_side.read(velocity);
  across.sharp.read_past(on_side.sharp);
  on_side.sharp.read_past(across.sharp);
  on_side.sharp.read_past(on_side.sharp);
  EXPECT_GT((across.read(velocity) - of_across).abs().maxCoeff(), 0.01);
  EXPECT_GT((on_side.read(velocity) - of_side).abs().maxCoeff(), 0.01);
  EXPECT_LT((across.read(velocity) - first.read(everywhere)).abs().maxCoeff(), tolerance(planes));
  EXPECT_LT((on_side.read(velocity) - second.read(everywhere)).abs().maxCoeff(), tolerance(planes));
}

// Also where it has moved in between, across a plane or on one side of it.
TEST(SharpMirror, ClearLeavesZeros) {
  const fluid::Grid some = part_of(whole_box(), {true, true, false});
  for (const bool across : {true, false}) {
    const Vector centre = across ? centre_of_planes() : centre_of_planes() + Vector(0.82, 0.0, 0.0);
    SharpBody body(some, mesh, markers_about(centre), {.across = {across, true, true}});
    OnGrid put(some);
    body.put(some_force(body.surface.positions(), centre), put.density, put.source);
    EXPECT_FALSE(put.is_zero());
    body.move(markers_about(centre + Vector(0, 0, 0.3)));
    body.put(some_force(body.surface.positions(), centre), put.density, put.source);
    body.clear(put.density, put.source);
    EXPECT_TRUE(put.is_zero());
  }
}

TEST(SharpMirror, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const fluid::Grid some = part_of(whole_box(), {true, true, true});
  const fluid::FaceVector velocity = test::random_field(some);
  const auto run = [&](int threads, OnGrid& put) {
    omp_set_num_threads(threads);
    SharpBody body(some, mesh, markers_about(centre_of_planes()));
    body.put(some_force(body.surface.positions(), centre_of_planes()), put.density, put.source);
    return body.read(velocity);
  };
  OnGrid one(some), three(some);
  const VectorField with_one = run(1, one), with_three = run(3, three);
  omp_set_num_threads(before);
  EXPECT_EQ(difference(one, three), 0.0);
  EXPECT_TRUE((with_one == with_three).all());
}

// A body that moves along the planes.
TEST(SharpMirror, AllocatesNothingOnceWarmedUp) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(2);  // with one the OpenMP library itself allocates a team for every loop
  const fluid::Grid some = part_of(whole_box(), {true, true, false});
  for (const bool across : {true, false}) {
    const Vector centre = across ? centre_of_planes() : centre_of_planes() + Vector(0.82, 0.0, 0.0);
    SharpBody body(some, mesh, markers_about(centre), {.across = {across, true, true}});
    std::vector<VectorField> path;
    for (int step = 1; step < 8; ++step) path.push_back(markers_about(centre + step * Vector(0, 0, 0.05)));
    const VectorField force = some_force(body.surface.positions(), centre);
    VectorField velocity = VectorField::Zero(force.rows(), 3);
    OnGrid put(some);
    const auto use = [&](const VectorField& positions) {
      body.move(positions);
      body.sharp.update(body.surface, true);
      body.put(force, put.density, put.source);
      if (!across) body.sharp.read_past(body.sharp);
      body.sharp.interpolate(put.density, velocity);
      body.clear(put.density, put.source);
    };
    use(path[0]);
    use(path[1]);
    const long before = vesiflow::test::allocation_count();
    for (const VectorField& positions : path) use(positions);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0) << across;
  }
  omp_set_num_threads(threads_before);
}

}  // namespace
}  // namespace vesiflow::coupling::sharp_mirror_test
