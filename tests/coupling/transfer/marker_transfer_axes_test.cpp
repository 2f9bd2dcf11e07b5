// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// MarkerTransfer for every kernel on every kind of axis.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

#include "coupling/errors.h"
#include "coupling/marker_transfer.h"
#include "support/allocation_counter.h"
#include "transfer_support.h"

namespace vesiflow::coupling::marker_transfer_axes_test {
namespace {

using namespace test;
using namespace test::letters;

struct Loads {
  explicit Loads(Eigen::Index count)
      : force(VectorField::Random(count, 3)), area(ScalarField::Random(count).abs() + 0.1) {}
  VectorField force;
  ScalarField area;
};

template <class Check>
void for_each_kernel_and_box(const Check& check) {
  for (const DeltaKernel kernel : delta_kernels)
    for (const Box& box : boxes) {
      SCOPED_TRACE(std::string(name(kernel)) + " " + box.describe());
      check(kernel, box);
    }
}

// What one marker gives to a point, along one axis: all images of the point, with the sign they have for the component.
double weight_along(const Box& box, DeltaKernel kernel, int axis, bool normal, double point, double marker) {
  const fluid::Grid grid = box.grid();
  const double h = grid.spacing(axis), length = grid.length(axis), from_lower = point - grid.lower[axis];
  const Direction direction = normal ? Direction::normal : Direction::tangential;
  const auto value = [&](double at) { return delta(kernel, (marker - grid.lower[axis] - at) / h, direction) / h; };
  if (box.is(axis, w)) return value(from_lower);
  double sum = 0.0;
  if (box.is(axis, p))
    for (int image = -4; image <= 4; ++image) sum += value(from_lower + image * length);
  else
    sum = 0.5 * (value(from_lower) + (normal ? -1.0 : 1.0) * value(-from_lower));
  return sum;
}

TEST(MarkerTransferAxes, SpreadingIsTheSumOverMarkersAndImages) {
  for_each_kernel_and_box([](DeltaKernel kernel, const Box& box) {
    MarkerTransfer transfer = box.transfer(kernel);
    const VectorField x = markers_in(box, kernel, 15);
    const Loads loads(x.rows());
    transfer.update(x);
    fluid::FaceVector density(box.grid());
    transfer.spread(loads.force, loads.area, density);
    double worst = 0.0, largest = 0.0;
    for_each_point(density, [&](double value, const fluid::Vector3& at, int component) {
      double sum = 0.0;
      for (Eigen::Index i = 0; i < x.rows(); ++i) {
        double product = loads.force(i, component) * loads.area(i);
        for (int axis = 0; axis < 3 && product != 0.0; ++axis)
          product *= weight_along(box, kernel, axis, axis == component, at[static_cast<std::size_t>(axis)], x(i, axis));
        sum += product;
      }
      worst = std::max(worst, std::abs(value - sum));
      largest = std::max(largest, std::abs(sum));
    });
    ASSERT_GT(largest, 0.1);
    EXPECT_LT(worst, 1e-12 * largest);
  });
}

TEST(MarkerTransferAxes, SpreadAndInterpolateAreDiscreteAdjoints) {
  for_each_kernel_and_box([](DeltaKernel kernel, const Box& box) {
    MarkerTransfer transfer = box.transfer(kernel);
    const VectorField x = markers_in(box, kernel, 200);
    const Loads loads(x.rows());
    transfer.update(x);
    const fluid::FaceVector u = random_field(box.grid());
    fluid::FaceVector density(box.grid());
    transfer.spread(loads.force, loads.area, density);
    VectorField velocity = VectorField::Zero(x.rows(), 3);
    transfer.interpolate(u, velocity);
    double share = 1.0;
    for (int axis = 0; axis < 3; ++axis) share *= box.is(axis, m) ? 0.5 : 1.0;
    const double on_grid = dot(density, u) * box.grid().cell_volume();
    const double on_markers = share * ((loads.force * velocity).rowwise().sum() * loads.area).sum();
    const double scale = share * ((loads.force * velocity).abs().rowwise().sum() * loads.area).sum();
    EXPECT_NEAR(on_grid, on_markers, 1e-14 * scale);
    EXPECT_GT(scale, 1.0);
  });
}

TEST(MarkerTransferAxes, PeriodicMarkersMayBeWholeBoxesAway) {
  const Box box{{p, w, p}};
  const fluid::Grid grid = box.grid();
  const VectorField x = markers_in(box, DeltaKernel::six_point, 100);
  VectorField inside = x;
  for (const int axis : {0, 2})
    for (auto& value : inside.col(axis))
      value -= grid.length(axis) * std::floor((value - grid.lower[axis]) / grid.length(axis));
  const fluid::FaceVector u = random_field(grid);
  MarkerTransfer transfer = box.transfer(DeltaKernel::six_point);
  VectorField far = VectorField::Zero(x.rows(), 3), near = far;
  transfer.update(x);
  transfer.interpolate(u, far);
  transfer.update(inside);
  transfer.interpolate(u, near);
  // Positions of size 10 carry a round-off of 1e-15, which the field's gradient of some 10 multiplies.
  EXPECT_LT((far - near).abs().maxCoeff(), 1e-13);
}

// The half of a symmetric whole: mirror images of a set of markers in all mirrored axes at once.
struct Mirrored {
  std::array<bool, 3> axes;
  VectorField x, force;
  ScalarField area;
};
Mirrored mirrored_set(const std::array<bool, 3>& axes, int count, const fluid::Vector3& reach) {
  int copies = 1;
  for (const bool mirror : axes) copies *= mirror ? 2 : 1;
  Mirrored set{axes, VectorField(count * copies, 3), VectorField(count * copies, 3), ScalarField(count * copies)};
  for (int axis = 0; axis < 3; ++axis)
    set.x.block(0, axis, count, 1) = VectorField::Random(count, 3).col(axis) * reach[static_cast<std::size_t>(axis)];
  set.force.topRows(count) = VectorField::Random(count, 3);
  set.area.head(count) = ScalarField::Random(count).abs() + 0.1;
  int filled = count;
  for (int axis = 0; axis < 3; ++axis) {
    if (!axes[static_cast<std::size_t>(axis)]) continue;
    set.x.middleRows(filled, filled) = set.x.topRows(filled).eval();
    set.force.middleRows(filled, filled) = set.force.topRows(filled).eval();
    set.area.segment(filled, filled) = set.area.head(filled).eval();
    set.x.block(filled, axis, filled, 1) *= -1.0;
    set.force.block(filled, axis, filled, 1) *= -1.0;
    filled *= 2;
  }
  return set;
}

fluid::Grid whole_or_half(const std::array<bool, 3>& axes, bool whole) {
  fluid::Vector3 lower{-1.3, -1.1, -1.2}, upper{1.3, 1.1, 1.2};
  std::array<int, 3> cells{20, 18, 16};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (axes[axis] && !whole) {
      lower[axis] = 0.0;
      cells[axis] /= 2;
    }
  return {lower, upper, cells, {{false, !axes[1], false}, whole ? std::array<bool, 3>{} : axes}};
}

// Value of a field of the whole at the points of the half.
double at_same_point(const fluid::FaceVector& whole, const fluid::Vector3& position, int component) {
  const fluid::Grid& grid = whole.grid();
  std::array<int, 3> index{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double s = (position[a] - grid.lower[a]) / grid.spacing(axis) - (axis == component ? 0.0 : 0.5);
    index[a] = static_cast<int>(std::lround(s));
  }
  return whole.points()[static_cast<std::size_t>(component)](index[0], index[1], index[2]);
}

constexpr std::array<bool, 3> mirror_cases[] = {
    {true, false, false}, {false, true, false}, {false, false, true}, {true, false, true}, {true, true, true}};

TEST(MarkerTransferMirror, SymmetricMarkersGiveTheHalfBoxItsHalfOfTheWhole) {
  for (const DeltaKernel kernel : delta_kernels)
    for (const auto& axes : mirror_cases) {
      const Mirrored set = mirrored_set(axes, 150, {0.9, 0.7, 0.7});
      fluid::FaceVector whole(whole_or_half(axes, true)), half(whole_or_half(axes, false));
      MarkerTransfer in_whole(whole.grid(), kernel), in_half(half.grid(), kernel);
      in_whole.update(set.x);
      in_half.update(set.x);
      in_whole.spread(set.force, set.area, whole);
      in_half.spread(set.force, set.area, half);
      double worst = 0.0, largest = 0.0;
      for_each_point(half, [&](double value, const fluid::Vector3& at, int component) {
        worst = std::max(worst, std::abs(value - at_same_point(whole, at, component)));
        largest = std::max(largest, std::abs(value));
        const auto c = static_cast<std::size_t>(component);
        EXPECT_TRUE(value == 0.0 || !axes[c] || at[c] != 0.0);  // no force normal to the plane on the plane
      });
      EXPECT_LT(worst, 2e-14 * largest) << name(kernel);
    }
}

// A set on one side of the plane, near enough for its kernels to reach beyond, and its mirror image in the whole.
TEST(MarkerTransferMirror, MarkersOnOneSideStandForTheirImagesToo) {
  for (const DeltaKernel kernel : delta_kernels)
    for (const auto& axes : mirror_cases) {
      constexpr int count = 100;
      Mirrored set = mirrored_set({}, count, {0.9, 0.7, 0.7});
      for (int axis = 0; axis < 3; ++axis)
        if (axes[static_cast<std::size_t>(axis)]) set.x.col(axis) = set.x.col(axis).abs();
      fluid::FaceVector whole(whole_or_half(axes, true)), half(whole_or_half(axes, false));
      MarkerTransfer in_whole(whole.grid(), kernel), in_half(half.grid(), kernel, {false, false, false});
      in_half.update(set.x);
      in_half.spread(set.force, set.area, half);
      VectorField image = set.x, force = set.force;
      for (int copy = 0; copy < 8; ++copy) {
        bool is_image = true;
        for (int axis = 0; axis < 3; ++axis) {
          const bool reflected = (copy >> axis & 1) != 0;
          is_image = is_image && (axes[static_cast<std::size_t>(axis)] || !reflected);
          image.col(axis) = (reflected ? -1.0 : 1.0) * set.x.col(axis);
          force.col(axis) = (reflected ? -1.0 : 1.0) * set.force.col(axis);
        }
        if (!is_image) continue;
        in_whole.update(image);
        in_whole.spread(force, set.area, whole);
      }
      double worst = 0.0, largest = 0.0;
      for_each_point(half, [&](double value, const fluid::Vector3& at, int component) {
        worst = std::max(worst, std::abs(value - at_same_point(whole, at, component)));
        largest = std::max(largest, std::abs(value));
      });
      EXPECT_LT(worst, 2e-14 * largest) << name(kernel);
      for (int axis = 0; axis < 3; ++axis)
        if (axes[static_cast<std::size_t>(axis)]) set.x(3, axis) = -1e-9;
      EXPECT_THROW(in_half.update(set.x), SimulationStopped);
    }
}

TEST(MarkerTransferMirror, HalfOfASymmetricVelocityInterpolatesAsTheWhole) {
  for (const DeltaKernel kernel : delta_kernels)
    for (const auto& axes : mirror_cases) {
      const Mirrored set = mirrored_set(axes, 150, {0.9, 0.7, 0.7});
      fluid::FaceVector half = random_field(whole_or_half(axes, false)), whole(whole_or_half(axes, true));
      for_each_point(half, [&](double& value, const fluid::Vector3& at, int component) {
        const auto c = static_cast<std::size_t>(component);
        if (axes[c] && at[c] == 0.0) value = 0.0;
      });
      for_each_point(whole, [&](double& value, const fluid::Vector3& at, int component) {
        fluid::Vector3 folded = at;
        double sign = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (axes[axis] && at[axis] < 0.0) {
            folded[axis] = -at[axis];
            if (static_cast<int>(axis) == component) sign = -1.0;
          }
        value = sign * at_same_point(half, folded, component);
      });
      MarkerTransfer in_whole(whole.grid(), kernel), in_half(half.grid(), kernel);
      in_whole.update(set.x);
      in_half.update(set.x);
      VectorField from_whole = VectorField::Zero(set.x.rows(), 3), from_half = from_whole;
      in_whole.interpolate(whole, from_whole);
      in_half.interpolate(half, from_half);
      EXPECT_LT((from_whole - from_half).abs().maxCoeff(), 2e-14) << name(kernel);
    }
}

TEST(MarkerTransferAxes, ClearLeavesNothingOfAllThatWasSpreadSinceTheLastTime) {
  for_each_kernel_and_box([](DeltaKernel kernel, const Box& box) {
    MarkerTransfer transfer = box.transfer(kernel);
    const VectorField x = markers_in(box, kernel, 60);
    const Loads loads(30);
    fluid::FaceVector density(box.grid());
    transfer.update(x.topRows(30));
    transfer.spread(loads.force, loads.area, density);
    transfer.update(x.bottomRows(30));
    transfer.spread(loads.force, loads.area, density);
    transfer.update(x.topRows(1));  // new weights must not confuse what is to be cleared
    ASSERT_GT(dot(density, density), 0.0);
    transfer.clear(density);
    EXPECT_EQ(dot(density, density), 0.0);
  });
}

// A small cluster around the seam of a periodic axis: what is cleared is its box, in two parts, and no more.
TEST(MarkerTransferAxes, ClearKeepsToTheBoundingBoxAcrossTheSeam) {
  const fluid::Grid grid({0, 0, 0}, {1, 1, 1}, {20, 20, 20}, {true, true, true});
  for (const double centre : {0.0, 0.02, 0.5, 0.98, 7.0}) {
    MarkerTransfer transfer(grid);
    const VectorField x = 0.04 * VectorField::Random(50, 3) + centre;
    const Loads loads(x.rows());
    transfer.update(x);
    fluid::FaceVector density(grid);
    transfer.spread(loads.force, loads.area, density);
    density.fill(1.0);
    transfer.clear(density);
    int cleared = 0;
    for_each_point(density, [&](double value, const fluid::Vector3& at, int) {
      double distance = 0.0;
      for (const double coordinate : at) {
        const double r = coordinate - centre;
        distance = std::max(distance, std::abs(r - std::round(r)));
      }
      if (value == 0.0) ++cleared;
      EXPECT_TRUE(value == 1.0 || distance < 0.04 + 0.15 + 1e-9);  // at most three spacings beyond the cluster
    });
    EXPECT_GE(cleared, 3 * 5 * 5 * 5);
    EXPECT_LE(cleared, 3 * 7 * 7 * 7);
  }
}

TEST(MarkerTransfer, SeveralMembranesShareOneDensity) {
  const Box box{{p, w, m}};
  MarkerTransfer first = box.transfer(DeltaKernel::smoothed_four_point), second = box.transfer(DeltaKernel::six_point);
  const VectorField x = markers_in(box, DeltaKernel::six_point, 70);
  const Loads few(20), many(50);
  first.update(x.topRows(20));
  second.update(x.bottomRows(50));
  fluid::FaceVector together(box.grid()), alone(box.grid()), other(box.grid());
  first.spread(few.force, few.area, together);
  second.spread(many.force, many.area, together);
  MarkerTransfer first_alone = box.transfer(DeltaKernel::smoothed_four_point);
  MarkerTransfer second_alone = box.transfer(DeltaKernel::six_point);
  first_alone.update(x.topRows(20));
  first_alone.spread(few.force, few.area, alone);
  second_alone.update(x.bottomRows(50));
  second_alone.spread(many.force, many.area, other);
  const double sum = dot(together, together);
  EXPECT_NEAR(sum, dot(alone, alone) + 2.0 * dot(alone, other) + dot(other, other), 1e-12 * sum);
  first.clear(together);
  second.clear(together);
  EXPECT_EQ(dot(together, together), 0.0);
}

TEST(MarkerTransferAxes, GivesTheSameBitsForEveryNumberOfThreads) {
  const int threads_before = omp_get_max_threads();
  for (const DeltaKernel kernel : {DeltaKernel::smoothed_four_point, DeltaKernel::composite_bspline_54})
    for (const Box& box : boxes) {
      const VectorField x = markers_in(box, kernel, 300);
      const Loads loads(x.rows());
      const fluid::FaceVector u = random_field(box.grid());
      const auto with = [&](int threads) {
        omp_set_num_threads(threads);
        MarkerTransfer transfer = box.transfer(kernel);
        transfer.update(x);
        fluid::FaceVector density(box.grid());
        transfer.spread(loads.force, loads.area, density);
        VectorField velocity = VectorField::Zero(x.rows(), 3);
        transfer.interpolate(u, velocity);
        return std::pair(std::move(density), velocity);
      };
      const auto one = with(1);
      for (const int threads : {2, 3, 7}) {
        const auto several = with(threads);
        for (std::size_t c = 0; c < 3; ++c) {
          const auto a = one.first.points()[c], b = several.first.points()[c];
          EXPECT_TRUE(std::equal(a.data, a.row(a.extent[1], a.extent[2] - 1), b.data)) << box.describe();
        }
        EXPECT_TRUE((one.second == several.second).all()) << box.describe();
      }
    }
  omp_set_num_threads(threads_before);
}

TEST(MarkerTransferAxes, WarmedUpCallsAllocateNothing) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  for_each_kernel_and_box([](DeltaKernel kernel, const Box& box) {
    MarkerTransfer transfer = box.transfer(kernel);
    const VectorField x = markers_in(box, kernel, 50);
    const Loads loads(x.rows());
    fluid::FaceVector density(box.grid());
    VectorField velocity = VectorField::Zero(x.rows(), 3);
    const auto calls = [&] {
      transfer.clear(density);
      transfer.update(x);
      transfer.spread(loads.force, loads.area, density);
      transfer.interpolate(density, velocity);
    };
    calls();
    const long before = vesiflow::test::allocation_count();
    calls();
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
  });
}

TEST(MarkerTransferAxes, RefusesMarkersFromTheKernelsWallDistanceOn) {
  for (const DeltaKernel kernel : delta_kernels) {
    const Box box{{w, m, p}};
    const fluid::Grid grid = box.grid();
    MarkerTransfer transfer = box.transfer(kernel);
    EXPECT_EQ(transfer.wall_clearance(), wall_clearance(kernel));
    VectorField x = markers_in(box, kernel, 3);
    const auto at = [&](int axis, double s) {
      VectorField moved = x;
      moved(1, axis) = grid.lower[static_cast<std::size_t>(axis)] + s * grid.spacing(axis);
      return moved;
    };
    const double d = transfer.wall_clearance(), e = 1e-9;
    EXPECT_NO_THROW(transfer.update(at(0, d + e)));
    EXPECT_THROW(transfer.update(at(0, d - e)), SimulationStopped);
    EXPECT_NO_THROW(transfer.update(at(0, 13.0 - d - e)));
    EXPECT_THROW(transfer.update(at(0, 13.0 - d + e)), SimulationStopped);
    for (const double side : {1.0, -1.0}) {
      EXPECT_NO_THROW(transfer.update(at(1, side * (12.0 - d - e))));
      EXPECT_THROW(transfer.update(at(1, side * (12.0 - d + e))), SimulationStopped);
    }
    EXPECT_NO_THROW(transfer.update(at(2, -1e6)));
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
      for (int axis = 0; axis < 3; ++axis) EXPECT_THROW(transfer.update(at(axis, bad)), SimulationStopped);
  }
}

TEST(MarkerTransferAxes, ARefusalNamesTheFirstMarkerAndTheReason) {
  const fluid::Grid grid({0, 0, 0}, {1, 1, 1}, {10, 10, 10});
  MarkerTransfer transfer(grid, DeltaKernel::six_point);
  VectorField x = VectorField::Constant(9, 3, 0.5);
  x(4, 1) = 0.2;
  x(7, 0) = 0.2;
  try {
    transfer.update(x);
    FAIL();
  } catch (const SimulationStopped& stopped) {
    EXPECT_STREQ(
        stopped.what(),
        "marker 4 is at y = 0.200000, nearer than 2.500000 grid spacings to the wall (box 0.000000 to 1.000000)");
  }
}

TEST(MarkerTransferAxes, RefusesBoxesItCannotServe) {
  const fluid::Grid small({0, 0, 0}, {1, 1, 1}, {5, 8, 8}, {true, false, false});
  EXPECT_NO_THROW(MarkerTransfer(small, DeltaKernel::composite_bspline_54));
  try {
    MarkerTransfer(small, DeltaKernel::six_point);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "marker transfer: 5 cells along x; the kernel \"bao6\" needs at least 6 on a periodic or mirrored axis");
  }
  const fluid::Grid mirrored({0, 0, 0}, {1, 1, 1}, {5, 8, 8}, {.mirror = {true, false, false}});
  EXPECT_THROW(MarkerTransfer(mirrored, DeltaKernel::six_point), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::marker_transfer_axes_test
