// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/viscosity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "grid/planes.h"
#include "message.h"

namespace vesiflow::fluid {
namespace {

// Cells come before ghosts, which may be copies of them.
[[noreturn]] void refuse(const Field<Cell>& mu) {
  const auto [nx, ny, nz] = mu.extent();
  for (const bool ghosts : {false, true}) {
    for (int k = -1; k <= nz; ++k) {
      for (int j = -1; j <= ny; ++j) {
        for (int i = -1; i <= nx; ++i) {
          const double value = mu(i, j, k);
          const bool ghost = i < 0 || j < 0 || k < 0 || i == nx || j == ny || k == nz;
          if (ghost != ghosts || (std::isfinite(value) && value > 0.0)) continue;
          throw std::invalid_argument(message("viscosity: the value at cell (", i, ", ", j, ", ", k, ") is ", value,
                                              "; it must be finite and > 0",
                                              ghost ? " (this is a ghost: set them with extend_to_ghosts)" : ""));
        }
      }
    }
  }
  throw std::invalid_argument("viscosity: the field changed while it was checked");
}

}  // namespace

Viscosity::Viscosity(std::shared_ptr<const Field<Cell>> field) : field_(std::move(field)) {
  if (!field_) throw std::invalid_argument("viscosity: the field is a null pointer");
}

Viscosity::Range Viscosity::checked_range() const {
  if (is_constant()) {
    if (!std::isfinite(value_) || value_ <= 0.0) {
      throw std::invalid_argument(message("viscosity is ", value_, "; it must be finite and > 0"));
    }
    return {value_, value_};
  }
  const auto n = field_->extent();
  const std::array<int, 3> stored{n[0] + 2, n[1] + 2, n[2] + 2};
  // Both as largest values, infinite for what is not a viscosity.
  const auto largest = [&](auto&& key) {
    return max_over_planes(stored, [&](int k) {
      const double* mu = field_->data() + k * field_->stride(2);
      double value = -std::numeric_limits<double>::infinity();
      for (std::ptrdiff_t i = 0; i < field_->stride(2); ++i) {
        const bool sound = mu[i] > 0.0 && mu[i] <= std::numeric_limits<double>::max();
        value = std::max(value, sound ? key(mu[i]) : std::numeric_limits<double>::infinity());
      }
      return value;
    });
  };
  const double max = largest([](double mu) { return mu; });
  if (std::isinf(max)) refuse(*field_);
  return {-largest([](double mu) { return -mu; }), max};
}

void extend_to_ghosts(Field<Cell>& field) {
  const auto n = field.extent();
  const auto& periodic = field.grid().periodic;
  // The cell whose value belongs at index -1 (side 0) or n (side 1).
  const auto source = [&](int axis, int side) {
    const bool first = (side == 0) != periodic[axis];
    return first ? 0 : n[axis] - 1;
  };
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      double* row = field.row(j, k);
      row[-1] = row[source(0, 0)];
      row[n[0]] = row[source(0, 1)];
    }
    std::copy_n(field.row(source(1, 0), k) - 1, n[0] + 2, field.row(-1, k) - 1);
    std::copy_n(field.row(source(1, 1), k) - 1, n[0] + 2, field.row(n[1], k) - 1);
  }
  const auto plane = static_cast<std::size_t>(field.stride(2));
  std::copy_n(field.row(-1, source(2, 0)) - 1, plane, field.row(-1, -1) - 1);
  std::copy_n(field.row(-1, source(2, 1)) - 1, plane, field.row(-1, n[2]) - 1);
}

std::shared_ptr<Field<Cell>> sample_viscosity(const Grid& grid,
                                              const std::function<double(const Vector3& position)>& function) {
  auto field = std::make_shared<Field<Cell>>(grid);
  for (int k = 0; k < grid.cells[2]; ++k) {
    for (int j = 0; j < grid.cells[1]; ++j) {
      for (int i = 0; i < grid.cells[0]; ++i) (*field)(i, j, k) = function(field->position(i, j, k));
    }
  }
  extend_to_ghosts(*field);
  return field;
}

}  // namespace vesiflow::fluid
