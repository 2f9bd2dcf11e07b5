// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/viscosity_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "coupling/validity.h"
#include "fluid/elliptic_solver.h"

namespace vesiflow::run {
namespace {

using fluid::ViscousTreatment;

double field_bytes(const fluid::Grid& grid, fluid::Centring centring) {
  const auto n = fluid::point_extent(grid, centring);
  return 8.0 * (n[0] + 2.0) * (n[1] + 2.0) * (n[2] + 2.0);
}

double vector_bytes(const fluid::Grid& grid) {
  double bytes = 0.0;
  for (const fluid::Centring centring : fluid::face_centrings) bytes += field_bytes(grid, centring);
  return bytes;
}

double solver_bytes(const fluid::EllipticProblem& problem, const fluid::SolverOptions& options) {
  return static_cast<double>(fluid::estimate_solver_memory(problem, options));
}

// A problem of the same size as that of the implicit treatment, without its field.
fluid::EllipticProblem coupled_problem(const fluid::Grid& grid) {
  return fluid::EllipticProblem::velocity(grid, fluid::EllipticForm::stress, 1.0, 1.0);
}

double fluid_bytes(const Scene& scene, const fluid::Grid& grid, bool is_variable, bool is_coupled) {
  fluid::FluidParameters parameters = coupling::fluid_parameters_of(scene);
  if (!is_variable) return static_cast<double>(fluid::NavierStokes::estimate_memory(grid, parameters));
  // What counts is that there is a field, not which.
  parameters.viscosity = std::make_shared<fluid::Field<fluid::Cell>>(
      fluid::Grid(grid.lower, grid.upper, {fluid::Grid::min_cells, fluid::Grid::min_cells, fluid::Grid::min_cells}));
  if (!is_coupled) return static_cast<double>(fluid::NavierStokes::estimate_memory(grid, parameters));
  parameters.viscous_treatment = ViscousTreatment::extrapolated;
  parameters.velocity_solver = fluid::FftOptions{};
  const auto laplacian = fluid::EllipticProblem::velocity(grid, fluid::EllipticForm::laplacian, 1.0, 1.0);
  return static_cast<double>(fluid::NavierStokes::estimate_memory(grid, parameters)) + vector_bytes(grid) -
         solver_bytes(laplacian, parameters.velocity_solver) +
         solver_bytes(coupled_problem(grid), coupling::fluid_parameters_of(scene).velocity_solver);
}

// Without its precision.
std::string describe_solver(const Scene& scene, const fluid::Grid& grid, double greatest, bool is_coupled) {
  const fluid::SolverKind choice = scene.fluid.velocity_solver;
  if (choice != fluid::SolverKind::automatic) return std::string(name(choice));
  if (is_coupled) return "cholmod or pcg with fft, whichever is estimated to be faster in the first step";
  const auto problem = fluid::EllipticProblem::velocity(grid, fluid::EllipticForm::laplacian, 1.0, greatest);
  const fluid::ChosenSolver chosen = fluid::choose_solver(problem, {});
  return fmt::format("{} ({})", fluid::name(chosen.options), chosen.reason);
}

std::string describe_solve(const Scene& scene, const fluid::Grid& grid, double greatest, bool is_coupled) {
  const std::string solver = describe_solver(scene, grid, greatest, is_coupled);
  if (scene.fluid.precision == fluid::Precision::double_) return solver + ", in double precision";
  return solver + (is_coupled ? ", fast transforms that precondition it in single precision"
                              : ", for the change of the velocity, fast transforms in single precision");
}

std::string describe_treatment(const Scene& scene, double least, double greatest) {
  if (scene.fluid.inertia == fluid::Inertia::none)
    return "implicit, in the Stokes solve; fluid.viscous_treatment plays no part";
  switch (scene.fluid.viscous_treatment) {
    case ViscousTreatment::explicit_:
      return fmt::format(
          "explicit (paper): {:g} Lap u* + div((mu - {:g})(grad u + grad u^T)), an error of ratio x step", greatest,
          greatest);
    case ViscousTreatment::implicit: {
      const bool is_risky = scene.time.markers == coupling::MarkerMotion::shape_following &&
                            greatest / least > coupling::validity::quiet_implicit_contrast;
      return fmt::format("implicit: all three components in one solve{}",
                         is_risky
                             ? "; <- WARNING: unstable with time.markers = \"shape_following\" at this contrast but "
                               "for short steps: take time.markers = \"implicit\", or "
                               "fluid.viscous_treatment = \"extrapolated\""
                             : "");
    }
    case ViscousTreatment::extrapolated:
      break;
  }
  const double step = coupling::validity::extrapolated_step / std::sqrt(greatest / least);
  return fmt::format("extrapolated: {:g} Lap u* + div((mu - {:g})(grad u + grad u^T)), the second by extrapolation; {}",
                     greatest, greatest,
                     scene.time.step > step
                         ? fmt::format("<- WARNING: its errors ring with steps above {:.3g}: take them smaller, or "
                                       "fluid.viscous_treatment = \"implicit\"",
                                       step)
                         : fmt::format("good for steps up to {:.3g}", step));
}

}  // namespace

ViscosityPlan plan_viscosity(const Scene& scene) {
  const fluid::Grid grid = coupling::grid_of(scene);
  const auto [least, greatest] = scene.viscosity_range();
  ViscosityPlan plan;
  plan.is_variable = scene.has_viscosity_field();
  const bool is_coupled = plan.is_variable && scene.fluid.inertia != fluid::Inertia::none &&
                          scene.fluid.viscous_treatment == ViscousTreatment::implicit;
  plan.solve = describe_solve(scene, grid, greatest, is_coupled);
  plan.fluid_bytes = fluid_bytes(scene, grid, plan.is_variable, is_coupled);
  if (!plan.is_variable) return plan;
  plan.indicator =
      fmt::format("viscosity between {:g} and {:g} from one Poisson equation (fft) for all vesicles", least, greatest);
  plan.treatment = describe_treatment(scene, least, greatest);
  const auto poisson = fluid::EllipticProblem::pressure(grid);
  plan.indicator_bytes =
      vector_bytes(grid) + field_bytes(grid, fluid::Centring::cell) + solver_bytes(poisson, fluid::FftOptions{});
  return plan;
}

}  // namespace vesiflow::run
