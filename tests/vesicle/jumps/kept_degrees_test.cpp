// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What is kept of a membrane's jumps, and how it is handed over.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "jumps/exact_jumps.h"
#include "support.h"
#include "support/allocation_counter.h"
#include "vesicle/membrane_jumps.h"
#include "vesicle/scale_degrees.h"
#include "vesicle/shapes.h"

namespace vesiflow::vesicle::kept_degrees_test {
namespace {

constexpr int latitudes = 24;

struct KeptDegrees : ::testing::Test {
  KeptDegrees() { surface.update(ellipsoid(grid, {1, 1.2, 1.5})); }

  MembraneJumps jumps_with(const JumpParameters& parameters) const {
    MembraneJumps jumps(grid, parameters);
    jumps.update(surface);
    return jumps;
  }

  /// Coefficients as one row each, to compare.
  static Eigen::ArrayXXcd table(const Coefficients& c) {
    Eigen::ArrayXXcd result(c.degrees() * (c.degrees() + 1) / 2, c.fields());
    Eigen::Index row = 0;
    for (int n = 0; n < c.degrees(); ++n)
      for (int m = 0; m <= n; ++m, ++row)
        for (int field = 0; field < c.fields(); ++field) result(row, field) = c(field, n, m);
    return result;
  }

  const SphereGrid grid{latitudes};
  Surface surface{grid};
  const VectorField force = testing::smooth_vector(grid, latitudes, 1);
  const VectorField velocity_jump = testing::smooth_vector(grid, latitudes, 2);
};

/// Twelve fields without a velocity jump and fifteen with one, the first twelve in the same places.
TEST_F(KeptDegrees, CoefficientsAreThoseOfTheMarkers) {
  MembraneJumps jumps = jumps_with({});
  EXPECT_EQ(jumps.coefficients().fields(), 0);
  EXPECT_TRUE((jumps.at_markers() == 0).all());
  for (const bool with_jump : {false, true, false}) {
    with_jump ? jumps.compute(force, velocity_jump) : jumps.compute(force);
    EXPECT_EQ(jumps.has_velocity_jump(), with_jump);
    ASSERT_EQ(jumps.coefficients().fields(), with_jump ? 15 : 12);
    ASSERT_EQ(jumps.coefficients().degrees(), latitudes);
    ASSERT_EQ(jumps.at_markers().cols(), with_jump ? 15 : 12);
    Coefficients expected;
    SphericalHarmonics(latitudes, grid).analysis(jumps.at_markers(), expected);
    EXPECT_TRUE((table(jumps.coefficients()) == table(expected)).all());
  }
}

/// Synthesised on another mesh they are the exact jumps there: on a sphere, where those of a term of Lamb's solution
/// have few degrees.
TEST_F(KeptDegrees, CoefficientsServeOnAnyMesh) {
  const testing::LambTerm inside{Vector3::UnitX(), Vector3::UnitZ(), 3, false, 1.3, -0.4, 0.7};
  Surface here(SphereGrid{16}), there(SphereGrid{41, 90});
  here.update(sphere(here.grid()));
  there.update(sphere(there.grid()));
  MembraneJumps jumps(here.grid(), {.degrees = 5});
  jumps.update(here);
  jumps.compute(testing::ExactJumps(here, inside, inside.continued()).force);
  const Eigen::ArrayXXd exact = testing::ExactJumps(there, inside, inside.continued()).columns.leftCols(12);
  Eigen::ArrayXXd found(there.grid().size(), 12);
  SphericalHarmonics(5, there.grid()).synthesis(jumps.coefficients(), found);
  EXPECT_LT((found - exact).abs().maxCoeff(), 1e-12 * exact.abs().maxCoeff());
}

/// The degrees beyond are not in the result, and those of the arguments have no part in it.
TEST_F(KeptDegrees, OthersAreAbsentAndWithoutEffect) {
  MembraneJumps jumps = jumps_with({.degrees = 9}), more_jumps = jumps_with({.degrees = 9, .jump_degrees = 14});
  const auto low = [&](const VectorField& field) {
    Coefficients c;
    VectorField result(grid.size(), 3);
    SphericalHarmonics(9, grid).analysis(field, c);
    SphericalHarmonics(9, grid).synthesis(c, result);
    return result;
  };
  jumps.compute(force, velocity_jump);
  const Eigen::ArrayXXcd all = table(jumps.coefficients());
  EXPECT_EQ(jumps.coefficients().degrees(), 9);
  EXPECT_LT((Eigen::ArrayXXd(jumps.at_markers().rightCols<3>()) - low(velocity_jump)).abs().maxCoeff(), 1e-13);
  more_jumps.compute(force, velocity_jump);
  EXPECT_EQ(more_jumps.coefficients().degrees(), 14);
  EXPECT_TRUE((table(more_jumps.coefficients()).topRows(all.rows()) == all).all());
  jumps.compute(low(force), low(velocity_jump));
  EXPECT_LT((table(jumps.coefficients()) - all).abs().maxCoeff(), 1e-11 * all.abs().maxCoeff());
  jumps.compute(force - low(force), velocity_jump - low(velocity_jump));
  EXPECT_LT(table(jumps.coefficients()).abs().maxCoeff(), 1e-11 * all.abs().maxCoeff());
}

/// The smooth cut multiplies degree n by exp(-36 (n / degrees)^8): of the arguments and then of the jumps.
TEST_F(KeptDegrees, TheSmoothCutDampsArgumentsAndJumps) {
  constexpr int degrees = 10, jump_degrees = 12;
  const auto damp = [&](const Eigen::ArrayXXd& fields, int kept) {
    Coefficients c;
    SphericalHarmonics(kept, grid).analysis(fields, c);
    scale_degrees(c, [&](int n) { return std::exp(-36 * std::pow(n / double(kept), 8)); });
    return c;
  };
  const auto damped = [&](const VectorField& field) {
    VectorField result(grid.size(), 3);
    SphericalHarmonics(degrees, grid).synthesis(damp(field, degrees), result);
    return result;
  };
  MembraneJumps all = jumps_with({});
  all.compute(damped(force), damped(velocity_jump));
  const Eigen::ArrayXXcd expected = table(damp(all.at_markers(), jump_degrees));
  MembraneJumps jumps = jumps_with({.degrees = degrees, .jump_degrees = jump_degrees, .cut = DegreeCut::smooth});
  jumps.compute(force, velocity_jump);
  EXPECT_LT((table(jumps.coefficients()) - expected).abs().maxCoeff(), 1e-11 * expected.abs().maxCoeff());
}

/// Jumps stay as they are while the shape changes or goes.
TEST_F(KeptDegrees, ANewShapeCountsFromItsUpdateOn) {
  MembraneJumps jumps = jumps_with({});
  jumps.compute(force, velocity_jump);
  const Eigen::ArrayXXd before = jumps.at_markers();
  Surface other(grid);
  other.update(spheroid(grid, 0.7));
  {
    Surface gone(grid);
    gone.update(spheroid(grid, 0.7));
    jumps.update(gone);
  }
  EXPECT_TRUE((jumps.at_markers() == before).all());
  jumps.compute(force, velocity_jump);
  MembraneJumps fresh(grid);
  fresh.update(other);
  fresh.compute(force, velocity_jump);
  EXPECT_TRUE((jumps.at_markers() == fresh.at_markers()).all());
}

TEST_F(KeptDegrees, AWarmedUpCallAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  for (const JumpParameters& parameters :
       {JumpParameters{}, JumpParameters{.degrees = 10}, JumpParameters{10, 15, DegreeCut::smooth}}) {
    MembraneJumps jumps(grid, parameters);
    const auto call = [&] {
      jumps.update(surface);
      jumps.compute(force);
      jumps.compute(force, velocity_jump);
      jumps.compute(force);
    };
    call();
    const long before = test::allocation_count();
    call();
    EXPECT_EQ(test::allocation_count() - before, 0);
  }
}

#ifdef _OPENMP
/// Large enough for threads.
TEST(KeptDegreesThreads, ChangeNoBit) {
  const int before = omp_get_max_threads();
  const SphereGrid grid(90);
  Surface surface(grid);
  surface.update(ellipsoid(grid, {1, 1.2, 1.5}));
  const VectorField force = testing::smooth_vector(grid, 20, 1), velocity_jump = testing::smooth_vector(grid, 20, 2);
  std::vector<Eigen::ArrayXXd> results, expansions;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    MembraneJumps jumps(grid, {.degrees = 40});
    jumps.update(surface);
    jumps.compute(force, velocity_jump);
    results.push_back(jumps.at_markers());
    expansions.emplace_back(grid.size(), 15);
    omp_set_num_threads(1);
    SphericalHarmonics(40, grid).synthesis(jumps.coefficients(), expansions.back());
  }
  omp_set_num_threads(before);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_TRUE((results[0] == results[i]).all());
    EXPECT_TRUE((expansions[0] == expansions[i]).all());
  }
}
#endif

