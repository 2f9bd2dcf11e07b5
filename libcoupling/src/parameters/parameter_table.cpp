// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/parameter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/validity.h"

namespace vesiflow::coupling {
namespace {

constexpr Range latitudes{.low = 8, .high = 256};
const Range viscosity_ratios = Range::between(validity::least_viscosity_ratio, validity::greatest_viscosity_ratio);

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::describe() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (has_low && has_high)
    return fmt::format("in {}{:g}, {:g}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
  if (has_low) return fmt::format("{} {:g}", low_open ? ">" : ">=", low);
  if (has_high) return fmt::format("{} {:g}", high_open ? "<" : "<=", high);
  return "a finite number";
}

void RangeCheck::refuse(std::string_view name, const std::string& value, const std::string& allowed) {
  mistakes_.push_back(fmt::format("{}{} = {}: {}", prefix_, name, value, allowed));
}

void RangeCheck::number(std::string_view name, double& value, const Range& range) {
  if (!range.contains(value)) refuse(name, fmt::format("{:g}", value), "must be " + range.describe());
}

void RangeCheck::optional_number(std::string_view name, std::optional<double>& value, const Range& range) {
  if (value) number(name, *value, range);
}

void RangeCheck::integer(std::string_view name, int& value, const Range& range) {
  if (!range.contains(value)) refuse(name, fmt::format("{}", value), "must be " + range.describe());
}

void RangeCheck::optional_integer(std::string_view name, std::optional<int>& value, const Range& range) {
  if (value) integer(name, *value, range);
}

void RangeCheck::vector(std::string_view name, std::array<double, 3>& value, const Range& range) {
  if (!std::ranges::all_of(value, [&](double part) { return range.contains(part); }))
    refuse(name, fmt::format("[{:g}, {:g}, {:g}]", value[0], value[1], value[2]), "each must be " + range.describe());
}

void RangeCheck::optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value,
                                 const Range& range) {
  if (value) vector(name, *value, range);
}

void RangeCheck::cells(std::string_view name, std::array<int, 3>& value, const Range& range) {
  if (!std::ranges::all_of(value, [&](int part) { return range.contains(part); }))
    refuse(name, fmt::format("[{}, {}, {}]", value[0], value[1], value[2]), "each must be " + range.describe());
}

void RangeCheck::harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) {
  constexpr int largest_degree = 256;
  for (const vesicle::Harmonic& term : value)
    if (term.degree < 0 || term.degree > largest_degree || std::abs(term.order) > term.degree ||
        !std::isfinite(term.amplitude))
      refuse(name, fmt::format("[{}, {}, {:g}]", term.degree, term.order, term.amplitude),
             fmt::format("must have a degree in [0, {}], an order in [-degree, degree] and a finite amplitude",
                         largest_degree));
}

void RangeCheck::choice(std::string_view name, int& value, std::span<const std::string_view> names) {
  if (value < 0 || value >= static_cast<int>(names.size()))
    refuse(name, fmt::format("{}", value), fmt::format("this enumeration has the values 0 to {}", names.size() - 1));
}

void visit(SimulationParameters::Domain& domain, ParameterVisitor& v) {
  v.vector("domain.lower", domain.lower, Range::any());
  v.vector("domain.upper", domain.upper, Range::any());
  v.cells("domain.cells", domain.cells, Range::between(8, 2048));
  v.booleans("domain.periodic", domain.periodic);
  v.booleans("domain.mirror", domain.mirror);
}

void visit(SimulationParameters::Fluid& fluid, ParameterVisitor& v) {
  v.number("fluid.reynolds_number", fluid.reynolds_number, Range::positive());
  v.number("fluid.viscosity_ratio", fluid.viscosity_ratio, viscosity_ratios);
  visit_choice(v, "fluid.viscous_treatment", fluid.viscous_treatment, {"explicit", "extrapolated", "implicit"});
  visit_choice(v, "fluid.inertia", fluid.inertia, {"full", "unsteady", "none"});
  visit_choice(v, "fluid.velocity_solver", fluid.velocity_solver, fluid::solver_names);
  visit_choice(v, "fluid.pressure_solver", fluid.pressure_solver, fluid::solver_names);
  visit_choice(v, "fluid.precision", fluid.precision, fluid::precision_names);
}

void visit(SimulationParameters::Coupling& coupling, ParameterVisitor& v) {
  visit_choice(v, "coupling.method", coupling.method, {"delta", "sharp"});
  visit_choice(v, "coupling.kernel", coupling.kernel, delta_kernel_names);
  v.boolean("coupling.thickness_correction", coupling.thickness_correction);
}

