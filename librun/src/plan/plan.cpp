// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "coupling/flow.h"
#include "coupling/initial_shape.h"
#include "coupling/overlap.h"
#include "coupling/simulation.h"
#include "coupling/validity.h"
#include "fluid/elliptic_solver.h"
#include "plan/cost_model.h"
#include "plan/memory_plan.h"
#include "plan/plan_totals.h"
#include "plan/recommended_region.h"
#include "plan/scene_plan.h"
#include "plan/sharp_plan.h"
#include "plan/viscosity_plan.h"
#include "scene/accuracy.h"
#include "scene/coupling_choice.h"
#include "vesicle/mesh_control.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

namespace vesiflow::run {
namespace {

constexpr auto equal_viscosities = "the viscosity ratio of every vesicle is 1";

std::string interval(double every) {
  return every > 0.0 ? fmt::format("every {:g}", every) : "never";
}

class Plan {
 public:
  void head(const std::string& text) { text_ += text + "\n"; }
  template <class... Values>
  void line(const char* label, fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format("  {:<32}", label) + fmt::format(format, std::forward<Values>(values)...) + "\n";
  }
  // A part of the step that is done, or skipped with the reason.
  void part(bool done, const char* label, const std::string& what, const std::string& why_not) {
    text_ += fmt::format("  {} {:<30}{}\n", done ? "+" : "-", label, done ? what : "skipped: " + why_not);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

bool is_sharp(const Scene& scene) {
  return scene.coupling.method == coupling::CouplingMethod::sharp;
}

std::string describe_time(const Scene& scene) {
  if (!scene.time.adaptive)
    return fmt::format("{} steps of {:.6g} to t = {:g}", scene.steps(), scene.time.step, scene.time.end);
  return fmt::format("adaptive steps in [{:.3g}, {:.3g}], at first {:.6g}, to t = {:g}; position error {:.3g} per step",
                     scene.time.smallest_step, scene.time.largest_step, scene.time.step, scene.time.end,
                     scene.time.tolerance);
}

std::string describe_stability(const Scene& scene) {
  const double limit = scene.stable_tension_number();
  if (const double quiet = coupling::quiet_tension_number(scene); std::isfinite(quiet))
    return fmt::format("quiet to about {:g} at this Reynolds number{}", quiet,
                       scene.tension_number() > quiet ? "  <- WARNING: beyond it: take a smaller membrane.sigma0 or "
                                                        "time.step, or time.markers = \"implicit\""
                                                      : "");
  if (!std::isfinite(limit)) return "no limit to it with these markers";
  return fmt::format("stable below about {:.3g}{}", limit,
                     scene.tension_number() > limit ? "  <- WARNING: beyond it" : "");
}

std::string mirrored_axes(const Scene& scene) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (scene.domain.mirror[axis])
      text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ", "xyz"[axis], scene.domain.lower[axis]);
  return text;
}

// Of the vesicle that has fewest. The delta function thickens the membrane by about 0.4 h (docs/coupling.md).
void describe_cells_across(Plan& plan, const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const coupling::VesicleParameters& vesicle : scene.vesicles) smallest = std::min(smallest, vesicle.radius);
  const double across = 2.0 * smallest / scene.spacing();
  plan.line("cells across a vesicle", "{:.1f}{}", across,
            !is_sharp(scene) && across < coupling::validity::fewest_cells_across
                ? "  <- WARNING: below 8 its frequency is off by 5 % and more, at 4 by 10 %"
                : "");
}

// Of the start, between membranes and to the walls.
void describe_distances(Plan& plan, const Scene& scene, const std::vector<vesicle::VectorField>& markers) {
  const fluid::Grid grid = coupling::grid_of(scene);
  std::vector<const vesicle::VectorField*> pointers;
  double to_walls = std::numeric_limits<double>::infinity();
  for (const vesicle::VectorField& of_one : markers) {
    pointers.push_back(&of_one);
    to_walls = std::min(to_walls, coupling::distance_to_walls(grid, of_one));
  }
  const auto describe = [&](const char* label, double distance) {
    const double in_spacings = distance / scene.spacing();
    if (std::isfinite(distance))
      plan.line(label, "{:.3g} at the start, {:.2g} h{}", distance, in_spacings,
                in_spacings < coupling::validity::least_resolved_gap
                    ? "  <- WARNING: the fluid in between is not resolved below 2 h"
                    : "");
  };
  describe("between membranes", std::ranges::min(coupling::nearest_distances(grid, pointers)));
  describe("to the walls", to_walls);
}

// Of the start, of the vesicle that has least. Limits: docs/stability.md, reduced volume and capillary number.
void describe_deflation(Plan& plan, const Scene& scene, const std::vector<vesicle::VectorField>& markers) {
  constexpr double least_stable = coupling::validity::least_reduced_volume,
                   least_stable_in_fast_flow = coupling::validity::least_reduced_volume_in_fast_flow,
                   fast_flow = coupling::validity::fast_capillary_number;
  constexpr double quadrature = 2e-3;  // its error on few latitudes
  double least = 1.0, capillary_number = 0.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    vesicle::Surface surface(scene.latitudes(i));
    surface.update(markers[i]);
    const double deflated = vesicle::reduced_volume(surface.area(), surface.volume());
    if (deflated < least)
      std::tie(least, capillary_number) = std::pair{deflated, coupling::own_capillary_number(scene, i)};
  }
  const bool is_fast = scene.flow.type != FlowType::rest && capillary_number >= fast_flow;
  plan.line("reduced volume", "{:.3g} at the start{}", least,
            least < least_stable - quadrature ? "  <- WARNING: below 0.64 most runs stop"
            : is_fast && least < least_stable_in_fast_flow - quadrature
                ? "  <- WARNING: in a flow at Ca = 10 and more, runs below 0.9 are noisy or stop"
                : "");
}

bool has_unequal_spacings(const Scene& scene) {
  constexpr double round_off = 1e-9;
  return scene.finest_spacing() < (1.0 - round_off) * scene.spacing();
}

std::string describe_spacing(const Scene& scene) {
  return has_unequal_spacings(scene) ? fmt::format("{:.4g} to {:.4g}", scene.finest_spacing(), scene.spacing())
                                     : fmt::format("{:.4g}", scene.spacing());
}

void describe_resolution(Plan& plan, const Scene& scene, int threads) {
  const auto& c = scene.domain.cells;
  int coarsest = scene.latitudes(0), finest = scene.latitudes(0);
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    coarsest = std::min(coarsest, scene.latitudes(i));
    finest = std::max(finest, scene.latitudes(i));
  }
  const MemoryPlan memory = plan_memory(scene);
  plan.head("Resolution");
  plan.line("grid", "{} x {} x {} cells, spacing {}", c[0], c[1], c[2], describe_spacing(scene));
  if (scene.domain.mirror != std::array<bool, 3>{})
    plan.line("planes of symmetry", "{}: the box is one side of them", mirrored_axes(scene));
  plan.line("membranes", "{} of {} x {} markers{}, spacing {}", scene.vesicles.size(), coarsest, 2 * coarsest,
            finest > coarsest ? fmt::format(" to {} x {}", finest, 2 * finest) : "", describe_marker_spacing(scene));
  describe_cells_across(plan, scene);
  plan.line("membranes and grid", "{}", describe_coupling_method(scene));
  if (is_sharp(scene)) {
    plan.line("recommended region", "{}", describe_sharp_region(scene));
    plan.line("error of the grid",
              "of second order in the spacing (docs/coupling.md has what was measured): compare two spacings");
  } else if (scene.has_viscosity_contrast()) {
    plan.line("error of the grid", "of first order in the spacing where viscosities differ: compare two spacings");
  }
  std::vector<vesicle::VectorField> markers;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    markers.push_back(coupling::initial_markers(scene.vesicles[i], scene.latitudes(i)));
  describe_deflation(plan, scene, markers);
  describe_distances(plan, scene, markers);
  plan.line("time", "{}{}", describe_time(scene), step_warning(scene));
  constexpr double far = 10.0;
  const double longest = scene.time.adaptive ? scene.time.largest_step : scene.time.step;
  if (const double limit = stable_convection_step(scene); limit < far * longest)
    plan.line("convection", "explicit, stable for time.step below about {:.3g}{}", limit,
              scene.time.adaptive       ? "; adaptive steps stay below it"
              : scene.time.step > limit ? "  <- WARNING: beyond it"
                                        : "");
  plan.line("tension number g", "{:.3g} = dt sigma0/(4 h){}; {}", scene.tension_number(),
            has_unequal_spacings(scene) ? " of the finest h" : "", describe_stability(scene));
  plan.line("memory", "about {:.0f} MB (fluid {:.0f}, membranes {:.0f}, adaptive steps {:.0f}, output {:.0f}){}",
            1e-6 * memory.total(), 1e-6 * memory.fluid, 1e-6 * memory.membranes, 1e-6 * memory.steps,
            1e-6 * memory.output, memory_limit_warning(scene));
  plan.line("threads", "{}", threads);
}

