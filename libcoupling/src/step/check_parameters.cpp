// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/initial_shape.h"
#include "coupling/marker_integrator.h"
#include "coupling/marker_transfer.h"
#include "coupling/mistakes.h"
#include "coupling/parameter_table.h"
#include "coupling/validity.h"
#include "motion/mirror_symmetry.h"

namespace vesiflow::coupling {
namespace {

// In lengths of the box: coordinates keep ten digits of it.
constexpr double farthest_from_origin = 1e6;

void check_ranges(const SimulationParameters& given, Mistakes& mistakes) {
  SimulationParameters parameters = given;  // visitors may change what they are shown
  RangeCheck check;
  visit(parameters.domain, check);
  visit(parameters.fluid, check);
  visit(parameters.coupling, check);
  visit(parameters.membrane, check);
  visit(parameters.mesh, check);
  visit(parameters.gravity, check);
  visit(parameters.repulsion, check);
  visit(parameters.time, check);
  visit(parameters.limits, check);
  for (const std::string& mistake : check.mistakes()) mistakes.add(mistake);
  for (std::size_t i = 0; i < parameters.vesicles.size(); ++i) {
    RangeCheck of_vesicle(fmt::format("vesicles.{}.", i));
    visit(parameters.vesicles[i], of_vesicle);
    for (const std::string& mistake : of_vesicle.mistakes()) mistakes.add(mistake);
  }
}

std::string list(const std::array<bool, 3>& axes) {
  return fmt::format("[{}, {}, {}]", axes[0], axes[1], axes[2]);
}

void check_domain(const SimulationParameters& parameters) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(parameters.domain.upper[axis] > parameters.domain.lower[axis]))
      throw ParameterError(fmt::format("domain.upper[{}] = {:g}: must be above domain.lower[{}] = {:g}", axis,
                                       parameters.domain.upper[axis], axis, parameters.domain.lower[axis]));
    const double length = parameters.domain.upper[axis] - parameters.domain.lower[axis];
    const double farthest = std::max(std::abs(parameters.domain.lower[axis]), std::abs(parameters.domain.upper[axis]));
    if (!(std::isfinite(length) && farthest <= farthest_from_origin * length))
      throw ParameterError(fmt::format(
          "domain.lower[{}] = {:g}, domain.upper[{}] = {:g}: must lie within {:g} times their distance from 0, and "
          "that distance be finite; farther off coordinates have too few digits",
          axis, parameters.domain.lower[axis], axis, parameters.domain.upper[axis], farthest_from_origin));
    if (parameters.domain.mirror[axis] && parameters.domain.periodic[axis])
      throw ParameterError(fmt::format(
          "domain.mirror = {}: {} is periodic too (domain.periodic); a plane of symmetry needs an axis with walls",
          list(parameters.domain.mirror), "xyz"[axis]));
  }
}

void check_time(const SimulationParameters& parameters) {
  if (parameters.time.step > parameters.time.end)
    throw ParameterError(
        fmt::format("time.step = {:g}: must not be above time.end = {:g}", parameters.time.step, parameters.time.end));
  const double limit = parameters.stable_tension_number();
  if (parameters.tension_number() > validity::largest_excess_of_g * limit)
    throw ParameterError(fmt::format(
        "time.step = {:g}: g = time.step membrane.sigma0/(4 h) = {:.3g} is far beyond the stability limit of the "
        "explicit tension ({:.3g}); take time.step <= {:.3g} or sigma0 <= {:.4g}",
        parameters.time.step, parameters.tension_number(), limit,
        parameters.time.step * limit / parameters.tension_number(),
        limit * 4.0 * parameters.finest_spacing() / parameters.time.step));
  if (static_cast<double>(parameters.steps()) > 1e9)
    throw ParameterError(fmt::format("time.end = {:g}: that is {} steps of time.step = {:g}; at most 1e9",
                                     parameters.time.end, parameters.steps(), parameters.time.step));
}

