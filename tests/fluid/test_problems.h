// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Elliptic problems of every kind, and vectors of unknowns for them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <ostream>
#include <utility>
#include <vector>

#include "fluid/elliptic_problem.h"
#include "test_fields.h"

namespace vesiflow::fluid::test {

inline std::array<bool, 3> axes_of(int mask) {
  return {(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0};
}

// Masks of the axes that are periodic and that have a mirror.
struct Topology {
  int periodic = 0;
  int mirror = 0;
};

inline std::ostream& operator<<(std::ostream& out, const Topology& topology) {
  return out << "periodic axes " << topology.periodic << ", mirrors " << topology.mirror;
}

inline Grid with_topology(const Grid& grid, const Topology& topology) {
  return {
      grid.lower, grid.upper, grid.cells, {.periodic = axes_of(topology.periodic), .mirror = axes_of(topology.mirror)}};
}

inline Grid with_periodic_axes(const Grid& grid, int mask) {
  return with_topology(grid, {.periodic = mask});
}

// Every axis between walls, periodic, or with a mirror.
inline std::vector<Topology> all_topologies() {
  std::vector<Topology> topologies;
  for (int periodic = 0; periodic < 8; ++periodic) {
    for (int mirror = 0; mirror < 8; ++mirror) {
      if ((periodic & mirror) == 0) topologies.push_back({periodic, mirror});
    }
  }
  return topologies;
}

// What the unknowns are and what is applied to them.
struct Kind {
  const char* name;
  EllipticProblem (*problem)(const Grid& grid, double alpha, const Viscosity& mu);
};

inline void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

inline const std::array<Kind, 7> all_kinds{{
    {"cell_neumann",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, alpha, mu);
     }},
    {"cell_dirichlet",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem(grid, Centring::cell, BoundaryCondition::dirichlet, alpha, mu);
     }},
    {"face_x",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem(grid, Centring::face_x, BoundaryCondition::dirichlet, alpha, mu);
     }},
    {"face_y",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem(grid, Centring::face_y, BoundaryCondition::dirichlet, alpha, mu);
     }},
    {"face_z",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem(grid, Centring::face_z, BoundaryCondition::dirichlet, alpha, mu);
     }},
    {"velocity_laplacian",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem::velocity(grid, EllipticForm::laplacian, alpha, mu);
     }},
    {"velocity_stress",
     [](const Grid& grid, double alpha, const Viscosity& mu) {
       return EllipticProblem::velocity(grid, EllipticForm::stress, alpha, mu);
     }},
}};

// Between 1 and `ratio`, smooth, periodic, and different along every axis.
inline std::shared_ptr<Field<Cell>> wavy_viscosity(const Grid& grid, double ratio, double phase = 0.3) {
  return sample_viscosity(grid, [&](const Vector3& r) {
    double sum = phase;
    for (int axis = 0; axis < 3; ++axis) {
      sum += (axis + 1) * std::sin(2.0 * std::numbers::pi * (r[axis] - grid.lower[axis]) / grid.length(axis) + phase);
    }
    return std::pow(ratio, 0.5 * (1.0 + std::sin(sum)));
  });
}

// A smooth sphere of radius 1 and viscosity `ratio` in a fluid of viscosity 1.
inline std::shared_ptr<Field<Cell>> sphere_viscosity(const Grid& grid, double ratio, double cells_of_interface) {
  return sample_viscosity(grid, [&](const Vector3& r) {
    const double radius = std::hypot(r[0], r[1], r[2]);
    return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh((radius - 1.0) / (cells_of_interface * grid.spacing(0))));
  });
}

// A vector of unknowns, with padding between rows and planes that must survive. Zero, or random in [-1, 1).
class Numbers {
 public:
  explicit Numbers(const EllipticProblem& problem, unsigned seed = 0) : count_(problem.blocks()) {
    for (int block = 0; block < count_; ++block) {
      const auto n = problem.extent(block);
      const std::ptrdiff_t row = n[0] + 3;
      const std::ptrdiff_t plane = row * (n[1] + 2);
      storage_[block].assign(static_cast<std::size_t>(plane * n[2]), filling);
      views_[block] = {storage_[block].data(), n, row, plane};
      if (seed > 0) fill_random(views_[block], seed + block);
      if (seed == 0) for_each_point(n, [&](int i, int j, int k) { views_[block](i, j, k) = 0.0; });
    }
  }
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;

  Blocks blocks() const { return count_ == 1 ? Blocks(views_[0]) : Blocks(views_); }
  operator Blocks() const { return blocks(); }
  operator ConstBlocks() const { return blocks(); }
  const View& block(int b) const { return views_[b]; }

  bool padding_is_intact() const {
    std::size_t untouched = 0;
    std::size_t expected = 0;
    for (int b = 0; b < count_; ++b) {
      const auto& n = views_[b].extent;
      expected += storage_[b].size() - static_cast<std::size_t>(n[0]) * n[1] * n[2];
      untouched += static_cast<std::size_t>(std::count(storage_[b].begin(), storage_[b].end(), filling));
    }
    return untouched == expected;
  }
  bool same_bits(const Numbers& other) const {
    for (int b = 0; b < count_; ++b) {
      if (std::memcmp(storage_[b].data(), other.storage_[b].data(), storage_[b].size() * sizeof(double)) != 0) {
        return false;
      }
    }
    return true;
  }
  double dot(const Numbers& other) const {
    double sum = 0.0;
    for (int b = 0; b < count_; ++b) sum += test::dot(views_[b], other.views_[b]);
    return sum;
  }
  double norm() const { return std::sqrt(dot(*this)); }
  double max_difference(const Numbers& other) const {
    double largest = 0.0;
    for (int b = 0; b < count_; ++b) largest = std::max(largest, test::max_difference(views_[b], other.views_[b]));
    return largest;
  }
  double mean(int b) const {
    const auto& n = views_[b].extent;
    double sum = 0.0;
    for_each_point(n, [&](int i, int j, int k) { sum += views_[b](i, j, k); });
    return sum / (static_cast<double>(n[0]) * n[1] * n[2]);
  }
  void add_to_block(int b, double value) {
    for_each_point(views_[b].extent, [&](int i, int j, int k) { views_[b](i, j, k) += value; });
  }
  void subtract_means() {
    for (int b = 0; b < count_; ++b) add_to_block(b, -mean(b));
  }

 private:
  static constexpr double filling = 99.0;
  int count_;
  std::array<std::vector<double>, 3> storage_;
  std::array<View, 3> views_{};
};

}  // namespace vesiflow::fluid::test
