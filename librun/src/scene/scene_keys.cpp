// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_keys.h"

#include <fmt/format.h>

#include <cmath>

namespace vesiflow::run {
namespace {

using coupling::ParameterVisitor;
using coupling::Range;
using coupling::visit_choice;

void visit(Scene::Method& method, ParameterVisitor& v) {
  visit_choice(v, "method.preset", method.preset, {"standard", "paper"});
  visit_choice(v, "method.accuracy", method.accuracy, {"as_given", "1e-2", "1e-3", "1e-4"});
}

void visit(Scene::Flow& flow, ParameterVisitor& v) {
  visit_choice(v, "flow.type", flow.type,
               {"rest", "shear", "oscillating_shear", "extension", "plane_poiseuille", "duct", "custom"});
  v.number("flow.rate", flow.rate, Range::any());
  v.number("flow.angular_frequency", flow.angular_frequency, Range::from(0.0));
  visit_choice(v, "flow.extension", flow.extension, {"planar", "uniaxial"});
  v.number("flow.peak_velocity", flow.peak_velocity, Range::any());
  visit_choice(v, "flow.start", flow.start, {"flow", "rest"});
}

void visit(Scene::Ending& ending, ParameterVisitor& v) {
  v.number("limits.wall_time", ending.wall_time, Range::from(0.0));
  visit_choice(v, "limits.on_blowup", ending.on_blowup, {"stop", "reduce_step"});
  v.integer("limits.retries", ending.retries, Range::between(1, 30));
}

void visit(Scene::Output& output, ParameterVisitor& v) {
  v.number("output.diagnostics_every", output.diagnostics_every, Range::from(0.0));
  v.number("output.vesicle_every", output.vesicle_every, Range::from(0.0));
  v.number("output.fluid_every", output.fluid_every, Range::from(0.0));
  v.number("output.checkpoint_every", output.checkpoint_every, Range::from(0.0));
  v.boolean("output.report", output.report);
}

}  // namespace

void visit_preset(Scene& scene, KeyVisitor& v) {
  visit(scene.method, v);
}

void apply_preset(Scene& scene) {
  if (scene.method.preset != Preset::paper) return;
  scene.time.markers = coupling::MarkerMotion::euler;
  scene.time.step = 1.0 / 192.0;
  scene.membrane.sigma0 = 600.0;
  scene.fluid.viscous_treatment = fluid::ViscousTreatment::explicit_;
  scene.membrane.volume = vesicle::VolumeControl::penalty;
  scene.membrane.laplacian = vesicle::LaplacianForm::paper;
  scene.mesh.slip = vesicle::SlipReference::interpolated;
  scene.mesh.redistribute = coupling::Redistribute::never;
}

void visit_keys(Scene& scene, KeyVisitor& v) {
  v.text("title", scene.title);
  visit(scene.method, v);
  visit(scene.domain, v);
  visit(scene.flow, v);
  visit(scene.fluid, v);
  visit(scene.coupling, v);
  visit(scene.membrane, v);
  v.optional_number("membrane.g", scene.g, Range::positive());
  visit(scene.mesh, v);
  visit(scene.gravity, v);
  visit(scene.repulsion, v);
  visit(scene.time, v);
  visit(scene.limits, v);
  visit(scene.ending, v);
  visit(scene.output, v);
}

void visit_keys(coupling::VesicleParameters& vesicle, SurfaceFile& file, KeyVisitor& v) {
  visit(vesicle, v);
  v.optional_text("file", file.file);
  v.optional_integer("fit_degrees", file.fit_degrees, Range::between(2, 64));
}

void check_ranges_of_scene(const Scene& given, coupling::Mistakes& mistakes) {
  Scene scene = given;  // visitors may change what they are shown
  coupling::RangeCheck check;
  visit(scene.method, check);
  visit(scene.flow, check);
  visit(scene.ending, check);
  visit(scene.output, check);
  for (const std::string& mistake : check.mistakes()) mistakes.add(mistake);
}

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace vesiflow::run
