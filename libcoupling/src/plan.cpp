#include "coupling/plan.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "coupling/simulation.h"
#include "fluid/elliptic_solver.h"
#include "vesicle/mesh_control.h"

namespace vesiflow::coupling {
namespace {

std::string interval(double every) {
  return every > 0.0 ? fmt::format("every {:g}", every) : "never";
}

// Working arrays of one membrane, among them the doubled grid of the Laplacian of H and the Legendre tables.
double membrane_bytes(int latitudes) {
  const double markers = 2.0 * latitudes * latitudes, doubled = 4.0 * markers;
  const double tables = 3.0 * 8.0 * (std::pow(latitudes, 3) / 2.0 + std::pow(2 * latitudes, 3));
  return 8.0 * (70.0 * markers + 40.0 * doubled) + tables;
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

std::string describe_time(const Scene& scene) {
  if (!scene.time.adaptive)
    return fmt::format("{} steps of {:.6g} to t = {:g}", scene.steps(), scene.time.step, scene.time.end);
  return fmt::format("adaptive steps in [{:.3g}, {:.3g}], at first {:.6g}, to t = {:g}; position error {:.3g} per step",
                     scene.time.smallest_step, scene.time.largest_step, scene.time.step, scene.time.end,
                     scene.time.tolerance);
}

void describe_resolution(Plan& plan, const Scene& scene, int threads) {
  const auto& c = scene.domain.cells;
  const double h = scene.spacing();
  const auto vesicles = static_cast<double>(scene.vesicles.size());
  const auto fluid_bytes =
      static_cast<double>(fluid::NavierStokes::estimate_memory(grid_of(scene), fluid_parameters_of(scene)));
  plan.head("Resolution");
  plan.line("grid", "{} x {} x {} cells, spacing {:.4g}", c[0], c[1], c[2], h);
  plan.line("membranes", "{} of {} x {} markers, spacing about {:.2f} h at the equator of a sphere",
            scene.vesicles.size(), scene.mesh.latitudes, 2 * scene.mesh.latitudes, M_PI / scene.mesh.latitudes / h);
  plan.line("time", "{}", describe_time(scene));
  plan.line("tension number g", "{:.3g} = dt sigma0/(4 h); stable below about {:.3g}{}", scene.tension_number(),
            scene.stable_tension_number(),
            scene.tension_number() > scene.stable_tension_number() ? "  <- WARNING: beyond it" : "");
  plan.line("memory", "about {:.0f} MB (fluid {:.0f}, membranes {:.0f})",
            1e-6 * (fluid_bytes + vesicles * membrane_bytes(scene.mesh.latitudes)), 1e-6 * fluid_bytes,
            1e-6 * vesicles * membrane_bytes(scene.mesh.latitudes));
  plan.line("threads", "{}", threads);
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
  return text;
}

// The solver of a problem, and why if it was left to choose.
std::string describe_solver(const fluid::EllipticProblem& problem, SolverChoice choice) {
  constexpr std::array names{"auto", "fft", "cholmod", "pcg"};
  if (choice != SolverChoice::automatic) return names[static_cast<std::size_t>(choice)];
  const fluid::SolverChoice chosen = fluid::choose_solver(problem, {});
  return fmt::format("{} ({})", fluid::name(chosen.options), chosen.reason);
}

void describe_fluid(Plan& plan, const Scene& scene) {
  const fluid::Grid grid{scene.domain.lower, scene.domain.upper, scene.domain.cells};
  const bool steps_in_time = scene.fluid.inertia != fluid::Inertia::none;
  plan.part(scene.fluid.inertia == fluid::Inertia::full, "convection", "skew-symmetric, extrapolated",
            "fluid.inertia is not \"full\"");
  plan.part(steps_in_time, "acceleration", "BDF2, first step backward Euler", "fluid.inertia = \"none\"");
  plan.part(steps_in_time, "viscosity",
            "implicit: " + describe_solver(fluid::EllipticProblem::velocity(grid, fluid::EllipticForm::laplacian, 1.0,
                                                                            scene.fluid.viscosity_ratio),
                                           scene.fluid.velocity_solver),
            "fluid.inertia = \"none\"");
  plan.part(false, "indicator, variable viscosity", "", "fluid.viscosity_ratio = 1");
  plan.part(steps_in_time, "pressure",
            "rotational correction: " +
                describe_solver({grid, fluid::Centring::cell, fluid::BoundaryCondition::neumann, 0.0, 1.0},
                                scene.fluid.pressure_solver),
            "fluid.inertia = \"none\"");
  plan.part(!steps_in_time, "Stokes solve", "velocity and pressure together, to a tolerance",
            "fluid.inertia is not \"none\"");
}

std::string describe_markers(const Scene& scene) {
  const Scene::Time& time = scene.time;
  if (time.markers == "strain_relaxation")
    return fmt::format("euler, strain relaxed by {:g} in a step", time.relaxation);
  if (time.markers != "arkode") return time.markers;
  return fmt::format("arkode, tolerance {:g}, fluid velocity {} within a step", time.absolute_tolerance,
                     time.fluid_velocity == FluidVelocity::frozen ? "frozen" : "interpolated");
}

void describe_step(Plan& plan, const Scene& scene) {
  const bool tension = scene.membrane.sigma0 > 0.0;
  const bool shear = scene.flow.type == FlowType::shear;
  const int normal =
      scene.mesh.normal_degrees > 0 ? scene.mesh.normal_degrees : vesicle::two_thirds_degrees(scene.mesh.latitudes);
  plan.head("Each step");
  plan.part(true, "geometry", fmt::format("spherical harmonics of {} degrees", scene.mesh.latitudes), "");
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
            fmt::format("force with c_v = {:g}", scene.membrane.volume_stiffness),
            "membrane.volume is not \"penalty\"");
  plan.part(true, "spread, interpolate", "smoothed 4-point delta, in the bounding box of the markers", "");
  describe_fluid(plan, scene);
  plan.part(shear, "wall velocity", "steady shear, evaluated once", "flow.type = \"rest\"");
  plan.part(true, "mesh control",
            fmt::format("{}: normal velocity {} degrees, tangential {}",
                        scene.mesh.filter == vesicle::FilterOrder::velocity_first
                            ? "velocity filtered, then split"
                            : "normal and tangential parts filtered apart",
                        normal, scene.mesh.tangential_degrees),
            "");
  plan.part(scene.mesh.redistribute == Redistribute::when_needed, "redistribution",
            fmt::format("along the membrane, when its aspect ratio is above {:g} or the spectrum's tail above {:g}",
                        scene.mesh.max_aspect_ratio, scene.mesh.max_spectrum_tail),
            "mesh.redistribute = \"never\"");
  plan.part(scene.membrane.volume == vesicle::VolumeControl::projection, "volume projection",
            "exact, of the marker velocity and its step", "membrane.volume is not \"projection\"");
  plan.part(scene.membrane.area == vesicle::AreaControl::projection, "area projection",
            "exact, of the marker velocity and its step", "membrane.area is not \"projection\"");
  plan.part(true, "markers", describe_markers(scene), "");
  plan.part(tension, "target areas",
            scene.mesh.slip == vesicle::SlipReference::dealiased
                ? "Eqs. (32), (33), slip against the dealiased velocity"
                : "Eqs. (32), (33), slip against the interpolated velocity (paper)",
            "membrane.sigma0 = 0");
}

void describe_output(Plan& plan, const Scene& scene) {
  const auto& o = scene.output;
  const double cells = 1.0 * scene.domain.cells[0] * scene.domain.cells[1] * scene.domain.cells[2];
  const double snapshots = o.fluid_every > 0.0 ? std::floor(scene.time.end / o.fluid_every) + 1.0 : 0.0;
  plan.head("Output (intervals in time)");
  plan.line("diagnostics.csv", "{}", interval(o.diagnostics_every));
  plan.line("vesicle.h5", "{}", interval(o.vesicle_every));
  plan.line("fluid.h5", "{}, in all about {:.0f} MB", interval(o.fluid_every), 16e-6 * cells * snapshots);
  plan.line("checkpoint.h5", "{} and at the end, about {:.0f} MB", interval(o.checkpoint_every), 56e-6 * cells);
}

}  // namespace

std::string describe_plan(const Scene& scene, int threads) {
  Plan plan;
  if (!scene.title.empty()) plan.head(scene.title);
  describe_resolution(plan, scene, threads);
  describe_step(plan, scene);
  describe_output(plan, scene);
  return plan.text();
}

}  // namespace vesiflow::coupling
