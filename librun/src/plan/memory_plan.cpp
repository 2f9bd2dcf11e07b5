// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "coupling/simulation.h"
#include "plan/available_memory.h"
#include "plan/sharp_plan.h"
#include "plan/viscosity_plan.h"
#include "run/plan.h"

namespace vesiflow::run {
namespace {

// Resident size of an app before it computes (Debian 12), of which the libraries' code is most.
constexpr double program_bytes = 20.5e6;
// Of HDF5 once it has written.
constexpr double hdf5_bytes = 4e6;

double cell_field_bytes(const Scene& scene) {
  const auto& n = scene.domain.cells;
  return 8.0 * (n[0] + 2.0) * (n[1] + 2.0) * (n[2] + 2.0);
}

// Share of what the membrane takes that goes with the grid on which the Laplacian of H is formed: most of it.
double upsampled_share(const Scene& scene) {
  constexpr std::array upsampling{1.0, 1.5, 2.0, 2.0};
  return 0.163 + 0.209 * std::pow(upsampling[static_cast<std::size_t>(scene.membrane.upsampling)], 2);
}

// Fitted to peak sizes of runs with 16 to 128 latitudes, on 32^3 and 40^3 cells without output.
double membrane_bytes(const Scene& scene, std::size_t vesicle) {
  const double markers = 2.0 * scene.latitudes(vesicle) * scene.latitudes(vesicle);
  double per_marker = 2465.0 * upsampled_share(scene);
  if (scene.mesh.redistribute == coupling::Redistribute::when_needed) per_marker += 415.0;
  if (scene.follows_shape()) per_marker += 370.0;
  return per_marker * markers;
}

// Tables of Legendre functions: membranes of as many latitudes share theirs.
double table_bytes(const Scene& scene) {
  std::set<int> sizes;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) sizes.insert(scene.latitudes(i));
  double bytes = 0.0;
  for (const int latitudes : sizes) bytes += 88.5 * upsampled_share(scene) * std::pow(latitudes, 3);
  return bytes;
}

}  // namespace

MemoryPlan plan_memory(const Scene& scene) {
  const ViscosityPlan viscosity = plan_viscosity(scene);
  const double field = cell_field_bytes(scene);
  MemoryPlan plan;
  plan.program = program_bytes;
  plan.fluid = viscosity.fluid_bytes + viscosity.indicator_bytes;
  plan.membranes = table_bytes(scene);
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) plan.membranes += membrane_bytes(scene, i);
  if (scene.coupling.method == coupling::CouplingMethod::sharp) {
    // The source of the divergence, and the velocity that is shown where it is not the one that is solved for.
    plan.fluid += (scene.has_scaled_velocity() ? 4.0 : 1.0) * field;
    plan.membranes += sharp_bytes(scene);
    if (scene.corrects_fluid(scene.time.step) || scene.has_phase_inertia())
      plan.fluid += 3.0 * field;  // the force that a step is solved again with another than
    if (scene.has_phase_inertia()) {
      // A force, the velocity that is expected and what continues it; where the solver has another Reynolds number, convection and, if two times
      // are not enough, velocities. In boxes four times of both phases and of what the grid has, with their convection.
      const bool convects = scene.fluid.inertia == fluid::Inertia::full;
      const coupling::PhaseSplitting splitting = scene.phase_splitting();
      const bool solves_another = splitting.solved_reynolds_number != scene.fluid.reynolds_number;
      plan.fluid +=
          (9.0 + (solves_another && convects ? 9.0 : 0.0) + (solves_another && splitting.curvature > 0.0 ? 9.0 : 0.0)) *
          field;
      plan.membranes += 12.0 * (convects ? 6.0 : 3.0) * body_box_bytes(scene);
    }
  }
  // To try steps again: a velocity, a pressure and, where there is a field of it, the viscosity.
  const double remembered = (viscosity.is_variable ? 5.0 : 4.0) * field;
  if (scene.time.adaptive || scene.time.markers == coupling::MarkerMotion::implicit) plan.steps = remembered;
  // Two velocities and a pressure, of two phases more velocities; four single precision numbers per cell.
  if (scene.output.checkpoint_every > 0.0)
    plan.output = scene.has_phase_inertia() ? 16.0 * field + 12.0 * body_box_bytes(scene) : 7.0 * field;
  if (scene.output.fluid_every > 0.0) plan.output = std::max(plan.output, 2.0 * field);
  if (plan.steps == 0.0 && scene.follows_shape())
    plan.steps = std::max(0.0, remembered - plan.output);  // of the start only
  if (plan.output > 0.0 || scene.output.vesicle_every > 0.0) plan.output += hdf5_bytes;
  return plan;
}

std::string memory_warning(const Scene& scene) {
  const double planned = plan_memory(scene).total();
  const AvailableMemory available = available_memory();
  if (planned <= available.bytes) return "";
  return fmt::format(
      "this scene takes about {:.0f} MB, {} has {:.0f} MB: fewer domain.cells or mesh.latitudes take less, see --plan",
      1e-6 * planned, available.of, 1e-6 * available.bytes);
}

}  // namespace vesiflow::run
