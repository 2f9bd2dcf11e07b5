// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "equilibrium.h"

#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "stationarity.h"
#include "vesicle/shapes.h"

namespace equilibrium {
namespace {

using std::numbers::pi;

/// Unknowns of the shape with the given b_1, all others zero, scaled to the enclosed volume.
Eigen::VectorXd one_parameter_shape(ConstrainedEnergy& energy, double b) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(energy.unknowns());
  x[0] = 1;
  x[1] = 2 * b;
  energy.set(x);
  x[0] = std::cbrt(energy.target_volume() / energy.functionals().volume);
  return x;
}

/// The reduced volume falls from 1 at b = 0 to both sides: long shapes for b > 0, flat ones for b < 0.
Eigen::VectorXd initial_shape(ConstrainedEnergy& energy, Branch branch, double reduced_volume) {
  const double side = branch == Branch::prolate ? 1 : -1;
  const auto reduced_volume_of = [&](double b) {
    one_parameter_shape(energy, b);
    return vesiflow::vesicle::reduced_volume(energy.functionals().area, energy.functionals().volume);
  };
  constexpr double stride_of_b = 0.05, farthest = 1.2;
  try {
    double near = 0;
    double far = stride_of_b;
    for (; reduced_volume_of(side * far) > reduced_volume; far += stride_of_b) {
      if (far > farthest) throw std::domain_error("no start");
      near = far;
    }
    for (double middle = (near + far) / 2; middle != near && middle != far; middle = (near + far) / 2)
      (reduced_volume_of(side * middle) > reduced_volume ? near : far) = middle;
    return one_parameter_shape(energy, side * near);
  } catch (const std::domain_error&) {
    throw std::logic_error("no shape to start from has this reduced volume");
  }
}

/// Changes the shape as little as the other area needs.
void take_reduced_volume(ConstrainedEnergy& energy, double reduced_volume, Eigen::VectorXd& x) {
  energy.set(x);
  energy.set_reduced_volume(reduced_volume);
  const Directions bases = directions(energy.constraint_gradients());
  if (!retract(energy, bases.constrained, x))
    throw NotConverged(
        fmt::format("on the way from rounder shapes, none was found with reduced volume {:g}", reduced_volume),
        "Take more --latitudes or a larger reduced volume.");
}

void describe_shape(const ConstrainedEnergy& energy, Equilibrium& result) {
  const Meridian& meridian = energy.meridian();
  result.energy = energy.functionals().energy;
  result.polar_semi_axis = meridian.polar_semi_axis();
  result.equatorial_radius = meridian.equatorial_radius();
  result.half_arclength = pi * meridian.arclength_per_colatitude();
  result.polar_mean_curvature = meridian.polar_mean_curvature();
  result.equatorial_mean_curvature = meridian.equatorial_mean_curvature();
  result.area_error = energy.constraint_errors()[0];
  result.volume_error = energy.constraint_errors()[1];
  result.last_coefficient = meridian.last_coefficient();
}

void verify(ConstrainedEnergy& energy, Equilibrium& result) {
  const Stationarity at_shape = stationarity(energy.gradients());
  result.tension = at_shape.tension;
  result.pressure = at_shape.pressure;
  result.largest_force = energy.normal_force().abs().maxCoeff();
  result.euler_lagrange_residual =
      (energy.normal_force() + result.pressure - 2 * result.tension * energy.surface().mean_curvature())
          .abs()
          .maxCoeff();
  result.scaling_error =
      2 * result.tension * energy.functionals().area / (3 * result.pressure * energy.functionals().volume) - 1;
}

void check_usable(double reduced_volume, const Meridian& meridian) {
  if (!(meridian.polar_semi_axis() > 0))
    throw NotConverged(
        fmt::format("the two caps pass through each other at reduced volume {:g}: half length of the axis {:.3g}",
                    reduced_volume, meridian.polar_semi_axis()),
        "Without a contact force the oblate branch ends where its dimples meet: take a larger reduced volume.");
}

void minimise_or_throw(ConstrainedEnergy& energy, double reached, const SolverOptions& options, Eigen::VectorXd& x,
                       Equilibrium& result) {
  const SolverReport report = minimise(result.method, energy, x, options);
  result.residual = report.residual;
  result.iterations += report.iterations;
  if (report.converged) return;
  constexpr double nearly = 1e3;
  throw NotConverged(
      fmt::format("{}{}; after {} iterations the residual is {:.2g}, above the tolerance of {:.2g}",
                  reached > result.reduced_volume ? fmt::format("on the way, at reduced volume {:g}, ", reached) : "",
                  report.obstacle, report.iterations, report.residual, options.tolerance),
      report.residual < nearly * options.tolerance
          ? "The residual may be at the rounding of this mesh: raise --tolerance, or take another --method."
          : "Take another --method, more --latitudes, or a reduced volume nearer to 1.");
}

/// Down to this reduced volume the one-parameter shapes lead to both branches at once; below it, step by step.
constexpr double least_direct = 0.65;
constexpr double stride = 0.025;

void follow_branch(ConstrainedEnergy& energy, const SolverOptions& options, Equilibrium& result) {
  double reached = std::max(result.reduced_volume, least_direct);
  energy.set_reduced_volume(reached);
  Eigen::VectorXd x = initial_shape(energy, result.branch, reached);
  minimise_or_throw(energy, reached, options, x, result);
  while (reached > result.reduced_volume) {
    reached = std::max(result.reduced_volume, reached - stride);
    take_reduced_volume(energy, reached, x);
    minimise_or_throw(energy, reached, options, x, result);
    check_usable(reached, energy.meridian());
  }
}

}  // namespace

std::string name_of(Branch branch) {
  return branch == Branch::prolate ? "prolate" : "oblate";
}

Equilibrium find_equilibrium(ConstrainedEnergy& energy, Branch branch, double reduced_volume, Method method,
                             const SolverOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const int evaluations_before = energy.gradient_evaluations();
  Equilibrium result;
  result.branch = branch;
  result.reduced_volume = reduced_volume;
  result.latitudes = energy.surface().grid().latitudes();
  result.method = method;

  if (reduced_volume == 1) {  // area and volume alone fix the sphere
    energy.set_reduced_volume(1);
    energy.set(Eigen::VectorXd::Unit(energy.unknowns(), 0));
    describe_shape(energy, result);
  } else {
    follow_branch(energy, options, result);
    describe_shape(energy, result);
    verify(energy, result);
  }
  result.gradient_evaluations = energy.gradient_evaluations() - evaluations_before;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace equilibrium
