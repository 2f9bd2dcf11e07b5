// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/sharp_transfer.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/allocation_counter.h"
#include "transfer/ellipsoid.h"
#include "transfer/sharp_body.h"
#include "transfer/transfer_support.h"

namespace vesiflow::coupling::sharp_transfer_test {
namespace {

using test::Ellipsoid;
using test::SharpBody;
using vesicle::VectorField;
using Vector = Eigen::Vector3d;

// Three different widths; a body of about five cells per radius.
fluid::Grid box(bool periodic) {
  return {{-2, -2.2, -2}, {2, 2.2, 2}, {20, 24, 22}, {.periodic = {periodic, periodic, periodic}}};
}
const vesicle::SphereGrid mesh(20);
const Vector middle(0.1, -0.2, 0.05);

Ellipsoid some_body(const Vector& centre = middle) {
  return {{0.8, 1.0, 1.25}, centre};
}

/// Smooth, with total force and torque.
VectorField some_force(const VectorField& positions, const Vector& centre = middle) {
  VectorField force(positions.rows(), 3);
  for (Eigen::Index m = 0; m < force.rows(); ++m) {
    const Vector x = Vector(positions.row(m).transpose()) - centre;
    force.row(m) << x[1] * x[2] + 0.3 * x[0], 1 + x[0] * x[1] - x[2], x[0] * x[0] - 0.5 * x[1];
  }
  return force;
}

/// Without net flux, as that of an incompressible fluid.
VectorField some_velocity_jump(const vesicle::Surface& surface) {
  VectorField jump = some_force(surface.positions()).rowwise().reverse();
  jump -= surface.normal() * (surface.flux(jump) / surface.area());
  return jump;
}

SharpBody body_in(const fluid::Grid& grid, const Vector& centre = middle) {
  return SharpBody(grid, mesh, some_body(centre).markers(mesh), {.degrees = 8});
}

struct OnGrid {
  explicit OnGrid(const fluid::Grid& grid) : density(grid), source(grid) {}

  double total_source() const {
    double sum = 0.0;
    const fluid::ConstView values = source.points();
    for (int k = 0; k < values.extent[2]; ++k)
      for (int j = 0; j < values.extent[1]; ++j)
        for (int i = 0; i < values.extent[0]; ++i) sum += values(i, j, k);
    return sum * source.grid().cell_volume();
  }
  bool is_zero() const {
    const auto all_zero = [](const auto& field) {
      return std::all_of(field.data(), field.data() + field.size(), [](double value) { return value == 0.0; });
    };
    return all_zero(density.x) && all_zero(density.y) && all_zero(density.z) && all_zero(source);
  }

  fluid::FaceVector density;
  fluid::Field<fluid::Cell> source;
};

template <class Field>
double difference(const Field& a, const Field& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a.data()[i] - b.data()[i]));
  return largest;
}
double difference(const OnGrid& a, const OnGrid& b) {
  return std::max({difference(a.density.x, b.density.x), difference(a.density.y, b.density.y),
                   difference(a.density.z, b.density.z), difference(a.source, b.source)});
}

// The jump a + A x is a flow on both sides, with the stress A + A^T. What is solved for is smooth less that inside: its sum over points counts
// these as a whole, where the integral knows where the membrane is.
TEST(SharpTransfer, KnowsWhatASumOverPointsLacksOfTheIntegral) {
  const fluid::Grid grid = box(true);
  const Vector a(1.0, -2.0, 0.5);
  const Eigen::Matrix3d gradient{{0.3, 0.5, -0.2}, {-0.4, 0.2, 0.6}, {0.1, -0.7, -0.5}};
  const Eigen::Matrix3d stress = gradient + gradient.transpose();
  double counted = 0.0, known = 0.0;
  for (int place = 0; place < 8; ++place) {
    const Vector centre = middle + (0.2 / 8 * place) * Vector(1.0, 0.6, -0.7);
    const Ellipsoid shape = some_body(centre);
    SharpBody body(grid, mesh, shape.markers(mesh));
    VectorField jump = (body.surface.positions().matrix() * gradient.transpose()).array();
    jump.rowwise() += a.transpose().array();
    body.sharp.set_force((-body.surface.normal().matrix() * stress.transpose()).array(), &jump);

    const double volume = 4.0 / 3.0 * std::numbers::pi * 0.8 * 1.0 * 1.25;
    Vector lacking = -volume * (a + gradient * centre);
    fluid::FaceVector points(grid);
    test::for_each_point(points, [&](double, const fluid::Vector3& at, int component) {
      const Vector x(at[0], at[1], at[2]);
      if (shape.closest(x).distance < 0.0) lacking[component] += grid.cell_volume() * (a + gradient * x)[component];
    });
    counted += lacking.squaredNorm();
    known += (body.sharp.integral_beyond_sum() - lacking).squaredNorm();
  }
  EXPECT_GT(std::sqrt(counted / 8), 0.01);
  EXPECT_LT(std::sqrt(known / counted), 0.05);
}

