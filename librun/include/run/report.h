// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "run/export.h"

namespace vesiflow::run {

/// What a report is to be. See docs/report.md.
struct ReportOptions {
  int most_frames = 200;          ///< snapshots of the membranes that it holds at most, evenly chosen
  std::size_t bytes = 3'000'000;  ///< how large it may be
  bool live = false;              ///< for a server on this machine: the page asks its server for news
};

/// Name of the report in the folder of a run.
inline constexpr const char* report_name = "report.html";

/// The report of the run in `directory`, under way or ended: one page of HTML that needs nothing else. What cannot be read, for
/// whatever reason, is named on the page.
/// \throws FileError when the folder holds no run.
/// \throws std::invalid_argument unless most_frames >= 1 and bytes >= 100000.
VESIFLOW_RUN_EXPORT std::string report_of(const std::filesystem::path& directory, const ReportOptions& options = {});

/// Writes it to `file`, which appears complete or not at all.
/// \throws FileError when the folder holds no run, or the file cannot be written.
/// \throws std::invalid_argument as report_of().
VESIFLOW_RUN_EXPORT void write_report(const std::filesystem::path& directory, const std::filesystem::path& file,
                                      const ReportOptions& options = {});

/// Whether this build has the viewer, without which reports have plots and outlines, and nothing to turn.
VESIFLOW_RUN_EXPORT bool report_has_viewer();

}  // namespace vesiflow::run