// What a vesicle has of its own; empty where it has nothing.
std::string own_values(const coupling::VesicleParameters& vesicle) {
  std::string text;
  const auto add = [&](const char* key, const auto& value) {
    if (value) text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ", key, static_cast<double>(*value));
  };
  add("capillary_number", vesicle.capillary_number);
  add("sigma0", vesicle.sigma0);
  add("spontaneous_curvature", vesicle.spontaneous_curvature);
  add("latitudes", vesicle.latitudes);
  if (vesicle.density_difference != 0.0) add("density_difference", &vesicle.density_difference);
  return text;
}

void describe_vesicles(Plan& plan, const Scene& scene) {
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    if (const std::string own = own_values(scene.vesicles[i]); !own.empty())
      plan.line(fmt::format("vesicle {} has its own", i).c_str(), "{}", own);
}

std::string describe_bending(const Scene& scene) {
  constexpr std::array forms{"Cartesian gradients", "Christoffel symbols", "Eq. (14), truncated (paper)"};
  constexpr std::array grids{"the grid of the markers", "1.5 times the latitudes", "twice the latitudes",
                             "a grid chosen from the spectrum"};
  std::string text =
      fmt::format("Laplacian of H by {} on {}", forms[static_cast<std::size_t>(scene.membrane.laplacian)],
                  grids[static_cast<std::size_t>(scene.membrane.upsampling)]);
  if (scene.membrane.spontaneous_curvature != 0.0)
    text += fmt::format(", spontaneous curvature {:g}", scene.membrane.spontaneous_curvature);
  return text + bending_warning(scene);
}