TEST_F(KeptDegrees, WrongArgumentsAreRefused) {
  const VectorField wrong = VectorField::Ones(grid.size() + 2, 3);
  MembraneJumps jumps(grid);
  EXPECT_THROW(jumps.compute(force), std::logic_error) << "no surface yet";
  jumps.update(surface);
  jumps.compute(force);
  const Eigen::ArrayXXd before = jumps.at_markers();
  EXPECT_THROW(jumps.compute(wrong), std::invalid_argument);
  EXPECT_THROW(jumps.compute(wrong, velocity_jump), std::invalid_argument);
  EXPECT_THROW(jumps.compute(force, wrong), std::invalid_argument);
  testing::expect_refused_if_not_finite(force, [&](const VectorField& f) { jumps.compute(f); });
  testing::expect_refused_if_not_finite(force, [&](const VectorField& f) { jumps.compute(f, velocity_jump); });
  testing::expect_refused_if_not_finite(force, [&](const VectorField& q) { jumps.compute(force, q); });
  Surface wide(SphereGrid{latitudes, 2 * latitudes + 2});
  wide.update(sphere(wide.grid()));
  EXPECT_THROW(jumps.update(wide), std::invalid_argument);
  EXPECT_FALSE(jumps.has_velocity_jump());
  EXPECT_TRUE((jumps.at_markers() == before).all());
  for (const int degrees : {-1, latitudes + 1}) {
    EXPECT_THROW(MembraneJumps(grid, {.degrees = degrees}), std::invalid_argument);
    EXPECT_THROW(MembraneJumps(grid, {.jump_degrees = degrees}), std::invalid_argument);
  }
  EXPECT_THROW(MembraneJumps(SphereGrid{3}), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::kept_degrees_test
