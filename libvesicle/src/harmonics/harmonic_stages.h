// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "harmonics/hemispheres.h"
#include "harmonics/legendre_tables.h"
#include "vesicle/coefficients.h"
#include "vesicle/sphere_grid.h"

namespace vesiflow::vesicle {

/// Nodal values of one derivative of the fields: the kind of Legendre function and d^k/dphi^k; field f begins at
/// values + f * stride.
template <class Value>
struct NodalFields {
  LegendreKind kind;
  int longitude_derivative;
  Value* values;
  std::ptrdiff_t stride;
};

/// The two stages of spherical-harmonic transforms, Legendre sums for each order and Fourier transforms of the rings,
/// from coefficients to several nodal derivatives and back. Derivatives of one kind share their Legendre sums.
///
/// Threads share orders in one stage and fields and rings in the other, and no sum: the bits do not depend on their
/// number.
class HarmonicStages {
 public:
  HarmonicStages(int degrees, const SphereGrid& grid);

  /// Makes room for that many fields with that many derivatives of one kind, and makes the table.
  void reserve(int fields, int derivatives);
  void require(LegendreKind kind, LegendreSum sum);

  /// Derivatives of the expansion at the nodes; coefficients of at least these degrees.
  void evaluate(const Coefficients& coefficients, std::span<const NodalFields<double>> results);

  /// coefficients = sum over the fields of the adjoint of evaluating them, applied to the nodal values as they are
  /// (LegendreSum::over_latitudes) or with their quadrature weights (quadrature); the coefficients have the shape of the result.
  void project(std::span<const NodalFields<const double>> fields, LegendreSum sum, Coefficients& coefficients);

 private:
  using Complex = LongitudeTransform::Complex;

  /// What a thread needs for itself.
  struct Workspace {
    std::array<AlignedArray<double>, 2> half_sums;  ///< [parity]: (2 fields, northern latitudes)
    LongitudeTransform::Buffer rings;
  };

  template <class Fields, class Use>
  static void for_each_kind(Fields all, const Use& use);
  const LegendreTable& table(LegendreKind kind, LegendreSum sum) const {
    return *tables_[static_cast<int>(kind)][static_cast<int>(sum)];
  }
  int threads(int fields) const;
  int half_stride() const { return transform_.blocks() * LongitudeTransform::block_rings; }
  HalfSums half_sums(const Workspace& work, int parity, int field) const {
    double* const real = work.half_sums[parity].get() + std::ptrdiff_t(2) * field * half_stride();
    return {real, real + half_stride()};
  }

  void sum_degrees(const Coefficients& coefficients, const LegendreTable& table, int m, Workspace& work);
  void fill_mode(int k, const Coefficients& coefficients, std::span<const NodalFields<double>> results,
                 Workspace& work);
  /// Sets the coefficients of order m, or adds to them.
  template <bool add>
  void sum_latitudes(const LegendreTable& table, int m, Workspace& work, Coefficients& coefficients);

  int degrees_;
  LongitudeTransform transform_;
  std::array<std::array<std::shared_ptr<const LegendreTable>, 3>, 3> tables_;  ///< [kind][sum]
  AlignedArray<double> fold_weight_;
  int fields_ = 0;
  std::vector<Workspace> workspaces_;  ///< one per thread
};

}  // namespace vesiflow::vesicle
