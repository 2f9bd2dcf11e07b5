// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupling/export.h"
#include "coupling/simulation_parameters.h"

namespace vesiflow::coupling {

/// Allowed numbers, ends included or not.
struct VESIFLOW_COUPLING_EXPORT Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  bool contains(double value) const;  ///< and finite
  std::string describe() const;       ///< "> 0", "in (0, 1]" ...

  static Range any() { return {}; }
  static Range positive() { return {.low = 0.0, .low_open = true}; }
  static Range from(double low) { return {.low = low}; }
  static Range between(double low, double high) { return {.low = low, .high = high}; }
};

/// What can be done with each parameter: check it, read it, write it, list it. The functions visit() below are the one place where
/// names, types and ranges of parameters are written down.
class VESIFLOW_COUPLING_EXPORT ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;
  virtual void number(std::string_view name, double& value, const Range& range) = 0;
  virtual void optional_number(std::string_view name, std::optional<double>& value, const Range& range) = 0;
  virtual void integer(std::string_view name, int& value, const Range& range) = 0;
  virtual void optional_integer(std::string_view name, std::optional<int>& value, const Range& range) = 0;
  virtual void vector(std::string_view name, std::array<double, 3>& value, const Range& range) = 0;
  virtual void optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value,
                               const Range& range) = 0;
  virtual void boolean(std::string_view name, bool& value) = 0;
  /// One for each axis.
  virtual void booleans(std::string_view name, std::array<bool, 3>& value) = 0;
  virtual void cells(std::string_view name, std::array<int, 3>& value, const Range& range) = 0;
  /// A list of [degree, order, amplitude].
  virtual void harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) = 0;
  /// `value` is an index into `names`.
  virtual void choice(std::string_view name, int& value, std::span<const std::string_view> names) = 0;
};

/// Finds what is not in its range.
class VESIFLOW_COUPLING_EXPORT RangeCheck final : public ParameterVisitor {
 public:
  /// `prefix` goes before all names: "vesicles.0.", or nothing.
  explicit RangeCheck(std::string prefix = "") : prefix_(std::move(prefix)) {}

  /// Sentences that name parameter, value and what is allowed.
  const std::vector<std::string>& mistakes() const { return mistakes_; }

  void number(std::string_view name, double& value, const Range& range) override;
  void optional_number(std::string_view name, std::optional<double>& value, const Range& range) override;
  void integer(std::string_view name, int& value, const Range& range) override;
  void optional_integer(std::string_view name, std::optional<int>& value, const Range& range) override;
  void vector(std::string_view name, std::array<double, 3>& value, const Range& range) override;
  void optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value, const Range& range) override;
  void boolean(std::string_view, bool&) override {}
  void booleans(std::string_view, std::array<bool, 3>&) override {}
  void cells(std::string_view name, std::array<int, 3>& value, const Range& range) override;
  void harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) override;
  void choice(std::string_view name, int& value, std::span<const std::string_view> names) override;

 private:
  void refuse(std::string_view name, const std::string& value, const std::string& allowed);

  std::string prefix_;
  std::vector<std::string> mistakes_;
};

/// Shows an enumeration to a visitor as the index of its name.
template <class Enum>
void visit_choice(ParameterVisitor& visitor, std::string_view name, Enum& value,
                  std::span<const std::string_view> names) {
  int index = static_cast<int>(value);
  visitor.choice(name, index, names);
  value = static_cast<Enum>(index);
}
template <class Enum>
void visit_choice(ParameterVisitor& visitor, std::string_view name, Enum& value,
                  std::initializer_list<std::string_view> names) {
  visit_choice(visitor, name, value, std::span(names.begin(), names.size()));
}

// The parameters of each group, under their full names: "domain.lower" ...
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Domain& domain, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Fluid& fluid, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Coupling& coupling, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Membrane& membrane, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Mesh& mesh, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Gravity& gravity, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Repulsion& repulsion, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Time& time, ParameterVisitor& visitor);
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Limits& limits, ParameterVisitor& visitor);
/// Of one vesicle, without the leading `vesicles.N.`; VesicleParameters::surface is not among them.
VESIFLOW_COUPLING_EXPORT void visit(VesicleParameters& vesicle, ParameterVisitor& visitor);

}  // namespace vesiflow::coupling
