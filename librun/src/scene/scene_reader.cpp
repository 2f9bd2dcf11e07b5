// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace vesiflow::run {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

constexpr const char* harmonics_form =
    "must be a list of [degree, order, amplitude], such as [[2, 0, 0.1], [3, -2, 0.05]]";

// The number that is all of the text, whatever the decimal sign of the host program's locale; not a number if there is none.
double number_in(std::string_view text) {
  constexpr std::string_view blank = " \t";
  text.remove_prefix(std::min(text.find_first_not_of(blank), text.size()));
  text.remove_suffix(text.size() - 1 - text.find_last_not_of(blank));  // of blanks alone nothing: npos + 1 is 0
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = nan_value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : nan_value;
}

// Numbers may be written as fractions in quotes, "1/192", which TOML itself cannot say.
double to_number(const toml::node& node) {
  if (node.is_floating_point()) return node.as_floating_point()->get();
  if (node.is_integer()) return static_cast<double>(node.as_integer()->get());
  if (!node.is_string()) return nan_value;
  const std::string_view text = node.as_string()->get();
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return nan_value;
  return number_in(text.substr(0, slash)) / number_in(text.substr(slash + 1));
}

// Of a value that is infinite or no number, ranges without an end do not say what is wrong.
std::string must_be(double value, const coupling::Range& range) {
  const bool has_end = std::isfinite(range.low) && std::isfinite(range.high);
  const bool says_so = has_end || !(std::isfinite(range.low) || std::isfinite(range.high));
  return fmt::format("must be {}{}", std::isfinite(value) || says_so ? "" : "finite and ", range.describe());
}

bool is_three(const toml::node& node) {
  return node.is_array() && node.as_array()->size() == 3;
}

// A part that was refused leaves nothing.
template <class Value>
void set(std::optional<Value> checked, auto& value) {
  if (checked) value = *checked;
}

}  // namespace

SceneReader::Given SceneReader::find(std::string_view key) const {
  Given given{prefix_ + std::string(key), nullptr};
  given.node = document_.find(given.key);
  return given;
}

void SceneReader::text(std::string_view key, std::string& value) {
  const Given given = find(key);
  if (given.node == nullptr) return;
  if (given.node->is_string())
    value = given.node->as_string()->get();
  else
    refuse(given, "must be text in quotes");
}

void SceneReader::optional_text(std::string_view key, std::optional<std::string>& value) {
  if (find(key).node != nullptr) text(key, value.emplace());
}

void SceneReader::number(std::string_view key, double& value, const coupling::Range& range) {
  if (const Given given = find(key); given.node != nullptr) set(checked(given, *given.node, range), value);
}

void SceneReader::optional_number(std::string_view key, std::optional<double>& value, const coupling::Range& range) {
  if (const Given given = find(key); given.node != nullptr) set(checked(given, *given.node, range), value);
}

void SceneReader::integer(std::string_view key, int& value, const coupling::Range& range) {
  if (const Given given = find(key); given.node != nullptr) set(checked_integer(given, *given.node, range), value);
}

void SceneReader::optional_integer(std::string_view key, std::optional<int>& value, const coupling::Range& range) {
  if (const Given given = find(key); given.node != nullptr) set(checked_integer(given, *given.node, range), value);
}

void SceneReader::vector(std::string_view key, std::array<double, 3>& value, const coupling::Range& range) {
  if (const Given given = find(key); given.node != nullptr) set(checked_vector(given, range), value);
}

void SceneReader::optional_vector(std::string_view key, std::optional<std::array<double, 3>>& value,
                                  const coupling::Range& range) {
  if (const Given given = find(key); given.node != nullptr) set(checked_vector(given, range), value);
}

void SceneReader::boolean(std::string_view key, bool& value) {
  if (const Given given = find(key); given.node != nullptr)
    set(checked_boolean(given, *given.node, "must be true or false"), value);
}

void SceneReader::booleans(std::string_view key, std::array<bool, 3>& value) {
  constexpr const char* allowed = "must be three of true or false, such as [true, true, false]";
  const Given given = find(key);
  if (given.node == nullptr) return;
  if (!is_three(*given.node)) return refuse(given, allowed);
  for (std::size_t i = 0; i < 3; ++i) set(checked_boolean(given, *given.node->as_array()->get(i), allowed), value[i]);
}

