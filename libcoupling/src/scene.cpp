#include "coupling/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy.h"
#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/marker_integrator.h"
#include "coupling/marker_transfer.h"
#include "initial_shape.h"
#include "mirror_symmetry.h"
#include "scene_mistakes.h"
#include "vesicle_scales.h"

namespace vesiflow::coupling {
namespace {

// Twice the stable g and a little is not worth starting.
constexpr double largest_tension_excess = 16.0 / 7.0;
// A marker should not turn by more than about 15 degrees in a step.
constexpr double largest_turn_per_step = 0.25;
// In lengths of the box: coordinates keep ten digits of it.
constexpr double largest_distance = 1e6;
// A membrane that is thin answers faster than the thick one whose explicit tension is stable to g = 7.
constexpr double stable_with_thickness_correction = 2.0;

std::array<double, 3> spacings(const Scene::Domain& domain) {
  std::array<double, 3> all{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    all[axis] = (domain.upper[axis] - domain.lower[axis]) / domain.cells[axis];
  return all;
}

std::string list(const std::array<bool, 3>& axes) {
  return fmt::format("[{}, {}, {}]", axes[0], axes[1], axes[2]);
}

void check_domain(const Scene& scene, const std::string& name) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(scene.domain.upper[axis] > scene.domain.lower[axis]))
      throw SceneError(fmt::format("{}: domain.upper[{}] = {:g}: must be above domain.lower[{}] = {:g}", name, axis,
                                   scene.domain.upper[axis], axis, scene.domain.lower[axis]));
    const double length = scene.domain.upper[axis] - scene.domain.lower[axis];
    const double farthest = std::max(std::abs(scene.domain.lower[axis]), std::abs(scene.domain.upper[axis]));
    if (!(std::isfinite(length) && farthest <= largest_distance * length))
      throw SceneError(fmt::format(
          "{}: domain.lower[{}] = {:g}, domain.upper[{}] = {:g}: must lie within {:g} times their distance from 0, and "
          "that distance be finite; farther off coordinates have too few digits",
          name, axis, scene.domain.lower[axis], axis, scene.domain.upper[axis], largest_distance));
    if (scene.domain.mirror[axis] && scene.domain.periodic[axis])
      throw SceneError(fmt::format(
          "{}: domain.mirror = {}: {} is periodic too (domain.periodic); a plane of symmetry needs an axis with walls",
          name, list(scene.domain.mirror), "xyz"[axis]));
  }
}

void check_time(const Scene& scene, const std::string& name) {
  if (scene.time.step > scene.time.end)
    throw SceneError(
        fmt::format("{}: time.step = {:g}: must not be above time.end = {:g}", name, scene.time.step, scene.time.end));
  const double limit = scene.stable_tension_number();
  if (scene.tension_number() > largest_tension_excess * limit)
    throw SceneError(fmt::format(
        "{}: time.step = {:g}: g = time.step membrane.sigma0/(4 h) = {:.3g} is far beyond the stability limit of the "
        "explicit tension ({:.3g}); take time.step <= {:.3g} or sigma0 <= {:.4g}",
        name, scene.time.step, scene.tension_number(), limit, scene.time.step * limit / scene.tension_number(),
        limit * 4.0 * scene.finest_spacing() / scene.time.step));
  if (static_cast<double>(scene.steps()) > 1e9)
    throw SceneError(fmt::format("{}: time.end = {:g}: that is {} steps of time.step = {:g}; at most 1e9", name,
                                 scene.time.end, scene.steps(), scene.time.step));
}

