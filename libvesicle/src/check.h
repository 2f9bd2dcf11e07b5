// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

namespace vesiflow::vesicle {

/// Throws std::invalid_argument "name = value: must be range" unless ok.
template <class Value>
void check_argument(bool ok, const char* name, const Value& value, const char* range) {
  if (ok) return;
  std::ostringstream message;
  message << name << " = " << value << ": must be " << range;
  throw std::invalid_argument(message.str());
}

/// Throws std::invalid_argument unless a penalty's stiffness is finite and >= 0, and what it holds to is finite and > 0.
inline void check_penalty(double stiffness, const char* name, double target) {
  check_argument(std::isfinite(stiffness) && stiffness >= 0, "stiffness", stiffness, "finite and >= 0");
  check_argument(std::isfinite(target) && target > 0, name, target, "finite and > 0");
}

/// Throws std::invalid_argument unless the array has that many rows (one per marker).
template <class Array>
void check_markers(const Array& array, const char* name, Eigen::Index markers) {
  if (array.rows() == markers) return;
  std::ostringstream message;
  message << name << " has " << array.rows() << " rows: must be one per marker, " << markers;
  throw std::invalid_argument(message.str());
}

/// Throws std::invalid_argument unless the array has that many rows and columns.
template <class Array>
void check_shape(const Array& array, const char* name, Eigen::Index rows, Eigen::Index columns) {
  if (array.rows() == rows && array.cols() == columns) return;
  std::ostringstream message;
  message << name << " has " << array.rows() << " rows and " << array.cols() << " columns: must be " << rows << " and "
          << columns;
  throw std::invalid_argument(message.str());
}

/// Throws std::domain_error that names the first marker with a value that is not finite. `value` with its article: "a velocity".
template <class Array>
void check_finite(const Array& array, const char* value) {
  if ((0 * array).sum() == 0) return;  // 0 x is NaN for an x that is not finite, and no sum of zeros overflows
  Eigen::Index marker = 0;
  while (array.row(marker).isFinite().all()) ++marker;
  throw std::domain_error("marker " + std::to_string(marker) + " of " + std::to_string(array.rows()) + " has " + value +
                          " that is not finite");
}

/// Throws std::invalid_argument unless all areas, of which there is at least one, are finite and > 0.
template <class Array>
void check_areas(const Array& areas, const char* name) {
  const double smallest = areas.template minCoeff<Eigen::PropagateNaN>();
  check_argument(smallest > 0, name, smallest, "finite and > 0");
  const double largest = areas.maxCoeff();
  check_argument(std::isfinite(largest), name, largest, "finite and > 0");
}

}  // namespace vesiflow::vesicle
