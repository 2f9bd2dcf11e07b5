// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "fluid/export.h"

namespace vesiflow::fluid {

/// The version of the library that the program runs with, such as "1.2.3". A shared library may be another than the one whose headers
/// the program was compiled with: their version is VESIFLOW_VERSION of vesiflow/version.h.
VESIFLOW_FLUID_EXPORT std::string_view version();

/// What this library was built with: which of OpenMP and CHOLMOD, and for which processors, as -march= names them. For example
/// "OpenMP, x86-64-v3".
VESIFLOW_FLUID_EXPORT std::string_view built_with();

}  // namespace vesiflow::fluid