void visit(SimulationParameters::Membrane& membrane, ParameterVisitor& v) {
  v.number("membrane.capillary_number", membrane.capillary_number, Range::positive());
  v.number("membrane.sigma0", membrane.sigma0, Range::from(0.0));
  visit_choice(v, "membrane.volume", membrane.volume, {"none", "penalty", "projection"});
  v.number("membrane.volume_stiffness", membrane.volume_stiffness, Range::from(0.0));
  v.number("membrane.spontaneous_curvature", membrane.spontaneous_curvature, Range::any());
  visit_choice(v, "membrane.tension_law", membrane.tension_law, {"logarithmic", "linear"});
  visit_choice(v, "membrane.tension_form", membrane.tension_form, {"divergence", "non_divergence"});
  v.number("membrane.integral_rate", membrane.integral_rate, Range::from(0.0));
  v.integer("membrane.integral_degrees", membrane.integral_degrees, Range::from(1.0));
  visit_choice(v, "membrane.area", membrane.area, {"none", "penalty", "projection"});
  v.number("membrane.area_stiffness", membrane.area_stiffness, Range::from(0.0));
  visit_choice(v, "membrane.laplacian", membrane.laplacian, {"cartesian", "christoffel", "paper"});
  visit_choice(v, "membrane.upsampling", membrane.upsampling, {"1", "1.5", "2", "auto"});
}

void visit(SimulationParameters::Mesh& mesh, ParameterVisitor& v) {
  v.integer("mesh.latitudes", mesh.latitudes, latitudes);
  visit_choice(v, "mesh.filter", mesh.filter, {"velocity", "components"});
  visit_choice(v, "mesh.slip", mesh.slip, {"interpolated", "dealiased"});
  v.integer("mesh.normal_degrees", mesh.normal_degrees, Range::from(0));
  v.integer("mesh.tangential_degrees", mesh.tangential_degrees, Range::from(2));
  visit_choice(v, "mesh.redistribute", mesh.redistribute, {"never", "when_needed"});
  v.number("mesh.max_aspect_ratio", mesh.max_aspect_ratio, Range::from(1.0));
  v.number("mesh.max_spectrum_tail", mesh.max_spectrum_tail, Range::from(0.0));
}

void visit(SimulationParameters::Gravity& gravity, ParameterVisitor& v) {
  v.vector("gravity.acceleration", gravity.acceleration, Range::any());
}

void visit(SimulationParameters::Repulsion& repulsion, ParameterVisitor& v) {
  v.number("repulsion.range", repulsion.range, Range::from(0.0));
  v.number("repulsion.strength", repulsion.strength, Range::from(0.0));
  v.boolean("repulsion.walls", repulsion.walls);
}

void visit(SimulationParameters::Time& time, ParameterVisitor& v) {
  v.number("time.step", time.step, Range::positive());
  v.number("time.end", time.end, Range::positive());
  visit_choice(v, "time.markers", time.markers, marker_motion_names);
  v.number("time.relative_tolerance", time.relative_tolerance, Range::from(0.0));
  v.number("time.absolute_tolerance", time.absolute_tolerance, Range::positive());
  visit_choice(v, "time.fluid_velocity", time.fluid_velocity, {"frozen", "interpolated"});
  v.number("time.relaxation", time.relaxation, {.low = 0.0, .high = 1.0, .low_open = true});
  v.number("time.implicit_tolerance", time.implicit_tolerance, Range::positive());
  v.integer("time.implicit_iterations", time.implicit_iterations, Range::from(2));
  v.boolean("time.adaptive", time.adaptive);
  v.number("time.tolerance", time.tolerance, Range::positive());
  v.number("time.smallest_step", time.smallest_step, Range::positive());
  v.number("time.largest_step", time.largest_step, Range::positive());
}

void visit(SimulationParameters::Limits& limits, ParameterVisitor& v) {
  v.number("limits.local_area_error", limits.local_area_error, Range::positive());
  v.number("limits.velocity_noise", limits.velocity_noise, Range::positive());
  v.number("limits.area_error", limits.area_error, Range::positive());
  v.number("limits.volume_error", limits.volume_error, Range::positive());
}

void visit(VesicleParameters& vesicle, ParameterVisitor& v) {
  visit_choice(v, "shape", vesicle.shape,
               {"sphere", "prolate", "oblate", "ellipsoid", "biconcave", "harmonics", "coefficients", "mesh"});
  v.optional_number("reduced_volume", vesicle.reduced_volume, {.low = 0.3, .high = 1.0});
  v.optional_number("aspect_ratio", vesicle.aspect_ratio, Range::between(1.0, 20.0));
  v.optional_vector("axes", vesicle.axes, Range::positive());
  v.harmonics("harmonics", vesicle.harmonics);
  v.optional_number("viscosity_ratio", vesicle.viscosity_ratio, viscosity_ratios);
  v.number("radius", vesicle.radius, Range::positive());
  v.vector("centre", vesicle.centre, Range::any());
  v.vector("rotation_axis", vesicle.rotation_axis, Range::any());
  v.number("rotation_deg", vesicle.rotation_deg, Range::any());
  v.optional_number("capillary_number", vesicle.capillary_number, Range::positive());
  v.optional_number("sigma0", vesicle.sigma0, Range::from(0.0));
  v.optional_number("spontaneous_curvature", vesicle.spontaneous_curvature, Range::any());
  v.optional_integer("latitudes", vesicle.latitudes, latitudes);
  v.number("density_difference", vesicle.density_difference, Range::any());
}

}  // namespace vesiflow::coupling
