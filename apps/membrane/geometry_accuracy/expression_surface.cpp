// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "expression_surface.h"

#include <fmt/format.h>
#include <muParser.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

using namespace vesiflow::vesicle;

namespace {

constexpr double pi = std::numbers::pi;

// One key of the file as a function of theta and phi.
class Expression {
 public:
  Expression(std::string where, std::string key, std::string text, const toml::table& constants)
      : where_(std::move(where)), key_(std::move(key)), text_(std::move(text)) {
    try {
      parser_.DefineVar("theta", &theta_);
      parser_.DefineVar("phi", &phi_);
      parser_.DefineConst("pi", pi);
      for (const auto& [name, value] : constants)
        parser_.DefineConst(std::string(name.str()), value.value<double>().value());
      parser_.SetExpr(text_);
      int results = 0;
      parser_.Eval(results);
      if (results != 1) refuse("must be one expression, without commas outside of functions");
    } catch (const mu::Parser::exception_type& error) {
      refuse(message(error));
    }
    unchecked(0.7, 1.3);
  }
  Expression(const Expression&) = delete;

  /// @throws InputError unless finite
  double operator()(double theta, double phi) {
    const double value = unchecked(theta, phi);
    if (!std::isfinite(value))
      refuse(fmt::format("is {} at theta = {:.6g}, phi = {:.6g}: must be finite",
                         std::isnan(value) ? "not a number" : "infinite", theta, phi));
    return value;
  }

  double unchecked(double theta, double phi) {
    theta_ = theta;
    phi_ = phi;
    try {
      const double value = parser_.Eval();
      if (theta_ != theta || phi_ != phi) refuse("must not assign to theta or phi");
      return value;
    } catch (const mu::Parser::exception_type& error) {
      refuse(message(error));
    }
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}: {} = \"{}\": {}", where_, key_, text_, why));
  }

 private:
  static std::string message(const mu::Parser::exception_type& error) {
    const std::string& text = error.GetMsg();
    if (text.find("position") != std::string::npos || error.GetPos() < 0) return text;
    return fmt::format("{} (at position {})", text, error.GetPos());
  }

  std::string where_, key_, text_;
  double theta_ = 1, phi_ = 1;
  mu::Parser parser_;
};

toml::table parse_file(const std::string& file) {
  try {
    return toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    if (line == 0) throw InputError(fmt::format("{}: cannot be read", file));
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file, line, error.description()));
  }
}

void require_known_keys(const std::string& file, const toml::table& root) {
  for (const auto& [key, node] : root) {
    const std::string_view name = key.str();
    if (name == "x" || name == "y" || name == "z" || name == "r" || name == "constants") continue;
    throw InputError(fmt::format("{}:{}: {}: unknown key; allowed are r, or x, y and z, and [constants]", file,
                                 node.source().begin.line, name));
  }
}

bool is_free_name(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  constexpr std::string_view digits = "0123456789";
  if (name.empty() || name == "theta" || name == "phi" || name == "pi" || digits.find(name[0]) != digits.npos)
    return false;
  return std::ranges::all_of(name,
                             [&](char c) { return letters.find(c) != letters.npos || digits.find(c) != digits.npos; });
}

toml::table constants_of(const std::string& file, const toml::table& root) {
  const toml::node* const node = root.get("constants");
  if (node == nullptr) return {};
  if (!node->is_table())
    throw InputError(fmt::format("{}:{}: constants: must be a table of numbers", file, node->source().begin.line));
  for (const auto& [key, value] : *node->as_table()) {
    const std::string where = fmt::format("{}:{}: constants.{}", file, value.source().begin.line, key.str());
    if (!value.is_number() || !std::isfinite(*value.value<double>()))
      throw InputError(fmt::format("{}: must be a finite number", where));
    if (!is_free_name(key.str()))
      throw InputError(
          fmt::format("{}: a constant must be named by letters, digits and _, not beginning with a digit, "
                      "and not theta, phi or pi",
                      where));
  }
  return *node->as_table();
}

}  // namespace

