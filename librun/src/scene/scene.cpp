// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/scene.h"

namespace vesiflow::run {

const SurfaceFile& Scene::surface_file(std::size_t vesicle) const {
  static const SurfaceFile none;
  return vesicle < surface_files.size() ? surface_files[vesicle] : none;
}

coupling::Flow flow_of(const Scene& scene) {
  const Scene::Flow& flow = scene.flow;
  const auto named = [&]() -> coupling::Flow {
    switch (flow.type) {
      case FlowType::rest:
        return coupling::flow_at_rest();
      case FlowType::shear:
        return coupling::shear_flow(flow.rate, scene.domain);
      case FlowType::oscillating_shear:
        return coupling::oscillating_shear_flow(flow.rate, flow.angular_frequency, scene.domain);
      case FlowType::extension:
        return coupling::extension_flow(flow.rate, flow.extension, scene.domain);
      case FlowType::plane_poiseuille:
        return coupling::plane_poiseuille_flow(flow.peak_velocity, scene.domain);
      case FlowType::duct:
        return coupling::duct_flow(flow.peak_velocity, scene.domain);
      case FlowType::custom:
        break;
    }
    throw SceneError(
        "flow.type = \"custom\": stands for the flow of a program of one's own (docs/first_app.md); a scene file can "
        "name rest, shear, oscillating_shear, extension, plane_poiseuille or duct");
  };
  coupling::Flow all = named();
  all.start = flow.start;
  return all;
}

}  // namespace vesiflow::run