void check_marker_motion(const SimulationParameters& parameters) {
  const SimulationParameters::Time& time = parameters.time;
  if ((time.markers == MarkerMotion::arkode || time.markers == MarkerMotion::implicit) && !have_sundials())
    throw ParameterError(
        fmt::format("time.markers = \"{}\": this build has no SUNDIALS; configure with "
                    "-DVESIFLOW_WITH_SUNDIALS=ON, or take another of time.markers",
                    name(time.markers)));
  if (time.fluid_velocity == FluidVelocity::interpolated && time.markers != MarkerMotion::arkode)
    throw ParameterError(
        fmt::format("time.fluid_velocity = \"interpolated\": goes with time.markers = \"arkode\", the only one that "
                    "looks into the step"));
  if (time.markers == MarkerMotion::strain_relaxation && parameters.tension_number() == 0.0)
    throw ParameterError(fmt::format("time.markers = \"strain_relaxation\": needs a tension, membrane.sigma0 > 0"));
  if (!time.adaptive) return;
  if (!(time.smallest_step <= time.step && time.step <= time.largest_step))
    throw ParameterError(
        fmt::format("time.step = {:g}: the first of adaptive steps must be in [time.smallest_step, "
                    "time.largest_step] = [{:g}, {:g}]",
                    time.step, time.smallest_step, time.largest_step));
}

void check_flow(const SimulationParameters& parameters, const Flow& flow) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (parameters.domain.periodic[axis] && !flow.may_be_periodic[axis])
      throw ParameterError(fmt::format("domain.periodic = {}: this flow does not repeat along {}; allowed is {}",
                                       list(parameters.domain.periodic), "xyz"[axis], list(flow.may_be_periodic)));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (parameters.domain.mirror[axis] && !flow.may_be_mirrored[axis])
      throw ParameterError(fmt::format(
          "domain.mirror = {}: this flow is not symmetric about the plane {} = {:g} of domain.lower; "
          "allowed here is {}",
          list(parameters.domain.mirror), "xyz"[axis], parameters.domain.lower[axis], list(flow.may_be_mirrored)));
  const double fastest = std::max(flow.greatest_gradient, flow.angular_frequency);
  const auto check_step = [&](const char* parameter, double step) {
    if (fastest * step > validity::largest_turn_per_step)
      throw ParameterError(
          fmt::format("{} = {:g}: the flow changes a velocity at a rate of up to {:.4g}, which times {} must be "
                      "<= {:g}; so {} <= {:.4g}",
                      parameter, step, fastest, parameter, validity::largest_turn_per_step, parameter,
                      validity::largest_turn_per_step / fastest));
  };
  check_step("time.step", parameters.time.step);
  if (parameters.time.adaptive) check_step("time.largest_step", parameters.time.largest_step);
}

void check_physics(const SimulationParameters& parameters) {
  const bool coupled = parameters.has_viscosity_field() && parameters.fluid.inertia != fluid::Inertia::none &&
                       parameters.fluid.viscous_treatment == fluid::ViscousTreatment::implicit;
  if (coupled && parameters.fluid.velocity_solver == fluid::SolverKind::fft)
    throw ParameterError(fmt::format(
        "fluid.velocity_solver = \"fft\": cannot solve for three components coupled by a viscosity that "
        "varies, which fluid.viscous_treatment = \"implicit\" asks for; take auto, pcg or cholmod, or another "
        "treatment"));
  if (parameters.fluid.precision == fluid::Precision::mixed && parameters.fluid.inertia == fluid::Inertia::none)
    throw ParameterError(
        "fluid.precision = \"mixed\": is of the velocity solve in steps with inertia, and fluid.inertia = \"none\"; "
        "take "
        "fluid.precision = \"double\", or fluid.inertia = \"full\" or \"unsteady\"");
  try {
    fluid::check_solver_limits(fluid::EllipticProblem::pressure(grid_of(parameters)),
                               fluid::default_options(parameters.fluid.pressure_solver));
  } catch (const std::invalid_argument& error) {
    throw ParameterError(
        fmt::format("fluid.pressure_solver = \"{}\": {}", fluid::name(parameters.fluid.pressure_solver), error.what()));
  }
}

