// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/spherical_harmonics.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

#include "check.h"
#include "harmonics/harmonic_stages.h"

namespace vesiflow::vesicle {
namespace {

/// What the field is called in the arguments of the transforms.
const char* argument_name(Derivative derivative) {
  constexpr std::array names{"values", "theta", "phi", "theta_theta", "theta_phi", "phi_phi"};
  return names[static_cast<std::size_t>(derivative)];
}

/// Fields by kind, as the stages share the sums of neighbours of one kind.
template <class Value>
class FieldList {
 public:
  void add(Derivative derivative, Value* values, std::ptrdiff_t stride) {
    NodalFields<Value>& slot = slots_[slot_of(derivative)];
    if (slot.values) throw std::invalid_argument("a derivative is asked for twice");
    slot.values = values;
    slot.stride = stride;
  }

  /// Those that were added.
  std::span<const NodalFields<Value>> fields() {
    return {slots_.begin(), std::remove_if(slots_.begin(), slots_.end(), [](const auto& f) { return !f.values; })};
  }

 private:
  static std::size_t slot_of(Derivative derivative) {
    switch (derivative) {
      case Derivative::value:
        return 0;
      case Derivative::phi:
        return 1;
      case Derivative::phi_phi:
        return 2;
      case Derivative::theta:
        return 3;
      case Derivative::theta_phi:
        return 4;
      case Derivative::theta_theta:
        break;
    }
    return 5;
  }

  std::array<NodalFields<Value>, 6> slots_{{{LegendreKind::value, 0, nullptr, 0},
                                            {LegendreKind::value, 1, nullptr, 0},
                                            {LegendreKind::value, 2, nullptr, 0},
                                            {LegendreKind::first, 0, nullptr, 0},
                                            {LegendreKind::first, 1, nullptr, 0},
                                            {LegendreKind::second, 0, nullptr, 0}}};
};

}  // namespace

class SphericalHarmonics::Implementation {
 public:
  Implementation(int degrees, const SphereGrid& grid, int max_fields)
      : degrees_(checked_degrees(degrees)),
        grid_(grid),
        stages_(degrees, grid),
        analysis_weight_(grid.weight() * grid.longitude_spacing()) {
    check_argument(max_fields >= 1, "max_fields", max_fields, ">= 1");
    stages_.reserve(max_fields, 1);
  }

  int degrees() const { return degrees_; }
  const SphereGrid& grid() const { return grid_; }

  void prepare(const Uses& uses, int fields) {
    check_argument(fields >= 1, "fields", fields, ">= 1");
    const bool gradient = uses.gradient || uses.derivatives;
    stages_.reserve(fields, uses.derivatives ? 3 : 1);
    const auto require = [&](LegendreSum sum) {
      stages_.require(LegendreKind::value, sum);
      if (gradient) stages_.require(LegendreKind::first, sum);
      if (uses.derivatives) stages_.require(LegendreKind::second, sum);
    };
    if (uses.synthesis || gradient || (uses.analysis && uses.adjoints)) require(LegendreSum::over_degrees);
    if (uses.analysis) stages_.require(LegendreKind::value, LegendreSum::quadrature);
    if (uses.adjoints && (uses.synthesis || gradient)) require(LegendreSum::over_latitudes);
  }

  void check_analysis() const {
    if (degrees_ > grid_.latitudes()) throw std::logic_error("analysis needs at least as many latitudes as degrees");
  }

  void analysis(const Input& values, Coefficients& coefficients) {
    check_analysis();
    project({{Derivative::value, values}}, LegendreSum::quadrature, coefficients);
  }

  void analysis_adjoint(const Coefficients& coefficients, Output& values) {
    check_analysis();
    evaluate(coefficients, std::array{Request{Derivative::value, values}});
    for (int j = 0; j < grid_.latitudes(); ++j)
      values.middleRows(grid_.index(0, j), grid_.longitudes()) *= analysis_weight_[j];
  }

