// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vesiflow::run {

/// diagnostics.csv with what a page has room for: rows of all vesicles at times that are evenly chosen.
struct DiagnosticsRows {
  std::size_t stored_times = 0, times = 0;
  std::string text;                         ///< header and rows as they are in the file
  std::vector<std::string> columns;         ///< names
  std::vector<std::vector<double>> values;  ///< of each column, row by row; NaN where there is none

  /// Of a column; null where there is none of that name.
  const std::vector<double>* column(const std::string& name) const;
};

/// Rows that have not as many cells as the header are left out.
DiagnosticsRows diagnostics_rows(const std::string& text, std::size_t most_bytes);

}  // namespace vesiflow::run
