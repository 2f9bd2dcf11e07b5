#include "vesicle/spherical_harmonics.h"

#include <algorithm>
#include <array>
#include <complex>
#include <stdexcept>
#include <vector>

#include "check.h"
#include "legendre_tables.h"
#include "longitude_transform.h"

namespace vesiflow::vesicle {
namespace {

using Complex = std::complex<double>;

const double* reals(const Complex* data) {
  return reinterpret_cast<const double*>(data);
}

/// (i m)^derivative.
Complex longitude_derivative(int m, int derivative) {
  if (derivative == 1) return {0, double(m)};
  return derivative == 0 ? 1 : -double(m) * m;
}

/// Without the recovery of infinities that std::complex's product makes.
Complex product(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Mode m of f + i g for real f and g with modes a = F_m and b = G_m; and its mode -m.
Complex paired(Complex a, Complex b) {
  return {a.real() - b.imag(), a.imag() + b.real()};
}
Complex paired_negative(Complex a, Complex b) {
  return {a.real() + b.imag(), b.real() - a.imag()};
}

}  // namespace

class SphericalHarmonics::Implementation {
 public:
  Implementation(int degrees, const SphereGrid& grid, int max_fields)
      : degrees_(degrees), grid_(grid), longitude_transform_(grid.latitudes(), grid.longitudes()) {
    check_argument(degrees >= 1, "degrees", degrees, ">= 1");
    check_argument(max_fields >= 1, "max_fields", max_fields, ">= 1");
    reserve(max_fields);
  }

  int degrees() const { return degrees_; }
  const SphereGrid& grid() const { return grid_; }

  void analysis(const Input& values, Coefficients& coefficients) {
    if (degrees_ > grid_.latitudes()) throw std::logic_error("analysis needs at least as many latitudes as degrees");
    check_markers(values, "field", grid_.size());
    const int fields = static_cast<int>(values.cols());
    reserve(fields);
    if (analysis_.empty()) analysis_ = analysis_table(degrees_, grid_.latitudes());
    coefficients.resize(degrees_, fields);
    for (int field = 0; field < fields; ++field) longitude_transform_.forward(values.col(field).data(), field);
    for (int m = 0; m < degrees_; ++m) {
      fold_hemispheres(m, fields);
      for (int parity : {0, 1}) integrate_latitudes(m, parity, coefficients);
    }
  }

  /// Values of d^derivative/dphi^derivative of the expansion with the Legendre functions of that kind.
  void evaluate(const Coefficients& coefficients, LegendreKind kind, int derivative, Output& values) {
    check_markers(values, "field", grid_.size());
    const int fields = coefficients.fields();
    check_argument(values.cols() == fields, "columns of the output", values.cols(), "the number of fields");
    check_argument(coefficients.degrees() >= degrees_, "degrees of the coefficients", coefficients.degrees(),
                   "at least those of the transform");
    reserve(fields);
    LegendreTable& table = synthesis_[static_cast<int>(kind)];
    if (table.empty()) table = synthesis_table(kind, degrees_, grid_.latitudes());
    clear_modes(fields);
    const double south_sign = kind == LegendreKind::first ? -1 : 1;
    for (int m = 0; m < degrees_; ++m) {
      for (int parity : {0, 1})
        table.order[m][parity].multiply(reals(coefficients.block(m, parity)), 2 * fields, 2 * fields,
                                        panels_[parity].data(), padded_rows(longitude_transform_.pairs()));
      unfold_hemispheres(m, derivative, south_sign, fields);
    }
    for (int field = 0; field < fields; ++field) longitude_transform_.backward(field, values.col(field).data());
  }

 private:
  void reserve(int fields) {
    if (fields <= reserved_fields_) return;
    reserved_fields_ = fields;
    longitude_transform_.reserve(fields);
    const int half = longitude_transform_.pairs();
    for (int parity : {0, 1}) {
      folded_[parity].resize(std::size_t(half) * fields);
      panels_[parity].resize(std::size_t(2) * fields * std::max(padded_rows(half), padded_rows(degrees_ / 2 + 1)));
    }
  }

  /// folded_[parity](j, field) = mode m of the ring j plus (even) or minus (odd) that of its southern mirror
  /// image.
  void fold_hemispheres(int m, int fields) {
    const std::ptrdiff_t stride = longitude_transform_.mode_stride();
    const int negative = m == 0 ? 0 : grid_.longitudes() - m;
    for (int field = 0; field < fields; ++field) {
      const Complex* modes = longitude_transform_.modes(field);
      for (int j = 0; j < longitude_transform_.pairs(); ++j, modes += stride) {
        const Complex a = 0.5 * modes[m];
        const Complex b = 0.5 * std::conj(modes[negative]);
        const Complex north = a + b;
        const Complex south{a.imag() - b.imag(), b.real() - a.real()};
        folded_[0][std::size_t(j) * fields + field] = north + south;
        folded_[1][std::size_t(j) * fields + field] = north - south;
      }
    }
  }

