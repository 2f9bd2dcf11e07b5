// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/page_data.h"

namespace vesiflow::run {

// Sections of the page, as HTML that can be read without the viewer.

std::string heading(const StoredRun& run);
/// Numbers at the end, of each vesicle or, of many, their range.
std::string results_section(const StoredRun& run);
/// Estimated errors, warnings, retries.
std::string trust_section(const StoredRun& run);
/// Seconds of each phase.
std::string phases_section(const StoredRun& run);
/// Scene and plan.
std::string scene_section(const StoredRun& run);
/// Command, revision, threads.
std::string repeat_section(const StoredRun& run);
/// What the page holds, how exactly, and what it lacks.
std::string about_section(const ReportContents& contents, bool has_viewer);

}  // namespace vesiflow::run