TEST(SharpTransfer, ForceAndTorqueAreThoseOfTheMembrane) {
  for (const bool periodic : {false, true})
    for (const bool has_jump : {false, true}) {
      const fluid::Grid grid = box(periodic);
      SharpBody body = body_in(grid);
      const VectorField force = some_force(body.surface.positions()), jump = some_velocity_jump(body.surface);
      OnGrid put(grid);
      body.put(force, put.density, put.source, has_jump ? &jump : nullptr);

      Vector total = Vector::Zero(), torque = Vector::Zero();
      test::for_each_point(put.density, [&](double value, const fluid::Vector3& x, int component) {
        const Vector f = value * grid.cell_volume() * Vector::Unit(component);
        total += f;
        torque += Vector(x[0], x[1], x[2]).cross(f);
      });
      Vector exact = Vector::Zero(), exact_torque = Vector::Zero();
      for (Eigen::Index m = 0; m < force.rows(); ++m) {
        const Vector x = body.surface.positions().row(m).transpose(), f = force.row(m).transpose();
        exact += body.surface.area_weight()[m] * f;
        exact_torque += body.surface.area_weight()[m] * x.cross(f);
      }
      ASSERT_GT(exact.norm(), 5.0);
      ASSERT_GT(exact_torque.norm(), 1.0);
      EXPECT_LT((total - exact).norm(), 1e-12);
      EXPECT_LT((torque - exact_torque).norm(), 1e-12);
      // What the corrections alone have of it says how good they are.
      EXPECT_LT(body.sharp.lacking_force(), 0.01);
      EXPECT_GT(body.sharp.lacking_force(), 1e-8);
    }
}

// Across the ends of a periodic box, on both sides of it, and in another box.
TEST(SharpTransfer, ABodyMayLieAcrossPeriodicEnds) {
  // Of powers of two, so that positions keep all their digits.
  const fluid::Grid grid({-2, -2, -2}, {2, 2, 2}, {16, 16, 16}, {.periodic = {true, true, true}});
  const double h = 0.25;
  const auto put = [&](const Vector& centre, OnGrid& to) {
    SharpBody body = body_in(grid, centre);
    body.put(some_force(body.surface.positions(), centre), to.density, to.source);
    fluid::NavierStokes fluid(grid, test::without_inertia());
    fluid.force() = to.density.clone();
    fluid.divergence_source() = to.source.clone();
    fluid.step(1.0);
    return body.read(fluid.velocity());
  };
  OnGrid here(grid);
  const VectorField velocity = put(middle, here);
  for (const std::array<int, 3>& cells : {std::array{8, 0, 0}, std::array{-7, 8, 3}, std::array{40, -24, 9}}) {
    OnGrid there(grid);
    const VectorField moved = put(middle + h * Vector(cells[0], cells[1], cells[2]), there);
    EXPECT_LT((moved - velocity).abs().maxCoeff(), 1e-9);
    double error = 0.0;
    const auto& n = grid.cells;
    const auto index = [&](int i, int axis) { return ((i + cells[axis]) % n[axis] + n[axis]) % n[axis]; };
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const int a = index(i, 0), b = index(j, 1), c = index(k, 2);
          error = std::max({error, std::abs(here.density.x(i, j, k) - there.density.x(a, b, c)),
                            std::abs(here.density.y(i, j, k) - there.density.y(a, b, c)),
                            std::abs(here.density.z(i, j, k) - there.density.z(a, b, c)),
                            std::abs(here.source(i, j, k) - there.source(a, b, c))});
        }
    EXPECT_LT(error, 1e-7);
  }
}

