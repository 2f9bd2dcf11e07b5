// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vesiflow::run {

/// The files of a run (docs/results.md) as far as they can be read, whether it is under way, has ended or was killed.
struct StoredRun {
  using Json = nlohmann::ordered_json;

  std::filesystem::path folder;
  Json summary = Json::object();  ///< summary.json, an empty object where that cannot be read
  std::string diagnostics;        ///< whole lines of diagnostics.csv
  std::string scene;              ///< scene.toml
  std::string plan;               ///< of that scene, as this program makes it; empty where it cannot
  std::map<long, std::filesystem::path> membranes, fluid;  ///< snapshots by step
  std::vector<std::string> missing;                        ///< what could not be read and why, a sentence each

  /// A key of the scene as summary.json has it; null where it is not known.
  Json parameter(const std::string& key) const;
  /// The number at that place of the summary; NaN where there is none.
  double number(const std::string& key) const;
  /// The text at that place; empty where there is none.
  std::string text(const std::string& key) const;
};

/// \throws FileError when the folder holds no run.
StoredRun read_stored_run(const std::filesystem::path& folder);

}  // namespace vesiflow::run
