// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "cholmod" backend: its matrix, limits, and the policy of factoring anew.
#ifdef VESIFLOW_WITH_CHOLMOD
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "elliptic/cholmod/cholmod_blas.h"
#include "elliptic/cholmod/cholmod_estimate.h"
#include "elliptic/cholmod/cholmod_solver.h"
#include "fluid/elliptic_solver.h"
#include "operators/sparse_operator.h"
#include "support/allocation_counter.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::cholmod_solver_test {
namespace {

using test::Numbers;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid grid({0, 0, 0}, {1, 1.4, 0.9}, {6, 7, 5});

// y = A x with the numbers of the matrix, block after block.
std::vector<double> multiply(SparseOperator& matrix, const std::vector<double>& x) {
  std::vector<double> y(x.size(), 0.0);
  for (std::int64_t column = 0; column < matrix.size(); ++column) {
    for (std::int64_t e = matrix.column_starts()[column]; e < matrix.column_starts()[column + 1]; ++e) {
      const std::int64_t row = matrix.rows()[e];
      y[row] += matrix.values()[e] * x[column];
      if (row != column) y[column] += matrix.values()[e] * x[row];
    }
  }
  return y;
}

std::vector<double> gather(const EllipticProblem& problem, const Numbers& x) {
  std::vector<double> values;
  for (int block = 0; block < problem.blocks(); ++block) {
    test::for_each_point(problem.extent(block),
                         [&](int i, int j, int k) { values.push_back(x.block(block)(i, j, k)); });
  }
  return values;
}

// Two derivations of the same operator: energies of strains here, differences of fluxes there.
TEST(SparseOperator, IsTheStencilForEveryKindAndTopology) {
  for (const test::Kind& kind : test::all_kinds) {
    for (int mask = 0; mask < 8; ++mask) {
      const Grid box = test::with_periodic_axes(grid, mask);
      for (const Viscosity& mu : {Viscosity(0.7), Viscosity(test::wavy_viscosity(box, 20.0))}) {
        for (const double alpha : {0.0, 2.0}) {
          SCOPED_TRACE(testing::Message() << kind.name << ", periodic axes " << mask << ", alpha " << alpha);
          const EllipticProblem problem = kind.problem(box, alpha, mu);
          SparseOperator matrix(problem);
          const Numbers x(problem, 71);
          std::vector<bool> grounded(problem.unknowns(), false);
          for (int block = 0; problem.has_nullspace() && block < problem.blocks(); ++block) {
            const auto n = problem.extent(block);
            x.block(block)(n[0] - 1, n[1] - 1, n[2] - 1) = 0.0;
            grounded[matrix.block_starts()[block + 1] - 1] = true;
          }
          const Numbers y(problem);
          apply(problem, x, y);
          const std::vector<double> expected = gather(problem, y);
          const std::vector<double> product = multiply(matrix, gather(problem, x));
          double difference = 0.0;
          for (std::size_t m = 0; m < product.size(); ++m) {
            difference = std::max(difference, std::abs(product[m] - (grounded[m] ? 0.0 : expected[m])));
          }
          EXPECT_LT(difference, 1e-14 * y.norm());
        }
      }
    }
  }
}

TEST(CholmodSolver, AgreesWithTheFastTransforms) {
  for (const int mask : {0, 2, 7}) {
    for (const double alpha : {0.0, 10.0}) {
      const auto problem =
          EllipticProblem::velocity(test::with_periodic_axes(grid, mask), EllipticForm::laplacian, alpha, 2.0);
      const Numbers rhs(problem, 31);
      const Numbers x(problem);
      const Numbers y(problem);
      const SolveReport fft = make_elliptic_solver(problem, FftOptions{})->solve(rhs, x);
      const SolveReport cholmod = make_elliptic_solver(problem, CholmodOptions{})->solve(rhs, y);
      EXPECT_LT(x.max_difference(y), 1e-14);
      for (int block = 0; block < 3; ++block) {
        EXPECT_NEAR(fft.removed_mean[block], cholmod.removed_mean[block], 1e-15);
      }
    }
  }
}

TEST(CholmodSolver, RefusesByTheRuleOfThumbWhatIsHopeless) {
  const Grid large({0, 0, 0}, {1, 1, 1}, {128, 128, 128});
  const EllipticProblem problem(large, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  EXPECT_THAT([&] { make_elliptic_solver(problem, CholmodOptions{}); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("2097152 unknowns"), HasSubstr("about 21"),
                                                         HasSubstr("memory_limit is 2"), HasSubstr("'fft'"))));
  EXPECT_GT(estimate_solver_memory(problem, CholmodOptions{}), std::size_t{15'000'000'000});
  EXPECT_THROW(check_solver_limits(problem, CholmodOptions{}), std::invalid_argument);
  EXPECT_THROW(check_solver_limits(problem, PcgOptions{.preconditioner = CholmodOptions{}}), std::invalid_argument);
  EXPECT_NO_THROW(check_solver_limits(problem, PcgOptions{}));
}

// Limits between the exact count and twice the rule of thumb are decided by the analysis.
TEST(CholmodSolver, RefusesByTheExactCounts) {
  const Grid box({0, 0, 0}, {1, 1, 1}, {12, 12, 12});
  const auto problem = EllipticProblem::velocity(box, EllipticForm::stress, 1.0, 1.0);
  const FactorEstimate rule = rule_of_thumb(problem);
  CholmodOptions little_memory;
  little_memory.memory_limit = 0.55 * rule.bytes;
  EXPECT_THAT(
      [&] { make_elliptic_solver(problem, little_memory); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("GB"), HasSubstr("memory_limit"), HasSubstr("'pcg'"))));
  CholmodOptions little_time;
  little_time.time_limit = 0.55 * rule.seconds();
  EXPECT_THAT([&] { make_elliptic_solver(problem, little_time); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("s to factor"), HasSubstr("time_limit"))));
}

TEST(CholmodSolver, RefusesOptionsOutOfRange) {
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 1.0, 1.0);
  const auto refused = [&](auto&& change, const char* what) {
    CholmodOptions options;
    change(options);
    EXPECT_THAT([&] { make_elliptic_solver(problem, options); }, ThrowsMessage<std::invalid_argument>(HasSubstr(what)));
  };
  refused([](CholmodOptions& o) { o.memory_limit = 0.0; }, "memory_limit of 'cholmod' is 0");
  refused([](CholmodOptions& o) { o.time_limit = -1.0; }, "time_limit of 'cholmod' is -1");
  refused([](CholmodOptions& o) { o.refactor.every = -2; }, "refactor.every of 'cholmod' is -2");
  refused([](CholmodOptions& o) { o.refactor.change = -0.5; }, "refactor.change of 'cholmod' is -0.5");
}

