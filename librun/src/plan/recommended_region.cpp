// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/recommended_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "coupling/delta_kernel.h"
#include "coupling/flow.h"
#include "coupling/validity.h"
#include "plan/available_memory.h"
#include "plan/memory_plan.h"

namespace vesiflow::run {

namespace validity = coupling::validity;

double stable_convection_step(const Scene& scene) {
  if (scene.flow.type == FlowType::custom) return std::numeric_limits<double>::infinity();
  return coupling::stable_convection_step(scene, flow_of(scene));
}

std::string describe_marker_spacing(const Scene& scene) {
  using validity::closest_markers, validity::widest_markers;
  const double h = scene.spacing();
  double most = 0.0, least = std::numeric_limits<double>::infinity(), radius = 0.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    const double apart = std::numbers::pi * scene.vesicles[i].radius / scene.latitudes(i) / h;
    if (apart > most) std::tie(most, radius) = std::pair{apart, scene.vesicles[i].radius};
    least = std::min(least, apart);
  }
  constexpr double round_off = 1e-9;
  const std::string text = most > (1.0 + round_off) * least ? fmt::format("about {:.2f} to {:.2f} h", least, most)
                                                            : fmt::format("about {:.2f} h", most);
  std::string warning;
  const bool is_mapped = scene.coupling.method == coupling::CouplingMethod::delta;
  if (is_mapped && most > widest_markers)
    warning = fmt::format(
        "  <- WARNING: markers more than h apart let the fluid through between them, and runs stop: take "
        "mesh.latitudes >= {:.0f}",
        std::ceil(std::numbers::pi * radius / h / 8.0) * 8.0);
  else if (is_mapped && least < closest_markers)
    warning =
        "  <- WARNING: markers so close bring nothing that the fluid's grid resolves: fewer mesh.latitudes or more "
        "domain.cells";
  return text + " at the equator of a sphere" + warning;
}

std::string describe_sharp_region(const Scene& scene) {
  std::string warning;
  if (coupling::passes_inertia_of_thin_sharp(scene)) {
    const double least = scene.viscosity_range().least;
    warning = fmt::format(
        "  <- WARNING: a fluid of ratio {:g} inside can blow up at such Reynolds numbers: take fluid.reynolds_number "
        "<= {:g}, ratios >= {:g}, fluid.inertia = \"none\" or coupling.method = \"delta\"",
        least, validity::largest_reynolds_number_of_thin_sharp(least), validity::thin_sharp_ratio);
  }
  if (coupling::passes_inertia_of_fine_sharp(scene))
    warning += fmt::format(
        "  <- WARNING: with Reynolds numbers above {:g}, grids with more than {:g} cells per radius can blow up: take "
        "fewer domain.cells, fluid.reynolds_number <= {:g} or coupling.method = \"delta\"",
        validity::largest_reynolds_number_of_fine_sharp, validity::most_cells_per_radius_with_inertia_of_sharp,
        validity::largest_reynolds_number_of_fine_sharp);
  return fmt::format(
      "for coupling.method = \"sharp\" shapes, Reynolds numbers and viscosity ratios without inertia are mapped: other "
      "limits are those of "
      "\"delta\"; walls at least {:g} h off{}",
      coupling::wall_clearance(scene.coupling.kernel), warning);
}

std::string step_warning(const Scene& scene) {
  constexpr double longest = validity::recommended_turn_per_step;
  if (!scene.follows_shape() || scene.time.adaptive || scene.flow.type == FlowType::custom) return "";
  const coupling::Flow flow = flow_of(scene);
  const double rate = std::max(flow.greatest_gradient, flow.angular_frequency);
  constexpr double round_off = 1e-9;
  if (rate * scene.time.step <= longest * (1.0 + round_off)) return "";
  return fmt::format("  <- WARNING: the flow turns by more than 1/12 in a step: take time.step <= {:.3g}",
                     longest / rate);
}

std::string memory_limit_warning(const Scene& scene) {
  const AvailableMemory available = available_memory();
  if (plan_memory(scene).total() <= available.bytes) return "";
  return fmt::format("  <- WARNING: {} has {:.0f} MB: fewer domain.cells or mesh.latitudes take less", available.of,
                     1e-6 * available.bytes);
}

std::string bending_warning(const Scene& scene) {
  const double longest = coupling::stable_bending_step(scene);
  if (scene.time.step <= longest || scene.time.adaptive) return "";
  return fmt::format(
      "  <- WARNING: a shape far from rest relaxes at a rate of 1/Ca: take time.step <= {:.3g}{}", longest,
      longest > scene.time.smallest_step ? " or time.adaptive = true" : "; is membrane.capillary_number meant?");
}

std::string inertia_warning(const Scene& scene) {
  if (coupling::vesicle_reynolds_number(scene) <= validity::largest_reynolds_number) return "";
  return fmt::format("  <- WARNING: fluid.reynolds_number above {:g} has been compared with nothing",
                     validity::largest_reynolds_number);
}

}  // namespace vesiflow::run