// The solver of a problem, and why if it was left to choose.
std::string describe_solver(const fluid::EllipticProblem& problem, fluid::SolverKind choice) {
  if (choice != fluid::SolverKind::automatic) return std::string(name(choice));
  const fluid::ChosenSolver chosen = fluid::choose_solver(problem, {});
  return fmt::format("{} ({})", fluid::name(chosen.options), chosen.reason);
}

void describe_fluid(Plan& plan, const Scene& scene) {
  const fluid::Grid grid = coupling::grid_of(scene);
  const ViscosityPlan viscosity = plan_viscosity(scene);
  const bool steps_in_time = scene.fluid.inertia != fluid::Inertia::none;
  plan.part(scene.fluid.inertia == fluid::Inertia::full, "convection", "skew-symmetric, extrapolated",
            "fluid.inertia is not \"full\"");
  plan.part(steps_in_time, "acceleration", "BDF2, first step backward Euler" + inertia_warning(scene),
            "fluid.inertia = \"none\"");
  plan.part(steps_in_time, "viscosity", "implicit: " + viscosity.solve, "fluid.inertia = \"none\"");
  const std::string no_field = scene.has_scaled_velocity()
                                   ? "coupling.method = \"sharp\": mu u is solved for, with viscosity 1"
                                   : equal_viscosities;
  plan.part(viscosity.is_variable, "indicator", viscosity.indicator, no_field);
  plan.part(viscosity.is_variable, "variable viscosity", viscosity.treatment, no_field);
  plan.part(
      steps_in_time, "pressure",
      "rotational correction: " + describe_solver(fluid::EllipticProblem::pressure(grid), scene.fluid.pressure_solver),
      "fluid.inertia = \"none\"");
  plan.part(!steps_in_time, "Stokes solve",
            fmt::format("velocity and pressure together, to a tolerance{}",
                        viscosity.is_variable ? "" : ", with constant coefficients"),
            "fluid.inertia is not \"none\"");
}

