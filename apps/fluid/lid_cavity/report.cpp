// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <fmt/format.h>

#include <cmath>

using namespace vesiflow::fluid;

namespace cavity {
namespace {

double ratio(const CavityFlow& coarse, const CavityFlow& fine) {
  return static_cast<double>(fine.cells) / coarse.cells;
}

std::vector<double> limits(const std::vector<double>& coarse, const std::vector<double>& fine, double ratio) {
  std::vector<double> values;
  for (std::size_t p = 0; p < fine.size(); ++p) values.push_back(extrapolated(coarse[p], fine[p], ratio));
  return values;
}

// One of the two centrelines: what was published and what the grids give there.
struct Comparison {
  const char* name;  // of the velocity
  const char* position;
  std::span<const PublishedPoint> published;
  std::vector<std::vector<double>> grids;
  std::vector<double> limit;  // empty with one grid
};

Comparison compare(const std::vector<CavityFlow>& flows, bool u) {
  using namespace albensoeder_kuhlmann;
  Comparison result{u ? "u" : "v", u ? "y" : "x", u ? u_along_y() : v_along_x(), {}, {}};
  for (const CavityFlow& flow : flows)
    result.grids.push_back(sampled(u ? flow.u_along_y : flow.v_along_x, result.published));
  const std::size_t n = flows.size();
  if (n > 1) result.limit = limits(result.grids[n - 2], result.grids[n - 1], ratio(flows[n - 2], flows[n - 1]));
  return result;
}

std::string extrema_table(const std::vector<CavityFlow>& flows) {
  std::string text =
      fmt::format("{:>9} {:>7} {:>8} {:>9} {:>8}  {:>9} {:>7}  {:>9} {:>7}  {:>9} {:>7}\n", "cells", "steps", "time",
                  "change", "seconds", "min u", "at y", "max v", "at x", "min v", "at x");
  const auto extrema = [](const Extremum& a, const Extremum& b, const Extremum& c) {
    return fmt::format("  {:>9.5f} {:>7.4f}  {:>9.5f} {:>7.4f}  {:>9.5f} {:>7.4f}\n", a.value, a.position, b.value,
                       b.position, c.value, c.position);
  };
  for (const CavityFlow& flow : flows)
    text += fmt::format("{:>7}^3 {:>7} {:>8.2f} {:>9.1e} {:>8.1f}", flow.cells, flow.run.steps, flow.run.time,
                        flow.run.change, flow.run.seconds) +
            extrema(flow.u_minimum(), flow.v_maximum(), flow.v_minimum());
  if (flows.size() > 1) {
    const CavityFlow &coarse = flows[flows.size() - 2], &fine = flows.back();
    const auto limit = [&](const Extremum& a, const Extremum& b) {
      return Extremum{extrapolated(a.position, b.position, ratio(coarse, fine)),
                      extrapolated(a.value, b.value, ratio(coarse, fine))};
    };
    text += fmt::format("{:<45}", "    h -> 0") + extrema(limit(coarse.u_minimum(), fine.u_minimum()),
                                                          limit(coarse.v_maximum(), fine.v_maximum()),
                                                          limit(coarse.v_minimum(), fine.v_minimum()));
  }
  return text;
}

std::string profile_table(const Comparison& line, const std::vector<CavityFlow>& flows) {
  std::string text = fmt::format("\n{:>9} {:>11}", line.position, "published");
  for (const CavityFlow& flow : flows) text += fmt::format(" {:>8}^3", flow.cells);
  if (!line.limit.empty()) text += fmt::format(" {:>10} {:>11}", "h -> 0", "difference");
  text += "\n";
  for (std::size_t p = 0; p < line.published.size(); ++p) {
    text += fmt::format("{:>9.4f} {:>2}{:>9.5f}", line.published[p].position, line.name, line.published[p].value);
    for (const auto& grid : line.grids) text += fmt::format(" {:>10.5f}", grid[p]);
    if (!line.limit.empty())
      text += fmt::format(" {:>10.5f} {:>11.5f}", line.limit[p], line.limit[p] - line.published[p].value);
    text += "\n";
  }
  return text;
}

// Order of a difference that falls from `coarse` to `fine`.
double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

std::string deviation_table(const Comparison& u, const Comparison& v, const std::vector<CavityFlow>& flows) {
  std::string text = fmt::format("\n{:>9}  {:>9} {:>6} {:>9} {:>6}   {:>9} {:>6} {:>9} {:>6}\n", "cells", "u rms",
                                 "order", "u max", "order", "v rms", "order", "v max", "order");
  for (std::size_t g = 0; g < flows.size(); ++g) {
    text += fmt::format("{:>7}^3", flows[g].cells);
    for (const Comparison* line : {&u, &v}) {
      const Deviation fine = deviation(line->grids[g], line->published);
      if (g == 0) {
        text += fmt::format("  {:>9.2e} {:>6} {:>9.2e} {:>6} ", fine.rms, "", fine.max, "");
        continue;
      }
      const Deviation coarse = deviation(line->grids[g - 1], line->published);
      const double by = ratio(flows[g - 1], flows[g]);
      text += fmt::format("  {:>9.2e} {:>6.2f} {:>9.2e} {:>6.2f} ", fine.rms, order(coarse.rms, fine.rms, by), fine.max,
                          order(coarse.max, fine.max, by));
    }
    text += "\n";
  }
  if (!u.limit.empty()) {
    const Deviation in_u = deviation(u.limit, u.published), in_v = deviation(v.limit, v.published);
    text += fmt::format("{:>9}  {:>9.2e} {:>6} {:>9.2e} {:>6}   {:>9.2e} {:>6} {:>9.2e}\n", "h -> 0", in_u.rms, "",
                        in_u.max, "", in_v.rms, "", in_v.max);
  }
  return text;
}

nlohmann::ordered_json to_json(const Extremum& extremum) {
  return {{"position", extremum.position}, {"value", extremum.value}};
}

nlohmann::ordered_json to_json(const Profile& profile) {
  return {{"positions", profile.positions}, {"values", profile.values}};
}

nlohmann::ordered_json to_json(const CavityFlow& flow) {
  return {{"cells", flow.cells},
          {"steady", flow.run.steady},
          {"steps", flow.run.steps},
          {"time", flow.run.time},
          {"time_step", flow.run.time_step},
          {"change", flow.run.change},
          {"seconds", flow.run.seconds},
          {"u_minimum", to_json(flow.u_minimum())},
          {"v_maximum", to_json(flow.v_maximum())},
          {"v_minimum", to_json(flow.v_minimum())},
          {"u_along_y", to_json(flow.u_along_y)},
          {"v_along_x", to_json(flow.v_along_x)}};
}

nlohmann::ordered_json to_json(const Comparison& line) {
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t p = 0; p < line.published.size(); ++p) {
    nlohmann::ordered_json row = {{line.position, line.published[p].position}, {"published", line.published[p].value}};
    for (const auto& grid : line.grids) row["grids"].push_back(grid[p]);
    if (!line.limit.empty()) row["extrapolated"] = line.limit[p];
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::string table(const std::vector<CavityFlow>& flows, double reynolds_number) {
  std::string text =
      fmt::format(
          "Cube [0, 1]^3, wall y = 1 moving with velocity 1 along x, Reynolds number {:g}. u on (1/2, y, 1/2), v on "
          "(x, 1/2, 1/2).\n\n",
          reynolds_number) +
      extrema_table(flows);
  if (reynolds_number != albensoeder_kuhlmann::reynolds_number) return text;
  const Comparison u = compare(flows, true), v = compare(flows, false);
  text += fmt::format("\nDifferences from {}:\n", albensoeder_kuhlmann::reference) + deviation_table(u, v, flows) +
          profile_table(u, flows) + profile_table(v, flows);
  if (flows.size() > 1) text += "\nh -> 0: extrapolated from the last two grids, errors taken as O(h^2).\n";
  return text;
}

nlohmann::ordered_json to_json(const std::vector<CavityFlow>& flows, double reynolds_number) {
  nlohmann::ordered_json json = {{"reynolds_number", reynolds_number}};
  for (const CavityFlow& flow : flows) json["grids"].push_back(to_json(flow));
  if (reynolds_number == albensoeder_kuhlmann::reynolds_number) {
    json["published"] = {{"reference", albensoeder_kuhlmann::reference},
                         {"u_along_y", to_json(compare(flows, true))},
                         {"v_along_x", to_json(compare(flows, false))}};
  }
  return json;
}

std::string mid_plane(const CavityFlow& flow) {
  const int n = flow.cells, upper = n / 2, lower = (n - 1) / 2;  // the same layer if n is odd
  const auto& u = flow.velocity.x;
  const auto& v = flow.velocity.y;
  std::string text = "x,y,u,v\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double at_u = u(i, j, lower) + u(i, j, upper) + u(i + 1, j, lower) + u(i + 1, j, upper);
      const double at_v = v(i, j, lower) + v(i, j, upper) + v(i, j + 1, lower) + v(i, j + 1, upper);
      text += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}\n", (i + 0.5) / n, (j + 0.5) / n, at_u / 4, at_v / 4);
    }
  return text;
}

}  // namespace cavity
