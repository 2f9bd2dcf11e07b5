// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/stored_run.h"

#include <fmt/format.h>

#include <limits>
#include <system_error>

#include "files/file_error.h"
#include "files/snapshot_series.h"
#include "files/text_of.h"
#include "plan/scene_plan.h"
#include "run/scene.h"

namespace vesiflow::run {
namespace {

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

// Why a file of results is not there, as its interval says.
std::string why(const StoredRun& run, const std::string& key) {
  const StoredRun::Json every = run.parameter(key);
  if (every.is_number() && every.get<double>() == 0.0) return fmt::format("{} = 0 in the scene", key);
  return run.text("status") == "running" ? "nothing is written yet" : "it is not in the folder";
}

void read_summary(StoredRun& run) {
  const std::filesystem::path file = run.folder / "summary.json";
  StoredRun::Json read = StoredRun::Json::parse(text_of(file), nullptr, /*allow_exceptions=*/false);
  if (read.is_object())
    run.summary = std::move(read);
  else
    run.missing.push_back(
        fmt::format("summary.json: {}.", is_there(file) ? "it is damaged" : "it is not in the folder"));
}

void read_diagnostics(StoredRun& run) {
  run.diagnostics = text_of(run.folder / "diagnostics.csv");
  run.diagnostics.resize(run.diagnostics.rfind('\n') + 1);  // a row may be being written
  if (run.diagnostics.empty())
    run.missing.push_back(fmt::format("Numbers against time: {}.", why(run, "output.diagnostics_every")));
}

// A scene with a flow of a program's own, or with a file of a shape that is no longer there, has none.
std::string plan_of(const StoredRun& run) {
  if (run.scene.empty()) return "";
  const double threads = run.number("threads");
  try {
    return describe_scene_plan(load_scene(run.folder / "scene.toml"),
                               threads >= 1.0 && threads < 1e6 ? static_cast<int>(threads) : 1);
  } catch (const std::exception&) {
    return "";
  }
}

void find_snapshots(StoredRun& run) {
  try {
    run.membranes = stored_snapshots(run.folder, "vesicle");
    run.fluid = stored_snapshots(run.folder, "fluid");
  } catch (const std::filesystem::filesystem_error& failure) {
    run.missing.push_back(fmt::format("Snapshots: {}.", file_error(failure).what()));
    return;
  }
  if (run.membranes.empty()) run.missing.push_back(fmt::format("Membranes: {}.", why(run, "output.vesicle_every")));
  if (run.fluid.empty()) run.missing.push_back(fmt::format("Fluid: {}.", why(run, "output.fluid_every")));
}

}  // namespace

StoredRun::Json StoredRun::parameter(const std::string& key) const {
  const auto parameters = summary.find("parameters");
  if (parameters == summary.end() || !parameters->is_object() || !parameters->contains(key)) return nullptr;
  return (*parameters)[key];
}

double StoredRun::number(const std::string& key) const {
  const auto found = summary.find(key);
  return found != summary.end() && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string StoredRun::text(const std::string& key) const {
  const auto found = summary.find(key);
  return found != summary.end() && found->is_string() ? found->get<std::string>() : "";
}

StoredRun read_stored_run(const std::filesystem::path& folder) {
  bool found = false;
  for (const char* name : {"summary.json", "diagnostics.csv", snapshots_folder})
    found = found || is_there(folder / name);
  if (!found)
    throw FileError(fmt::format("{}: holds no run: neither summary.json nor diagnostics.csv nor {} is there",
                                folder.string(), snapshots_folder));
  StoredRun run;
  run.folder = folder;
  read_summary(run);
  read_diagnostics(run);
  run.scene = text_of(folder / "scene.toml");
  if (run.scene.empty()) run.missing.push_back("scene.toml: it is not in the folder.");
  run.plan = plan_of(run);
  find_snapshots(run);
  return run;
}

}  // namespace vesiflow::run