  void evaluate(const Coefficients& coefficients, std::span<const Request> requests) {
    check_argument(coefficients.degrees() >= degrees_, "degrees of the coefficients", coefficients.degrees(),
                   "at least those of the transform");
    FieldList<double> results;
    for (const Request& request : requests) {
      Output values = request.values;
      check_shape(values, argument_name(request.derivative), grid_.size(), coefficients.fields());
      results.add(request.derivative, values.data(), values.outerStride());
    }
    stages_.evaluate(coefficients, results.fields());
  }

  struct Given {
    Derivative derivative;
    const Input& values;
  };

  void project_adjoint(std::initializer_list<Given> given, Coefficients& coefficients) {
    project(given, LegendreSum::over_latitudes, coefficients);
  }

 private:
  static int checked_degrees(int degrees) {
    check_argument(degrees >= 1, "degrees", degrees, ">= 1");
    return degrees;
  }

  void project(std::initializer_list<Given> given, LegendreSum sum, Coefficients& coefficients) {
    FieldList<const double> fields;
    const Eigen::Index columns = given.begin()->values.cols();
    for (const Given& g : given) {
      check_shape(g.values, argument_name(g.derivative), grid_.size(), columns);
      fields.add(g.derivative, g.values.data(), g.values.outerStride());
    }
    coefficients.resize(degrees_, static_cast<int>(columns));
    stages_.project(fields.fields(), sum, coefficients);
  }

  int degrees_;
  SphereGrid grid_;
  HarmonicStages stages_;
  ScalarField analysis_weight_;
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

void SphericalHarmonics::prepare(const Uses& uses, int fields) {
  implementation_->prepare(uses, fields);
}

void SphericalHarmonics::analysis(const Input& values, Coefficients& coefficients) const {
  implementation_->analysis(values, coefficients);
}

void SphericalHarmonics::synthesis(const Coefficients& coefficients, Output values) const {
  evaluate(coefficients, {{Derivative::value, values}});
}

void SphericalHarmonics::gradient(const Coefficients& coefficients, Output theta, Output phi) const {
  evaluate(coefficients, {{Derivative::theta, theta}, {Derivative::phi, phi}});
}

void SphericalHarmonics::second_derivatives(const Coefficients& coefficients, Output theta_theta, Output theta_phi,
                                            Output phi_phi) const {
  evaluate(
      coefficients,
      {{Derivative::theta_theta, theta_theta}, {Derivative::theta_phi, theta_phi}, {Derivative::phi_phi, phi_phi}});
}

void SphericalHarmonics::derivatives(const Coefficients& coefficients, Output theta, Output phi, Output theta_theta,
                                     Output theta_phi, Output phi_phi) const {
  evaluate(coefficients, {{Derivative::theta, theta},
                          {Derivative::phi, phi},
                          {Derivative::theta_theta, theta_theta},
                          {Derivative::theta_phi, theta_phi},
                          {Derivative::phi_phi, phi_phi}});
}

void SphericalHarmonics::evaluate(const Coefficients& coefficients, std::initializer_list<Request> requests) const {
  implementation_->evaluate(coefficients, requests);
}

void SphericalHarmonics::analysis_adjoint(const Coefficients& coefficients, Output values) const {
  implementation_->analysis_adjoint(coefficients, values);
}

void SphericalHarmonics::synthesis_adjoint(const Input& values, Coefficients& coefficients) const {
  implementation_->project_adjoint({{Derivative::value, values}}, coefficients);
}

void SphericalHarmonics::gradient_adjoint(const Input& theta, const Input& phi, Coefficients& coefficients) const {
  implementation_->project_adjoint({{Derivative::theta, theta}, {Derivative::phi, phi}}, coefficients);
}

void SphericalHarmonics::second_derivatives_adjoint(const Input& theta_theta, const Input& theta_phi,
                                                    const Input& phi_phi, Coefficients& coefficients) const {
  implementation_->project_adjoint(
      {{Derivative::theta_theta, theta_theta}, {Derivative::theta_phi, theta_phi}, {Derivative::phi_phi, phi_phi}},
      coefficients);
}

}  // namespace vesiflow::vesicle