void describe_external_forces(Plan& plan, const Scene& scene) {
  const auto& g = scene.gravity.acceleration;
  const bool pulls = g != std::array<double, 3>{};
  const bool differs = std::ranges::any_of(scene.vesicles, [](const auto& v) { return v.density_difference != 0.0; });
  plan.part(pulls && differs, "buoyancy", fmt::format("gravity ({:g}, {:g}, {:g})", g[0], g[1], g[2]),
            pulls ? "all densities are equal" : "gravity.acceleration = [0, 0, 0]");
  plan.part(scene.repulsion.range > 0.0, "repulsion",
            fmt::format("within {:g} of another vesicle{}, up to {:g}", scene.repulsion.range,
                        scene.repulsion.walls ? " or a wall" : "", scene.repulsion.strength),
            "repulsion.range = 0");
}

std::string describe_markers(const Scene& scene) {
  const Scene::Time& time = scene.time;
  if (time.markers == coupling::MarkerMotion::strain_relaxation)
    return fmt::format("euler, strain relaxed by {:g} in a step", time.relaxation);
  if (time.markers == coupling::MarkerMotion::implicit)
    return fmt::format("implicit, by fixed-point iteration to {:g} of a radius, at most {} times",
                       time.implicit_tolerance, time.implicit_iterations);
  if (time.markers != coupling::MarkerMotion::arkode) return std::string(name(time.markers));
  return fmt::format("arkode, tolerance {:g}, fluid velocity {} within a step", time.absolute_tolerance,
                     time.fluid_velocity == coupling::FluidVelocity::frozen ? "frozen" : "interpolated");
}

std::string describe_kernel(coupling::DeltaKernel kernel) {
  const int normal = coupling::support_width(kernel, coupling::Direction::normal),
            across = coupling::support_width(kernel, coupling::Direction::tangential);
  const std::string points = normal == across ? fmt::format("{}", normal)
                                              : fmt::format("{} along a component and {} across it", normal, across);
  return fmt::format("delta function \"{}\", points {}{}", name(kernel), points,
                     coupling::interpolation(kernel) == coupling::Interpolation::divergence_preserving
                         ? ", preserving divergence"
                         : "");
}