// A membrane that is thin answers faster: too fast for an explicit tension that is right for a thick one.
void check_thickness(const SimulationParameters& parameters) {
  if (!parameters.coupling.thickness_correction) return;
  constexpr double largest = validity::largest_reynolds_number_with_thickness_correction;
  const double radius = largest_radius(parameters);
  if (vesicle_reynolds_number(parameters) > largest)
    throw ParameterError(
        fmt::format("coupling.thickness_correction = true: is for slow flow, fluid.reynolds_number <= {:g} or "
                    "fluid.inertia = \"none\", here it is {:g}",
                    largest / (radius * radius), parameters.fluid.reynolds_number));
  if (parameters.follows_shape()) return;
  if (parameters.tension_number() > validity::largest_g_with_thickness_correction)
    throw ParameterError(fmt::format(
        "coupling.thickness_correction = true: with it the explicit tension is stable below g = time.step "
        "membrane.sigma0/(4 h) of about {:g}, and here it is {:.3g}; take time.step <= {:.3g} or time.markers = "
        "\"shape_following\"",
        validity::stable_g_with_thickness_correction, parameters.tension_number(),
        validity::stable_g_with_thickness_correction * parameters.time.step / parameters.tension_number()));
}

// What a sharp membrane does not know yet.
void check_sharp(const SimulationParameters& parameters) {
  if (parameters.coupling.method != CouplingMethod::sharp) return;
  const auto refuse = [](const std::string& why) {
    throw ParameterError(fmt::format("coupling.method = \"sharp\": {}; or take \"delta\"", why));
  };
  if (!parameters.follows_shape())
    refuse(
        fmt::format("knows a membrane in the middle of a step only, not with time.markers = \"{}\"; take "
                    "\"shape_following\" or \"implicit\"",
                    name(parameters.time.markers)));
  if (parameters.coupling.thickness_correction)
    refuse("a membrane without thickness needs no coupling.thickness_correction; set it to false");
  // Nearer to a wall markers would read points beyond it, and faces on it would take a force.
  constexpr double clearance = validity::sharp_wall_clearance;
  const bool has_walls = std::ranges::any_of(parameters.domain.periodic, [](bool periodic) { return !periodic; });
  if (has_walls && wall_clearance(parameters.coupling.kernel) < clearance)
    refuse(
        fmt::format("must keep {:g} grid spacings off walls, and coupling.kernel = \"{}\" lets membranes come as near "
                    "as {:g}; take \"smoothed4\"",
                    clearance, name(parameters.coupling.kernel), wall_clearance(parameters.coupling.kernel)));
}

void check_gravity(const SimulationParameters& parameters) {
  const bool differs =
      std::ranges::any_of(parameters.vesicles, [](const auto& v) { return v.density_difference != 0.0; });
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (differs && parameters.domain.mirror[axis] && parameters.gravity.acceleration[axis] != 0.0)
      throw ParameterError(fmt::format(
          "gravity.acceleration[{}] = {:g}: pulls across the plane of symmetry that domain.mirror = {} asks for", axis,
          parameters.gravity.acceleration[axis], list(parameters.domain.mirror)));
}

// Where the number of latitudes of vesicle i was said.
std::string latitudes_parameter(const SimulationParameters& parameters, std::size_t i) {
  return parameters.vesicles[i].latitudes ? fmt::format("vesicles.{}.latitudes", i) : "mesh.latitudes";
}

