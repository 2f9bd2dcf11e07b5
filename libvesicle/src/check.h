#pragma once

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

/// Throws std::invalid_argument unless the array has that many rows (one per marker).
template <class Array>
void check_markers(const Array& array, const char* name, Eigen::Index markers) {
  if (array.rows() == markers) return;
  std::ostringstream message;
  message << name << " has " << array.rows() << " rows: must be one per marker, " << markers;
  throw std::invalid_argument(message.str());
}

}  // namespace vesiflow::vesicle