void describe_step(Plan& plan, const Scene& scene) {
  const bool tension = scene.tension_number() > 0.0;
  const bool moving = scene.flow.type != FlowType::rest;
  const int normal =
      scene.mesh.normal_degrees > 0 ? scene.mesh.normal_degrees : vesicle::two_thirds_degrees(scene.latitudes(0));
  plan.head("Each step");
  plan.part(scene.method.accuracy != Accuracy::as_given, "accuracy", describe_accuracy(scene),
            "method.accuracy = \"as_given\"");
  plan.part(true, "geometry", "spherical harmonics, as many degrees as latitudes", "");
  plan.part(true, "bending", describe_bending(scene), "");
  plan.part(
      tension, "tension",
      fmt::format("{} tension, {} form, sigma0 = {:g}",
                  scene.membrane.tension_law == vesicle::TensionLaw::logarithmic ? "log" : "linear",
                  scene.membrane.tension_form == vesicle::TensionForm::divergence ? "divergence" : "non-divergence",
                  scene.membrane.sigma0),
      "membrane.sigma0 = 0");
  plan.part(tension && scene.membrane.integral_rate > 0.0, "integral tension",
            fmt::format("rate {:g}, degrees below {}", scene.membrane.integral_rate, scene.membrane.integral_degrees),
            tension ? "membrane.integral_rate = 0" : "membrane.sigma0 = 0");
  plan.part(scene.membrane.area == vesicle::AreaControl::penalty, "area penalty",
            fmt::format("force with c_a = {:g}", scene.membrane.area_stiffness), "membrane.area is not \"penalty\"");
  plan.part(scene.membrane.volume == vesicle::VolumeControl::penalty, "volume penalty",
            fmt::format("force with c_v = {:g}{}", scene.membrane.volume_stiffness,
                        scene.follows_shape() ? "  <- WARNING: explicit, unstable in the long steps of these markers: "
                                                "take membrane.volume = \"projection\""
                                              : ""),
            "membrane.volume is not \"penalty\"");
  describe_external_forces(plan, scene);
  plan.part(!is_sharp(scene), "spread, interpolate", describe_kernel(scene.coupling.kernel),
            "coupling.method = \"sharp\": but for what the jumps lack of total force and torque");
  plan.part(is_sharp(scene), "jumps", describe_jumps(scene), "coupling.method = \"delta\"");
  plan.part(scene.has_scaled_velocity(), "interface velocity", describe_interface_passes(scene),
            is_sharp(scene) ? equal_viscosities : "coupling.method = \"delta\"");
  plan.part(scene.has_phase_inertia(), "inertia of phases",
            "as a force: both phases at three times, continued across the membranes",
            !is_sharp(scene)                 ? "coupling.method = \"delta\""
            : scene.has_viscosity_contrast() ? "fluid.inertia = \"none\""
                                             : equal_viscosities);
  plan.part(scene.coupling.thickness_correction, "thickness correction",
            fmt::format("of {:.3g} h per viscosity, in low degrees", coupling::thickening(scene.coupling.kernel)),
            is_sharp(scene) ? "coupling.method = \"sharp\": membranes have no thickness"
                            : "coupling.thickness_correction = false");
  describe_fluid(plan, scene);
  plan.part(moving, "wall velocity", scene.flow.type == FlowType::custom ? "of a program" : flow_of(scene).description,
            "flow.type = \"rest\"");
  if (scene.flow.type != FlowType::custom) {
    const double driving = scene.domain.periodic[0] ? flow_of(scene).driving_force : 0.0;
    plan.part(driving != 0.0, "driving force", fmt::format("uniform, {:.4g} along x", driving),
              "walls drive the flow, or nothing does");
  }
  const bool follows = scene.follows_shape();
  const bool implicit = scene.time.markers == coupling::MarkerMotion::implicit;
  plan.part(!follows, "mesh control",
            fmt::format("{}: normal velocity {} degrees, tangential {}",
                        scene.mesh.filter == vesicle::FilterOrder::velocity_first
                            ? "velocity filtered, then split"
                            : "normal and tangential parts filtered apart",
                        normal, scene.mesh.tangential_degrees),
            fmt::format("time.markers = \"{}\": the mesh follows the shape", name(scene.time.markers)));
  plan.part(scene.mesh.redistribute == coupling::Redistribute::when_needed, "redistribution",
            fmt::format("along the membrane, when its aspect ratio is above {:g} or the spectrum's tail above {:g}",
                        scene.mesh.max_aspect_ratio, scene.mesh.max_spectrum_tail),
            "mesh.redistribute = \"never\"");
  plan.part(scene.membrane.volume == vesicle::VolumeControl::projection, "volume projection",
            "exact, of the marker velocity and its step", "membrane.volume is not \"projection\"");
  plan.part((follows && tension) || scene.membrane.area == vesicle::AreaControl::projection, "area projection",
            follows ? "exact, of each step; nearly spherical: within the strain"
                    : "exact, of the marker velocity and its step",
            "membrane.area is not \"projection\"");
  plan.part(true, "markers", describe_markers(scene), "");
  plan.part(follows && tension, "strain field",
            implicit ? "with forces and velocities of the new time"
            : scene.corrects_fluid(scene.time.step)
                ? "implicit in tension and bending; the fluid is solved a second time with the forces of these terms"
            : scene.coupling.method == coupling::CouplingMethod::sharp
                ? "implicit in tension and bending, of which the fluid keeps no memory that matters"
                : "implicit in tension and bending, momentum of its corrections owed to the fluid",
            follows ? "membrane.sigma0 = 0" : "time.markers is not \"shape_following\"");
  plan.part(follows && !scene.time.adaptive, "start", "in parts of steps where shapes start far from rest",
            follows ? "time.adaptive = true" : fmt::format("time.markers = \"{}\"", name(scene.time.markers)));
  plan.part(tension && !follows, "target areas",
            scene.mesh.slip == vesicle::SlipReference::dealiased
                ? "Eqs. (32), (33), slip against the dealiased velocity"
                : "Eqs. (32), (33), slip against the interpolated velocity (paper)",
            follows ? fmt::format("time.markers = \"{}\"", name(scene.time.markers)) : "membrane.sigma0 = 0");
}

