#include "memory_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "available_memory.h"
#include "coupling/plan.h"
#include "coupling/simulation.h"
#include "viscosity_plan.h"

namespace vesiflow::coupling {
namespace {

// Resident size of an app before it computes (Debian 12), of which the libraries' code is most.
constexpr double program_bytes = 20.5e6;
// Of HDF5 once it has written.
constexpr double hdf5_bytes = 4e6;

double cell_field_bytes(const Scene& scene) {
  const auto& n = scene.domain.cells;
  return 8.0 * (n[0] + 2.0) * (n[1] + 2.0) * (n[2] + 2.0);
}

// Fitted to peak sizes of runs with 32, 64 and 96 latitudes, on 32^3 cells without output; per marker, and per cubed number of
// latitudes for the tables of Legendre functions. Most are those of the finer grid on which the Laplacian of H is formed.
double membrane_bytes(const Scene& scene, std::size_t vesicle) {
  const double latitudes = scene.latitudes(vesicle);
  const double markers = 2.0 * latitudes * latitudes;
  constexpr std::array upsampling{1.0, 1.5, 2.0, 2.0};
  const double share = 0.163 + 0.209 * std::pow(upsampling[static_cast<std::size_t>(scene.membrane.upsampling)], 2);
  double per_marker = 2465.0 * share;
  if (scene.mesh.redistribute == Redistribute::when_needed) per_marker += 415.0;
  if (scene.follows_shape()) per_marker += 370.0;
  return per_marker * markers + 88.5 * share * std::pow(latitudes, 3);
}

}  // namespace

MemoryPlan plan_memory(const Scene& scene) {
  const ViscosityPlan viscosity = plan_viscosity(scene);
  const double field = cell_field_bytes(scene);
  MemoryPlan plan;
  plan.program = program_bytes;
  plan.fluid = viscosity.fluid_bytes + viscosity.indicator_bytes;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) plan.membranes += membrane_bytes(scene, i);
  // To try steps again: a velocity, a pressure and, where there is a field of it, the viscosity.
  if (scene.time.adaptive || scene.time.markers == "implicit") plan.steps = (viscosity.is_variable ? 5.0 : 4.0) * field;
  // Two velocities and a pressure; four single precision numbers per cell.
  if (scene.output.checkpoint_every > 0.0) plan.output = 7.0 * field;
  if (scene.output.fluid_every > 0.0) plan.output = std::max(plan.output, 2.0 * field);
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

}  // namespace vesiflow::coupling
