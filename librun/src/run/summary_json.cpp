// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <omp.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "build_info.h"
#include "files/atomic_file.h"
#include "run/results.h"
#include "run/vesicle_record.h"
#include "scene/scene_keys.h"
#include "vesiflow/version.h"

namespace vesiflow::run {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* summary_name = "summary.json";

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// A scene value as TOML writes it is JSON as well.
Json parameters_of(const Scene& scene) {
  Json all = Json::object();
  for (const auto& [key, value] : scene_values(scene)) all[key] = Json::parse(value);
  return all;
}

Json vesicle_of(const vesicle::Diagnostics& diagnostics, long redistributions,
                const coupling::MarkerStatistics& markers) {
  Json entry;
  visit_record(diagnostics, [&](std::string_view name, const double* values, int length) {
    if (length == 1) {
      entry[std::string(name)] = finite_or_null(values[0]);
    } else {
      for (int i = 0; i < length; ++i) entry[std::string(name)].push_back(finite_or_null(values[i]));
    }
  });
  entry["redistributions"] = redistributions;
  entry["marker_sub_steps"] = markers.sub_steps;
  entry["marker_rejected_sub_steps"] = markers.rejected;
  entry["marker_evaluations"] = markers.evaluations;
  return entry;
}

// `value` of each account.
template <class Value>
Json phases_of(const coupling::Phases& phases, const RunRecord& record, Value&& value) {
  Json all;
  const auto add = [&](const char* name, const fluid::PhaseAccount& account) { all[name] = value(account); };
  visit_phases(phases, add);
  add("output_table", record.output_table);
  add("output_vesicle", record.output_vesicle);
  add("output_fluid", record.output_fluid);
  add("output_checkpoint", record.output_checkpoint);
  return all;
}

// A state that has blown up may not be measurable any more.
Json vesicles_of(SceneSimulation& simulation, RunQuality& quality) {
  Json list = Json::array();
  try {
    const std::vector<double> distances = simulation.nearest_distances();
    const std::vector<vesicle::Diagnostics> all = simulation.measure();
    quality.observe(simulation, all, distances);
    for (const auto& diagnostics : all)
      list.push_back(
          vesicle_of(diagnostics, simulation.redistributions(list.size()), simulation.marker_statistics(list.size())));
    for (std::size_t i = 0; distances.size() > 1 && i < distances.size(); ++i)
      list[i]["min_distance"] = finite_or_null(distances[i]);
  } catch (const std::exception&) {
    list.clear();
    for (std::size_t i = 0; i < simulation.vesicle_count(); ++i) list.push_back(nullptr);
  }
  return list;
}

Json retries_of(const std::vector<RunRecord::Retry>& retries) {
  Json list = Json::array();
  for (const auto& retry : retries)
    list.push_back({{"step", retry.step},
                    {"time", retry.time},
                    {"cause", retry.cause},
                    {"from_step", retry.from_step},
                    {"time_step", retry.time_step}});
  return list;
}

Json errors_of(const RunQuality::Errors& errors) {
  return {{"area", finite_or_null(errors.greatest[RunQuality::area])},
          {"volume", finite_or_null(errors.greatest[RunQuality::volume])},
          {"local_area", finite_or_null(errors.greatest[RunQuality::local_area])},
          {"surface_divergence", finite_or_null(errors.greatest[RunQuality::surface_divergence])},
          {"spectrum_tail", finite_or_null(errors.greatest[RunQuality::spectrum_tail])},
          {"unresolved_bending", finite_or_null(errors.greatest[RunQuality::unresolved_bending])},
          {"velocity_noise", finite_or_null(errors.greatest[RunQuality::velocity_noise])},
          {"courant_number", finite_or_null(errors.greatest[RunQuality::courant_number])},
          {"membrane_gap", finite_or_null(errors.membrane_gap)},
          {"wall_gap", finite_or_null(errors.wall_gap)},
          {"divergence", finite_or_null(errors.divergence)}};
}

// Solves for the velocities of sharp membranes between two viscosities.
Json interface_passes_of(const SceneSimulation& simulation, const RunRecord& record) {
  if (!simulation.scene().has_scaled_velocity()) return nullptr;
  return {{"last_step", simulation.interface_passes()},
          {"per_step", record.steps_taken > 0 ? Json(static_cast<double>(record.interface_passes) /
                                                     static_cast<double>(record.steps_taken))
                                              : Json(nullptr)}};
}

Json numbers_of(const RunQuality::SceneNumbers& numbers) {
  return {{"g", numbers.tension_number},
          {"stable_g", finite_or_null(numbers.stable_tension_number)},
          {"convection_step_ratio", numbers.convection_step_ratio},
          {"grid_error", numbers.grid_error ? Json(*numbers.grid_error) : Json(nullptr)}};
}

}  // namespace

void write_summary(const std::filesystem::path& directory, const RunOptions& options, SceneSimulation& simulation,
                   RunRecord& record) {
  Json summary;
  summary["format"] = 1;
  summary["status"] = record.status;
  summary["stop_reason"] = record.stop_reason ? Json(*record.stop_reason) : Json(nullptr);
  summary["program"] = options.program;
  summary["version"] = VESIFLOW_VERSION;
  summary["git_revision"] = VESIFLOW_GIT_REVISION;
  summary["scene"] = options.scene_file;
  const coupling::Start* start = simulation.started_from();
  summary["started_from"] =
      start ? Json{{"run", start->run}, {"time", start->time}, {"steps", start->steps}} : Json(nullptr);
  summary["parameters"] = parameters_of(simulation.scene());
  summary["threads"] = omp_get_max_threads();
  summary["steps"] = simulation.steps();
  summary["time"] = simulation.time();
  summary["time_step"] = simulation.time_step();
  summary["rejected_steps"] = simulation.rejected_steps();
  summary["start_parts"] = simulation.start_parts();
  summary["interface_passes"] = interface_passes_of(simulation, record);
  summary["wall_seconds"] = record.wall.seconds;
  summary["seconds_per_step"] =
      record.steps_taken > 0 ? Json(record.wall.seconds / static_cast<double>(record.steps_taken)) : Json(nullptr);
  summary["retries"] = retries_of(record.retries);
  summary["vesicles"] = vesicles_of(simulation, record.quality);
  summary["largest_errors"] = errors_of(record.quality.errors());
  summary["scene_numbers"] = numbers_of(record.quality.scene_numbers());
  summary["warnings"] = record.quality.warnings();
  summary["max_divergence"] = finite_or_null(simulation.max_divergence());
  const coupling::Phases phases = simulation.phases();
  summary["phase_seconds"] = phases_of(phases, record, [](const auto& account) { return account.seconds; });
  summary["phase_entries"] = phases_of(phases, record, [](const auto& account) { return account.entries; });
  write_text_atomically(directory / summary_name, summary.dump(2) + "\n");
}

bool is_completed(const std::filesystem::path& directory, long steps) {
  std::ifstream stream(directory / summary_name);
  const Json summary = Json::parse(stream, nullptr, /*allow_exceptions=*/false);
  const auto says = [&](const char* key, const Json& value) {
    return summary.is_object() && summary.contains(key) && summary[key] == value;
  };
  return says("status", "completed") && says("steps", steps);
}

}  // namespace vesiflow::run
