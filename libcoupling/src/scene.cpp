#include "coupling/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/marker_integrator.h"
#include "coupling/marker_transfer.h"
#include "initial_shape.h"

namespace vesiflow::coupling {
namespace {

// Twice the stable g and a little is not worth starting.
constexpr double largest_tension_excess = 16.0 / 7.0;
// A marker should not turn by more than about 15 degrees in a step.
constexpr double largest_shear_per_step = 0.25;

void check_domain(const Scene& scene, const std::string& name) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(scene.domain.upper[axis] > scene.domain.lower[axis]))
      throw SceneError(fmt::format("{}: domain.upper[{}] = {:g}: must be above domain.lower[{}] = {:g}", name, axis,
                                   scene.domain.upper[axis], axis, scene.domain.lower[axis]));
  }
}

void check_time(const Scene& scene, const std::string& name) {
  if (scene.time.step > scene.time.end)
    throw SceneError(
        fmt::format("{}: time.step = {:g}: must not be above time.end = {:g}", name, scene.time.step, scene.time.end));
  const double limit = scene.stable_tension_number();
  if (scene.flow.type == FlowType::shear && std::abs(scene.flow.rate) * scene.time.step > largest_shear_per_step)
    throw SceneError(
        fmt::format("{}: time.step = {:g}: flow.rate times time.step must be <= {:g}, so time.step <= {:g}", name,
                    scene.time.step, largest_shear_per_step, largest_shear_per_step / std::abs(scene.flow.rate)));
  if (scene.tension_number() > largest_tension_excess * limit)
    throw SceneError(fmt::format(
        "{}: time.step = {:g}: g = time.step membrane.sigma0/(4 h) = {:.3g} is far beyond the stability limit of the "
        "explicit tension ({:.3g}); take time.step <= {:.3g} or membrane.sigma0 <= {:.4g}",
        name, scene.time.step, scene.tension_number(), limit, scene.time.step * limit / scene.tension_number(),
        scene.membrane.sigma0 * limit / scene.tension_number()));
  if (static_cast<double>(scene.steps()) > 1e9)
    throw SceneError(fmt::format("{}: time.end = {:g}: that is {} steps of time.step = {:g}; at most 1e9", name,
                                 scene.time.end, scene.steps(), scene.time.step));
}

void check_time_keys(const Scene& scene, const std::string& name) {
  const Scene::Time& time = scene.time;
  if (time.markers == "arkode" && !have_sundials())
    throw SceneError(
        fmt::format("{}: time.markers = \"arkode\": this build has no SUNDIALS; configure with "
                    "-DVESIFLOW_WITH_SUNDIALS=ON, or take another of time.markers",
                    name));
  if (time.fluid_velocity == FluidVelocity::interpolated && time.markers != "arkode")
    throw SceneError(fmt::format(
        "{}: time.fluid_velocity = \"interpolated\": goes with time.markers = \"arkode\", the only one that "
        "looks into the step",
        name));
  if (time.markers == "strain_relaxation" && scene.membrane.sigma0 == 0.0)
    throw SceneError(
        fmt::format("{}: time.markers = \"strain_relaxation\": needs a tension, membrane.sigma0 > 0", name));
  if (!time.adaptive) return;
  if (!(time.smallest_step <= time.step && time.step <= time.largest_step))
    throw SceneError(
        fmt::format("{}: time.step = {:g}: the first of adaptive steps must be in [time.smallest_step, "
                    "time.largest_step] = [{:g}, {:g}]",
                    name, time.step, time.smallest_step, time.largest_step));
  if (scene.flow.type == FlowType::shear && std::abs(scene.flow.rate) * time.largest_step > largest_shear_per_step)
    throw SceneError(fmt::format("{}: time.largest_step = {:g}: flow.rate times time.largest_step must be <= {:g}",
                                 name, time.largest_step, largest_shear_per_step));
}

void check_physics(const Scene& scene, const std::string& name) {
  if (scene.fluid.viscosity_ratio != 1.0)
    throw SceneError(
        fmt::format("{}: fluid.viscosity_ratio = {:g}: this version computes equal viscosities only; "
                    "allowed is 1",
                    name, scene.fluid.viscosity_ratio));
  if (scene.mesh.normal_degrees > scene.mesh.latitudes)
    throw SceneError(fmt::format("{}: mesh.normal_degrees = {}: must be <= mesh.latitudes = {}", name,
                                 scene.mesh.normal_degrees, scene.mesh.latitudes));
  if (scene.mesh.tangential_degrees > scene.mesh.latitudes)
    throw SceneError(fmt::format("{}: mesh.tangential_degrees = {}: must be <= mesh.latitudes = {}", name,
                                 scene.mesh.tangential_degrees, scene.mesh.latitudes));
}

void check_tension(const Scene& scene, const std::string& name) {
  if (!scene.membrane.g) return;
  const double meant = *scene.membrane.g * 4.0 * scene.spacing() / scene.time.step;
  if (std::abs(meant - scene.membrane.sigma0) > 5e-3 * meant)
    throw SceneError(
        fmt::format("{}: membrane.g = {:g} and membrane.sigma0 = {:g} disagree: at this time step and spacing "
                    "g means sigma0 = {:g}; give one of them",
                    name, *scene.membrane.g, scene.membrane.sigma0, meant));
}

