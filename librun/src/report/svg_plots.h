// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/diagnostics_rows.h"
#include "report/membrane_course.h"

namespace vesiflow::run {

/// The most telling numbers against time, for pages without the viewer; empty without rows.
std::string svg_plots(const DiagnosticsRows& rows);

/// Cuts through the membranes by the plane of constant y through the middle of each, at the first, a middle and the last frame; empty
/// without frames.
std::string svg_outlines(const MembraneCourse& course);

}  // namespace vesiflow::run
