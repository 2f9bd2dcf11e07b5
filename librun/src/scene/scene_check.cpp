// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/accuracy.h"
#include "scene/scene_keys.h"
#include "scene/scene_mistakes.h"

namespace vesiflow::run {
namespace {

void check_ending(const Scene& scene, const std::string& name) {
  if (scene.ending.on_blowup == OnBlowUp::stop) return;
  if (scene.time.adaptive)
    throw SceneError(fmt::format(
        "{}: limits.on_blowup = \"reduce_step\": is for equal steps; time.adaptive = true shortens its steps by itself",
        name));
  if (scene.output.checkpoint_every == 0.0)
    throw SceneError(fmt::format(
        "{}: limits.on_blowup = \"reduce_step\": goes back to a checkpoint, so output.checkpoint_every must be > 0",
        name));
}

void check_surface_file(const Scene& scene, std::size_t i, const std::string& name) {
  const coupling::VesicleParameters& vesicle = scene.vesicles[i];
  const SurfaceFile& file = scene.surface_file(i);
  const std::string key = fmt::format("vesicles.{}", i);
  const bool from_file = vesicle.shape == coupling::Shape::coefficients || vesicle.shape == coupling::Shape::mesh;
  if (from_file != (file.file || vesicle.surface))
    throw SceneError(fmt::format(
        "{}: {}: file = \"...\" goes with shape = \"coefficients\" or \"mesh\", and only with it", name, key));
  if (vesicle.shape != coupling::Shape::mesh && file.fit_degrees)
    throw SceneError(fmt::format("{}: {}: fit_degrees goes with shape = \"mesh\" only", name, key));
  if (from_file && !vesicle.surface)
    throw SceneError(
        fmt::format("{}: {}.file = \"{}\": has not been read; a program that fills a scene itself sets "
                    "VesicleParameters::surface",
                    name, key, *file.file));
  if (file.fit_degrees && *file.fit_degrees >= scene.latitudes(i))
    throw SceneError(fmt::format("{}: {}.fit_degrees = {}: must be below {} = {}", name, key, *file.fit_degrees,
                                 vesicle.latitudes ? key + ".latitudes" : "mesh.latitudes", scene.latitudes(i)));
}

// A parameter by the key that a scene has for it: a surface comes from a file.
std::string as_key(std::string mistake, const Scene& scene, std::size_t i) {
  const std::string surface = fmt::format("vesicles.{}.surface:", i);
  if (scene.surface_file(i).file && mistake.starts_with(surface))
    mistake.replace(0, surface.size(), fmt::format("vesicles.{}.file:", i));
  return mistake;
}

}  // namespace

void check_tension_number(const Scene& scene, const std::string& name) {
  if (!scene.g) return;
  const double meant = *scene.g * 4.0 * scene.finest_spacing() / scene.time.step;
  if (!std::isfinite(meant))
    throw SceneError(
        fmt::format("{}: membrane.g = {:g}: too large: sigma0 = 4 g h/time.step overflows", name, *scene.g));
  if (std::abs(meant - scene.membrane.sigma0) > 5e-3 * meant)
    throw SceneError(
        fmt::format("{}: membrane.g = {:g} and membrane.sigma0 = {:g} disagree: at this time step and spacing "
                    "g means sigma0 = {:g}; give one of them",
                    name, *scene.g, scene.membrane.sigma0, meant));
}

void check_scene(const Scene& scene, const coupling::Flow& flow, const std::string& name) {
  SceneMistakes mistakes;
  check_ranges_of_scene(scene, name, mistakes);
  for (const auto check : {check_accuracy, check_tension_number, check_ending})
    mistakes.gather([&] { check(scene, name); });
  std::vector<bool> has_file_mistake(scene.vesicles.size());
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    has_file_mistake[i] = !mistakes.gather([&] { check_surface_file(scene, i, name); });
  try {
    coupling::check(scene, flow);
  } catch (const coupling::ParameterError& error) {
    for (std::string mistake : error.mistakes()) {
      bool is_said = false;
      for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
        is_said |= has_file_mistake[i] && mistake.starts_with(fmt::format("vesicles.{}: a surface", i));
        mistake = as_key(mistake, scene, i);
      }
      if (!is_said) mistakes.add(fmt::format("{}: {}", name, mistake));
    }
  }
  mistakes.refuse();
}

void check_scene(const Scene& scene, const std::string& name) {
  // Nothing flows in a box without a volume, which is refused below.
  const bool has_volume = std::ranges::equal(scene.domain.lower, scene.domain.upper, std::ranges::less{});
  if (scene.flow.type == FlowType::custom || !has_volume)
    return check_scene(scene,
                       coupling::custom_flow([](const fluid::Vector3&, double) { return fluid::Vector3{}; },
                                             fluid::WallMotion::steady),
                       name);
  check_scene(scene, flow_of(scene), name);
}

}  // namespace vesiflow::run
