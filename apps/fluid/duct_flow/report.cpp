// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <fmt/format.h>

#include <cmath>

namespace {

const char* name_of(DuctEnds ends) {
  return ends == DuctEnds::periodic ? "periodic" : "walls";
}

std::string order(double coarse, double fine, double ratio) {
  return fmt::format("{:.3f}", std::log(coarse / fine) / std::log(ratio));
}

nlohmann::ordered_json to_json(const DuctFlow& flow) {
  return {{"cells", flow.cells},          {"steady", flow.run.steady},       {"steps", flow.run.steps},
          {"time", flow.run.time},        {"time_step", flow.run.time_step}, {"change", flow.run.change},
          {"seconds", flow.run.seconds},  {"error_l2", flow.error_l2},       {"error_max", flow.error_max},
          {"cross_flow", flow.cross_flow}};
}

}  // namespace

std::string table(const Duct& duct, DuctMethod method, const std::vector<DuctFlow>& flows) {
  const bool stokes = method == DuctMethod::stokes;
  std::string text = fmt::format("Duct |y| <= {:g}, |z| <= {:g}, ends: {}, {}. Largest velocity 1.\n\n", duct.d, duct.e,
                                 name_of(duct.ends),
                                 stokes ? "Stokes flow" : fmt::format("Reynolds number {:g}", duct.reynolds_number));
  text += fmt::format("{:>13} {:>9} {:>10} {:>9} {:>8}  {:>10} {:>6}  {:>10} {:>6}  {:>10}\n", "cells",
                      stokes ? "iterations" : "steps", "time", stokes ? "residual" : "change", "seconds", "L2 error",
                      "order", "max error", "order", "cross flow");
  for (std::size_t g = 0; g < flows.size(); ++g) {
    const DuctFlow& flow = flows[g];
    std::string l2, max;
    if (g > 0) {
      const double ratio = static_cast<double>(flow.cells[1]) / flows[g - 1].cells[1];
      l2 = order(flows[g - 1].error_l2, flow.error_l2, ratio);
      max = order(flows[g - 1].error_max, flow.error_max, ratio);
    }
    text +=
        fmt::format("{:>13} {:>9} {:>10.4g} {:>9.1e} {:>8.1f}  {:>10.3e} {:>6}  {:>10.3e} {:>6}  {:>10.1e}\n",
                    fmt::format("{}x{}x{}", flow.cells[0], flow.cells[1], flow.cells[2]), flow.run.steps, flow.run.time,
                    flow.run.change, flow.run.seconds, flow.error_l2, l2, flow.error_max, max, flow.cross_flow);
  }
  return text;
}

nlohmann::ordered_json to_json(const Duct& duct, DuctMethod method, const std::vector<DuctFlow>& flows) {
  nlohmann::ordered_json json = {{"half_widths", {duct.d, duct.e}},
                                 {"length", duct.length},
                                 {"ends", name_of(duct.ends)},
                                 {"method", method == DuctMethod::stokes ? "stokes" : "unsteady"},
                                 {"reynolds_number", duct.reynolds_number}};
  for (const DuctFlow& flow : flows) json["grids"].push_back(to_json(flow));
  return json;
}

std::string cross_section(const Duct& duct, const DuctFlow& flow) {
  const vesiflow::fluid::DuctSeries series(duct.d, duct.e);
  const auto& u = flow.velocity.x;
  std::string text = "y,z,u,series\n";
  for (int k = 0; k < flow.cells[2]; ++k)
    for (int j = 0; j < flow.cells[1]; ++j) {
      const auto position = u.position(0, j, k);
      text += fmt::format("{:.6f},{:.6f},{:.9f},{:.9f}\n", position[1], position[2], u(flow.cells[0] / 2, j, k),
                          series.velocity(position[1], position[2]));
    }
  return text;
}
