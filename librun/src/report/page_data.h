// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "report/diagnostics_rows.h"
#include "report/fluid_planes.h"
#include "report/membrane_course.h"
#include "report/packed_membranes.h"
#include "report/stored_run.h"

namespace vesiflow::run {

/// All that a report is made of.
struct ReportContents {
  StoredRun run;
  DiagnosticsRows diagnostics;
  MembraneCourse course;
  PackedMembranes membranes;
  FluidPlanes fluid;
};

/// What the viewer reads, viewer/src/data.js: box, frames, planes, rows, and how numbers are called.
nlohmann::ordered_json page_data(const ReportContents& contents, bool live);

}  // namespace vesiflow::run
