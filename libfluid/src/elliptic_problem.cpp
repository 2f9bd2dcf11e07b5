#include "fluid/elliptic_problem.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "message.h"

namespace vesiflow::fluid {

const char* name(BoundaryCondition boundary) {
  return boundary == BoundaryCondition::dirichlet ? "dirichlet" : "neumann";
}

EllipticProblem::EllipticProblem(const Grid& grid_, Centring centring_, BoundaryCondition boundary_, double alpha_,
                                 double mu_)
    : grid(grid_), centring(centring_), boundary(boundary_), alpha(alpha_), mu(mu_) {
  if (!std::isfinite(alpha) || alpha < 0.0) {
    throw std::invalid_argument(message("elliptic problem: alpha is ", alpha, "; it must be finite and >= 0"));
  }
  if (!std::isfinite(mu) || mu <= 0.0) {
    throw std::invalid_argument(message("elliptic problem: mu is ", mu, "; it must be finite and > 0"));
  }
  if (boundary == BoundaryCondition::neumann && centring != Centring::cell) {
    throw std::invalid_argument(message("elliptic problem: neumann conditions with ", name(centring),
                                        " centring; use cell centring, or dirichlet conditions"));
  }
}

std::size_t EllipticProblem::unknowns() const {
  const auto n = extent();
  return static_cast<std::size_t>(n[0]) * n[1] * n[2];
}

bool EllipticProblem::same_structure(const EllipticProblem& other) const {
  return grid == other.grid && centring == other.centring && boundary == other.boundary;
}

double EllipticProblem::end_diagonal(int axis) const {
  if (boundary == BoundaryCondition::neumann) return 1.0;
  return is_face_normal(centring, axis) ? 2.0 : 3.0;
}

void apply(const EllipticProblem& problem, ConstView x, View y) {
  const auto n = problem.extent();
  std::array<double, 3> scale{};
  for (int axis = 0; axis < 3; ++axis) {
    const double h = problem.grid.spacing(axis);
    scale[axis] = problem.mu / (h * h);
  }
  // -h^2 times the second difference along one axis of the number at p, whose place on that axis is i.
  const auto second_difference = [&](const double* p, std::ptrdiff_t stride, int axis, int i) {
    const bool first = i == 0;
    const bool last = i == n[axis] - 1;
    const double diagonal = first || last ? problem.end_diagonal(axis) : 2.0;
    return diagonal * *p - (first ? 0.0 : p[-stride]) - (last ? 0.0 : p[stride]);
  };
#pragma omp parallel for schedule(static)
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const double* p = x.row(j, k) + i;
        y(i, j, k) = problem.alpha * *p + scale[0] * second_difference(p, 1, 0, i) +
                     scale[1] * second_difference(p, x.row_stride, 1, j) +
                     scale[2] * second_difference(p, x.plane_stride, 2, k);
      }
    }
  }
}

double relative_residual(const EllipticProblem& problem, ConstView rhs, ConstView x) {
  const auto n = problem.extent();
  std::vector<double> product(problem.unknowns());
  const View ax{product.data(), n, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1]};
  apply(problem, x, ax);
  const auto for_each = [&](auto&& visit) {
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) visit(rhs(i, j, k), ax(i, j, k));
      }
    }
  };
  double mean = 0.0;
  if (problem.has_nullspace()) {
    for_each([&](double b, double) { mean += b; });
    mean /= static_cast<double>(problem.unknowns());
  }
  double largest = 0.0;
  double residual = 0.0;
  for_each([&](double b, double a) {
    largest = std::max(largest, std::abs(b - mean));
    residual = std::max(residual, std::abs(b - mean - a));
  });
  return largest > 0.0 ? residual / largest : residual;
}

}  // namespace vesiflow::fluid
