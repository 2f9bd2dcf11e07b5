#include "legendre_tables.h"

#include <cmath>
#include <numbers>

#include "gauss_legendre.h"

namespace vesiflow::vesicle {
namespace {

/// Values indexed by degree n and order m, 0 <= m <= n < degrees, at one colatitude.
class Triangle {
 public:
  explicit Triangle(int degrees) : degrees_(degrees), data_(std::size_t(degrees) * degrees) {}
  long double& operator()(int n, int m) { return data_[std::size_t(n) * degrees_ + m]; }

  /// Extended to m = -1 by antisymmetry (which is what no Condon-Shortley phase means) and to m > n by zero.
  long double extended(int n, int m) const {
    if (m > n) return 0;
    return m < 0 ? -data_[std::size_t(n) * degrees_ + 1] : data_[std::size_t(n) * degrees_ + m];
  }

 private:
  int degrees_;
  std::vector<long double> data_;
};

void fill_legendre(long double theta, int degrees, Triangle& p) {
  const long double x = std::cos(theta);
  const long double s = std::sin(theta);
  long double diagonal = std::sqrt(1 / (4 * std::numbers::pi_v<long double>));
  for (int m = 0; m < degrees; ++m) {
    if (m > 0) diagonal *= s * std::sqrt((2 * m + 1) / (2.0L * m));
    p(m, m) = diagonal;
    if (m + 1 < degrees) p(m + 1, m) = std::sqrt(2.0L * m + 3) * x * diagonal;
    for (int n = m + 2; n < degrees; ++n) {
      const long double nn = static_cast<long double>(n) * n;
      const long double kk = static_cast<long double>(n - 1) * (n - 1);
      const long double mm = static_cast<long double>(m) * m;
      const long double a = std::sqrt((4 * nn - 1) / (nn - mm));
      const long double b = std::sqrt((kk - mm) / (4 * kk - 1));
      p(n, m) = a * (x * p(n - 1, m) - b * p(n - 2, m));
    }
  }
}

/// d/dtheta of an expansion table by the ladder formula; applies to derivatives as well as to values.
void differentiate(const Triangle& from, int degrees, Triangle& to) {
  for (int n = 0; n < degrees; ++n)
    for (int m = 0; m <= n; ++m) {
      if (n == 0) {
        to(0, 0) = 0;
        continue;
      }
      const long double down = std::sqrt(static_cast<long double>(n + m) * (n - m + 1));
      const long double up = std::sqrt(static_cast<long double>(n - m) * (n + m + 1));
      to(n, m) = (down * from.extended(n, m - 1) - up * from.extended(n, m + 1)) / 2;
    }
}

/// High orders decay like sin(theta)^m towards the poles. What no coefficient can lift to round-off is stored
/// as zero: it would otherwise breed denormal numbers, which are a hundred times slower.
double flushed(long double value) {
  constexpr long double negligible = 1e-150L;
  return std::abs(value) < negligible ? 0.0 : static_cast<double>(value);
}

/// Calls store(j, n, m, value) for all northern latitudes j.
template <class Store>
void for_each_entry(LegendreKind kind, int degrees, int latitudes, const GaussLegendre& rule, Store store) {
  Triangle values(degrees), derivatives(degrees);
  for (int j = 0; j < (latitudes + 1) / 2; ++j) {
    fill_legendre(rule.colatitude[j], degrees, values);
    for (int order = 0; order < static_cast<int>(kind); ++order) {
      differentiate(values, degrees, derivatives);
      std::swap(values, derivatives);
    }
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) store(j, n, m, values(n, m));
  }
}

}  // namespace

LegendreTable synthesis_table(LegendreKind kind, int degrees, int latitudes) {
  LegendreTable table;
  for (int m = 0; m < degrees; ++m) {
    auto& parities = table.order.emplace_back();
    for (int parity : {0, 1}) parities[parity] = PanelMatrix((latitudes + 1) / 2, degree_count(degrees, m, parity));
  }
  for_each_entry(kind, degrees, latitudes, gauss_legendre(latitudes), [&](int j, int n, int m, long double value) {
    table.order[m][(n - m) % 2](j, (n - m) / 2) = flushed(value);
  });
  return table;
}

LegendreTable analysis_table(int degrees, int latitudes) {
  LegendreTable table;
  for (int m = 0; m < degrees; ++m) {
    auto& parities = table.order.emplace_back();
    for (int parity : {0, 1}) parities[parity] = PanelMatrix(degree_count(degrees, m, parity), (latitudes + 1) / 2);
  }
  const GaussLegendre rule = gauss_legendre(latitudes);
  const long double spacing = std::numbers::pi_v<long double> / latitudes;
  for_each_entry(LegendreKind::value, degrees, latitudes, rule, [&](int j, int n, int m, long double value) {
    const long double fold = 2 * j + 1 == latitudes ? 0.5L : 1.0L;
    table.order[m][(n - m) % 2]((n - m) / 2, j) = flushed(fold * rule.weight[j] * spacing * value);
  });
  return table;
}

}  // namespace vesiflow::vesicle