void check_time_keys(const Scene& scene, const std::string& name) {
  const Scene::Time& time = scene.time;
  if ((time.markers == "arkode" || time.markers == "implicit") && !have_sundials())
    throw SceneError(
        fmt::format("{}: time.markers = \"{}\": this build has no SUNDIALS; configure with "
                    "-DVESIFLOW_WITH_SUNDIALS=ON, or take another of time.markers",
                    name, time.markers));
  if (time.fluid_velocity == FluidVelocity::interpolated && time.markers != "arkode")
    throw SceneError(fmt::format(
        "{}: time.fluid_velocity = \"interpolated\": goes with time.markers = \"arkode\", the only one that "
        "looks into the step",
        name));
  if (time.markers == "strain_relaxation" && scene.tension_number() == 0.0)
    throw SceneError(
        fmt::format("{}: time.markers = \"strain_relaxation\": needs a tension, membrane.sigma0 > 0", name));
  if (!time.adaptive) return;
  if (!(time.smallest_step <= time.step && time.step <= time.largest_step))
    throw SceneError(
        fmt::format("{}: time.step = {:g}: the first of adaptive steps must be in [time.smallest_step, "
                    "time.largest_step] = [{:g}, {:g}]",
                    name, time.step, time.smallest_step, time.largest_step));
}

void check_flow(const Scene& scene, const std::string& name) {
  if (scene.flow.type == FlowType::custom) return;
  const Flow flow = flow_of(scene);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (scene.domain.periodic[axis] && !flow.may_be_periodic[axis])
      throw SceneError(fmt::format("{}: domain.periodic = {}: this flow.type does not repeat along {}; allowed is {}",
                                   name, list(scene.domain.periodic), "xyz"[axis], list(flow.may_be_periodic)));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (scene.domain.mirror[axis] && !flow.may_be_mirrored[axis])
      throw SceneError(fmt::format(
          "{}: domain.mirror = {}: this flow.type is not symmetric about the plane {} = {:g} of domain.lower; "
          "allowed here is {}",
          name, list(scene.domain.mirror), "xyz"[axis], scene.domain.lower[axis], list(flow.may_be_mirrored)));
  const double fastest = std::max(flow.greatest_gradient, flow.angular_frequency);
  const auto check_step = [&](const char* key, double step) {
    if (fastest * step > largest_turn_per_step)
      throw SceneError(
          fmt::format("{}: {} = {:g}: the flow changes a velocity at a rate of up to {:.4g}, which times {} must be "
                      "<= {:g}; so {} <= {:.4g}",
                      name, key, step, fastest, key, largest_turn_per_step, key, largest_turn_per_step / fastest));
  };
  check_step("time.step", scene.time.step);
  if (scene.time.adaptive) check_step("time.largest_step", scene.time.largest_step);
}

void check_physics(const Scene& scene, const std::string& name) {
  const bool coupled = scene.has_viscosity_contrast() && scene.fluid.inertia != fluid::Inertia::none &&
                       scene.fluid.viscous_treatment == fluid::ViscousTreatment::implicit;
  if (coupled && scene.fluid.velocity_solver == SolverChoice::fft)
    throw SceneError(fmt::format(
        "{}: fluid.velocity_solver = \"fft\": cannot solve for three components coupled by a viscosity that "
        "varies, which fluid.viscous_treatment = \"implicit\" asks for; take auto, pcg or cholmod, or another "
        "treatment",
        name));
}

void check_limits(const Scene& scene, const std::string& name) {
  if (scene.limits.on_blowup == OnBlowUp::stop) return;
  if (scene.time.adaptive)
    throw SceneError(fmt::format(
        "{}: limits.on_blowup = \"reduce_step\": is for equal steps; time.adaptive = true shortens its steps by itself",
        name));
  if (scene.output.checkpoint_every == 0.0)
    throw SceneError(fmt::format(
        "{}: limits.on_blowup = \"reduce_step\": goes back to a checkpoint, so output.checkpoint_every must be > 0",
        name));
}

