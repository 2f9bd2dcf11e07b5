// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vesiflow::vesicle {

/// A vector at one marker, for loops over markers: three numbers that the compiler keeps in registers and vectorises.
struct Triple {
  double x, y, z;

  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator-(const Triple& a) { return {-a.x, -a.y, -a.z}; }
  friend Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline double dot(const Triple& a, const Triple& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Three neighbouring columns of an array as one vector per row.
template <class Value>
class TripleColumns {
 public:
  template <class Array>
  explicit TripleColumns(Array&& array, Eigen::Index first = 0)
      : x_(array.col(first).data()), y_(array.col(first + 1).data()), z_(array.col(first + 2).data()) {}

  Triple operator[](Eigen::Index k) const { return {x_[k], y_[k], z_[k]}; }
  void set(Eigen::Index k, const Triple& t) const {
    x_[k] = t.x;
    y_[k] = t.y;
    z_[k] = t.z;
  }

 private:
  Value *x_, *y_, *z_;
};

using ConstTriples = TripleColumns<const double>;
using Triples = TripleColumns<double>;

}  // namespace vesiflow::vesicle