// Interval, number and size of snapshots of so many bytes, a file each.
std::string snapshots(const Scene& scene, double every, double bytes) {
  if (every <= 0.0) return interval(every);
  const double count = std::ceil(scene.time.end / std::max(every, scene.time.step) - 1e-9) + 1.0;
  return fmt::format("{}: {:.0f} files of {:.3g} MB, in all about {:.3g} MB", interval(every), count, 1e-6 * bytes,
                     1e-6 * bytes * count);
}

void describe_output(Plan& plan, const Scene& scene) {
  const auto& o = scene.output;
  const double cells = 1.0 * scene.domain.cells[0] * scene.domain.cells[1] * scene.domain.cells[2];
  constexpr double bytes_of_point = 104.0, bytes_of_vesicle = 4100.0;  // 13 numbers; what HDF5 needs for 7 data sets
  double membranes = 0.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    membranes += bytes_of_point * (2.0 * scene.latitudes(i) * scene.latitudes(i) + 2.0) + bytes_of_vesicle;
  plan.head("Output (intervals in time)");
  plan.line("diagnostics.csv", "{}", interval(o.diagnostics_every));
  plan.line("snapshots of membranes", "{}", snapshots(scene, o.vesicle_every, membranes));
  plan.line("snapshots of the fluid", "{}", snapshots(scene, o.fluid_every, 16.0 * cells));
  plan.line("checkpoint.h5", "{}",
            o.checkpoint_every > 0.0
                ? fmt::format("{} and at the end, about {:.0f} MB", interval(o.checkpoint_every), 56e-6 * cells)
                : interval(o.checkpoint_every));
  plan.line("report.html", "{}", o.report ? "at the end, at most 3 MB" : "never: output.report = false");
}

// Shares are of one thread: phases gain alike from more.
void describe_costs(Plan& plan, const Scene& scene) {
  const std::vector<PhaseCost> costs = estimate_costs(scene);
  double seconds = 0.0;
  for (const PhaseCost& cost : costs) seconds += cost.seconds;
  plan.head(
      fmt::format("Run time (estimate: {:.3g} s per step by one thread of a 2.6 GHz machine, docs/plan.md)", seconds));
  for (const PhaseCost& cost : costs) {
    if (!cost.off.empty()) {
      plan.part(false, cost.phase.c_str(), "", cost.off);
      continue;
    }
    plan.part(true, cost.phase.c_str(),
              fmt::format("{:5.1f} %  {:8.3g} ms per step{}{}", 100.0 * cost.share, 1e3 * cost.seconds,
                          cost.rough ? ", rough" : "", cost.key.empty() ? "" : "; off with " + cost.key),
              "");
  }
}

}  // namespace

std::string describe_scene_plan(const Scene& scene, int threads) {
  Plan plan;
  if (!scene.title.empty()) plan.head(scene.title);
  describe_resolution(plan, scene, threads);
  describe_vesicles(plan, scene);
  describe_step(plan, scene);
  describe_output(plan, scene);
  describe_costs(plan, scene);
  return plan.text();
}

std::string describe_plan(const Scene& scene, int threads, const std::filesystem::path& directory) {
  return describe_scene_plan(scene, threads) + describe_totals(scene, threads, directory);
}

}  // namespace vesiflow::run