// A flow has no divergence as a whole. The source's is a difference of large terms, of third order in the spacing: averaged
// over places of the body in the grid.
TEST(SharpTransfer, TheTotalOfTheSourceVanishesToThirdOrder) {
  const auto total = [](double cells_per_radius) {
    const int n = static_cast<int>(std::lround(4.5 * cells_per_radius));
    const fluid::Grid grid({-2.25, -2.25, -2.25}, {2.25, 2.25, 2.25}, {n, n, n});
    double squares = 0.0;
    constexpr int places = 8;
    for (int k = 0; k < places; ++k) {
      const Vector centre = middle + Vector(0.037, -0.021, 0.013) * k;
      SharpBody body = body_in(grid, centre);
      OnGrid put(grid);
      body.put(some_force(body.surface.positions(), centre), put.density, put.source);
      squares += std::pow(put.total_source(), 2) / places;
    }
    return std::sqrt(squares);
  };
  const double coarse = total(4.0), fine = total(8.0);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_GT(std::log2(coarse / fine), 2.5);
}

TEST(SharpTransfer, SeveralBodiesSuperpose) {
  const fluid::Grid grid({-2, -2, -2}, {4.5, 2, 2}, {26, 16, 16}, {.periodic = {true, true, true}});
  const Vector other(2.6, 0.1, -0.1);
  SharpBody first = body_in(grid), second = body_in(grid, other);
  const VectorField force = some_force(first.surface.positions());
  const VectorField other_force = some_force(second.surface.positions(), other).rowwise().reverse();

  fluid::NavierStokes of_first(grid, test::without_inertia()), of_second(grid, test::without_inertia());
  fluid::NavierStokes of_both(grid, test::without_inertia());
  first.put(force, of_first);
  second.put(other_force, of_second);
  first.put(force, of_both);
  second.put(other_force, of_both);
  for (auto* fluid : {&of_first, &of_second, &of_both}) fluid->step(1.0);

  fluid::FaceVector nothing(grid);
  const VectorField own = first.read(of_first.velocity()), of_jumps = first.read(nothing);
  const VectorField of_other = first.read(of_second.velocity()) - of_jumps;
  EXPECT_GT(of_other.abs().maxCoeff(), 0.01);
  EXPECT_LT((first.read(of_both.velocity()) - own - of_other).abs().maxCoeff(), 1e-12);
}

// Also of several, in any order, where one has moved in between.
TEST(SharpTransfer, ClearLeavesZeros) {
  for (const bool periodic : {false, true}) {
    const fluid::Grid grid = box(periodic);
    const Vector other = periodic ? Vector(1.9, -2.1, 1.8) : Vector(-0.2, 0.3, 0.1);
    SharpBody first = body_in(grid), second = body_in(grid, other);
    OnGrid put(grid);
    for (int k = 0; k < 2; ++k) {
      first.put(some_force(first.surface.positions()), put.density, put.source);
      second.put(some_force(second.surface.positions()), put.density, put.source);
      first.put(some_force(first.surface.positions()), put.density, put.source);
      EXPECT_FALSE(put.is_zero());
      first.move(some_body(middle + Vector(0.3, -0.2, 0.1)).markers(mesh));
      first.clear(put.density, put.source);
      second.clear(put.density, put.source);
      EXPECT_TRUE(put.is_zero());
    }
  }
}

// Of the same body the same again.
TEST(SharpTransfer, AMembraneThatComesBackGivesTheSameBits) {
  const fluid::Grid grid = box(true);
  SharpBody body = body_in(grid);
  const VectorField positions = body.surface.positions(), force = some_force(positions);
  OnGrid first(grid), again(grid);
  body.put(force, first.density, first.source);
  body.move(some_body(middle + Vector(0.3, -0.2, 0.1)).markers(mesh));
  const VectorField jump = some_velocity_jump(body.surface);
  OnGrid elsewhere(grid);
  body.put(force, elsewhere.density, elsewhere.source, &jump);
  body.move(positions);
  body.put(force, again.density, again.source);
  EXPECT_EQ(difference(first, again), 0.0);
}