void check_degrees(const SimulationParameters& parameters, std::size_t i) {
  const auto check = [&](const char* parameter, int degrees) {
    if (degrees > parameters.latitudes(i))
      throw ParameterError(fmt::format("{} = {}: must be <= {} = {}", parameter, degrees,
                                       latitudes_parameter(parameters, i), parameters.latitudes(i)));
  };
  check("mesh.normal_degrees", parameters.mesh.normal_degrees);
  if (!parameters.follows_shape()) check("mesh.tangential_degrees", parameters.mesh.tangential_degrees);
}

void check_tension(const SimulationParameters& parameters) {
  if (parameters.follows_shape() && parameters.membrane.area == vesicle::AreaControl::penalty)
    throw ParameterError(
        fmt::format("membrane.area = \"penalty\": time.markers = \"{}\" keeps the area exactly where "
                    "there is tension; set "
                    "it to \"none\", or take another way to move the markers",
                    name(parameters.time.markers)));
  if (parameters.follows_shape() && parameters.membrane.integral_rate > 0.0)
    throw ParameterError(
        fmt::format("membrane.integral_rate = {:g}: time.markers = \"{}\" keeps the area without it; set "
                    "it to 0, or take another way to move the markers",
                    parameters.membrane.integral_rate, name(parameters.time.markers)));
}

void check_shape_parameters(const SimulationParameters& parameters, std::size_t i) {
  const VesicleParameters& vesicle = parameters.vesicles[i];
  const std::string which = fmt::format("vesicles.{}", i);
  const bool spheroid = vesicle.shape == Shape::prolate || vesicle.shape == Shape::oblate;
  const int given = (vesicle.reduced_volume ? 1 : 0) + (vesicle.aspect_ratio ? 1 : 0);
  if (spheroid && given != 1)
    throw ParameterError(
        fmt::format("{}: a prolate or oblate needs reduced_volume or aspect_ratio, one of them", which));
  if (!spheroid && given != 0)
    throw ParameterError(
        fmt::format("{}: reduced_volume and aspect_ratio belong to prolate and oblate shapes; an "
                    "ellipsoid takes axes, a sphere nothing",
                    which));
  const bool from_file = vesicle.shape == Shape::coefficients || vesicle.shape == Shape::mesh;
  const auto go_together = [&](bool shape, bool is_given, const char* what, const char* shapes) {
    if (shape != is_given)
      throw ParameterError(fmt::format("{}: {} goes with shape = {}, and only with it", which, what, shapes));
  };
  go_together(vesicle.shape == Shape::ellipsoid, vesicle.axes.has_value(), "axes = [a, b, c]", "\"ellipsoid\"");
  go_together(vesicle.shape == Shape::harmonics, !vesicle.harmonics.empty(),
              "harmonics = [[degree, order, amplitude], ...]", "\"harmonics\"");
  go_together(from_file, vesicle.surface.has_value(), "a surface", "\"coefficients\" or \"mesh\"");
  const auto& a = vesicle.rotation_axis;
  const double squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  if (!(squares > 0.0 && std::isfinite(squares)))
    throw ParameterError(
        fmt::format("{}.rotation_axis = [{:g}, {:g}, {:g}]: must not vanish, nor be so long or short that "
                    "its length overflows",
                    which, a[0], a[1], a[2]));
}

// A vesicle on both sides of a plane of symmetry must be symmetric about it, markers and all. Returns how low it may reach.
double check_mirrored(const SimulationParameters& parameters, std::size_t i, int axis,
                      const vesicle::VectorField& markers) {
  const auto u = static_cast<std::size_t>(axis);
  const double plane = parameters.domain.lower[u];
  if (markers.col(axis).minCoeff() >= plane) return plane;
  constexpr double tolerance = 1e-10;  // in radii
  if (!is_symmetric(markers, axis, plane, tolerance * parameters.vesicles[i].radius))
    throw ParameterError(fmt::format(
        "vesicles.{}: lies across the plane {} = {:g} of domain.mirror without being symmetric about it, each "
        "marker "
        "with a mirror image; turn it about an axis normal to the plane or along it (its own axis is z, its longitudes "
        "count from x), put its centre on the plane, or keep all of it on the side {} >= {:g}",
        i, "xyz"[u], plane, "xyz"[u], plane));
  return -std::numeric_limits<double>::infinity();
}