// A membrane that is thin answers faster: too fast for an explicit tension that is right for a thick one.
void check_thickness(const Scene& scene, const std::string& name) {
  constexpr double largest = 3.0, largest_reynolds_number = 0.1;
  if (!scene.coupling.thickness_correction) return;
  // It is that of Stokes flow: seen to be stable to Re = 0.1, and to blow up at Re = 1.
  const double radius = largest_radius(scene);
  if (vesicle_reynolds_number(scene) > largest_reynolds_number)
    throw SceneError(
        fmt::format("{}: coupling.thickness_correction = true: is for slow flow, fluid.reynolds_number <= {:g} or "
                    "fluid.inertia = \"none\", and this scene has {:g}",
                    name, largest_reynolds_number / (radius * radius), scene.fluid.reynolds_number));
  if (scene.follows_shape()) return;
  if (scene.tension_number() > largest)
    throw SceneError(fmt::format(
        "{}: coupling.thickness_correction = true: with it the explicit tension is stable below g = time.step "
        "membrane.sigma0/(4 h) of about 2, and this scene has {:.3g}; take time.step <= {:.3g} or time.markers = "
        "\"shape_following\"",
        name, scene.tension_number(), 2.0 * scene.time.step / scene.tension_number()));
}

void check_gravity(const Scene& scene, const std::string& name) {
  const bool differs = std::ranges::any_of(scene.vesicles, [](const auto& v) { return v.density_difference != 0.0; });
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (differs && scene.domain.mirror[axis] && scene.gravity.acceleration[axis] != 0.0)
      throw SceneError(fmt::format(
          "{}: gravity.acceleration[{}] = {:g}: pulls across the plane of symmetry that domain.mirror = {} asks for",
          name, axis, scene.gravity.acceleration[axis], list(scene.domain.mirror)));
}

// Where the number of latitudes of vesicle i was said.
std::string latitudes_key(const Scene& scene, std::size_t i) {
  return scene.vesicles[i].latitudes ? fmt::format("vesicles.{}.latitudes", i) : "mesh.latitudes";
}

void check_degrees(const Scene& scene, std::size_t i, const std::string& name) {
  const auto check = [&](const char* key, int degrees) {
    if (degrees > scene.latitudes(i))
      throw SceneError(fmt::format("{}: {} = {}: must be <= {} = {}", name, key, degrees, latitudes_key(scene, i),
                                   scene.latitudes(i)));
  };
  check("mesh.normal_degrees", scene.mesh.normal_degrees);
  if (!scene.follows_shape()) check("mesh.tangential_degrees", scene.mesh.tangential_degrees);
}

void check_tension(const Scene& scene, const std::string& name) {
  if (scene.follows_shape() && scene.membrane.area == vesicle::AreaControl::penalty)
    throw SceneError(
        fmt::format("{}: membrane.area = \"penalty\": time.markers = \"{}\" keeps the area exactly where "
                    "there is tension; set "
                    "it to \"none\", or take another way to move the markers",
                    name, scene.time.markers));
  if (scene.follows_shape() && scene.membrane.integral_rate > 0.0)
    throw SceneError(
        fmt::format("{}: membrane.integral_rate = {:g}: time.markers = \"{}\" keeps the area without it; set "
                    "it to 0, or take another way to move the markers",
                    name, scene.membrane.integral_rate, scene.time.markers));
  if (!scene.membrane.g) return;
  const double meant = *scene.membrane.g * 4.0 * scene.finest_spacing() / scene.time.step;
  if (!std::isfinite(meant))
    throw SceneError(
        fmt::format("{}: membrane.g = {:g}: too large: sigma0 = 4 g h/time.step overflows", name, *scene.membrane.g));
  if (std::abs(meant - scene.membrane.sigma0) > 5e-3 * meant)
    throw SceneError(
        fmt::format("{}: membrane.g = {:g} and membrane.sigma0 = {:g} disagree: at this time step and spacing "
                    "g means sigma0 = {:g}; give one of them",
                    name, *scene.membrane.g, scene.membrane.sigma0, meant));
}