void check_vesicle_keys(const VesicleScene& vesicle, int latitudes, const std::string& key, const std::string& name) {
  const bool spheroid = vesicle.shape == Shape::prolate || vesicle.shape == Shape::oblate;
  const int given = (vesicle.reduced_volume ? 1 : 0) + (vesicle.aspect_ratio ? 1 : 0);
  if (spheroid && given != 1)
    throw SceneError(
        fmt::format("{}: {}: a prolate or oblate needs reduced_volume or aspect_ratio, one of them", name, key));
  if (!spheroid && given != 0)
    throw SceneError(
        fmt::format("{}: {}: reduced_volume and aspect_ratio belong to prolate and oblate shapes; an "
                    "ellipsoid takes axes, a sphere nothing",
                    name, key));
  const bool from_file = vesicle.shape == Shape::coefficients || vesicle.shape == Shape::mesh;
  const auto go_together = [&](bool shape, bool is_given, const char* what, const char* shapes) {
    if (shape != is_given)
      throw SceneError(fmt::format("{}: {}: {} goes with shape = {}, and only with it", name, key, what, shapes));
  };
  go_together(vesicle.shape == Shape::ellipsoid, vesicle.axes.has_value(), "axes = [a, b, c]", "\"ellipsoid\"");
  go_together(vesicle.shape == Shape::harmonics, !vesicle.harmonics.empty(),
              "harmonics = [[degree, order, amplitude], ...]", "\"harmonics\"");
  go_together(from_file, vesicle.file || vesicle.surface, "file = \"...\"", "\"coefficients\" or \"mesh\"");
  go_together(vesicle.shape == Shape::mesh, vesicle.fit_degrees.has_value(), "fit_degrees", "\"mesh\"");
  if (from_file && !vesicle.surface)
    throw SceneError(
        fmt::format("{}: {}.file = \"{}\": has not been read; a program that fills a scene itself sets "
                    "VesicleScene::surface",
                    name, key, *vesicle.file));
  if (vesicle.fit_degrees && *vesicle.fit_degrees >= latitudes)
    throw SceneError(fmt::format("{}: {}.fit_degrees = {}: must be below mesh.latitudes = {}", name, key,
                                 *vesicle.fit_degrees, latitudes));
  const auto& a = vesicle.rotation_axis;
  if (!(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] > 0.0))
    throw SceneError(fmt::format("{}: {}.rotation_axis = [0, 0, 0]: must not vanish", name, key));
}

void check_inside_box(const Scene& scene, std::size_t i, const std::string& name) {
  const vesicle::VectorField markers = checked_markers(scene, i, name);
  for (int axis = 0; axis < 3; ++axis) {
    const auto u = static_cast<std::size_t>(axis);
    const double h = (scene.domain.upper[u] - scene.domain.lower[u]) / scene.domain.cells[u];
    const double low = scene.domain.lower[u] + MarkerTransfer::wall_distance * h;
    const double high = scene.domain.upper[u] - MarkerTransfer::wall_distance * h;
    const double from = markers.col(axis).minCoeff(), to = markers.col(axis).maxCoeff();
    if (from < low || to > high)
      throw SceneError(
          fmt::format("{}: vesicles.{}.centre = [{:g}, {:g}, {:g}]: the vesicle reaches from {:.4g} to {:.4g} "
                      "along {}; it must stay within [{:.4g}, {:.4g}], {} grid spacings off the walls",
                      name, i, scene.vesicles[i].centre[0], scene.vesicles[i].centre[1], scene.vesicles[i].centre[2],
                      from, to, "xyz"[u], low, high, MarkerTransfer::wall_distance));
  }
}

}  // namespace

double Scene::spacing() const {
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest = std::max(largest, (domain.upper[axis] - domain.lower[axis]) / domain.cells[axis]);
  return largest;
}

double Scene::tension_number() const {
  return time.step * membrane.sigma0 / (4.0 * spacing());
}

double Scene::stable_tension_number() const {
  constexpr double without_relaxation = 7.0;
  return without_relaxation * (time.markers == "strain_relaxation" ? (2.0 - time.relaxation) / time.relaxation : 1.0);
}

long Scene::steps() const {
  // A last step that would only make up for round-off in time.end is not taken.
  return static_cast<long>(std::min(1e18, std::ceil(time.end / time.step - 1e-6)));
}

void check_scene(const Scene& scene, const std::string& name) {
  check_domain(scene, name);
  check_physics(scene, name);
  check_tension(scene, name);
  check_time(scene, name);
  check_time_keys(scene, name);
  if (scene.vesicles.empty()) throw SceneError(fmt::format("{}: a scene needs at least one vesicle", name));
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    check_vesicle_keys(scene.vesicles[i], scene.mesh.latitudes, fmt::format("vesicles.{}", i), name);
    check_inside_box(scene, i, name);
  }
  check_apart(scene, name);
}

}  // namespace vesiflow::coupling