class ExpressionSurface::Expressions {
 public:
  explicit Expressions(const std::string& file) {
    const toml::table root = parse_file(file);
    require_known_keys(file, root);
    const toml::table constants = constants_of(file, root);
    const bool radial = root.contains("r");
    if (radial == (root.contains("x") || root.contains("y") || root.contains("z")))
      throw InputError(fmt::format("{}: must give either r or x, y and z{}", file, radial ? ", not both" : ""));
    for (const char* key : {"r", "x", "y", "z"}) {
      if (radial != (std::string_view(key) == "r")) continue;
      const toml::node* const node = root.get(key);
      if (node == nullptr) throw InputError(fmt::format("{}: {}: missing; give x, y and z", file, key));
      const std::string where = fmt::format("{}:{}", file, node->source().begin.line);
      const auto text = node->value_exact<std::string>();
      if (!text) throw InputError(fmt::format("{}: {}: must be an expression in quotes", where, key));
      expressions_.push_back(std::make_unique<Expression>(where, key, *text, constants));
    }
  }

  /// sin_theta and cos_theta are those of theta, without the rounding of theta itself.
  Vector3 position(double theta, double sin_theta, double cos_theta, double phi) {
    if (!radial())
      return {(*expressions_[0])(theta, phi), (*expressions_[1])(theta, phi), (*expressions_[2])(theta, phi)};
    const double r = (*expressions_[0])(theta, phi);
    if (!(r > 0))
      expressions_[0]->refuse(fmt::format("is {:.6g} at theta = {:.6g}, phi = {:.6g}: must be > 0", r, theta, phi));
    return {r * sin_theta * std::cos(phi), r * sin_theta * std::sin(phi), r * cos_theta};
  }

  /// Each expression must take the same value at phi and phi + 2 pi, and at every phi of a pole; where an expression has
  /// no value at a pole itself (0 / 0), that pole is not looked at.
  void require_single_valued() {
    constexpr double tolerance = 1e-9;
    for (const auto& expression : expressions_) {
      const auto require_equal = [&](double theta, double phi, double theta2, double phi2) {
        const double a = expression->unchecked(theta, phi), b = expression->unchecked(theta2, phi2);
        if (!std::isfinite(a) || !std::isfinite(b) || std::abs(a - b) <= tolerance * (1 + std::abs(a))) return;
        expression->refuse(
            fmt::format("is {:.6g} at theta = {:.6g}, phi = {:.6g} but {:.6g} at theta = {:.6g}, phi = "
                        "{:.6g}, the same point of the sphere: the surface is not closed",
                        a, theta, phi, b, theta2, phi2));
      };
      for (int k = 1; k < 8; ++k)
        for (const double phi : {0.0, 0.7, 2.1, 4.2}) require_equal(k * pi / 8, phi, k * pi / 8, phi + 2 * pi);
      for (const double pole : {0.0, pi})
        for (const double phi : {0.7, 1.9, 3.3, 5.1}) require_equal(pole, 0, pole, phi);
    }
  }

 private:
  bool radial() const { return expressions_.size() == 1; }

  std::vector<std::unique_ptr<Expression>> expressions_;
};

ExpressionSurface::ExpressionSurface(const std::filesystem::path& file)
    : SampledSurface(file.string(), "expressions in theta and phi"),
      expressions_(std::make_unique<Expressions>(file.string())) {
  expressions_->require_single_valued();
  require_closed_and_outward();
}
ExpressionSurface::~ExpressionSurface() = default;

VectorField ExpressionSurface::sample(const SphereGrid& grid) const {
  VectorField positions(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      positions.row(grid.index(i, j)) =
          expressions_
              ->position(grid.colatitude()[j], grid.sin_colatitude()[j], grid.cos_colatitude()[j], grid.longitude(i))
              .transpose()
              .array();
  return positions;
}
