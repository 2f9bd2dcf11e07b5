// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

#include "vesicle/diagnostics.h"

namespace vesiflow::run {

/// The numbers reported of a vesicle, in the order of docs/results.md: the one list from which summary.json and
/// diagnostics.csv are written. Vectors come as `length` numbers; a value that does not exist is NaN.
void visit_record(const vesicle::Diagnostics& d,
                  const std::function<void(std::string_view name, const double* values, int length)>& visit);

}  // namespace vesiflow::run
