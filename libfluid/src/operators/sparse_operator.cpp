// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "operators/sparse_operator.h"

#include <algorithm>
#include <utility>

namespace vesiflow::fluid {
namespace {

using Index = std::array<int, 3>;

// factor * x[unknown].
struct Term {
  std::int64_t unknown;
  double factor;
};

// A difference quotient of the unknowns, or the sum of two, and its weight in the energy.
struct Strain {
  double weight;
  std::array<Term, 4> terms{};
  int count = 0;

  void add(const Term& term, double factor) {
    if (term.factor == 0.0) return;
    for (int t = 0; t < count; ++t) {
      if (terms[t].unknown == term.unknown) {
        terms[t].factor += term.factor * factor;
        return;
      }
    }
    terms[count++] = {term.unknown, term.factor * factor};
  }
};

class Assembly {
 public:
  explicit Assembly(const EllipticProblem& problem) : problem_(problem), grid_(problem.grid) {
    for (int block = 0; block < problem.blocks(); ++block) {
      extent_[block] = problem.extent(block);
      starts_[block + 1] = starts_[block] + static_cast<std::int64_t>(problem.unknowns(block));
    }
    for (int block = problem.blocks(); block < 3; ++block) starts_[block + 1] = starts_[block];
  }
  const std::array<std::int64_t, 4>& starts() const { return starts_; }

  // visit(const Strain&) for every term of the energy but alpha's.
  template <class Visit>
  void for_each_strain(Visit&& visit) const {
    const bool stress = problem_.form == EllipticForm::stress;
    for (int block = 0; block < problem_.blocks(); ++block) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!stress) differences(block, axis, 1.0, visit);
      }
      if (stress) differences(block, block, 2.0, visit);
    }
    if (!stress) return;
    for (int c = 0; c < 3; ++c) shears(c, (c + 1) % 3, visit);
  }

 private:
  // Differences along an axis between neighbouring points of a block: those with an end beyond a wall count half, as
  // half of the difference lies outside. (Across a mirror they are zero, and so are shears on it.)
  template <class Visit>
  void differences(int block, int axis, double weight, Visit&& visit) const {
    const Centring centring = problem_.centring(block);
    const bool normal = is_face_normal(centring, axis);
    Index begin{};
    Index end{};
    std::array<bool, 3> between{};  // the point midway lies between cells along this axis
    for (int a = 0; a < 3; ++a) {
      begin[a] = first_unknown(grid_, centring, a);
      end[a] = begin[a] + extent_[block][a];
      between[a] = is_face_normal(centring, a);
    }
    begin[axis] = 0;
    end[axis] = normal ? grid_.cells[axis] : lines_between_cells(axis);
    between[axis] = !normal;
    const double per_h = 1.0 / grid_.spacing(axis);
    for_each_index(begin, end, [&](const Index& at) {
      // In cell `at` from its lower to its upper face; or else from the point below to the one at `at`.
      Index upper = at;
      Index lower = at;
      if (normal) {
        ++upper[axis];
      } else {
        --lower[axis];
      }
      Strain strain{weight * (normal || !on_wall(axis, at[axis]) ? 1.0 : 0.5) * mean_viscosity(at, between)};
      strain.add(value(block, upper), per_h);
      strain.add(value(block, lower), -per_h);
      visit(strain);
    });
  }

  // du_c/dx_d + du_d/dx_c at the edges where faces normal to c and to d meet.
  template <class Visit>
  void shears(int c, int d, Visit&& visit) const {
    Index end = grid_.cells;
    std::array<bool, 3> between{};
    for (const int axis : {c, d}) {
      end[axis] = lines_between_cells(axis);
      between[axis] = true;
    }
    for_each_index({0, 0, 0}, end, [&](const Index& at) {
      const bool wall = on_wall(c, at[c]) || on_wall(d, at[d]);
      Strain strain{(wall ? 0.5 : 1.0) * mean_viscosity(at, between)};
      for (const auto& [component, axis] : {std::pair(c, d), std::pair(d, c)}) {
        Index below = at;
        --below[axis];
        strain.add(value(component, at), 1.0 / grid_.spacing(axis));
        strain.add(value(component, below), -1.0 / grid_.spacing(axis));
      }
      visit(strain);
    });
  }

  // x at a point of a block, on and beyond walls and mirrors too.
  Term value(int block, Index point) const {
    double factor = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const int n = grid_.cells[axis];
      int& p = point[axis];
      if (grid_.periodic[axis]) {
        p = (p + n) % n;
      } else if (is_face_normal(problem_.centring(block), axis)) {
        if (p <= 0 || p >= n) return {0, 0.0};
        --p;
      } else if (p < 0 || p >= n) {
        const int side = p < 0 ? 0 : 1;
        p = side == 0 ? 0 : n - 1;
        factor *= problem_.condition(block, axis, side) == BoundaryCondition::dirichlet ? -1.0 : 1.0;
      }
    }
    const Index& n = extent_[block];
    return {starts_[block] + (static_cast<std::int64_t>(point[2]) * n[1] + point[1]) * n[0] + point[0], factor};
  }

  // Mean over the cell `at`, and those below it along the axes along which the place is between cells.
  double mean_viscosity(const Index& at, const std::array<bool, 3>& between) const {
    if (problem_.mu.is_constant()) return problem_.mu.value();
    const Field<Cell>& mu = problem_.mu.field();
    double sum = 0.0;
    int count = 0;
    for (int k = at[2] - between[2]; k <= at[2]; ++k) {
      for (int j = at[1] - between[1]; j <= at[1]; ++j) {
        for (int i = at[0] - between[0]; i <= at[0]; ++i, ++count) sum += mu(i, j, k);
      }
    }
    return sum / count;
  }

  int lines_between_cells(int axis) const { return grid_.cells[axis] + (grid_.periodic[axis] ? 0 : 1); }
  bool on_wall(int axis, int line) const { return !grid_.periodic[axis] && (line == 0 || line == grid_.cells[axis]); }

  template <class Visit>
  static void for_each_index(const Index& begin, const Index& end, Visit&& visit) {
    for (int k = begin[2]; k < end[2]; ++k) {
      for (int j = begin[1]; j < end[1]; ++j) {
        for (int i = begin[0]; i < end[0]; ++i) visit(Index{i, j, k});
      }
    }
  }

  const EllipticProblem& problem_;
  const Grid& grid_;
  std::array<Index, 3> extent_{};
  std::array<std::int64_t, 4> starts_{};
};

}  // namespace

