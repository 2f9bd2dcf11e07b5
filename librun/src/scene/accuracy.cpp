// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/validity.h"

namespace vesiflow::run {
namespace {

struct Settings {
  double cells_per_radius, latitudes_per_cells, steps_per_rate;
};

constexpr double stiff = 9000.0;  // strains below 1e-3 where stresses are of order one
constexpr double largest_slow_reynolds_number = coupling::validity::largest_reynolds_number_with_thickness_correction;
constexpr double largest_reynolds_number = coupling::validity::largest_reynolds_number;
constexpr double least_ratio_with_inertia = coupling::validity::thin_sharp_ratio;
constexpr double widest_contrast_with_inertia = coupling::validity::widest_contrast_of_second_order;
constexpr double smallest_capillary_number = coupling::validity::preset_least_capillary_number;
constexpr double smallest_reduced_volume = coupling::validity::preset_least_reduced_volume - 1e-12;

bool is_slow(const Scene& scene) {
  return coupling::vesicle_reynolds_number(scene) <= largest_slow_reynolds_number;
}

// Delta functions with their correction are the cheaper way at equal viscosities in slow flow.
bool wants_sharp(const Scene& scene) {
  return scene.coupling.method == coupling::CouplingMethod::sharp || scene.has_viscosity_contrast() || !is_slow(scene);
}

Settings settings_of(const Scene& scene) {
  const bool is_fine = scene.method.accuracy == Accuracy::per_mille;
  if (wants_sharp(scene) && is_fine) return is_slow(scene) ? Settings{16.0, 4.0, 96.0} : Settings{18.0, 4.0, 192.0};
  if (wants_sharp(scene)) return Settings{8.0, 5.0, 96.0};
  return is_fine ? Settings{12.0, 5.0, 192.0} : Settings{8.0, 5.0, 96.0};
}

double smallest_radius(const Scene& scene) {
  double radius = INFINITY;
  for (const coupling::VesicleParameters& vesicle : scene.vesicles) radius = std::min(radius, vesicle.radius);
  return radius;
}

// With the radius of the vesicle as the unit of length.
double vesicle_capillary_number(const Scene& scene, std::size_t i) {
  const double radius = scene.vesicles[i].radius;
  return scene.capillary_number(i) * (radius * radius * radius);
}

// An even number of cells with no prime factor above 5, which the solvers are fast for.
int even_and_smooth(double at_least) {
  const auto is_smooth = [](int n) {
    for (const int prime : {2, 3, 5})
      while (n % prime == 0) n /= prime;
    return n == 1;
  };
  int n = std::max(8, 2 * static_cast<int>(std::ceil(0.5 * at_least - 1e-9)));
  while (!is_smooth(n)) n += 2;
  return n;
}

// The fastest of the rates of the flow and of bending, 1/Ca.
double fastest_rate(const Scene& scene) {
  const coupling::Flow flow = flow_of(scene);
  double rate = std::max(flow.greatest_gradient, flow.angular_frequency);
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    rate = std::max(rate, 1.0 / vesicle_capillary_number(scene, i));
  return rate;
}

}  // namespace

void apply_accuracy(Scene& scene) {
  if (scene.method.accuracy == Accuracy::as_given || scene.vesicles.empty()) return;
  const Settings s = settings_of(scene);
  const bool sharp = wants_sharp(scene);
  const double spacing = smallest_radius(scene) / s.cells_per_radius;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cells = (scene.domain.upper[axis] - scene.domain.lower[axis]) / spacing;
    if (!(cells > 0.0 && cells <= 2048.0)) return;  // check_scene says what is wrong
    scene.domain.cells[axis] = even_and_smooth(cells);
  }
  const double latitudes = std::min(256.0, s.latitudes_per_cells * coupling::largest_radius(scene) / spacing);
  scene.mesh.latitudes = 8 * static_cast<int>(std::ceil(latitudes / 8.0 - 1e-9));
  if (scene.flow.type != FlowType::custom) {
    const double longest = coupling::stable_convection_step(scene, flow_of(scene));
    scene.time.step = 1.0 / std::ceil(std::max(s.steps_per_rate * fastest_rate(scene), 1.0 / longest));
  }
  scene.membrane.sigma0 = stiff * coupling::largest_radius(scene);
  scene.time.markers = coupling::MarkerMotion::shape_following;
  scene.coupling.method = sharp ? coupling::CouplingMethod::sharp : coupling::CouplingMethod::delta;
  scene.coupling.thickness_correction = !sharp;
}

