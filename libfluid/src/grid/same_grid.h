// Public functions that take fields check that these are on one grid: their loops do not look at extents.
#pragma once

#include <stdexcept>
#include <string>

#include "fluid/field.h"

namespace vesiflow::fluid {

inline bool is_on(const Grid& grid, const FaceVector& u) {
  return u.x.grid() == grid && u.y.grid() == grid && u.z.grid() == grid;
}

/// \throws std::invalid_argument "`function`: its fields are on different grids" unless `same`
inline void require_same_grid(const char* function, bool same) {
  if (!same) throw std::invalid_argument(std::string(function) + ": its fields are on different grids");
}

}  // namespace vesiflow::fluid