SparseOperator::SparseOperator(const EllipticProblem& problem) {
  const Assembly assembly(problem);
  block_starts_ = assembly.starts();
  const std::int64_t n = block_starts_[3];
  std::vector<std::int64_t> entries;  // column * n + row
  for (std::int64_t m = 0; m < n; ++m) entries.push_back(m * n + m);
  assembly.for_each_strain([&](const Strain& strain) {
    for (int s = 0; s < strain.count; ++s) {
      for (int t = 0; t < s; ++t) {
        const auto [column, row] = std::minmax(strain.terms[s].unknown, strain.terms[t].unknown);
        entries.push_back(column * n + row);
      }
    }
  });
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  column_starts_.assign(static_cast<std::size_t>(n) + 1, 0);
  rows_.reserve(entries.size());
  for (const std::int64_t entry : entries) {
    ++column_starts_[entry / n + 1];
    rows_.push_back(entry % n);
  }
  for (std::int64_t m = 0; m < n; ++m) column_starts_[m + 1] += column_starts_[m];
  update(problem);
}

void SparseOperator::update(const EllipticProblem& problem) {
  values_.assign(rows_.size(), 0.0);
  for (std::int64_t m = 0; m < size(); ++m) values_[column_starts_[m]] = problem.alpha;
  Assembly(problem).for_each_strain([&](const Strain& strain) {
    for (int s = 0; s < strain.count; ++s) {
      for (int t = 0; t <= s; ++t) {
        const auto [column, row] = std::minmax(strain.terms[s].unknown, strain.terms[t].unknown);
        add(row, column, strain.weight * strain.terms[s].factor * strain.terms[t].factor);
      }
    }
  });
  if (!problem.has_nullspace()) return;
  for (int block = 0; block < problem.blocks(); ++block) {
    const std::int64_t grounded = block_starts_[block + 1] - 1;
    for (std::int64_t m = 0; m <= grounded; ++m) {
      const auto begin = rows_.begin() + column_starts_[m];
      const auto end = rows_.begin() + column_starts_[m + 1];
      const auto found = std::lower_bound(begin, end, grounded);
      if (m < grounded && found != end && *found == grounded) values_[found - rows_.begin()] = 0.0;
    }
    std::fill(values_.begin() + column_starts_[grounded] + 1, values_.begin() + column_starts_[grounded + 1], 0.0);
  }
}

void SparseOperator::add(std::int64_t row, std::int64_t column, double value) {
  std::int64_t entry = column_starts_[column];
  while (rows_[entry] != row) ++entry;
  values_[entry] += value;
}

}  // namespace vesiflow::fluid