// After k updates to viscosities scaled by factors[k], the expected number of factorisations.
void check_factorisations(const RefactorPolicy& policy, const std::vector<double>& factors,
                          const std::vector<int>& expected) {
  const auto mu = test::wavy_viscosity(grid, 5.0);
  const auto original = mu->clone();
  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, Viscosity(mu));
  CholmodOptions options;
  options.refactor = policy;
  const auto solver = make_elliptic_solver(problem, options);
  EXPECT_EQ(solver->factorisations(), 1);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    for (std::size_t i = 0; i < mu->size(); ++i) mu->data()[i] = factors[k] * original.data()[i];
    solver->update(problem);
    EXPECT_EQ(solver->factorisations(), expected[k]) << "update " << k + 1;
    const Numbers rhs(problem, 72);
    const Numbers x(problem);
    EXPECT_TRUE(solver->solve(rhs, x).converged);
    EXPECT_LT(relative_residual(problem, rhs, x), 1e-8);
  }
}

TEST(RefactorPolicy, FactorsAtEveryChangeByDefault) {
  check_factorisations({}, {1.0, 1.001, 1.001, 2.0}, {1, 2, 2, 3});
}

TEST(RefactorPolicy, FactorsAtMostAtEveryNthUpdate) {
  check_factorisations({.every = 3, .change = 0.0}, {1.1, 1.2, 1.3, 1.4, 1.5, 1.6}, {1, 1, 2, 2, 2, 3});
}

TEST(RefactorPolicy, FactorsWhenTheCoefficientsHaveMovedFarEnough) {
  // By more than 20 % of what was factored: 1, then 1.25.
  check_factorisations({.every = 1, .change = 0.2}, {1.1, 1.19, 1.25, 1.4, 1.05, 0.9}, {1, 1, 2, 2, 2, 3});
}

