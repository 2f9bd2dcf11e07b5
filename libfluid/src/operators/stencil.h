// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The operators of EllipticProblem applied to arrays with ghosts, without a branch at the walls.
#pragma once

#include <array>
#include <vector>

#include "fluid/elliptic_problem.h"
#include "fluid/view.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid {

// The arrays of a problem's unknowns laid out as fields: all points, and one layer of ghosts. Zero at first.
class GhostedBlocks {
 public:
  explicit GhostedBlocks(const EllipticProblem& problem);

  Blocks unknowns() { return blocks(unknowns_); }
  ConstBlocks unknowns() const { return blocks(unknowns_); }
  Blocks points() { return blocks(points_); }
  ConstBlocks points() const { return blocks(points_); }

  // Copies the unknowns.
  void assign(ConstBlocks x);
  // Sets points on walls and mirrors to zero, and ghosts by the problem's conditions or from the other end.
  void set_ghosts();

 private:
  Blocks blocks(const std::array<View, 3>& views) const { return count_ == 1 ? Blocks(views[0]) : Blocks(views); }

  int count_;
  std::array<bool, 3> periodic_;
  std::array<Centring, 3> centring_{};
  std::array<std::array<double, 2>, 3>
      reflection_{};  // by axis and side: ghost / value inside, half a cell from the end
  std::array<AlignedArray, 3> storage_;
  std::array<View, 3> points_, unknowns_;
};

// The coefficient as an array with ghosts, whether it is one or not.
class CoefficientView {
 public:
  CoefficientView(const Grid& grid, const Viscosity& mu) { set(grid, mu); }
  CoefficientView(const CoefficientView&) = delete;
  CoefficientView& operator=(const CoefficientView&) = delete;
  // Allocates at most for the first constant.
  void set(const Grid& grid, const Viscosity& mu);
  operator ConstView() const { return view_; }

 private:
  std::vector<double> row_;  // of a constant: it stands for all rows
  ConstView view_;
};

class Stencil {
 public:
  explicit Stencil(const EllipticProblem& problem);
  // Another alpha or mu.
  void update(const EllipticProblem& problem);

  // y = A x. Sets the ghosts of x. Parallel over planes.
  void apply(GhostedBlocks& x, Blocks y) const;
  // The same from all points of arrays whose ghosts have been set, by other conditions perhaps.
  void apply_to_points(ConstBlocks points, Blocks y) const;

 private:
  void apply_row(ConstBlocks points, int block, int j, int k, double* out) const;

  EllipticProblem problem_;
  CoefficientView mu_;
};

// out += factor times one component of div(m (grad u + grad u^T)), m = mu - offset, at its unknowns i of row (j, k),
// counted in points; out[0] belongs to point (0, j, k). Reads the ghosts of u and mu.
// Never inlined, for the same bits wherever it is called from.
[[gnu::noinline]] void add_stress_row(const Grid& grid, const std::array<ConstView, 3>& u, ConstView mu, double offset,
                                      double factor, int component, int j, int k, double* out);

// The diagonal of -div(mu (grad u + grad u^T)) with homogeneous walls, of a velocity component at its unknowns of row
// (j, k), as above.
void stress_diagonal_row(const Grid& grid, ConstView mu, int component, int j, int k, double* out);

// out += factor div(mu grad x) of one array on a centring, likewise.
[[gnu::noinline]] void add_variable_laplacian_row(const Grid& grid, Centring centring, ConstView x, ConstView mu,
                                                  double factor, int j, int k, double* out);

// f += div((mu - offset) (grad u + grad u^T)) on the unknowns. Parallel over planes.
void add_stress(const FaceVector& u, ConstView mu, double offset, FaceVector& f);

}  // namespace vesiflow::fluid
