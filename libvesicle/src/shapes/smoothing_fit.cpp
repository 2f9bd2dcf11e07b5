// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/smoothing_fit.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/Cholesky>

#include "harmonics/harmonics_at.h"
#include "vesicle/mesh_energy.h"

namespace vesiflow::vesicle {
namespace {

/// Rows of the basis, each times the root of its weight.
Eigen::MatrixXd weighted_basis(const VectorField& directions, const Eigen::VectorXd& root, int degrees) {
  Eigen::MatrixXd transposed(Eigen::Index{degrees} * degrees, directions.rows());
  for (Eigen::Index i = 0; i < directions.rows(); ++i) {
    harmonics_at(directions.row(i).matrix().transpose(), degrees, transposed.col(i));
    transposed.col(i) *= root[i];
  }
  return transposed;
}

/// Of each unknown: |f_n^m|^2 counts twice for m > 0, where the basis functions have the squared norm 2.
Eigen::VectorXd penalties(int degrees) {
  Eigen::VectorXd result(Eigen::Index{degrees} * degrees);
  for (int n = 0; n < degrees; ++n) {
    result.segment(Eigen::Index{n} * n, 2 * n + 1).setConstant(2 * mesh_energy_weight(n));
    result[Eigen::Index{n} * n] /= 2;
  }
  return result;
}

}  // namespace

SmoothingFit fit_smoothly(const VectorField& directions, const Eigen::VectorXd& weights, const Eigen::MatrixXd& values,
                          int degrees, const SmoothingRange& range,
                          const std::function<double(const Eigen::MatrixXd&)>& error_between) {
  const Eigen::Index points = values.rows(), fields = values.cols();
  const Eigen::VectorXd root = weights.cwiseSqrt();
  const Eigen::MatrixXd basis = weighted_basis(directions, root, degrees);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(basis.rows(), basis.rows());
  matrix.selfadjointView<Eigen::Lower>().rankUpdate(basis);
  Eigen::MatrixXd right(points, fields + 1);
  right.leftCols(fields) = root.asDiagonal() * values;
  std::mt19937 generator(1);
  for (double& sign : right.col(fields)) sign = generator() % 2 == 0 ? 1 : -1;
  const Eigen::MatrixXd projected = basis * right;
  const Eigen::VectorXd penalty = penalties(degrees);

  SmoothingFit best;
  double least_error = std::numeric_limits<double>::infinity();
  for (double lambda = range.largest; lambda > 0.9 * range.smallest; lambda /= 10) {
    Eigen::MatrixXd sum = matrix;
    sum.diagonal() += lambda * penalty;
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(sum);
    if (factors.info() != Eigen::Success) break;
    const Eigen::MatrixXd unknowns = factors.solve(projected);
    const Eigen::MatrixXd residual = right - basis.transpose() * unknowns;
    const double trace = double(points) - right.col(fields).dot(residual.col(fields));
    const double freedom = 1 - trace / double(points);
    const double error = residual.leftCols(fields).squaredNorm() / weights.sum() / (freedom * freedom) +
                         error_between(unknowns.leftCols(fields));
    if (!(error < least_error)) continue;
    least_error = error;
    best = {unknowns.leftCols(fields), lambda};
  }
  if (best.unknowns.size() == 0) throw std::domain_error("the equations of the fit cannot be solved");
  return best;
}

}  // namespace vesiflow::vesicle