  void integrate_latitudes(int m, int parity, Coefficients& coefficients) {
    const int fields = coefficients.fields();
    const int rows = degree_count(degrees_, m, parity);
    const int stride = padded_rows(rows);
    double* sums = panels_[parity].data();
    analysis_.order[m][parity].multiply(reals(folded_[parity].data()), 2 * fields, 2 * fields, sums, stride);
    Complex* block = coefficients.block(m, parity);
    for (int field = 0; field < fields; ++field) {
      const double* real = sums + std::ptrdiff_t(2 * field) * stride;
      const double* imaginary = real + stride;
      for (int row = 0; row < rows; ++row) block[row * fields + field] = {real[row], imaginary[row]};
    }
  }

  /// Orders reach the longitudes' Nyquist mode, so that several orders may share a mode.
  bool folds_orders() const { return degrees_ > grid_.latitudes(); }

  /// Modes that unfold_hemispheres does not set, or adds to.
  void clear_modes(int fields) {
    const int first = folds_orders() ? 0 : degrees_;
    const int last = folds_orders() ? grid_.longitudes() : grid_.longitudes() - degrees_ + 1;
    for (int field = 0; field < fields; ++field) {
      Complex* modes = longitude_transform_.modes(field);
      for (int j = 0; j < longitude_transform_.pairs(); ++j, modes += longitude_transform_.mode_stride())
        std::fill(modes + first, modes + last, Complex{});
    }
  }

  /// Puts orders m and -m of the northern and southern rings into the modes that they equal at the
  /// longitudes.
  void unfold_hemispheres(int m, int derivative, double south_sign, int fields) {
    const int positive = m % grid_.longitudes();
    const int negative = positive == 0 ? 0 : grid_.longitudes() - positive;
    const bool add = folds_orders();
    const Complex factor = longitude_derivative(m, derivative);
    const int half = longitude_transform_.pairs();
    const int stride = padded_rows(half);
    for (int field = 0; field < fields; ++field) {
      const double* even = panels_[0].data() + std::ptrdiff_t(2 * field) * stride;
      const double* odd = panels_[1].data() + std::ptrdiff_t(2 * field) * stride;
      Complex* modes = longitude_transform_.modes(field);
      for (int j = 0; j < half; ++j, modes += longitude_transform_.mode_stride()) {
        const Complex e{even[j], even[j + stride]};
        const Complex o{odd[j], odd[j + stride]};
        const Complex north = product(factor, e + o);
        const Complex south = product(south_sign * factor, e - o);
        modes[positive] = (add ? modes[positive] : Complex{}) + paired(north, south);
        if (m > 0) modes[negative] = (add ? modes[negative] : Complex{}) + paired_negative(north, south);
      }
    }
  }

  int degrees_;
  SphereGrid grid_;
  LongitudeTransform longitude_transform_;
  LegendreTable analysis_;
  std::array<LegendreTable, 3> synthesis_;

  int reserved_fields_ = 0;
  std::array<std::vector<Complex>, 2> folded_;  ///< (northern latitude, field) for each parity
  std::array<std::vector<double>, 2> panels_;   ///< (2 fields, padded rows) for each parity
};

SphericalHarmonics::SphericalHarmonics(int degrees, const SphereGrid& grid, int max_fields)
    : implementation_(std::make_unique<Implementation>(degrees, grid, max_fields)) {}
SphericalHarmonics::~SphericalHarmonics() = default;
SphericalHarmonics::SphericalHarmonics(SphericalHarmonics&&) noexcept = default;
SphericalHarmonics& SphericalHarmonics::operator=(SphericalHarmonics&&) noexcept = default;

int SphericalHarmonics::degrees() const {
  return implementation_->degrees();
}
const SphereGrid& SphericalHarmonics::grid() const {
  return implementation_->grid();
}

void SphericalHarmonics::analysis(const Input& values, Coefficients& coefficients) const {
  implementation_->analysis(values, coefficients);
}

void SphericalHarmonics::synthesis(const Coefficients& coefficients, Output values) const {
  implementation_->evaluate(coefficients, LegendreKind::value, 0, values);
}

void SphericalHarmonics::gradient(const Coefficients& coefficients, Output theta, Output phi) const {
  implementation_->evaluate(coefficients, LegendreKind::first, 0, theta);
  implementation_->evaluate(coefficients, LegendreKind::value, 1, phi);
}

void SphericalHarmonics::second_derivatives(const Coefficients& coefficients, Output theta_theta, Output theta_phi,
                                            Output phi_phi) const {
  implementation_->evaluate(coefficients, LegendreKind::second, 0, theta_theta);
  implementation_->evaluate(coefficients, LegendreKind::first, 1, theta_phi);
  implementation_->evaluate(coefficients, LegendreKind::value, 2, phi_phi);
}

}  // namespace vesiflow::vesicle
