// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A sharp membrane in a fluid without inertia, and exact flows around and inside a sphere, for the tests of SharpTransfer.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "coupling/marker_transfer.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_transfer.h"
#include "vesicle/jumps/stokes_flows.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling::test {

/// What a vesicle is to the grid.
class SharpBody {
 public:
  SharpBody(const fluid::Grid& grid, const vesicle::SphereGrid& markers, const vesicle::VectorField& positions,
            const SharpTransfer::Parameters& parameters = {})
      : surface(markers),
        delta(grid, DeltaKernel::smoothed_four_point, parameters.across),
        sharp(grid, markers, parameters) {
    move(positions);
  }

  void move(const vesicle::VectorField& positions) {
    surface.update(positions);
    delta.update(positions);
    sharp.update(surface);
  }
  void put(const vesicle::VectorField& force, fluid::FaceVector& density, fluid::Field<fluid::Cell>& source,
           const vesicle::VectorField* velocity_jump = nullptr) {
    sharp.set_force(force, velocity_jump);
    sharp.add_to(density, source, delta);
  }
  void put(const vesicle::VectorField& force, fluid::NavierStokes& fluid,
           const vesicle::VectorField* velocity_jump = nullptr) {
    put(force, fluid.force(), fluid.divergence_source(), velocity_jump);
  }
  void clear(fluid::FaceVector& density, fluid::Field<fluid::Cell>& source) {
    delta.clear(density);
    sharp.clear(density, source);
  }
  void clear(fluid::NavierStokes& fluid) { clear(fluid.force(), fluid.divergence_source()); }
  vesicle::VectorField read(const fluid::FaceVector& velocity) const {
    vesicle::VectorField u = vesicle::VectorField::Zero(surface.positions().rows(), 3);
    sharp.interpolate(velocity, u);
    return u;
  }

  vesicle::Surface surface;
  MarkerTransfer delta;
  SharpTransfer sharp;
};

inline fluid::FluidParameters without_inertia() {
  fluid::FluidParameters parameters;
  parameters.inertia = fluid::Inertia::none;
  return parameters;
}

/// Root mean square over a membrane, of a difference relative to that of `exact`.
inline double relative_error(const vesicle::Surface& surface, const vesicle::VectorField& found,
                             const vesicle::VectorField& exact) {
  const auto square = [&](const vesicle::VectorField& field) {
    return (field.square().rowwise().sum() * surface.area_weight()).sum();
  };
  return std::sqrt(square(found - exact) / square(exact));
}

enum class Traction {
  normal,  ///< h n
  tension  ///< grad_s h - 2 h n, of a tension h
};

/// The flow of a membrane on the unit sphere that acts on the fluid by a traction of one degree, h a surface harmonic without
/// symmetry: a term of Lamb's solution inside, where the viscosity is `ratio`, and the one with the same velocity on the sphere
/// outside, where it is 1. (H. Lamb, Hydrodynamics, 6th ed., art. 335.) Tractions are linear in the two amplitudes of the term,
/// which follow from what they are at one point.
class SphereFlow {
 public:
  using Vector = Eigen::Vector3d;

  SphereFlow(int degree, Traction traction, double ratio, const Vector& centre)
      : degree_(degree), ratio_(ratio), centre_(centre), inside_(term(0.0, 0.0)) {
    const Vector n = Vector(0.3, -0.5, 0.6).normalized();
    const Harmonic h = harmonic(n);
    Eigen::Matrix2d answers;
    for (int i = 0; i < 2; ++i) {
      inside_ = term(i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0);
      const Vector f = force(n);
      answers(0, i) = f.dot(n) / h.value;
      answers(1, i) = f.dot(h.gradient) / h.gradient.squaredNorm();
    }
    const Eigen::Vector2d wanted = traction == Traction::normal ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(-2, 1);
    const Eigen::Vector2d amplitudes = answers.inverse() * wanted;
    inside_ = term(amplitudes[0], amplitudes[1]);
  }

