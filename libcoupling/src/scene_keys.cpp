#include "scene_keys.h"

#include <fmt/format.h>

#include <cmath>

namespace vesiflow::coupling {
namespace {

constexpr std::string_view marker_motions[] = {"euler",           "ab2",     "arkode", "strain_relaxation",
                                               "shape_following", "implicit"};
constexpr Range latitudes{.low = 8, .high = 256};
// What has been tried, in libfluid and here.
const Range viscosity_ratios = Range::between(0.05, 100.0);

template <class Enum>
void choice_of(KeyVisitor& visitor, std::string_view key, Enum& value, std::span<const std::string_view> names) {
  int index = static_cast<int>(value);
  visitor.choice(key, index, names);
  value = static_cast<Enum>(index);
}

template <class Enum>
void choice_of(KeyVisitor& visitor, std::string_view key, Enum& value, std::initializer_list<std::string_view> names) {
  choice_of(visitor, key, value, std::span(names.begin(), names.size()));
}

void choice_of_name(KeyVisitor& visitor, std::string_view key, std::string& value,
                    std::span<const std::string_view> names) {
  int index = 0;
  while (names[static_cast<std::size_t>(index)] != value) ++index;
  visitor.choice(key, index, names);
  value = names[static_cast<std::size_t>(index)];
}

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::describe() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (has_low && has_high)
    return fmt::format("in {}{:g}, {:g}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
  if (has_low) return fmt::format("{} {:g}", low_open ? ">" : ">=", low);
  if (has_high) return fmt::format("{} {:g}", high_open ? "<" : "<=", high);
  return "a finite number";
}

void visit_preset(Scene& scene, KeyVisitor& v) {
  choice_of(v, "method.preset", scene.method.preset, {"standard", "paper"});
  choice_of(v, "method.accuracy", scene.method.accuracy, {"as_given", "1e-2", "1e-3", "1e-4"});
}

void apply_preset(Scene& scene) {
  if (scene.method.preset != Preset::paper) return;
  scene.time.markers = "euler";
  scene.time.step = 1.0 / 192.0;
  scene.membrane.sigma0 = 600.0;
  scene.fluid.viscous_treatment = fluid::ViscousTreatment::explicit_;
  scene.membrane.volume = vesicle::VolumeControl::penalty;
  scene.membrane.laplacian = vesicle::LaplacianForm::paper;
  scene.mesh.slip = vesicle::SlipReference::interpolated;
  scene.mesh.redistribute = Redistribute::never;
}

void visit_keys(Scene& scene, KeyVisitor& v) {
  v.text("title", scene.title);
  visit_preset(scene, v);

  v.vector("domain.lower", scene.domain.lower, Range::any());
  v.vector("domain.upper", scene.domain.upper, Range::any());
  v.cells("domain.cells", scene.domain.cells, Range::between(8, 2048));
  v.booleans("domain.periodic", scene.domain.periodic);
  v.booleans("domain.mirror", scene.domain.mirror);

  choice_of(v, "flow.type", scene.flow.type,
            {"rest", "shear", "oscillating_shear", "extension", "plane_poiseuille", "duct", "custom"});
  v.number("flow.rate", scene.flow.rate, Range::any());
  v.number("flow.angular_frequency", scene.flow.angular_frequency, Range::from(0.0));
  choice_of(v, "flow.extension", scene.flow.extension, {"planar", "uniaxial"});
  v.number("flow.peak_velocity", scene.flow.peak_velocity, Range::any());
  choice_of(v, "flow.start", scene.flow.start, {"flow", "rest"});

  v.number("fluid.reynolds_number", scene.fluid.reynolds_number, Range::positive());
  v.number("fluid.viscosity_ratio", scene.fluid.viscosity_ratio, viscosity_ratios);
  choice_of(v, "fluid.viscous_treatment", scene.fluid.viscous_treatment, {"explicit", "extrapolated", "implicit"});
  choice_of(v, "fluid.inertia", scene.fluid.inertia, {"full", "unsteady", "none"});
  choice_of(v, "fluid.velocity_solver", scene.fluid.velocity_solver, {"auto", "fft", "cholmod", "pcg"});
  choice_of(v, "fluid.pressure_solver", scene.fluid.pressure_solver, {"auto", "fft", "cholmod", "pcg"});

  choice_of(v, "coupling.kernel", scene.coupling.kernel, delta_kernel_names);
  v.boolean("coupling.thickness_correction", scene.coupling.thickness_correction);

  v.number("membrane.capillary_number", scene.membrane.capillary_number, Range::positive());
  v.number("membrane.sigma0", scene.membrane.sigma0, Range::from(0.0));
  v.optional_number("membrane.g", scene.membrane.g, Range::positive());
  choice_of(v, "membrane.volume", scene.membrane.volume, {"none", "penalty", "projection"});
  v.number("membrane.volume_stiffness", scene.membrane.volume_stiffness, Range::from(0.0));
  v.number("membrane.spontaneous_curvature", scene.membrane.spontaneous_curvature, Range::any());
  choice_of(v, "membrane.tension_law", scene.membrane.tension_law, {"logarithmic", "linear"});
  choice_of(v, "membrane.tension_form", scene.membrane.tension_form, {"divergence", "non_divergence"});
  v.number("membrane.integral_rate", scene.membrane.integral_rate, Range::from(0.0));
  v.integer("membrane.integral_degrees", scene.membrane.integral_degrees, Range::from(1.0));
  choice_of(v, "membrane.area", scene.membrane.area, {"none", "penalty", "projection"});
  v.number("membrane.area_stiffness", scene.membrane.area_stiffness, Range::from(0.0));
  choice_of(v, "membrane.laplacian", scene.membrane.laplacian, {"cartesian", "christoffel", "paper"});
  choice_of(v, "membrane.upsampling", scene.membrane.upsampling, {"1", "1.5", "2", "auto"});

  v.integer("mesh.latitudes", scene.mesh.latitudes, latitudes);
  choice_of(v, "mesh.filter", scene.mesh.filter, {"velocity", "components"});
  choice_of(v, "mesh.slip", scene.mesh.slip, {"interpolated", "dealiased"});
  v.integer("mesh.normal_degrees", scene.mesh.normal_degrees, Range::from(0));
  v.integer("mesh.tangential_degrees", scene.mesh.tangential_degrees, Range::from(2));
  choice_of(v, "mesh.redistribute", scene.mesh.redistribute, {"never", "when_needed"});
  v.number("mesh.max_aspect_ratio", scene.mesh.max_aspect_ratio, Range::from(1.0));
  v.number("mesh.max_spectrum_tail", scene.mesh.max_spectrum_tail, Range::from(0.0));

  v.vector("gravity.acceleration", scene.gravity.acceleration, Range::any());

  v.number("repulsion.range", scene.repulsion.range, Range::from(0.0));
  v.number("repulsion.strength", scene.repulsion.strength, Range::from(0.0));
  v.boolean("repulsion.walls", scene.repulsion.walls);

  v.number("time.step", scene.time.step, Range::positive());
  v.number("time.end", scene.time.end, Range::positive());
  choice_of_name(v, "time.markers", scene.time.markers, marker_motions);
  v.number("time.relative_tolerance", scene.time.relative_tolerance, Range::from(0.0));
  v.number("time.absolute_tolerance", scene.time.absolute_tolerance, Range::positive());
  choice_of(v, "time.fluid_velocity", scene.time.fluid_velocity, {"frozen", "interpolated"});
  v.number("time.relaxation", scene.time.relaxation, {.low = 0.0, .high = 1.0, .low_open = true});
  v.number("time.implicit_tolerance", scene.time.implicit_tolerance, Range::positive());
  v.integer("time.implicit_iterations", scene.time.implicit_iterations, Range::from(2));
  v.boolean("time.adaptive", scene.time.adaptive);
  v.number("time.tolerance", scene.time.tolerance, Range::positive());
  v.number("time.smallest_step", scene.time.smallest_step, Range::positive());
  v.number("time.largest_step", scene.time.largest_step, Range::positive());

  v.number("limits.local_area_error", scene.limits.local_area_error, Range::positive());
  v.number("limits.velocity_noise", scene.limits.velocity_noise, Range::positive());
  v.number("limits.area_error", scene.limits.area_error, Range::positive());
  v.number("limits.volume_error", scene.limits.volume_error, Range::positive());
  v.number("limits.wall_time", scene.limits.wall_time, Range::from(0.0));
  choice_of(v, "limits.on_blowup", scene.limits.on_blowup, {"stop", "reduce_step"});
  v.integer("limits.retries", scene.limits.retries, Range::between(1, 30));

  v.number("output.diagnostics_every", scene.output.diagnostics_every, Range::from(0.0));
  v.number("output.vesicle_every", scene.output.vesicle_every, Range::from(0.0));
  v.number("output.fluid_every", scene.output.fluid_every, Range::from(0.0));
  v.number("output.checkpoint_every", scene.output.checkpoint_every, Range::from(0.0));
}

void visit_keys(VesicleScene& vesicle, KeyVisitor& v) {
  choice_of(v, "shape", vesicle.shape,
            {"sphere", "prolate", "oblate", "ellipsoid", "biconcave", "harmonics", "coefficients", "mesh"});
  v.optional_number("reduced_volume", vesicle.reduced_volume, {.low = 0.3, .high = 1.0});
  v.optional_number("aspect_ratio", vesicle.aspect_ratio, Range::between(1.0, 20.0));
  v.optional_vector("axes", vesicle.axes, Range::positive());
  v.harmonics("harmonics", vesicle.harmonics);
  v.optional_text("file", vesicle.file);
  v.optional_integer("fit_degrees", vesicle.fit_degrees, Range::between(2, 64));
  v.optional_number("viscosity_ratio", vesicle.viscosity_ratio, viscosity_ratios);
  v.number("radius", vesicle.radius, Range::positive());
  v.vector("centre", vesicle.centre, Range::any());
  v.vector("rotation_axis", vesicle.rotation_axis, Range::any());
  v.number("rotation_deg", vesicle.rotation_deg, Range::any());
  v.optional_number("capillary_number", vesicle.capillary_number, Range::positive());
  v.optional_number("sigma0", vesicle.sigma0, Range::from(0.0));
  v.optional_number("spontaneous_curvature", vesicle.spontaneous_curvature, Range::any());
  v.optional_integer("latitudes", vesicle.latitudes, latitudes);
  v.number("density_difference", vesicle.density_difference, Range::any());
}

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace vesiflow::coupling
