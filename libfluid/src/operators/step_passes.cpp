// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "operators/step_passes.h"

#include <algorithm>
#include <array>

#include "fluid/viscosity.h"
#include "grid/planes.h"
#include "operators/cell_divergence.h"
#include "operators/convection_row.h"

namespace vesiflow::fluid {
namespace {

// visit(component, first, here, before, slope) for the inner faces below the cells of row (j, k), from the first one: the
// gradient of chi there is (here[i] - before[i]) * slope.
template <class Visit>
void for_each_gradient_row(const Field<Cell>& chi, const Vector3& per_h, int j, int k, const Visit& visit) {
  const auto& periodic = chi.grid().periodic;
  const double* here = chi.row(j, k);
  visit(0, periodic[0] ? 0 : 1, here, here - 1, per_h[0]);
  if (j > 0 || periodic[1]) visit(1, 0, here, chi.row(j - 1, k), per_h[1]);
  if (k > 0 || periodic[2]) visit(2, 0, here, chi.row(j, k - 1), per_h[2]);
}

// u += grad chi in the faces below the cells of row (j, k).
void add_gradient_row(const Field<Cell>& chi, const Vector3& per_h, int j, int k, const std::array<View, 3>& u) {
  const int nx = chi.extent(0);
  for_each_gradient_row(chi, per_h, j, k,
                        [&](int component, int first, const double* here, const double* before, double slope) {
                          double* x = u[component].row(j, k);
#pragma omp simd
                          for (int i = first; i < nx; ++i) x[i] += (here[i] - before[i]) * slope;
                        });
}

Vector3 inverse_spacing(const Grid& grid) {
  return {1.0 / grid.spacing(0), 1.0 / grid.spacing(1), 1.0 / grid.spacing(2)};
}

}  // namespace

StepCoefficients step_coefficients(double dt, double previous_dt) {
  if (previous_dt == 0.0) return {1.0, 1.0, 0.0, 1.0, 0.0};
  const double r = dt / previous_dt;
  return {(1.0 + 2.0 * r) / (1.0 + r), 1.0 + r, r * r / (1.0 + r), 1.0 + r, r};
}

void explicit_terms(const StepCoefficients& coefficients, double reynolds_number, double dt, const FaceVector& u,
                    const Field<Cell>& pressure, const FaceVector& force, const Vector3& uniform_force,
                    FaceVector* convection, FaceVector& previous, FaceVector* kept,
                    const std::optional<MomentumOperator>& implicit) {
  const Grid& grid = u.grid();
  const double c1 = reynolds_number * coefficients.a1 / dt;
  const double c2 = reynolds_number * coefficients.a2 / dt;
  const double n1 = reynolds_number * coefficients.b1;
  const double n2 = reynolds_number * coefficients.b2;
  const Vector3 per_h = inverse_spacing(grid);
  const double mu = implicit ? implicit->mu : 0.0;
  const Vector3 m{mu * per_h[0] * per_h[0], mu * per_h[1] * per_h[1], mu * per_h[2] * per_h[2]};
  const double diagonal = 2.0 * (m[0] + m[1] + m[2]) + (implicit ? implicit->alpha : 0.0);
  const std::array<std::ptrdiff_t, 3> back{1, pressure.stride(1), pressure.stride(2)};
  const auto velocity = u.points();
  const auto forces = force.points();
  const auto results = previous.points();

  const auto row = [&](int component, const UnknownRange& range, int j, int k) {
    const double* c = velocity[component].row(j, k);
    const double* p = pressure.row(j, k);
    const double* p_below = p - back[component];
    const double* f = forces[component].row(j, k);
    const double slope = per_h[component], everywhere = uniform_force[component];
    double* out = results[component].row(j, k);
#pragma omp simd
    for (int i = range.begin[0]; i < range.end[0]; ++i) {
      out[i] = c1 * c[i] - c2 * out[i] - (p[i] - p_below[i]) * slope + (f[i] + everywhere);
    }
    if (kept != nullptr)
      std::copy(f + range.begin[0], f + range.end[0], kept->points()[component].row(j, k) + range.begin[0]);
    if (implicit) {
      const std::ptrdiff_t y = velocity[component].row_stride, z = velocity[component].plane_stride;
#pragma omp simd
      for (int i = range.begin[0]; i < range.end[0]; ++i) {
        out[i] += m[0] * (c[i - 1] + c[i + 1]) + m[1] * (c[i - y] + c[i + y]) + m[2] * (c[i - z] + c[i + z]) -
                  diagonal * c[i];
      }
    }
    if (convection == nullptr) return;
    double* n = convection->points()[component].row(j, k);
#pragma omp simd
    for (int i = range.begin[0]; i < range.end[0]; ++i) out[i] += n2 * n[i];
    convection_row(grid, velocity, component, j, k, n);
#pragma omp simd
    for (int i = range.begin[0]; i < range.end[0]; ++i) out[i] -= n1 * n[i];
  };

  for_each_plane(grid.cells, [&](int k) {
    for (int component = 0; component < 3; ++component) {
      const UnknownRange range = unknown_range(grid, component);
      for (int j = range.begin[1]; j < range.end[1]; ++j) {
        if (range.contains_row(j, k)) row(component, range, j, k);
      }
    }
  });
}

namespace {

// chi = div u + sign given - (source - mean), and given becomes the latter.
template <int sign>
void subtract_source(const FaceVector& u, const Field<Cell>& source, double mean, Field<Cell>& given,
                     Field<Cell>& chi) {
  const CellDivergence cell_divergence(u);
  for_each_plane(chi.extent(), [&](int k) {
    for (int j = 0; j < chi.extent(1); ++j) {
      const double* x = u.x.row(j, k);
      const double* y = u.y.row(j, k);
      const double* z = u.z.row(j, k);
      const double* s = source.row(j, k);
      double* g = given.row(j, k);
      double* out = chi.row(j, k);
#pragma omp simd
      for (int i = 0; i < chi.extent(0); ++i) {
        const double now = s[i] - mean;
        double divergence = cell_divergence(x + i, y + i, z + i);
        if constexpr (sign > 0) divergence += g[i];
        out[i] = divergence - now;
        g[i] = now;
      }
    }
  });
}

// p += phi - factor mu div u with phi = -a chi, where div u = -Lap chi.
class PressureUpdate {
 public:
  PressureUpdate(const Field<Cell>& chi, double a, ConstView mu, double factor, Field<Cell>& pressure)
      : chi_(chi), a_(a), mu_(mu), pressure_(pressure) {
    const Vector3 per_h = inverse_spacing(chi.grid());
    m_ = {factor * per_h[0] * per_h[0], factor * per_h[1] * per_h[1], factor * per_h[2] * per_h[2]};
    diagonal_ = 2.0 * (m_[0] + m_[1] + m_[2]);
  }
  void row(int j, int k) const {
    const double* here = chi_.row(j, k);
    const double* south = chi_.row(j - 1, k);
    const double* north = chi_.row(j + 1, k);
    const double* below = chi_.row(j, k - 1);
    const double* above = chi_.row(j, k + 1);
    const double* viscosity = mu_.row(j, k);
    double* p = pressure_.row(j, k);
    const Vector3 m = m_;
    const double a = a_, diagonal = diagonal_;
#pragma omp simd
    for (int i = 0; i < chi_.extent(0); ++i) {
      p[i] += viscosity[i] * (m[0] * (here[i - 1] + here[i + 1]) + m[1] * (south[i] + north[i]) +
                              m[2] * (below[i] + above[i]) - diagonal * here[i]) -
              a * here[i];
    }
  }