// A vesicle need not be in the box along a periodic axis, but some periods off at most, and not be many of them long.
void check_within_periods(const SimulationParameters& parameters, std::size_t i, int axis, double from, double to) {
  constexpr double most_periods = 10.0;
  const auto u = static_cast<std::size_t>(axis);
  const double length = parameters.domain.upper[u] - parameters.domain.lower[u];
  if (!(to - from <= most_periods * length))
    throw ParameterError(
        fmt::format("vesicles.{}: is {:.4g} long along {}, along which the box repeats after {:.4g}; at "
                    "most {:g} times that",
                    i, to - from, "xyz"[u], length, most_periods));
  if (!(std::max(std::abs(from), std::abs(to)) <= farthest_from_origin * length))
    throw ParameterError(
        fmt::format("vesicles.{}.centre[{}] = {:g}: must be within {:g} lengths of the box of 0; farther "
                    "off coordinates have too few digits",
                    i, axis, parameters.vesicles[i].centre[u], farthest_from_origin));
}

void check_inside_box(const SimulationParameters& parameters, std::size_t i) {
  const vesicle::VectorField markers = checked_markers(parameters, i);
  const double distance = wall_clearance(parameters.coupling.kernel);
  for (int axis = 0; axis < 3; ++axis) {
    const auto u = static_cast<std::size_t>(axis);
    const double length = parameters.domain.upper[u] - parameters.domain.lower[u];
    const double from = markers.col(axis).minCoeff(), to = markers.col(axis).maxCoeff();
    if (parameters.domain.periodic[u]) {
      check_within_periods(parameters, i, axis, from, to);
      continue;
    }
    const double h = length / parameters.domain.cells[u];
    const bool mirrored = parameters.domain.mirror[u];
    const double low =
        mirrored ? check_mirrored(parameters, i, axis, markers) : parameters.domain.lower[u] + distance * h;
    const double high = parameters.domain.upper[u] - distance * h;
    if (!(from >= low && to <= high))
      throw ParameterError(
          fmt::format("vesicles.{}.centre = [{:g}, {:g}, {:g}]: the vesicle reaches from {:.4g} to {:.4g} "
                      "along {}; it must stay within [{:.4g}, {:.4g}], {} grid spacings off the walls",
                      i, parameters.vesicles[i].centre[0], parameters.vesicles[i].centre[1],
                      parameters.vesicles[i].centre[2], from, to, "xyz"[u], low, high, distance));
  }
}

}  // namespace

void check(const SimulationParameters& parameters, const Flow& flow) {
  Mistakes mistakes;
  check_ranges(parameters, mistakes);
  mistakes.gather([&] { check_domain(parameters); });
  if (parameters.vesicles.empty()) mistakes.add("vesicles: a simulation needs at least one");
  mistakes.refuse();  // what follows counts in spacings and steps
  for (const auto check :
       {check_physics, check_tension, check_time, check_marker_motion, check_thickness, check_sharp, check_gravity})
    mistakes.gather([&] { check(parameters); });
  mistakes.gather([&] { check_flow(parameters, flow); });
  bool have_shapes = true;
  for (std::size_t i = 0; i < parameters.vesicles.size(); ++i)
    have_shapes &= mistakes.gather([&] {
      check_degrees(parameters, i);
      check_shape_parameters(parameters, i);
      check_inside_box(parameters, i);
    });
  if (have_shapes) mistakes.gather([&] { check_apart(parameters); });
  mistakes.refuse();
}

}  // namespace vesiflow::coupling
