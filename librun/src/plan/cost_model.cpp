// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/cost_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "plan/sharp_plan.h"

namespace vesiflow::run {
namespace {

// Nanoseconds of one thread of the reference machine (2.6 GHz, AVX2), fitted by hand to
//   OMP_WAIT_POLICY=passive bench/step --cells 64 128 256 --ratio 1 20 --json
// with 32, 64 and 96 latitudes while nothing else ran; tests/coupling/cost_model_test.cpp holds the numbers. Those of external
// forces, thickness correction, diagnostics and output are of single runs (docs/plan.md).
namespace ns {
// Of the fluid per cell. Solves are transforms: times log2 of the cells along an axis.
constexpr double convection = 13.5, right_side = 8.0, viscous = 15.0;
constexpr double momentum = 3.45, projection = 2.0, indicator = 1.63;
// Of a membrane per marker, and per cubed number of latitudes: Legendre transforms.
constexpr double membrane = 400.0, membrane_cubed = 14.0;
constexpr double following = 290.0, following_cubed = 12.0;  // the mesh, shape_following
constexpr double filter = 180.0, filter_cubed = 3.0;         // the mesh, all others, per evaluation of the velocity
constexpr double spread = 270.0, interpolate = 185.0;
constexpr double cleared_cell = 30.0;  // of the box around a membrane
constexpr double thickness = 100.0;
constexpr double buoyancy = 20.0, repulsion = 10.0;  // of membranes apart
constexpr double look = 5.0;                         // at a mesh
constexpr double diagnostics = 250.0, distances = 1800.0;
// Of sharp membranes, over those of delta functions with as many markers (docs/plan.md): finding the points of the grid near them, and
// for each solve the jumps, and what is read.
constexpr double sharp_points_factor = 4.0, sharp_jumps_factor = 3.0, sharp_interpolate_factor = 1.5;
constexpr double checkpoint_byte = 1.7, fluid_byte = 3.0, vesicle_byte = 2.0;
}  // namespace ns

constexpr double nanosecond = 1e-9;
// Steps between two looks at the meshes, and the geometry that one takes beside that of the step.
constexpr double steps_between_looks = 16.0;
// Velocity evaluations of a step by "arkode" with the tolerance of the default.
constexpr double stages = 4.0;
// Evaluations of a step by "implicit": 2 to 7 were seen.
constexpr double fluids_of_implicit = 4.0;
// Of solvers that iterate or factor, over fft: orders of magnitude.
constexpr double iterations_of_stokes = 14.0, pcg_over_fft = 8.0;
constexpr double single_over_double = 0.7;  // bench/micro/fluid_step.cpp, 32^3 to 128^3
constexpr double coupled_over_fft = 22.0;   // times the square root of the ratio of viscosities
constexpr double cholmod_unknown = 480.0;   // nanoseconds per solve
constexpr double row = 1e-4, file = 6e-3;   // seconds, of a line of a table and of opening and closing HDF5

struct Size {
  double cells, log2_cells;
  double markers = 0.0, cubed = 0.0, boxes = 0.0;  // sums over the vesicles
};

Size size_of(const Scene& scene) {
  const auto& n = scene.domain.cells;
  Size size;
  size.cells = 1.0 * n[0] * n[1] * n[2];
  size.log2_cells = std::log2(size.cells) / 3.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    const double latitudes = scene.latitudes(i);
    size.markers += 2.0 * latitudes * latitudes;
    size.cubed += std::pow(latitudes, 3);
    // About 1.2 effective radii each way, and the reach of the delta function.
    size.boxes += std::pow(2.4 * scene.vesicles[i].radius / scene.spacing() + 4.0, 3);
  }
  return size;
}

class CostModel {
 public:
  explicit CostModel(const Scene& scene) : scene_(scene), size_(size_of(scene)), steps_(planned_steps(scene)) {}

  std::vector<PhaseCost> all() {
    of_membranes();
    of_fluid();
    of_markers();
    if (scene_.coupling.method == coupling::CouplingMethod::sharp) sharpen();
    if (scene_.time.markers == coupling::MarkerMotion::implicit) repeat();
    of_output();
    const double sum = std::accumulate(costs_.begin(), costs_.end(), 0.0,
                                       [](double part, const PhaseCost& cost) { return part + cost.seconds; });
    for (PhaseCost& cost : costs_) cost.share = cost.seconds / sum;
    return std::move(costs_);
  }

