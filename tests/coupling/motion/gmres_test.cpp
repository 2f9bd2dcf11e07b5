// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/gmres.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "support/allocation_counter.h"

namespace vesiflow::coupling::gmres_test {
namespace {

using Vector = Gmres::Vector;

constexpr int size = 30;

Vector random_vector(int length, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector x(length);
  for (double& value : x) value = uniform(generator);
  return x;
}

/// Not symmetric, its eigenvalues about 1 as those of the operators this is for.
Eigen::MatrixXd matrix(double distance_from_one) {
  Eigen::MatrixXd a(size, size);
  for (int j = 0; j < size; ++j) a.col(j) = distance_from_one * random_vector(size, 100 + static_cast<unsigned>(j));
  return a + Eigen::MatrixXd::Identity(size, size);
}

Gmres::Operator by(const Eigen::MatrixXd& a) {
  return [&a](const Vector& x, Vector& result) { result.noalias() = a * x; };
}

TEST(Gmres, SolvesANonsymmetricSystem) {
  const Eigen::MatrixXd a = matrix(0.1);
  const Vector b = random_vector(size, 1), exact = a.partialPivLu().solve(b);
  Gmres gmres(size);
  Vector x;
  const Gmres::Report report = gmres.solve(by(a), b, 1e-12, x);
  EXPECT_LE(report.residual, 1e-12);
  EXPECT_LT((x - exact).norm(), 1e-11 * exact.norm());
}

/// The residual it knows is the true one, falls with every iteration, and stops it as soon as it may.
TEST(Gmres, ReportsTheResidualAndStopsByIt) {
  const Eigen::MatrixXd a = matrix(0.1);
  const Vector b = random_vector(size, 2);
  double last = 1.0;
  for (int iterations = 1; iterations < 20; ++iterations) {
    Gmres gmres(iterations);
    Vector x;
    const Gmres::Report report = gmres.solve(by(a), b, 0.0, x);
    EXPECT_EQ(report.iterations, iterations);
    EXPECT_NEAR(report.residual, (b - a * x).norm() / b.norm(), 1e-14);
    EXPECT_LE(report.residual, last);
    last = report.residual;
    Gmres stopped(size);
    EXPECT_EQ(stopped.solve(by(a), b, report.residual * (1 + 1e-9), x).iterations, iterations);
  }
}

/// The least residual in the Krylov space, by an orthogonal projection of its own.
TEST(Gmres, HasTheLeastResidualOfItsKrylovSpace) {
  const Eigen::MatrixXd a = matrix(0.3);
  const Vector b = random_vector(size, 3);
  constexpr int iterations = 6;
  Eigen::MatrixXd space(size, iterations);
  space.col(0) = b / b.norm();
  for (int k = 1; k < iterations; ++k) space.col(k) = (a * space.col(k - 1)).normalized();
  const Eigen::MatrixXd image = a * space;
  const Vector best = (image.transpose() * image).partialPivLu().solve(image.transpose() * b);
  Gmres gmres(iterations);
  Vector x;
  const Gmres::Report report = gmres.solve(by(a), b, 0.0, x);
  EXPECT_NEAR(report.residual, (b - image * best).norm() / b.norm(), 1e-10);
}

TEST(Gmres, IsExactAfterAsManyIterationsAsUnknowns) {
  const Eigen::MatrixXd a = matrix(1.0);  // nothing near one any more
  const Vector b = random_vector(size, 4), exact = a.partialPivLu().solve(b);
  Gmres gmres(size);
  Vector x;
  const Gmres::Report report = gmres.solve(by(a), b, 1e-13, x);
  EXPECT_LT(report.residual, 1e-11);
  EXPECT_LT((x - exact).norm(), 1e-9 * exact.norm());
  // Earlier where the matrix has few eigenvalues: two here.
  Vector diagonal = Vector::Constant(size, 2.0);
  diagonal.head(7).setConstant(-0.5);
  const Eigen::MatrixXd two = diagonal.asDiagonal();
  EXPECT_EQ(gmres.solve(by(two), b, 1e-13, x).iterations, 2);
  EXPECT_LT((x - b.cwiseQuotient(diagonal)).norm(), 1e-13 * b.norm());
}

TEST(Gmres, OfNothingIsNothing) {
  const Eigen::MatrixXd a = matrix(0.1);
  Gmres gmres(size);
  Vector x = random_vector(size, 5);
  const Gmres::Report report = gmres.solve(by(a), Vector::Zero(size), 1e-12, x);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.residual, 0.0);
  EXPECT_EQ(x.size(), size);
  EXPECT_EQ(x.norm(), 0.0);
}

/// What an earlier solve left has no part in a later one.
TEST(Gmres, SolvesDoNotDependOnEarlierOnes) {
  const Eigen::MatrixXd a = matrix(0.1), other = matrix(0.3);
  const Vector b = random_vector(size, 6);
  Gmres used(size), fresh(size);
  Vector x, y;
  used.solve(by(other), random_vector(size, 7), 1e-12, y);
  used.solve(by(a), b, 1e-6, x);
  fresh.solve(by(a), b, 1e-6, y);
  EXPECT_TRUE((x.array() == y.array()).all());
}

TEST(Gmres, ASecondSolveAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const Eigen::MatrixXd a = matrix(0.1);
  const Vector b = random_vector(size, 8);
  const Gmres::Operator apply = by(a);
  Gmres gmres(size);
  Vector x;
  gmres.solve(apply, b, 1e-3, x);
  const long before = test::allocation_count();
  gmres.solve(apply, b, 1e-10, x);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

}  // namespace
}  // namespace vesiflow::coupling::gmres_test
