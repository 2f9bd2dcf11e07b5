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
  double low = -std::numeric_limits<double>::infinity();  ///< lower end
  double high = std::numeric_limits<double>::infinity();  ///< upper end
  bool low_open = false;                                  ///< whether the lower end is left out
  bool high_open = false;                                 ///< whether the upper end is left out

  bool contains(double value) const;  ///< whether a value is in the range, and finite

  /// In words: "> 0", "in (0, 1]" ...
  std::string describe() const;  ///< "> 0", "in (0, 1]" ...

  static Range any() { return {}; }                                   ///< all finite numbers
  static Range positive() { return {.low = 0.0, .low_open = true}; }  ///< numbers > 0
  static Range from(double low) { return {.low = low}; }              ///< numbers >= low

  /// Numbers from low to high, both included.
  static Range between(double low, double high) { return {.low = low, .high = high}; }
};

/// What can be done with each parameter: check it, read it, write it, list it. The functions visit() below are the one
/// place where names, types and ranges of parameters are written down.
class VESIFLOW_COUPLING_EXPORT ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;
  /// A number.
  virtual void number(std::string_view name, double& value, const Range& range) = 0;
  /// A number that may be missing.
  virtual void optional_number(std::string_view name, std::optional<double>& value, const Range& range) = 0;
  /// An integer.
  virtual void integer(std::string_view name, int& value, const Range& range) = 0;
  /// An integer that may be missing.
  virtual void optional_integer(std::string_view name, std::optional<int>& value, const Range& range) = 0;
  /// Three numbers, one for each axis.
  virtual void vector(std::string_view name, std::array<double, 3>& value, const Range& range) = 0;
  /// Three numbers that may be missing.
  virtual void optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value,
                               const Range& range) = 0;
  /// True or false.
  virtual void boolean(std::string_view name, bool& value) = 0;
  /// True or false for each axis.
  virtual void booleans(std::string_view name, std::array<bool, 3>& value) = 0;
  /// Three integers, one for each axis.
  virtual void cells(std::string_view name, std::array<int, 3>& value, const Range& range) = 0;
  /// A list of [degree, order, amplitude].
  virtual void harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) = 0;
  /// One of several names; `value` is an index into `names`.
  virtual void choice(std::string_view name, int& value, std::span<const std::string_view> names) = 0;
};

/// Finds what is not in its range.
class VESIFLOW_COUPLING_EXPORT RangeCheck final : public ParameterVisitor {
 public:
  /// `prefix` goes before all names: "vesicles.0.", or nothing.
  explicit RangeCheck(std::string prefix = "") : prefix_(std::move(prefix)) {}

  /// Sentences that name parameter, value and what is allowed.
  const std::vector<std::string>& mistakes() const { return mistakes_; }

  /// Checks that it is in its range.
  void number(std::string_view name, double& value, const Range& range) override;
  /// Checks that it is in its range, or missing.
  void optional_number(std::string_view name, std::optional<double>& value, const Range& range) override;
  /// Checks that it is in its range.
  void integer(std::string_view name, int& value, const Range& range) override;
  /// Checks that it is in its range, or missing.
  void optional_integer(std::string_view name, std::optional<int>& value, const Range& range) override;
  /// Checks that each number is in the range.
  void vector(std::string_view name, std::array<double, 3>& value, const Range& range) override;
  /// Checks that each number is in the range, or that they are missing.
  void optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value, const Range& range) override;
  /// Nothing to check.
  void boolean(std::string_view, bool&) override {}
  /// Nothing to check.
  void booleans(std::string_view, std::array<bool, 3>&) override {}
  /// Checks that each integer is in the range.
  void cells(std::string_view name, std::array<int, 3>& value, const Range& range) override;
  /// Checks degrees, orders and amplitudes.
  void harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) override;
  /// Checks that the index is that of a name.
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
/// The same for names in braces.
template <class Enum>
void visit_choice(ParameterVisitor& visitor, std::string_view name, Enum& value,
                  std::initializer_list<std::string_view> names) {
  visit_choice(visitor, name, value, std::span(names.begin(), names.size()));
}

/// Shows the parameters of `domain` under their full names: "domain.lower" ...
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Domain& domain, ParameterVisitor& visitor);
/// Shows the parameters of `fluid` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Fluid& fluid, ParameterVisitor& visitor);
/// Shows the parameters of `coupling` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Coupling& coupling, ParameterVisitor& visitor);
/// Shows the parameters of `membrane` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Membrane& membrane, ParameterVisitor& visitor);
/// Shows the parameters of `mesh` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Mesh& mesh, ParameterVisitor& visitor);
/// Shows the parameters of `gravity` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Gravity& gravity, ParameterVisitor& visitor);
/// Shows the parameters of `repulsion` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Repulsion& repulsion, ParameterVisitor& visitor);
/// Shows the parameters of `time` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Time& time, ParameterVisitor& visitor);
/// Shows the parameters of `limits` under their full names.
VESIFLOW_COUPLING_EXPORT void visit(SimulationParameters::Limits& limits, ParameterVisitor& visitor);
/// Shows the parameters of one vesicle, without the leading `vesicles.N.`; VesicleParameters::surface is not among
/// them.
VESIFLOW_COUPLING_EXPORT void visit(VesicleParameters& vesicle, ParameterVisitor& visitor);

}  // namespace vesiflow::coupling
