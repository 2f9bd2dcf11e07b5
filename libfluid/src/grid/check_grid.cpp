// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "grid/check_grid.h"

#include <stdexcept>
#include <string>

#include "message.h"

namespace vesiflow::fluid {
namespace {

std::string described(const Grid& grid) {
  const auto& [lower, upper, cells, periodic, mirror] = grid;
  std::string text = message(cells[0], " x ", cells[1], " x ", cells[2], " cells from (", lower[0], ", ", lower[1],
                             ", ", lower[2], ") to (", upper[0], ", ", upper[1], ", ", upper[2], ")");
  for (int axis = 0; axis < 3; ++axis) {
    if (periodic[axis]) text += message(", axis ", axis, " periodic");
    if (mirror[axis]) text += message(", axis ", axis, " with a mirror");
  }
  return text;
}

}  // namespace

void check_grid(const char* function, const char* argument, const Grid& found, const Grid& wanted) {
  if (found == wanted) return;
  throw std::invalid_argument(
      message(function, ": ", argument, " is on another grid: ", described(found), "; must be ", described(wanted)));
}

}  // namespace vesiflow::fluid
