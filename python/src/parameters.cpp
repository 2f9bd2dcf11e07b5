// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "parameters.h"

#include <pybind11/stl.h>

#include <set>

#include "coupling/mistakes.h"
#include "coupling/parameter_table.h"

namespace vesiflow::python {
namespace {

namespace py = pybind11;
using coupling::Range;

template <class Visit>
void visit_all(coupling::SimulationParameters& parameters, const Visit& visit) {
  visit("", parameters.domain);
  visit("", parameters.fluid);
  visit("", parameters.coupling);
  visit("", parameters.membrane);
  visit("", parameters.mesh);
  visit("", parameters.gravity);
  visit("", parameters.repulsion);
  visit("", parameters.time);
  visit("", parameters.limits);
  for (std::size_t i = 0; i < parameters.vesicles.size(); ++i)
    visit("vesicles." + std::to_string(i) + ".", parameters.vesicles[i]);
}

class Reader final : public coupling::ParameterVisitor {
 public:
  Reader(const py::dict& values, coupling::Mistakes& mistakes, std::set<std::string>& known)
      : values_(values), mistakes_(mistakes), known_(known) {}
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }

  void number(std::string_view name, double& value, const Range&) override { read(name, value, "a number"); }
  void optional_number(std::string_view name, std::optional<double>& value, const Range&) override {
    read(name, value, "a number");
  }
  void integer(std::string_view name, int& value, const Range&) override { read(name, value, "an integer"); }
  void optional_integer(std::string_view name, std::optional<int>& value, const Range&) override {
    read(name, value, "an integer");
  }
  void vector(std::string_view name, std::array<double, 3>& value, const Range&) override {
    read(name, value, "three numbers");
  }
  void optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value, const Range&) override {
    read(name, value, "three numbers");
  }
  void boolean(std::string_view name, bool& value) override { read(name, value, "True or False"); }
  void booleans(std::string_view name, std::array<bool, 3>& value) override {
    read(name, value, "three of True and False");
  }
  void cells(std::string_view name, std::array<int, 3>& value, const Range&) override {
    const py::object given = find(name);
    if (given && py::isinstance<py::int_>(given))
      value.fill(given.cast<int>());
    else
      read(name, value, "an integer or three of them");
  }
  void harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) override {
    std::vector<std::tuple<int, int, double>> terms;
    if (!read(name, terms, "a list of (degree, order, amplitude)")) return;
    value.clear();
    for (const auto& [degree, order, amplitude] : terms) value.push_back({degree, order, amplitude});
  }
  void choice(std::string_view name, int& value, std::span<const std::string_view> names) override {
    std::string allowed, given;
    for (const std::string_view one : names) allowed += (allowed.empty() ? "" : ", ") + std::string(one);
    if (!read(name, given, "one of " + allowed)) return;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == given) {
        value = static_cast<int>(i);
        return;
      }
    refuse(name, "one of " + allowed);
  }

 private:
  std::string full(std::string_view name) const { return prefix_ + std::string(name); }

  py::object find(std::string_view name) {
    const std::string key = full(name);
    known_.insert(key);
    return values_.contains(key) ? py::object(values_[key.c_str()]) : py::object();
  }

  void refuse(std::string_view name, const std::string& allowed) {
    mistakes_.add(full(name) + " = " + py::repr(values_[full(name).c_str()]).cast<std::string>() + ": must be " +
                  allowed);
  }

  // Whether there is one.
  template <class Value>
  bool read(std::string_view name, Value& value, const std::string& allowed) {
    const py::object given = find(name);
    if (!given) return false;
    try {
      value = given.cast<Value>();
      return true;
    } catch (const py::cast_error&) {
      refuse(name, allowed);
      return false;
    }
  }

  const py::dict& values_;
  coupling::Mistakes& mistakes_;
  std::set<std::string>& known_;
  std::string prefix_;
};

class Writer final : public coupling::ParameterVisitor {
 public:
  explicit Writer(py::dict& values) : values_(values) {}
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }

  void number(std::string_view name, double& value, const Range&) override { set(name, value); }
  void optional_number(std::string_view name, std::optional<double>& value, const Range&) override {
    set_if(name, value);
  }
  void integer(std::string_view name, int& value, const Range&) override { set(name, value); }
  void optional_integer(std::string_view name, std::optional<int>& value, const Range&) override {
    set_if(name, value);
  }
  void vector(std::string_view name, std::array<double, 3>& value, const Range&) override { set(name, value); }
  void optional_vector(std::string_view name, std::optional<std::array<double, 3>>& value, const Range&) override {
    set_if(name, value);
  }
  void boolean(std::string_view name, bool& value) override { set(name, value); }
  void booleans(std::string_view name, std::array<bool, 3>& value) override { set(name, value); }
  void cells(std::string_view name, std::array<int, 3>& value, const Range&) override { set(name, value); }
  void harmonics(std::string_view name, std::vector<vesicle::Harmonic>& value) override {
    py::list terms;
    for (const vesicle::Harmonic& term : value) terms.append(py::make_tuple(term.degree, term.order, term.amplitude));
    set(name, terms);
  }
  void choice(std::string_view name, int& value, std::span<const std::string_view> names) override {
    set(name, std::string(names[static_cast<std::size_t>(value)]));
  }

 private:
  template <class Value>
  void set(std::string_view name, const Value& value) {
    values_[(prefix_ + std::string(name)).c_str()] = value;
  }
  template <class Value>
  void set_if(std::string_view name, const std::optional<Value>& value) {
    if (value) set(name, *value);
  }

  py::dict& values_;
  std::string prefix_;
};

constexpr std::string_view of_vesicles = "vesicles.";

std::size_t number_of_vesicles(const py::dict& values) {
  std::size_t count = 0;
  for (const auto& [key, value] : values) {
    const std::string name = key.cast<std::string>();
    if (name.starts_with(of_vesicles))
      count = std::max(count, std::size_t{1} + std::stoul(name.substr(of_vesicles.size())));
  }
  return count;
}

}  // namespace

coupling::SimulationParameters parameters_of(const py::dict& values) {
  coupling::SimulationParameters parameters;
  parameters.vesicles.resize(number_of_vesicles(values));
  coupling::Mistakes mistakes;
  std::set<std::string> known;
  Reader reader(values, mistakes, known);
  visit_all(parameters, [&reader](const std::string& prefix, auto& table) {
    reader.set_prefix(prefix);
    coupling::visit(table, reader);
  });
  for (const auto& [key, value] : values)
    if (const std::string name = key.cast<std::string>(); !known.contains(name))
      mistakes.add(name + ": there is no such parameter");
  mistakes.refuse();
  return parameters;
}

py::dict dict_of(const coupling::SimulationParameters& parameters) {
  coupling::SimulationParameters visited = parameters;
  py::dict values;
  Writer writer(values);
  visit_all(visited, [&writer](const std::string& prefix, auto& table) {
    writer.set_prefix(prefix);
    coupling::visit(table, writer);
  });
  return values;
}

}  // namespace vesiflow::python