TEST(RefactorPolicy, NeverFactorsAgainIfToldSo) {
  check_factorisations({.every = 0, .change = 0.0}, {2.0, 0.5, 10.0}, {1, 1, 1});
}

TEST(RefactorPolicy, OneCellIsEnough) {
  const auto mu = test::wavy_viscosity(grid, 5.0);
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::dirichlet, 0.0, Viscosity(mu));
  CholmodOptions options;
  options.refactor.change = 0.5;
  const auto solver = make_elliptic_solver(problem, options);
  (*mu)(3, 2, 4) *= 1.4;
  solver->update(problem);
  EXPECT_EQ(solver->factorisations(), 1);
  (*mu)(3, 2, 4) *= 1.4;
  solver->update(problem);
  EXPECT_EQ(solver->factorisations(), 2);
  EllipticProblem other_alpha = problem;
  other_alpha.alpha = 1.0;  // from zero: any change is too much
  solver->update(other_alpha);
  EXPECT_EQ(solver->factorisations(), 3);
}

TEST(RefactorPolicy, ANullspaceThatComesOrGoesIsAlwaysFactored) {
  CholmodOptions options;
  options.refactor.every = 0;
  const auto problem = [](double alpha) {
    return EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, alpha, 1.0);
  };
  const auto solver = make_elliptic_solver(problem(1.0), options);
  solver->update(problem(3.0));
  EXPECT_EQ(solver->factorisations(), 1);
  solver->update(problem(0.0));
  EXPECT_EQ(solver->factorisations(), 2);
}

// The solver alone, without conjugate gradients around it, solves the factored problem.
TEST(CholmodSolver, IsAPreconditionerWhenItsFactorLags) {
  CholmodOptions options;
  options.refactor.every = 0;
  const EllipticProblem factored(grid, Centring::cell, BoundaryCondition::dirichlet, 1.0, 1.0);
  EllipticProblem other = factored;
  other.mu = 2.0;
  CholmodSolver solver(factored, options);
  solver.update(other);
  const Numbers rhs(factored, 73);
  const Numbers x(factored);
  solver.solve(rhs, x);
  EXPECT_LT(relative_residual(factored, rhs, x), 1e-13);
  EXPECT_GT(relative_residual(other, rhs, x), 0.1);
}

TEST(CholmodSolver, DoesNotAllocateInASolve) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, 1.0);
  CholmodOptions lagged;
  lagged.refactor.every = 5;
  for (const CholmodOptions& options : {CholmodOptions{}, lagged}) {
    const auto solver = make_elliptic_solver(problem, options);
    const Numbers rhs(problem, 74);
    const Numbers x(problem);
    solver->solve(rhs, x);
    const long before = vesiflow::test::allocation_count();
    solver->solve(rhs, rhs);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
  }
}

// Large enough for METIS, which draws random numbers of the process.
TEST(CholmodSolver, HasTheSameBitsWhereThreadsFactorSideBySide) {
  const auto problem =
      EllipticProblem::velocity(Grid({0, 0, 0}, {1, 1, 1}, {12, 12, 12}), EllipticForm::stress, 1.0, 1.0);
  const Numbers rhs(problem, 76), alone(problem);
  make_elliptic_solver(problem, CholmodOptions{})->solve(rhs, alone);
  const std::array<Numbers, 2> x{Numbers(problem), Numbers(problem)};
  {
    const auto solve = [&](const Numbers& solution) {
      make_elliptic_solver(problem, CholmodOptions{})->solve(rhs, solution);
    };
    const std::jthread first([&] { solve(x[0]); }), second([&] { solve(x[1]); });
  }
  for (const Numbers& solution : x) EXPECT_TRUE(solution.same_bits(alone));
}

// OpenBLAS, if that is the BLAS and has threads; the number of before is given back.
class BlasThreads : public testing::Test {
 protected:
  using Get = int (*)();
  using Set = void (*)(int);
  using Dgemm = void (*)(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
                         const int*, const double*, const int*, const double*, double*, const int*);