 private:
  bool has_inertia() const { return scene_.fluid.inertia != fluid::Inertia::none; }
  double geometry() const {
    constexpr std::array of_upsampling{0.4, 0.65, 1.0, 1.0};
    return nanosecond * of_upsampling[static_cast<std::size_t>(scene_.membrane.upsampling)] *
           (ns::membrane * size_.markers + ns::membrane_cubed * size_.cubed);
  }

  void on(const char* phase, double seconds, const char* key, bool rough = false) {
    costs_.push_back({phase, seconds, 0.0, "", key, rough || scene_.time.adaptive});
  }
  void off(const char* phase, const char* why) { costs_.push_back({phase, 0.0, 0.0, why, "", false}); }

  // What each evaluation of an implicit step does again.
  void repeat() {
    for (PhaseCost& cost : costs_) {
      if (cost.phase == "indicator" || cost.phase == "redistribution" || cost.phase == "adaptation") continue;
      cost.seconds *= fluids_of_implicit;
      cost.rough = true;
    }
  }

  // What sharp membranes take in the place of delta functions, and each solve for their velocities again.
  void sharpen() {
    const double solves = fluid_solves(scene_);
    for (PhaseCost& cost : costs_) {
      if (cost.phase == "spread") cost.seconds *= ns::sharp_points_factor + ns::sharp_jumps_factor * solves;
      if (cost.phase == "interpolate")
        cost.seconds *= ns::sharp_interpolate_factor * (scene_.has_scaled_velocity() ? solves : 1.0);
      // Convection is the same in all of them.
      if (cost.phase.starts_with("fluid_") && cost.phase != "fluid_convection") cost.seconds *= solves;
      cost.rough = cost.rough || cost.phase == "spread" || cost.phase == "interpolate";
    }
  }

  void of_membranes() {
    // What is measured between two steps need not be found again, unless the next step predicts.
    const double found = scene_.follows_shape() ? 0.0 : std::min(1.0, tables() / steps_);
    on("membrane", geometry() * (1.0 - found), "");
    const auto& g = scene_.gravity.acceleration;
    const bool pulls = g != std::array<double, 3>{} &&
                       std::ranges::any_of(scene_.vesicles, [](const auto& v) { return v.density_difference != 0.0; });
    const bool repels = scene_.repulsion.range > 0.0;
    if (pulls || repels)
      on("external_forces",
         nanosecond * size_.markers * ((pulls ? ns::buoyancy : 0.0) + (repels ? ns::repulsion : 0.0)),
         "gravity.acceleration = [0, 0, 0], repulsion.range = 0", repels);
    else
      off("external_forces", "no gravity on different densities, and repulsion.range = 0");
    on("spread", nanosecond * (ns::spread * size_.markers + ns::cleared_cell * size_.boxes), "");
  }

  void of_fluid() {
    const bool contrast = scene_.has_viscosity_field();
    const double cells = nanosecond * size_.cells, transforms = cells * size_.log2_cells;
    const auto equal = scene_.has_scaled_velocity() ? "coupling.method = \"sharp\": mu u is solved for"
                                                    : "the viscosity ratio of every vesicle is 1";
    constexpr auto ratio = "fluid.viscosity_ratio = 1, and of every vesicle";
    if (contrast)
      on("indicator", ns::indicator * transforms, ratio);
    else
      off("indicator", equal);
    if (has_inertia())
      on("fluid_convection", cells * (scene_.fluid.inertia == fluid::Inertia::full ? ns::convection : ns::right_side),
         "fluid.inertia = \"none\"");
    else
      off("fluid_convection", "fluid.inertia = \"none\"");
    if (contrast)
      on("fluid_viscous", ns::viscous * cells, ratio);
    else
      off("fluid_viscous", equal);
    if (!has_inertia()) {
      on("fluid_momentum", iterations_of_stokes * transforms * (ns::momentum + ns::projection), "", true);
      off("fluid_projection", "fluid.inertia = \"none\": part of the Stokes solve");
      return;
    }
    const bool coupled = contrast && scene_.fluid.viscous_treatment == fluid::ViscousTreatment::implicit;
    const bool mixed = scene_.fluid.precision == fluid::Precision::mixed;
    const auto [momentum, rough] =
        solve(scene_.fluid.velocity_solver, (mixed ? single_over_double : 1.0) * ns::momentum * transforms, 3.0);
    on("fluid_momentum", coupled ? of_coupled(transforms) : momentum, "", coupled || rough);
    const auto [projection, is_rough] = solve(scene_.fluid.pressure_solver, ns::projection * transforms, 1.0);
    on("fluid_projection", projection, "", is_rough);
  }

