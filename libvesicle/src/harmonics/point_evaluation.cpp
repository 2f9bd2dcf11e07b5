// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/point_evaluation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check.h"

namespace vesiflow::vesicle {
namespace {

constexpr int block_points = 8;  // sums of three fields over two AVX2 registers of points stay near the registers
using Block = Eigen::Array<double, block_points, 1>;

/// A block of directions; the last block is filled up with its last point.
struct BlockOfDirections {
  BlockOfDirections(const VectorField& directions, Eigen::Index first) {
    for (int lane = 0; lane < block_points; ++lane) {
      const Eigen::Index point = std::min(first + lane, directions.rows() - 1);
      x[lane] = directions(point, 0);
      y[lane] = directions(point, 1);
      z[lane] = directions(point, 2);
    }
  }
  Block x, y, z;
};

template <int fields>
struct Sums {
  void add(const Coefficients::Complex* coefficients, const Block& q) {
    for (int field = 0; field < fields; ++field) {
      real[field] += coefficients[field].real() * q;
      imaginary[field] += coefficients[field].imag() * q;
    }
  }
  Block real[fields], imaginary[fields];
};

}  // namespace

PointEvaluation::PointEvaluation(int degrees) : degrees_(degrees) {
  check_argument(degrees >= 1 && degrees <= 512, "degrees", degrees, "in [1, 512]");
  long double diagonal = std::sqrt(1 / (4 * std::numbers::pi_v<long double>));
  for (int m = 0; m < degrees; ++m) {
    if (m > 0) diagonal *= std::sqrt((2 * m + 1) / (2.0L * m));
    diagonal_.push_back(static_cast<double>(diagonal));
    const long double mm = static_cast<long double>(m) * m;
    for (int n = m + 1; n < degrees; ++n) {
      const long double nn = static_cast<long double>(n) * n;
      const long double kk = static_cast<long double>(n - 1) * (n - 1);
      steps_.push_back({static_cast<double>(std::sqrt((4 * nn - 1) / (nn - mm))),
                        static_cast<double>(std::sqrt((kk - mm) / (4 * kk - 1)))});
    }
  }
}

void PointEvaluation::values_at(const Coefficients& coefficients, const VectorField& directions,
                                Eigen::Ref<Eigen::ArrayXXd> values) const {
  const int fields = coefficients.fields();
  check_argument(coefficients.degrees() <= degrees_, "degrees of the coefficients", coefficients.degrees(),
                 "at most those of the evaluation");
  check_shape(values, "values", directions.rows(), fields);
  if (directions.rows() == 0) return;
  const double off = (directions.square().rowwise().sum() - 1).abs().maxCoeff<Eigen::PropagateNaN>();
  check_argument(off < 2e-8, "largest ||direction|^2 - 1|", off, "below 2e-8");
  int first = 0;
  for (; first + 3 <= fields; first += 3) evaluate<3>(coefficients, first, directions, values);
  for (; first < fields; ++first) evaluate<1>(coefficients, first, directions, values);
}

template <int fields>
void PointEvaluation::evaluate(const Coefficients& coefficients, int first_field, const VectorField& directions,
                               Eigen::Ref<Eigen::ArrayXXd> values) const {
  const int degrees = coefficients.degrees();
  const int stride = coefficients.fields();
  for (Eigen::Index first = 0; first < directions.rows(); first += block_points) {
    const BlockOfDirections d(directions, first);
    Block result[fields];
    for (Block& r : result) r.setZero();
    Block power_real = Block::Ones(), power_imaginary = Block::Zero();  // (x + i y)^m
    const Step* step = steps_.data();
    for (int m = 0; m < degrees; ++m) {
      Sums<fields> sums;
      for (int field = 0; field < fields; ++field) sums.real[field] = sums.imaginary[field] = Block::Zero();
      const Coefficients::Complex* even = coefficients.block(m, 0) + first_field;
      const Coefficients::Complex* odd = coefficients.block(m, 1) + first_field;
      Block before = Block::Zero();
      Block q = Block::Constant(diagonal_[m]);
      const Step* s = step;
      for (int n = m;;) {  // degrees in pairs, as their coefficients are stored
        sums.add(even, q);
        if (++n == degrees) break;
        before = s->a * (d.z * q - s->b * before);
        ++s;
        sums.add(odd, before);
        if (++n == degrees) break;
        q = s->a * (d.z * before - s->b * q);
        ++s;
        even += stride;
        odd += stride;
      }
      const double pairs = m == 0 ? 1 : 2;  // m and -m
      for (int field = 0; field < fields; ++field)
        result[field] += pairs * (power_real * sums.real[field] - power_imaginary * sums.imaginary[field]);
      const Block next = power_real * d.x - power_imaginary * d.y;
      power_imaginary = power_real * d.y + power_imaginary * d.x;
      power_real = next;
      step += degrees_ - m - 1;
    }
    const Eigen::Index points = std::min<Eigen::Index>(block_points, directions.rows() - first);
    for (int field = 0; field < fields; ++field)
      values.col(first_field + field).segment(first, points) = result[field].head(points);
  }
}

}  // namespace vesiflow::vesicle
