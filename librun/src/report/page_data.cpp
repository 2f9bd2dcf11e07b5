// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/page_data.h"

#include "report/base64.h"
#include "report/quantities.h"

namespace vesiflow::run {
namespace {

using Json = nlohmann::ordered_json;

constexpr int data_format = 1;

Json packing_of(const CoefficientPacking& packing) {
  return {{"quantum", packing.quantum()}, {"widths", packing.widths()}};
}

Json membranes_of(const MembraneCourse& course, const PackedMembranes& packed) {
  Json all = {{"stored", course.stored}, {"latitudes", course.latitudes}};
  all["times"] = Json::array();
  all["steps"] = Json::array();
  for (const std::size_t i : packed.frames) {
    all["times"].push_back(course.frames[i].time);
    all["steps"].push_back(course.frames[i].step);
  }
  all["fields"] = Json::array();
  for (std::size_t f = 0; f < membrane_fields.size(); ++f)
    all["fields"].push_back({{"name", membrane_fields[f].name},
                             {"label", membrane_fields[f].label},
                             {"unit", membrane_fields[f].unit},
                             {"components", membrane_fields[f].components},
                             {"low", course.ranges[f].low},
                             {"high", course.ranges[f].high},
                             {"error", packed.error[f]}});
  all["packings"] = Json::array();
  for (const auto& fields : packed.packings) {
    Json of_vesicle = Json::array();
    for (const CoefficientPacking& packing : fields) of_vesicle.push_back(packing_of(packing));
    all["packings"].push_back(std::move(of_vesicle));
  }
  all["bytes"] = base64(packed.bytes);
  return all;
}

Json fluid_of(const FluidPlanes& fluid) {
  Json all = {{"stored", fluid.stored}, {"times", fluid.times}, {"planes", Json::array()}};
  for (const FluidPlanes::Plane& plane : fluid.planes)
    all["planes"].push_back({{"axis", plane.axis},
                             {"position", plane.position},
                             {"points", plane.points},
                             {"lower", plane.lower},
                             {"upper", plane.upper},
                             {"velocity_quantum", plane.velocity_quantum},
                             {"pressure_quantum", plane.pressure_quantum},
                             {"bytes", base64(plane.bytes)}});
  return all;
}

Json quantities_of(const DiagnosticsRows& rows) {
  Json all = Json::object();
  const auto add = [&](const Quantity& quantity) {
    all[std::string(quantity.name)] = {{"label", quantity.label}, {"unit", quantity.unit}, {"group", quantity.group}};
  };
  // Known ones in the order of the plots, then those of the program's own.
  for (const Quantity& quantity : vesicle_quantities())
    if (rows.column(std::string(quantity.name)) != nullptr) add(quantity);
  for (const std::string& name : rows.columns)
    if (name != "step" && name != "time" && name != "vesicle" && !all.contains(name))
      add(quantity_of(vesicle_quantities(), name));
  return all;
}

}  // namespace

Json page_data(const ReportContents& contents, bool live) {
  const StoredRun& run = contents.run;
  Json data = {{"format", data_format}, {"live", live}};
  data["name"] = run.folder.filename().string();
  data["title"] = run.parameter("title");
  data["status"] = run.text("status");
  data["box"] = {{"lower", run.parameter("domain.lower")},
                 {"upper", run.parameter("domain.upper")},
                 {"periodic", run.parameter("domain.periodic")},
                 {"mirror", run.parameter("domain.mirror")}};
  data["membranes"] = membranes_of(contents.course, contents.membranes);
  data["fluid"] = fluid_of(contents.fluid);
  data["quantities"] = quantities_of(contents.diagnostics);
  data["diagnostics"] = contents.diagnostics.text;
  data["scene"] = run.scene;
  data["summary"] = run.summary;
  return data;
}

}  // namespace vesiflow::run
