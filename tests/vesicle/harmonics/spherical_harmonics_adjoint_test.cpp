// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Adjoints, shared Legendre sums, threads and allocations of the transforms.
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "support.h"
#include "support/allocation_counter.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace vesiflow::vesicle::spherical_harmonics_adjoint_test {
namespace {

using testing::random_coefficients;

struct Case {
  int latitudes, longitudes, degrees, fields;
};

/// Fewer and more degrees than latitudes (with several windings of the orders), more longitudes than twice the
/// latitudes, the smallest grids, both parities, and panels of four and of eight rows.
const Case cases[] = {{2, 4, 2, 1},    {3, 6, 3, 2},    {4, 8, 9, 1},    {5, 14, 5, 3},
                      {8, 16, 16, 3},  {9, 18, 23, 2},  {7, 30, 14, 1},  {12, 24, 12, 4},
                      {16, 40, 10, 5}, {31, 62, 31, 3}, {32, 64, 64, 1}, {33, 66, 33, 6}};

Eigen::ArrayXXd random_fields(const SphereGrid& grid, int fields, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::ArrayXXd::NullaryExpr(grid.size(), fields, [&] { return uniform(generator); });
}

/// |a - b| is rounding beside the terms of the two sums, of which `scale` is a bound.
void expect_equal_sums(double a, double b, double scale, const Case& c) {
  EXPECT_NEAR(a, b, 1e-14 * scale) << c.latitudes << ' ' << c.longitudes << ' ' << c.degrees;
}

double norm(const Eigen::ArrayXXd& field) {
  return std::sqrt(field.square().sum());
}

TEST(HarmonicAdjoints, Synthesis) {
  for (const Case& k : cases) {
    const SphereGrid grid(k.latitudes, k.longitudes);
    const SphericalHarmonics harmonics(k.degrees, grid);
    const Coefficients c = random_coefficients(k.degrees, k.fields, 1);
    const Eigen::ArrayXXd f = random_fields(grid, k.fields, 2);
    Eigen::ArrayXXd values(grid.size(), k.fields);
    Coefficients adjoint;
    harmonics.synthesis(c, values);
    harmonics.synthesis_adjoint(f, adjoint);
    expect_equal_sums((f * values).sum(), adjoint.dot(c), norm(f) * norm(values), k);
  }
}

TEST(HarmonicAdjoints, Gradient) {
  for (const Case& k : cases) {
    const SphereGrid grid(k.latitudes, k.longitudes);
    const SphericalHarmonics harmonics(k.degrees, grid);
    const Coefficients c = random_coefficients(k.degrees, k.fields, 3);
    const Eigen::ArrayXXd f = random_fields(grid, k.fields, 4), g = random_fields(grid, k.fields, 5);
    Eigen::ArrayXXd theta = f, phi = f;
    Coefficients adjoint;
    harmonics.gradient(c, theta, phi);
    harmonics.gradient_adjoint(f, g, adjoint);
    expect_equal_sums((f * theta + g * phi).sum(), adjoint.dot(c), norm(f) * norm(theta) + norm(g) * norm(phi), k);
  }
}

TEST(HarmonicAdjoints, SecondDerivatives) {
  for (const Case& k : cases) {
    const SphereGrid grid(k.latitudes, k.longitudes);
    const SphericalHarmonics harmonics(k.degrees, grid);
    const Coefficients c = random_coefficients(k.degrees, k.fields, 6);
    const Eigen::ArrayXXd f = random_fields(grid, k.fields, 7), g = random_fields(grid, k.fields, 8),
                          h = random_fields(grid, k.fields, 9);
    Eigen::ArrayXXd tt = f, tp = f, pp = f;
    Coefficients adjoint;
    harmonics.second_derivatives(c, tt, tp, pp);
    harmonics.second_derivatives_adjoint(f, g, h, adjoint);
    expect_equal_sums((f * tt + g * tp + h * pp).sum(), adjoint.dot(c),
                      norm(f) * norm(tt) + norm(g) * norm(tp) + norm(h) * norm(pp), k);
  }
}

TEST(HarmonicAdjoints, Analysis) {
  for (const Case& k : cases) {
    if (k.degrees > k.latitudes) continue;
    const SphereGrid grid(k.latitudes, k.longitudes);
    const SphericalHarmonics harmonics(k.degrees, grid);
    const Coefficients c = random_coefficients(k.degrees, k.fields, 10);
    const Eigen::ArrayXXd f = random_fields(grid, k.fields, 11);
    Eigen::ArrayXXd adjoint = f;
    Coefficients analysed;
    harmonics.analysis(f, analysed);
    harmonics.analysis_adjoint(c, adjoint);
    expect_equal_sums(analysed.dot(c), (f * adjoint).sum(), norm(f) * norm(adjoint), k);
  }
}

/// Sharing changes no bit, whatever is asked for with what.
TEST(SharedLegendreSums, GiveTheBitsOfSeparateCalls) {
  const SphereGrid grid(11);
  const SphericalHarmonics harmonics(17, grid);
  const Coefficients c = random_coefficients(17, 2, 12);
  Eigen::ArrayXXd f(grid.size(), 2), t = f, p = f, tt = f, tp = f, pp = f;
  harmonics.synthesis(c, f);
  harmonics.gradient(c, t, p);
  harmonics.second_derivatives(c, tt, tp, pp);
  Eigen::ArrayXXd f2 = f, t2 = f, p2 = f, tt2 = f, tp2 = f, pp2 = f;
  harmonics.derivatives(c, t2, p2, tt2, tp2, pp2);
  harmonics.evaluate(c, {{Derivative::theta_theta, tt}, {Derivative::value, f2}, {Derivative::theta, t}});
  EXPECT_TRUE((f == f2).all() && (t == t2).all() && (p == p2).all());
  EXPECT_TRUE((tt == tt2).all() && (tp == tp2).all() && (pp == pp2).all());
  EXPECT_THROW(harmonics.evaluate(c, {{Derivative::value, f}, {Derivative::value, f2}}), std::invalid_argument);
}

/// Columns of a batch are what each field gives alone, for widths that use all kernels, and from arrays that begin
/// anywhere.
TEST(Batches, GiveTheBitsOfSingleFieldsAtAnyAddress) {
  const SphereGrid grid(19);
  const SphericalHarmonics harmonics(19, grid);
  for (int fields : {2, 3, 4, 5, 9}) {
    const Coefficients c = random_coefficients(19, fields, 13);
    std::vector<double> memory(std::size_t(grid.size()) * fields + 1);
    Eigen::Map<Eigen::ArrayXXd> all(memory.data() + 1, grid.size(), fields);
    harmonics.synthesis(c, all);
    Coefficients analysed;
    harmonics.analysis(all, analysed);
    for (int field = 0; field < fields; ++field) {
      Coefficients one(19, 1), found;
      for (int n = 0; n < 19; ++n)
        for (int m = 0; m <= n; ++m) one(0, n, m) = c(field, n, m);
      ScalarField alone(grid.size());
      harmonics.synthesis(one, alone);
      EXPECT_TRUE((alone == all.col(field)).all());
      harmonics.analysis(alone, found);
      for (int n = 0; n < 19; ++n)
        for (int m = 0; m <= n; ++m) EXPECT_EQ(found(0, n, m), analysed(field, n, m));
    }
  }
}

TEST(Plans, OfOneShapeMayWorkAtTheSameTime) {
  const SphereGrid grid(24);
  const Coefficients c = random_coefficients(24, 3, 14);
  VectorField expected(grid.size(), 3);
  SphericalHarmonics(24, grid).synthesis(c, expected);
  std::vector<VectorField> values(4, VectorField(grid.size(), 3));
  std::vector<std::thread> threads;
  for (VectorField& result : values)
    threads.emplace_back([&] {
      for (int repetition = 0; repetition < 20; ++repetition) {
        const SphericalHarmonics harmonics(24, grid);
        Coefficients found;
        harmonics.synthesis(c, result);
        harmonics.analysis(result, found);
        harmonics.synthesis(found, result);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const VectorField& result : values) {
    EXPECT_LT((result - expected).abs().maxCoeff(), 1e-12);
    EXPECT_TRUE((result == values[0]).all());
  }
}

TEST(Plans, PreparedAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const SphereGrid grid(10);
  SphericalHarmonics harmonics(10, grid, 1);
  harmonics.prepare({.analysis = true, .synthesis = true, .gradient = true, .derivatives = true, .adjoints = true}, 3);
  Coefficients c = random_coefficients(10, 3, 15), d(10, 3);
  VectorField f(grid.size(), 3), t = f, p = f, tt = f, tp = f, pp = f;
  const long before = test::allocation_count();
  harmonics.synthesis(c, f);
  harmonics.analysis(f, d);
  harmonics.gradient(c, t, p);
  harmonics.derivatives(c, t, p, tt, tp, pp);
  harmonics.analysis_adjoint(c, f);
  harmonics.synthesis_adjoint(f, d);
  harmonics.gradient_adjoint(t, p, d);
  harmonics.second_derivatives_adjoint(tt, tp, pp, d);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

#ifdef _OPENMP
/// Large enough for threads; three of them share nothing evenly.
TEST(Threads, ChangeNoBit) {
  const int before = omp_get_max_threads();
  const SphereGrid grid(90);
  const Coefficients c = random_coefficients(90, 3, 16);
  std::vector<VectorField> theta, phi;
  std::vector<Coefficients> analysed(2);
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    const SphericalHarmonics harmonics(90, grid);
    theta.emplace_back(grid.size(), 3);
    phi.emplace_back(grid.size(), 3);
    harmonics.gradient(c, theta.back(), phi.back());
    harmonics.analysis(phi.back(), analysed[threads - 1]);
  }
  omp_set_num_threads(before);
  EXPECT_TRUE((theta[0] == theta[1]).all() && (phi[0] == phi[1]).all());
  for (int field = 0; field < 3; ++field)
    for (int n = 0; n < 90; ++n)
      for (int m = 0; m <= n; ++m) EXPECT_EQ(analysed[0](field, n, m), analysed[1](field, n, m));
}
#endif

}  // namespace
}  // namespace vesiflow::vesicle::spherical_harmonics_adjoint_test
