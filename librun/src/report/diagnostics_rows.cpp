// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/diagnostics_rows.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <span>
#include <string_view>

#include "report/thinning.h"

namespace vesiflow::run {
namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

double number_of(std::string_view cell) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

}  // namespace

const std::vector<double>* DiagnosticsRows::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name);
  return found == columns.end() ? nullptr : &values[static_cast<std::size_t>(found - columns.begin())];
}

DiagnosticsRows diagnostics_rows(const std::string& text, std::size_t most_bytes) {
  DiagnosticsRows rows;
  const std::vector<std::string_view> lines = split(text, '\n');
  for (const std::string_view name : split(lines.front(), ',')) rows.columns.emplace_back(name);
  if (lines.front().empty()) rows.columns.clear();
  rows.values.resize(rows.columns.size());
  std::vector<std::vector<std::string_view>> times;  // the rows of a step
  std::string_view step;
  for (const std::string_view line : std::span(lines).subspan(1)) {
    if (static_cast<std::size_t>(std::ranges::count(line, ',')) + 1 != rows.columns.size() || line.empty()) continue;
    const std::string_view of_row = line.substr(0, line.find(','));
    if (times.empty() || of_row != step) times.emplace_back();
    step = of_row;
    times.back().push_back(line);
  }
  rows.stored_times = times.size();
  const std::size_t of_time = times.empty() ? 1 : std::max<std::size_t>(1, text.size() / times.size());
  const std::vector<std::size_t> kept = evenly_chosen(times.size(), std::max<std::size_t>(2, most_bytes / of_time));
  rows.times = kept.size();
  rows.text = std::string(lines.front()) + '\n';
  for (const std::size_t t : kept)
    for (const std::string_view line : times[t]) {
      rows.text.append(line) += '\n';
      const std::vector<std::string_view> cells = split(line, ',');
      for (std::size_t c = 0; c < cells.size(); ++c) rows.values[c].push_back(number_of(cells[c]));
    }
  return rows;
}

}  // namespace vesiflow::run