void check_vesicle_keys(const Scene& scene, std::size_t i, const std::string& name) {
  const VesicleScene& vesicle = scene.vesicles[i];
  const std::string key = fmt::format("vesicles.{}", i);
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
  if (vesicle.shape != Shape::mesh && vesicle.fit_degrees)
    throw SceneError(fmt::format("{}: {}: fit_degrees goes with shape = \"mesh\" only", name, key));
  if (from_file && !vesicle.surface)
    throw SceneError(
        fmt::format("{}: {}.file = \"{}\": has not been read; a program that fills a scene itself sets "
                    "VesicleScene::surface",
                    name, key, *vesicle.file));
  if (vesicle.fit_degrees && *vesicle.fit_degrees >= scene.latitudes(i))
    throw SceneError(fmt::format("{}: {}.fit_degrees = {}: must be below {} = {}", name, key, *vesicle.fit_degrees,
                                 latitudes_key(scene, i), scene.latitudes(i)));
  const auto& a = vesicle.rotation_axis;
  const double squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  if (!(squares > 0.0 && std::isfinite(squares)))
    throw SceneError(
        fmt::format("{}: {}.rotation_axis = [{:g}, {:g}, {:g}]: must not vanish, nor be so long or short that "
                    "its length overflows",
                    name, key, a[0], a[1], a[2]));
}

// A vesicle on both sides of a plane of symmetry must be symmetric about it, markers and all. Returns how low it may reach.
double check_mirrored(const Scene& scene, std::size_t i, int axis, const vesicle::VectorField& markers,
                      const std::string& name) {
  const auto u = static_cast<std::size_t>(axis);
  const double plane = scene.domain.lower[u];
  if (markers.col(axis).minCoeff() >= plane) return plane;
  constexpr double tolerance = 1e-10;  // in radii
  if (!is_symmetric(markers, axis, plane, tolerance * scene.vesicles[i].radius))
    throw SceneError(fmt::format(
        "{}: vesicles.{}: lies across the plane {} = {:g} of domain.mirror without being symmetric about it, each "
        "marker "
        "with a mirror image; turn it about an axis normal to the plane or along it (its own axis is z, its longitudes "
        "count from x), put its centre on the plane, or keep all of it on the side {} >= {:g}",
        name, i, "xyz"[u], plane, "xyz"[u], plane));
  return -std::numeric_limits<double>::infinity();
}

// A vesicle need not be in the box along a periodic axis, but some periods off at most, and not be many of them long.
void check_within_periods(const Scene& scene, std::size_t i, int axis, double from, double to,
                          const std::string& name) {
  constexpr double most_periods = 10.0;
  const auto u = static_cast<std::size_t>(axis);
  const double length = scene.domain.upper[u] - scene.domain.lower[u];
  if (!(to - from <= most_periods * length))
    throw SceneError(
        fmt::format("{}: vesicles.{}: is {:.4g} long along {}, along which the box repeats after {:.4g}; at "
                    "most {:g} times that",
                    name, i, to - from, "xyz"[u], length, most_periods));
  if (!(std::max(std::abs(from), std::abs(to)) <= largest_distance * length))
    throw SceneError(
        fmt::format("{}: vesicles.{}.centre[{}] = {:g}: must be within {:g} lengths of the box of 0; farther "
                    "off coordinates have too few digits",
                    name, i, axis, scene.vesicles[i].centre[u], largest_distance));
}