  void SetUp() override {
    if (get == nullptr || set == nullptr || kind == nullptr) GTEST_SKIP() << "the BLAS is not OpenBLAS";
    if (kind() == 0) GTEST_SKIP() << "this OpenBLAS has no threads";
    before_ = get();
  }
  void TearDown() override {
    if (before_ > 0) set(before_);
  }
  bool are_of_openmp() const { return kind() == 2; }

  Get get = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  Set set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  Get kind = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_parallel"));

 private:
  int before_ = 0;
};

// Large enough for products that OpenBLAS divides: without the guard the bits do differ.
EllipticProblem divided_problem() {
  return EllipticProblem::velocity(Grid({0, 0, 0}, {1, 1, 1}, {16, 16, 16}), EllipticForm::stress, 1.0, 1.0);
}

TEST_F(BlasThreads, SolutionsHaveTheSameBitsForAnyNumber) {
  const EllipticProblem problem = divided_problem();
  const Numbers rhs(problem, 75);
  const std::array<Numbers, 2> x{Numbers(problem), Numbers(problem)};
  for (const int threads : {1, 2}) {
    set(threads);
    const int granted = get();
    make_elliptic_solver(problem, CholmodOptions{})->solve(rhs, x[threads - 1]);
    EXPECT_EQ(get(), granted);
  }
  EXPECT_TRUE(x[0].same_bits(x[1]));
}

// Two threads of a host program may factor side by side.
TEST_F(BlasThreads, TheLastToLeaveGivesThemBack) {
  if (are_of_openmp()) GTEST_SKIP() << "their number is not the process's";
  set(2);
  const int granted = get();
  auto first = std::make_unique<OneBlasThread>();
  auto second = std::make_unique<OneBlasThread>();
  EXPECT_EQ(get(), 1);
  first.reset();
  EXPECT_EQ(get(), 1) << "the second is still at work";
  second.reset();
  EXPECT_EQ(get(), granted);
}

TEST_F(BlasThreads, ANumberThatTheHostSetsMeanwhileStays) {
  if (are_of_openmp()) GTEST_SKIP() << "their number is not the process's";
  set(2);
  auto guard = std::make_unique<OneBlasThread>();
  set(3);
  const int granted = get();
  guard.reset();
  EXPECT_EQ(get(), granted);
}

// A thread of the host multiplies matrices of small integers, which are exact however the sums are divided, while
// another factors and solves.
TEST_F(BlasThreads, AHostMayUseBlasWhileWeFactor) {
  const auto dgemm = reinterpret_cast<Dgemm>(dlsym(RTLD_DEFAULT, "dgemm_"));
  ASSERT_NE(dgemm, nullptr);
  set(2);
  const int granted = get(), openmp_before = omp_get_max_threads();
  const EllipticProblem problem = divided_problem();
  const Numbers rhs(problem, 75), alone(problem);
  make_elliptic_solver(problem, CholmodOptions{})->solve(rhs, alone);

  constexpr int n = 128;  // beyond 64^3 products OpenBLAS divides them
  std::vector<double> a(n * n), b(n * n), expected(n * n, 0.0);
  for (int i = 0; i < n * n; ++i) {
    a[i] = (37 * i) % 11 - 5;
    b[i] = (53 * i) % 13 - 6;
  }
  for (int column = 0; column < n; ++column)
    for (int k = 0; k < n; ++k)
      for (int row = 0; row < n; ++row) expected[row + n * column] += a[row + n * k] * b[k + n * column];
  std::atomic<bool> done = false;
  std::atomic<long> products = 0, wrong = 0;
  std::thread host([&] {
    const double one = 1.0, zero = 0.0;
    std::vector<double> c(n * n);
    while (!done || products == 0) {
      dgemm("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
      if (c != expected) ++wrong;
      ++products;
    }
  });
  for (int repetition = 0; repetition < 3; ++repetition) {
    const Numbers x(problem);
    const auto solver = make_elliptic_solver(problem, CholmodOptions{});
    for (int again = 0; again < 5; ++again) solver->solve(rhs, x);
    EXPECT_TRUE(x.same_bits(alone)) << "repetition " << repetition;
  }
  done = true;
  host.join();
  EXPECT_EQ(wrong, 0) << "of " << products;
  EXPECT_EQ(get(), granted);
  EXPECT_EQ(omp_get_max_threads(), openmp_before);
}

}  // namespace
}  // namespace vesiflow::fluid::cholmod_solver_test
#endif
