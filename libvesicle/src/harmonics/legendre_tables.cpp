// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "harmonics/legendre_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>
#include <utility>

#include "harmonics/gauss_legendre.h"

namespace vesiflow::vesicle {
namespace {

/// Values by degree n and order m, 0 <= m <= n < degrees, in extended precision.
class Triangle {
 public:
  explicit Triangle(int degrees) : data_(std::size_t(degrees) * (degrees + 1) / 2) {}
  long double& operator()(int n, int m) { return data_[std::size_t(n) * (n + 1) / 2 + m]; }
  long double operator()(int n, int m) const { return data_[std::size_t(n) * (n + 1) / 2 + m]; }

  /// Extended to m = -1 by antisymmetry (which is what no Condon-Shortley phase means) and to m > n by zero.
  long double extended(int n, int m) const {
    if (m > n) return 0;
    return m < 0 ? -(*this)(n, 1) : (*this)(n, m);
  }

 private:
  std::vector<long double> data_;
};

/// Functions of one kind at any colatitude. The square roots of the recurrences are taken once.
class Legendre {
 public:
  Legendre(LegendreKind kind, int degrees)
      : kind_(kind), degrees_(degrees), a_(degrees), b_(degrees), up_(degrees), values_(degrees), scratch_(degrees) {
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) {
        const long double nn = static_cast<long double>(n) * n;
        const long double kk = static_cast<long double>(n - 1) * (n - 1);
        const long double mm = static_cast<long double>(m) * m;
        if (m < n) a_(n, m) = std::sqrt((4 * nn - 1) / (nn - mm));
        if (m < n - 1) b_(n, m) = std::sqrt((kk - mm) / (4 * kk - 1));
        up_(n, m) = std::sqrt(static_cast<long double>(n - m) * (n + m + 1)) / 2;
      }
  }

  const Triangle& at(long double theta) {
    fill(std::cos(theta), std::sin(theta));
    for (int order = 0; order < static_cast<int>(kind_); ++order) differentiate();
    return values_;
  }

 private:
  void fill(long double x, long double s) {
    long double diagonal = std::sqrt(1 / (4 * std::numbers::pi_v<long double>));
    for (int n = 0; n < degrees_; ++n) {
      if (n > 0) diagonal *= s * std::sqrt((2 * n + 1) / (2.0L * n));
      for (int m = 0; m < n; ++m)
        values_(n, m) = a_(n, m) * (x * values_(n - 1, m) - (m < n - 1 ? b_(n, m) * values_(n - 2, m) : 0));
      values_(n, n) = diagonal;
    }
  }

  /// The ladder formula, which applies to derivatives as well as to values.
  void differentiate() {
    for (int n = 0; n < degrees_; ++n)
      for (int m = 0; m <= n; ++m) {
        const long double down = n == 0 ? 0 : m == 0 ? up_(n, 0) : up_(n, m - 1);
        scratch_(n, m) = (n == 0 ? 0 : down * values_.extended(n, m - 1)) - up_(n, m) * values_.extended(n, m + 1);
      }
    std::swap(values_, scratch_);
  }

  LegendreKind kind_;
  int degrees_;
  Triangle a_, b_, up_;
  Triangle values_, scratch_;
};

double flushed(long double value) {
  constexpr long double denormal_factor = 1e-150L;
  return std::abs(value) < denormal_factor ? 0.0 : static_cast<double>(value);
}

/// For each order the first latitude, a multiple of four, where some function is not negligible.
std::vector<int> find_first_latitudes(Legendre& legendre, const GaussLegendre& rule, int degrees, int half) {
  constexpr long double negligible = 1e-22L;
  std::vector<int> first(degrees, half);
  for (int j = 0; j < half; ++j) {
    const Triangle& p = legendre.at(rule.colatitude[j]);
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m)
        if (std::abs(p(n, m)) >= negligible) first[m] = std::min(first[m], j);
  }
  for (int& j : first) j = j / 4 * 4;
  return first;
}

}  // namespace

LegendreTable::LegendreTable(LegendreKind kind, LegendreSum sum, int degrees, int latitudes, int longitudes)
    : matrices_(degrees) {
  const GaussLegendre rule = gauss_legendre(latitudes);
  const int half = (latitudes + 1) / 2;
  Legendre legendre(kind, degrees);
  first_latitudes_ = find_first_latitudes(legendre, rule, degrees, half);
  const bool to_latitudes = sum == LegendreSum::over_degrees;
  std::size_t size = 0;
  for (int m = 0; m < degrees; ++m)
    for (int parity : {0, 1}) {
      const int count = degree_count(degrees, m, parity);
      const int first = first_latitudes_[m];
      matrices_[m][parity] = to_latitudes ? PanelMatrix(first, half, count) : PanelMatrix(0, count, half - first);
      size += matrices_[m][parity].size();
    }
  data_ = allocate_aligned<double>(size);
  double* next = data_.get();
  for (auto& parities : matrices_)
    for (PanelMatrix& matrix : parities) {
      matrix.place(next);
      next += matrix.size();
    }
  for (int j = 0; j < half; ++j) {
    const Triangle& p = legendre.at(rule.colatitude[j]);
    const long double weight =
        sum == LegendreSum::quadrature ? rule.weight[j] * 2 * std::numbers::pi_v<long double> / longitudes : 1;
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) {
        if (j < first_latitudes_[m]) continue;
        PanelMatrix& matrix = matrices_[m][(n - m) % 2];
        const int row = (n - m) / 2;
        (to_latitudes ? matrix(j, row) : matrix(row, j - first_latitudes_[m])) = flushed(weight * p(n, m));
      }
  }
}

std::shared_ptr<const LegendreTable> shared_legendre_table(LegendreKind kind, LegendreSum sum, int degrees,
                                                           int latitudes, int longitudes) {
  using Key = std::tuple<LegendreKind, LegendreSum, int, int, int>;
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<const LegendreTable>> tables;
  const std::lock_guard lock(mutex);
  std::erase_if(tables, [](const auto& entry) { return entry.second.expired(); });
  const int key_longitudes = sum == LegendreSum::quadrature ? longitudes : 0;
  std::weak_ptr<const LegendreTable>& entry = tables[{kind, sum, degrees, latitudes, key_longitudes}];
  std::shared_ptr<const LegendreTable> table = entry.lock();
  if (!table) entry = table = std::make_shared<const LegendreTable>(kind, sum, degrees, latitudes, longitudes);
  return table;
}

}  // namespace vesiflow::vesicle