void check_inside_box(const Scene& scene, std::size_t i, const std::string& name) {
  const vesicle::VectorField markers = checked_markers(scene, i, name);
  const double distance = wall_distance(scene.coupling.kernel);
  for (int axis = 0; axis < 3; ++axis) {
    const auto u = static_cast<std::size_t>(axis);
    const double length = scene.domain.upper[u] - scene.domain.lower[u];
    const double from = markers.col(axis).minCoeff(), to = markers.col(axis).maxCoeff();
    if (scene.domain.periodic[u]) {
      check_within_periods(scene, i, axis, from, to, name);
      continue;
    }
    const double h = length / scene.domain.cells[u];
    const bool mirrored = scene.domain.mirror[u];
    const double low = mirrored ? check_mirrored(scene, i, axis, markers, name) : scene.domain.lower[u] + distance * h;
    const double high = scene.domain.upper[u] - distance * h;
    if (!(from >= low && to <= high))
      throw SceneError(
          fmt::format("{}: vesicles.{}.centre = [{:g}, {:g}, {:g}]: the vesicle reaches from {:.4g} to {:.4g} "
                      "along {}; it must stay within [{:.4g}, {:.4g}], {} grid spacings off the walls",
                      name, i, scene.vesicles[i].centre[0], scene.vesicles[i].centre[1], scene.vesicles[i].centre[2],
                      from, to, "xyz"[u], low, high, distance));
  }
}

}  // namespace

double Scene::spacing() const {
  const std::array<double, 3> all = spacings(domain);
  return *std::ranges::max_element(all);
}

double Scene::finest_spacing() const {
  const std::array<double, 3> all = spacings(domain);
  return *std::ranges::min_element(all);
}

double Scene::tension_number() const {
  double stiffest = vesicles.empty() ? membrane.sigma0 : 0.0;
  for (std::size_t i = 0; i < vesicles.size(); ++i) stiffest = std::max(stiffest, sigma0(i));
  return time.step * stiffest / (4.0 * finest_spacing());
}

double Scene::capillary_number(std::size_t i) const {
  return vesicles.at(i).capillary_number.value_or(membrane.capillary_number);
}

double Scene::sigma0(std::size_t i) const {
  return vesicles.at(i).sigma0.value_or(membrane.sigma0);
}

double Scene::spontaneous_curvature(std::size_t i) const {
  return vesicles.at(i).spontaneous_curvature.value_or(membrane.spontaneous_curvature);
}

int Scene::latitudes(std::size_t i) const {
  return vesicles.at(i).latitudes.value_or(mesh.latitudes);
}

double Scene::viscosity_ratio(std::size_t vesicle) const {
  return vesicles.at(vesicle).viscosity_ratio.value_or(fluid.viscosity_ratio);
}

bool Scene::follows_shape() const {
  return time.markers == "shape_following" || time.markers == "implicit";
}

bool Scene::has_viscosity_contrast() const {
  for (std::size_t i = 0; i < vesicles.size(); ++i)
    if (viscosity_ratio(i) != 1.0) return true;
  return false;
}

double Scene::stable_tension_number() const {
  if (follows_shape()) return std::numeric_limits<double>::infinity();
  const double of_euler = coupling.thickness_correction ? stable_with_thickness_correction : 7.0;
  if (time.markers == "ab2") return 0.5 * of_euler;  // its interval of real stability is half of Euler's
  return of_euler * (time.markers == "strain_relaxation" ? (2.0 - time.relaxation) / time.relaxation : 1.0);
}

long Scene::steps() const {
  // A last step that would only make up for round-off in time.end is not taken.
  return static_cast<long>(std::min(1e18, std::ceil(time.end / time.step - 1e-6)));
}

void check_scene(const Scene& scene, const std::string& name) {
  check_domain(scene, name);  // all others count in its spacings
  if (scene.vesicles.empty()) throw SceneError(fmt::format("{}: a scene needs at least one vesicle", name));
  SceneMistakes mistakes;
  for (const auto check : {check_accuracy, check_physics, check_tension, check_time, check_time_keys, check_flow,
                           check_thickness, check_limits, check_gravity})
    mistakes.gather([&] { check(scene, name); });
  bool have_shapes = true;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    have_shapes &= mistakes.gather([&] {
      check_degrees(scene, i, name);
      check_vesicle_keys(scene, i, name);
      check_inside_box(scene, i, name);
    });
  if (have_shapes) mistakes.gather([&] { check_apart(scene, name); });
  mistakes.refuse();
}

}  // namespace vesiflow::coupling