  const Vector& centre() const { return centre_; }

  /// Of the membrane on the fluid, at a point n of the unit sphere.
  Vector force(const Vector& n) const {
    return ratio_ * vesicle::testing::traction(inside_, n, n) - vesicle::testing::traction(inside_.continued(), n, n);
  }
  Vector velocity_on_sphere(const Vector& n) const { return velocity(inside_, n); }
  Vector velocity_outside(const Vector& x) const { return velocity(inside_.continued(), x - centre_); }

  /// At the markers of a sphere about the centre.
  vesicle::VectorField force(const vesicle::Surface& sphere) const {
    return at_markers(sphere, [this](const Vector& n) { return force(n); });
  }
  vesicle::VectorField velocity(const vesicle::Surface& sphere) const {
    return at_markers(sphere, [this](const Vector& n) { return velocity_on_sphere(n); });
  }

  /// A fluid whose walls move with the flow outside: that of an unbounded fluid is then the solution in the box.
  fluid::NavierStokes fluid(const fluid::Grid& grid) const {
    return fluid::NavierStokes(grid, without_inertia(), [flow = *this](const fluid::Vector3& x, double) {
      const Vector u = flow.velocity_outside({x[0], x[1], x[2]});
      return fluid::Vector3{u[0], u[1], u[2]};
    });
  }

  struct Harmonic {
    double value;
    Vector gradient;  ///< along the sphere
  };
  Harmonic harmonic(const Vector& n) const {
    const auto h = vesicle::testing::solid_harmonic(axis(0), axis(1), degree_, false, vesicle::testing::line(n, n));
    const Vector gradient = value(h.gradient);
    return {h.value.derivative(0), gradient - n.dot(gradient) * n};
  }

 private:
  using LambTerm = vesicle::testing::LambTerm;

  static Vector axis(int i) { return Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix().col(i); }
  LambTerm term(double pressure, double potential) const {
    return {axis(0), axis(1), degree_, false, pressure, potential, 0.0};
  }
  static Vector value(const vesicle::testing::TaylorVector& v) {
    return {v[0].derivative(0), v[1].derivative(0), v[2].derivative(0)};
  }
  static Vector velocity(const LambTerm& flow, const Vector& x) {
    return value(flow(vesicle::testing::line(x, Vector::UnitX())).velocity);
  }
  template <class Function>
  vesicle::VectorField at_markers(const vesicle::Surface& sphere, const Function& function) const {
    vesicle::VectorField result(sphere.positions().rows(), 3);
    for (Eigen::Index m = 0; m < result.rows(); ++m)
      result.row(m) =
          function((Vector(sphere.positions().row(m).transpose()) - centre_).normalized()).transpose().array();
    return result;
  }

  int degree_;
  double ratio_;
  Vector centre_;
  LambTerm inside_;
};

/// A unit sphere in the middle of a box of width 4.5 but for a part of a cell, of that many cells per radius.
struct SphereInBox {
  double cells_per_radius;
  Eigen::Vector3d centre{0.13, 0.04, -0.09};

  fluid::Grid grid() const {
    const int n = static_cast<int>(std::lround(4.5 * cells_per_radius));
    return {{-2.25, -2.25, -2.25}, {2.25, 2.25, 2.25}, {n, n, n}};
  }
  vesicle::SphereGrid markers() const { return vesicle::SphereGrid(24); }
  vesicle::VectorField positions() const { return vesicle::sphere(markers(), {.centre = centre}); }
  /// Those that the grid resolves.
  int degrees() const { return std::min(24, 1 + static_cast<int>(1.5 * cells_per_radius)); }
  SharpBody body(double smoothing = SharpTransfer::Parameters{}.smoothing) const {
    return SharpBody(grid(), markers(), positions(), {.degrees = degrees(), .smoothing = smoothing});
  }
};

}  // namespace vesiflow::coupling::test