 private:
  const Field<Cell>& chi_;
  double a_;
  ConstView mu_;
  Field<Cell>& pressure_;
  Vector3 m_{};
  double diagonal_ = 0.0;
};

}  // namespace

void divergence_beyond(const FaceVector& u, const Field<Cell>& source, double mean, Field<Cell>& given,
                       Field<Cell>& chi) {
  subtract_source<0>(u, source, mean, given, chi);
}

void change_of_divergence_beyond(const FaceVector& u, const Field<Cell>& source, double mean, Field<Cell>& given,
                                 Field<Cell>& chi) {
  subtract_source<1>(u, source, mean, given, chi);
}

void remove_divergence(Field<Cell>& chi, FaceVector& u) {
  extend_to_ghosts(chi);
  const Vector3 per_h = inverse_spacing(chi.grid());
  const auto fields = u.points();
  for_each_plane(chi.extent(), [&](int k) {
    for (int j = 0; j < chi.extent(1); ++j) add_gradient_row(chi, per_h, j, k, fields);
  });
}

void correct_velocity_and_pressure(Field<Cell>& chi, double a, ConstView mu, double factor, FaceVector& u,
                                   Field<Cell>& pressure) {
  extend_to_ghosts(chi);
  const Vector3 per_h = inverse_spacing(chi.grid());
  const PressureUpdate update(chi, a, mu, factor, pressure);
  const auto fields = u.points();
  for_each_plane(chi.extent(), [&](int k) {
    for (int j = 0; j < chi.extent(1); ++j) {
      add_gradient_row(chi, per_h, j, k, fields);
      update.row(j, k);
    }
  });
}

void add_corrected_increment(Field<Cell>& chi, double a, ConstView mu, double factor, const FaceVector& force,
                             FaceVector& increment, FaceVector& u, Field<Cell>& pressure) {
  extend_to_ghosts(chi);
  const Vector3 per_h = inverse_spacing(chi.grid());
  const PressureUpdate update(chi, a, mu, factor, pressure);
  const int nx = chi.extent(0);
  const auto forces = force.points();
  const auto increments = increment.points();
  const auto fields = u.points();
  for_each_plane(chi.extent(), [&](int k) {
    for (int j = 0; j < chi.extent(1); ++j) {
      for_each_gradient_row(chi, per_h, j, k,
                            [&](int component, int first, const double* here, const double* before, double slope) {
                              const double* f = forces[component].row(j, k);
                              double* d = increments[component].row(j, k);
                              double* x = fields[component].row(j, k);
#pragma omp simd
                              for (int i = first; i < nx; ++i) {
                                x[i] += d[i] + (here[i] - before[i]) * slope;
                                d[i] = f[i];
                              }
                            });
      update.row(j, k);
    }
  });
}

void extrapolate(const FaceVector& u, const FaceVector& previous, double r, FaceVector& e) {
  const auto extrapolate_field = [r](const auto& now, const auto& before, auto& result) {
    const auto n = now.extent();
    for_each_plane({n[0] + 2, n[1] + 2, n[2] + 2}, [&](int k) {
      const std::ptrdiff_t plane = now.stride(2);
      const double* x = now.data() + k * plane;
      const double* y = before.data() + k * plane;
      double* out = result.data() + k * plane;
#pragma omp simd
      for (std::ptrdiff_t i = 0; i < plane; ++i) out[i] = (1.0 + r) * x[i] - r * y[i];
    });
  };
  extrapolate_field(u.x, previous.x, e.x);
  extrapolate_field(u.y, previous.y, e.y);
  extrapolate_field(u.z, previous.z, e.z);
}

}  // namespace vesiflow::fluid
