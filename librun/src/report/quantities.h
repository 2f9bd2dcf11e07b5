// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace vesiflow::run {

/// How a number of docs/results.md is called on a page. What is not in these lists goes by its own name.
struct Quantity {
  std::string_view name;   ///< in summary.json or diagnostics.csv
  std::string_view label;  ///< for people
  std::string_view unit;   ///< empty for pure numbers
  std::string_view group;  ///< of plots; of errors a sentence that says what it is
};

/// Of a vesicle: columns of diagnostics.csv, in the order of the plots.
std::span<const Quantity> vesicle_quantities();
/// `largest_errors` of summary.json.
std::span<const Quantity> error_quantities();

/// That of this name, or one that is called by its name.
Quantity quantity_of(std::span<const Quantity> all, std::string_view name);

}  // namespace vesiflow::run