void SceneReader::cells(std::string_view key, std::array<int, 3>& value, const coupling::Range& range) {
  const Given given = find(key);
  if (given.node == nullptr) return;
  if (is_three(*given.node)) {
    for (std::size_t i = 0; i < 3; ++i) set(checked_integer(given, *given.node->as_array()->get(i), range), value[i]);
  } else if (given.node->is_integer()) {
    if (const auto all = checked_integer(given, *given.node, range)) value.fill(*all);
  } else {
    refuse(given, "must be one whole number or three, such as 64 or [320, 96, 96]");
  }
}

void SceneReader::harmonics(std::string_view key, std::vector<vesicle::Harmonic>& value) {
  const Given given = find(key);
  if (given.node == nullptr) return;
  if (!given.node->is_array() || given.node->as_array()->empty()) return refuse(given, harmonics_form);
  value.clear();
  for (const toml::node& term : *given.node->as_array())
    if (const auto harmonic = checked_harmonic(given, term)) value.push_back(*harmonic);
}

void SceneReader::choice(std::string_view key, int& value, std::span<const std::string_view> names) {
  const Given given = find(key);
  if (given.node == nullptr) return;
  // Names that are numbers may be given as such: upsampling = 1.5 for "1.5".
  const auto is_given = [&](std::string_view name) {
    if (!given.node->is_number()) return given.node->is_string() && name == given.node->as_string()->get();
    return number_in(name) == to_number(*given.node);
  };
  const auto found = std::ranges::find_if(names, is_given);
  if (found == names.end()) return refuse(given, fmt::format("allowed are {}", fmt::join(names, ", ")));
  value = static_cast<int>(found - names.begin());
}

std::optional<double> SceneReader::checked(const Given& given, const toml::node& part, const coupling::Range& range) {
  const double value = to_number(part);
  const bool numeric = part.is_number() || (part.is_string() && !std::isnan(value));
  if (numeric && range.contains(value)) return value;
  refuse(given, numeric ? must_be(value, range) : fmt::format("must be a number {}", range.describe()));
  return std::nullopt;
}

std::optional<bool> SceneReader::checked_boolean(const Given& given, const toml::node& part, const char* allowed) {
  if (part.is_boolean()) return part.as_boolean()->get();
  refuse(given, allowed);
  return std::nullopt;
}

std::optional<int> SceneReader::checked_integer(const Given& given, const toml::node& part,
                                                const coupling::Range& range) {
  if (!part.is_integer()) {
    refuse(given, fmt::format("must be a whole number {}", range.describe()));
    return std::nullopt;
  }
  const auto value = part.as_integer()->get();
  if (range.contains(static_cast<double>(value)) && value <= std::numeric_limits<int>::max())
    return static_cast<int>(value);
  refuse(given, fmt::format("must be {}", range.describe()));
  return std::nullopt;
}

std::optional<std::array<double, 3>> SceneReader::checked_vector(const Given& given, const coupling::Range& range) {
  if (!is_three(*given.node)) {
    refuse(given, "must be three numbers, such as [0.0, 0.0, 0.0]");
    return std::nullopt;
  }
  std::array<double, 3> value{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto component = checked(given, *given.node->as_array()->get(i), range);
    if (!component) return std::nullopt;
    value[i] = *component;
  }
  return value;
}

std::optional<vesicle::Harmonic> SceneReader::checked_harmonic(const Given& given, const toml::node& term) {
  constexpr int largest_degree = 256;
  const toml::array* entries = is_three(term) ? term.as_array() : nullptr;
  if (entries == nullptr || !(*entries)[0].is_integer() || !(*entries)[1].is_integer()) {
    refuse(given, harmonics_form);
    return std::nullopt;
  }
  const auto degree = checked_integer(given, (*entries)[0], coupling::Range::between(0, largest_degree));
  if (!degree) return std::nullopt;
  const auto order = checked_integer(given, (*entries)[1], coupling::Range::between(-*degree, *degree));
  const auto amplitude = checked(given, (*entries)[2], coupling::Range::any());
  if (!order || !amplitude) return std::nullopt;
  return vesicle::Harmonic{*degree, *order, *amplitude};
}

}  // namespace vesiflow::run