void check_accuracy(const Scene& scene) {
  using coupling::ParameterError;
  if (scene.method.accuracy == Accuracy::as_given) return;
  if (scene.method.accuracy == Accuracy::tenth_per_mille)
    throw ParameterError(
        "method.accuracy = \"1e-4\": no settings are known that meet it: what the runs were compared with is itself "
        "known to 1e-3 only (docs/performance.md#presets); take \"1e-3\", and compare two grids");
  const std::string key =
      fmt::format("method.accuracy = \"{}\"", scene.method.accuracy == Accuracy::per_cent ? "1e-2" : "1e-3");
  if (scene.method.preset == Preset::paper)
    throw ParameterError(fmt::format("{}: is not for method.preset = \"paper\", whose settings are the paper's", key));
  if (scene.flow.type == FlowType::custom)
    throw ParameterError(
        fmt::format("{}: knows nothing of the time scale of flow.type = \"custom\"; leave it out and give "
                    "domain.cells, mesh.latitudes and time.step",
                    key));
  const double radius = coupling::largest_radius(scene), re = coupling::vesicle_reynolds_number(scene);
  if (re > largest_reynolds_number)
    throw ParameterError(
        fmt::format("{}: no settings are known for fluid.reynolds_number = {:g}; it must be <= {:g}, or "
                    "fluid.inertia = \"none\"; leave method.accuracy out, and compare two grids",
                    key, scene.fluid.reynolds_number, largest_reynolds_number / (radius * radius)));
  constexpr double largest_of_fine = coupling::validity::largest_reynolds_number_of_fine_sharp;
  if (scene.method.accuracy == Accuracy::per_mille && re > largest_of_fine)
    throw ParameterError(
        fmt::format("{}: no settings are known for fluid.reynolds_number = {:g}; it must be <= {:g}: above, sharp "
                    "membranes can blow "
                    "up on so fine a grid (docs/performance.md#presets); take \"1e-2\"",
                    key, scene.fluid.reynolds_number, largest_of_fine / (radius * radius)));
  if (const double contrast = scene.viscosity_range().contrast();
      !is_slow(scene) && contrast > widest_contrast_with_inertia)
    throw ParameterError(fmt::format(
        "{}: no settings are known for viscosities that differ by a factor of {:g} at fluid.reynolds_number "
        "= {:g}; it must be <= {:g} above {:g}, where the step is of second order "
        "(docs/performance.md#presets); leave method.accuracy out, and compare two grids and two steps",
        key, contrast, scene.fluid.reynolds_number, widest_contrast_with_inertia,
        largest_slow_reynolds_number / (radius * radius)));
  const double ratio = scene.viscosity_range().least;
  if (re > 0.0 && ratio < least_ratio_with_inertia)
    throw ParameterError(
        fmt::format("{}: no settings are known for a fluid of ratio {:g} inside, with inertia; it must be >= {:g}, or "
                    "fluid.inertia = \"none\"; leave method.accuracy out, and compare two grids",
                    key, ratio, least_ratio_with_inertia));
}

namespace {

// What the scene has that is coarser than the target asks for, or beyond what was verified; empty if nothing is.
std::string accuracy_doubts(const Scene& scene) {
  std::vector<std::string> doubts;
  Scene asked = scene;
  apply_accuracy(asked);
  const bool sharp_asked = asked.coupling.method == coupling::CouplingMethod::sharp;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (scene.domain.cells[axis] < asked.domain.cells[axis]) {
      doubts.push_back(fmt::format("domain.cells below {}", fmt::join(asked.domain.cells, " x ")));
      break;
    }
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    const coupling::VesicleParameters& v = scene.vesicles[i];
    if (scene.latitudes(i) < asked.mesh.latitudes)
      doubts.push_back(fmt::format("fewer than {} latitudes", asked.mesh.latitudes));
    if (v.reduced_volume && *v.reduced_volume < smallest_reduced_volume)
      doubts.push_back(fmt::format("a reduced volume below {:.2g}, which was not verified", smallest_reduced_volume));
    if (vesicle_capillary_number(scene, i) < smallest_capillary_number)
      doubts.push_back(fmt::format("a capillary number below {:g}, which was not verified", smallest_capillary_number));
    if (!doubts.empty()) break;
  }
  if (scene.time.step > asked.time.step * (1.0 + 1e-9) && !scene.time.adaptive)
    doubts.push_back(fmt::format("time.step above 1/{:.0f}", 1.0 / asked.time.step));
  if (scene.coupling.method == coupling::CouplingMethod::delta && !scene.coupling.thickness_correction)
    doubts.emplace_back("no thickness correction");
  if (scene.coupling.method != asked.coupling.method)
    doubts.push_back(fmt::format("coupling.method = \"{}\"", sharp_asked ? "delta" : "sharp"));
  return fmt::format("{}", fmt::join(doubts, "; "));
}

}  // namespace

std::string describe_accuracy(const Scene& scene) {
  const Settings s = settings_of(scene);
  const std::string doubts = accuracy_doubts(scene);
  return fmt::format(
      "{} of position, angle, frequency, deformation: {}, h = R/{:g}, {:g} R/h latitudes, 1/({:g} rates){}",
      scene.method.accuracy == Accuracy::per_cent ? "1 %" : "0.1 %",
      wants_sharp(scene) ? "sharp membranes" : "the thickness corrected", s.cells_per_radius, s.latitudes_per_cells,
      s.steps_per_rate, doubts.empty() ? "" : fmt::format("  <- WARNING: not met for certain: {}", doubts));
}

}  // namespace vesiflow::run