TEST(SharpTransfer, PutsWhatIsLinearInForceAndVelocityJump) {
  const fluid::Grid grid = box(true);
  SharpBody body = body_in(grid);
  const VectorField force = some_force(body.surface.positions()), jump = some_velocity_jump(body.surface);
  const VectorField zero = VectorField::Zero(force.rows(), 3), twice = 2.0 * force, minus = -jump;
  OnGrid of_force(grid), of_jump(grid), of_both(grid), of_nothing(grid);
  body.put(twice, of_both.density, of_both.source, &minus);
  body.put(force, of_force.density, of_force.source);
  body.put(zero, of_jump.density, of_jump.source, &jump);
  body.put(zero, of_nothing.density, of_nothing.source);
  EXPECT_TRUE(of_nothing.is_zero());
  OnGrid sum(grid);
  const auto add = [](auto& to, const auto& a, const auto& b) {
    for (std::size_t i = 0; i < to.size(); ++i) to.data()[i] = 2.0 * a.data()[i] - b.data()[i];
  };
  add(sum.density.x, of_force.density.x, of_jump.density.x);
  add(sum.density.y, of_force.density.y, of_jump.density.y);
  add(sum.density.z, of_force.density.z, of_jump.density.z);
  add(sum.source, of_force.source, of_jump.source);
  EXPECT_LT(difference(of_both, sum), 1e-10);
}

// Where nothing jumps, four points of Lagrange: exact for polynomials of third degree.
TEST(SharpTransfer, ReadsASmoothVelocity) {
  const fluid::Grid grid = box(false);
  SharpBody body = body_in(grid);
  const VectorField& x = body.surface.positions();
  body.sharp.set_force(VectorField::Zero(x.rows(), 3));
  fluid::FaceVector u(grid);
  const auto cubic = [](double a, double b, double c, int component) {
    return 0.3 + a * b * c - component * b * b * b + 0.2 * a * a * c + c * c * c;
  };
  test::for_each_point(
      u, [&](double& value, const fluid::Vector3& r, int component) { value = cubic(r[0], r[1], r[2], component); });
  const VectorField found = body.read(u);
  for (Eigen::Index m = 0; m < x.rows(); ++m)
    for (int component = 0; component < 3; ++component)
      EXPECT_NEAR(found(m, component), cubic(x(m, 0), x(m, 1), x(m, 2), component), 1e-13);
}

// What is inside a neighbour a third of a spacing away, across the periodic end too, is read as what is outside of it, continued: whatever
// its jump is, the velocity read is that without it.
TEST(SharpTransfer, ReadsPastANeighbour) {
  const fluid::Grid grid({-1.5, -2, -2}, {3.0, 2, 2}, {22, 20, 20}, {.periodic = {true, false, false}});
  const double apart = 1.6 + 0.3 * grid.spacing(1);
  for (const double offset : {apart, apart - grid.length(0)}) {
    SharpBody first = body_in(grid), second = body_in(grid, middle + Vector(offset, 0, 0));
    for (SharpBody* body : {&first, &second}) {
      body->sharp.update(body->surface, true);
      const VectorField jump = some_velocity_jump(body->surface);
      body->sharp.set_force(some_force(body->surface.positions()), &jump);
    }
    fluid::FaceVector velocity = test::random_field(grid);
    const VectorField alone = first.read(velocity);
    const auto views = velocity.points();
    for (int c = 0; c < 3; ++c) {
      const GridBand& band = second.sharp.band(c);
      for (const GridBand::Point& point : band.points())
        if (point.distance() < 0.0)
          views[std::size_t(c)](band.in_grid(0, point.index[0]), band.in_grid(1, point.index[1]),
                                band.in_grid(2, point.index[2])) -= band.jump(point.at);
    }
    EXPECT_GT((first.read(velocity) - alone).abs().maxCoeff(), 0.05) << offset;
    first.sharp.read_past(second.sharp);
    EXPECT_LT((first.read(velocity) - alone).abs().maxCoeff(), 1e-13) << offset;
    first.sharp.set_force(some_force(first.surface.positions()));  // forgets the neighbour
    EXPECT_GT((first.read(velocity) - alone).abs().maxCoeff(), 0.05) << offset;
  }
}