  double of_coupled(double transforms) const {
    return coupled_over_fft * std::sqrt(scene_.viscosity_range().contrast()) * ns::momentum * transforms;
  }

  // Seconds of solves of that many components, and whether they are rough.
  std::pair<double, bool> solve(fluid::SolverKind choice, double by_fft, double components) const {
    if (choice == fluid::SolverKind::pcg) return {pcg_over_fft * by_fft, true};
    if (choice == fluid::SolverKind::cholmod) return {nanosecond * cholmod_unknown * components * size_.cells, true};
    return {by_fft, false};
  }

  void of_markers() {
    const bool arkode = scene_.time.markers == coupling::MarkerMotion::arkode;
    const double evaluations = arkode ? stages : 1.0;
    on("interpolate", nanosecond * evaluations * ns::interpolate * size_.markers, "", arkode);
    if (scene_.coupling.thickness_correction)
      on("thickness_correction", nanosecond * evaluations * ns::thickness * size_.markers,
         "coupling.thickness_correction = false", arkode);
    else
      off("thickness_correction", "coupling.thickness_correction = false");
    if (scene_.follows_shape())
      on("mesh", nanosecond * (ns::following * size_.markers + ns::following_cubed * size_.cubed), "");
    else
      on("mesh", nanosecond * evaluations * (ns::filter * size_.markers + ns::filter_cubed * size_.cubed), "", arkode);
    if (scene_.mesh.redistribute == coupling::Redistribute::when_needed)
      on("redistribution", nanosecond * ns::look * size_.markers / steps_between_looks, "mesh.redistribute = \"never\"",
         true);
    else
      off("redistribution", "mesh.redistribute = \"never\"");
    if (scene_.time.adaptive)
      on("adaptation", nanosecond * ns::right_side * size_.cells, "time.adaptive = false", true);
    else
      off("adaptation", "time.adaptive = false");
  }

  double tables() const { return times_due(scene_, scene_.output.diagnostics_every, true); }

  void of_output() {
    const Scene::Output& o = scene_.output;
    const double checkpoints = times_due(scene_, o.checkpoint_every, false);
    // For the table; and for the summary at the start, with checkpoints and at the end, of what has mostly been found.
    const double measured = nanosecond * ns::diagnostics * size_.markers;
    on("diagnostics", (tables() * (geometry() + measured) + (checkpoints + 2.0) * measured) / steps_,
       "output.diagnostics_every = 0, but for summaries");
    const bool alone = scene_.vesicles.size() < 2;
    written("output_table", "output.diagnostics_every", o.diagnostics_every,
            tables() * (row + (alone ? 0.0 : nanosecond * ns::distances * size_.markers)));
    const double snapshots = times_due(scene_, o.vesicle_every, true);
    written("output_vesicle", "output.vesicle_every", o.vesicle_every,
            snapshots * (file + nanosecond * ns::vesicle_byte * 100.0 * size_.markers));
    written("output_fluid", "output.fluid_every", o.fluid_every,
            times_due(scene_, o.fluid_every, true) * (file + nanosecond * ns::fluid_byte * 16.0 * size_.cells));
    written("output_checkpoint", "output.checkpoint_every", o.checkpoint_every,
            checkpoints * (file + nanosecond * ns::checkpoint_byte * 56.0 * size_.cells));
  }

  void written(const char* phase, const char* key, double every, double seconds) {
    const std::string zero = std::string(key) + " = 0";
    if (every > 0.0)
      on(phase, seconds / steps_, zero.c_str());
    else
      off(phase, zero.c_str());
  }

  const Scene& scene_;
  Size size_;
  double steps_;
  std::vector<PhaseCost> costs_;
};

}  // namespace

double times_due(const Scene& scene, double every, bool at_start) {
  if (every <= 0.0) return 0.0;
  const double interval = std::max(every, scene.time.step);
  return std::ceil(scene.time.end / interval - 1e-9) + (at_start ? 1.0 : 0.0);
}

double planned_steps(const Scene& scene) {
  return scene.time.adaptive ? std::ceil(scene.time.end / scene.time.step) : static_cast<double>(scene.steps());
}

std::vector<PhaseCost> estimate_costs(const Scene& scene) {
  return CostModel(scene).all();
}

}  // namespace vesiflow::run