// In a box hardly longer than the body, its own image is the neighbour: as the second of two in a box twice as long.
TEST(SharpTransfer, ReadsPastItsOwnImage) {
  const fluid::Grid one({-0.9, -2, -2}, {0.9, 2, 2}, {9, 20, 20}, {.periodic = {true, false, false}});
  const fluid::Grid two({-0.9, -2, -2}, {2.7, 2, 2}, {18, 20, 20}, {.periodic = {true, false, false}});
  const double period = one.length(0);
  SharpBody alone = body_in(one), first = body_in(two), second = body_in(two, middle + Vector(period, 0, 0));
  for (SharpBody* body : {&alone, &first, &second}) {
    body->sharp.update(body->surface, true);
    const VectorField jump = some_velocity_jump(alone.surface);
    body->sharp.set_force(some_force(alone.surface.positions()), &jump);
  }
  const auto repeated = [](const fluid::Vector3& x, int component) {
    return std::sin(2 * std::numbers::pi / 1.8 * x[0] + component) + x[1] * x[2];
  };
  fluid::FaceVector of_one(one), of_two(two);
  for (fluid::FaceVector* field : {&of_one, &of_two})
    test::for_each_point(
        *field, [&](double& value, const fluid::Vector3& x, int component) { value = repeated(x, component); });
  const VectorField uncorrected = alone.read(of_one);
  alone.sharp.read_past(alone.sharp);
  first.sharp.read_past(second.sharp);
  EXPECT_GT((alone.read(of_one) - uncorrected).abs().maxCoeff(), 0.01);
  EXPECT_LT((alone.read(of_one) - first.read(of_two)).abs().maxCoeff(), 1e-10);
}

// Every point inside a body that a marker outside it may read knows its jump.
TEST(SharpTransfer, NeighboursReadWhereTheJumpIsKnown) {
  const fluid::Grid grid = box(false);
  SharpBody body = body_in(grid);
  body.sharp.update(body.surface, true);
  const double deepest = std::sqrt(3.0) * body.sharp.reading_reach();
  for (int c = 0; c < 3; ++c) {
    const GridBand& band = body.sharp.band(c);
    double deepest_known = 0.0;
    for (const GridBand::Point& point : band.points())
      if (point.distance() != GridBand::far) deepest_known = std::min(deepest_known, point.distance());
    EXPECT_LT(deepest_known, -0.9 * deepest) << c;
  }
}

TEST(SharpTransfer, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const fluid::Grid grid = box(true);
  fluid::FaceVector velocity = test::random_field(grid);
  const auto run = [&](int threads, OnGrid& put) {
    omp_set_num_threads(threads);
    SharpBody body = body_in(grid);
    const VectorField jump = some_velocity_jump(body.surface);
    body.put(some_force(body.surface.positions()), put.density, put.source, &jump);
    return body.read(velocity);
  };
  OnGrid one(grid), three(grid);
  const VectorField with_one = run(1, one), with_three = run(3, three);
  omp_set_num_threads(before);
  EXPECT_EQ(difference(one, three), 0.0);
  EXPECT_TRUE((with_one == with_three).all());
}

// As a body moves and turns through the grid, the number of points next to it changes a little.
TEST(SharpTransfer, AllocatesNothingOnceWarmedUp) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(2);  // with one the OpenMP library itself allocates a team for every loop
  const fluid::Grid grid = box(true);
  SharpBody body = body_in(grid);
  std::vector<VectorField> path;
  for (int step = 1; step < 8; ++step)
    path.push_back(some_body(middle + step * Vector(0.03, -0.05, 0.02)).markers(mesh));
  const VectorField force = some_force(body.surface.positions()), jump = some_velocity_jump(body.surface);
  VectorField velocity = VectorField::Zero(force.rows(), 3);
  OnGrid put(grid);
  const auto use = [&](const VectorField& positions) {
    body.move(positions);
    for (const VectorField* velocity_jump : {static_cast<const VectorField*>(nullptr), &jump}) {
      body.put(force, put.density, put.source, velocity_jump);
      body.sharp.interpolate(put.density, velocity);
      body.clear(put.density, put.source);
    }
  };
  use(path[0]);
  use(path[1]);
  const long before = vesiflow::test::allocation_count();
  for (const VectorField& positions : path) use(positions);
  const long allocations = vesiflow::test::allocation_count() - before;
  omp_set_num_threads(threads_before);
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace vesiflow::coupling::sharp_transfer_test
