// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/surface_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "check.h"
#include "io/text_lines.h"

namespace vesiflow::vesicle {
namespace {

constexpr const char* header =
    "# Surface X = (x, y, z) of spherical topology, coefficients f_n^m of\n"
    "#   X(theta, phi) = sum_n [ f_n^0 Y_n^0 + 2 Re sum_{m=1}^n f_n^m Y_n^m ],  Y_n^m = P_n^m(cos theta) exp(i m "
    "phi),\n"
    "# fully normalised: the integral of |Y_n^m|^2 over the unit sphere is 1; P_n^m > 0 next to the north pole (no\n"
    "# Condon-Shortley phase), so Y_0^0 = 1/sqrt(4 pi). X_theta x X_phi points outward.\n"
    "# n m  re_x im_x  re_y im_y  re_z im_z\n";

struct Entry {
  std::array<Coefficients::Complex, 3> value;
  int line;
};

/// 17 significant digits, whatever the locale.
std::string digits(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::scientific, 16).ptr;
  return {text.data(), end};
}

}  // namespace

Coefficients read_surface_coefficients(const std::filesystem::path& path) {
  constexpr std::array<const char*, 8> names{"n", "m", "re_x", "im_x", "re_y", "im_y", "re_z", "im_z"};
  TextLines file(path);
  std::map<std::pair<int, int>, Entry> entries;
  int degrees = 0;
  while (file.next()) {
    const auto& words = file.words();
    if (words.size() != names.size())
      file.fail(std::to_string(words.size()) + " numbers: must be 8, n m re_x im_x re_y im_y re_z im_z");
    const int n = file.integer(words[0], "n");
    const int m = file.integer(words[1], "m");
    if (n < 0 || n > largest_file_degree)
      file.fail("n = " + std::to_string(n) + ": must be in [0, " + std::to_string(largest_file_degree) + "]");
    if (m < 0 || m > n) file.fail("m = " + std::to_string(m) + ": must be in [0, n] = [0, " + std::to_string(n) + "]");
    Entry entry{{}, file.line()};
    for (std::size_t k = 2; k < names.size(); k += 2) {
      const double re = file.number(words[k], names[k]);
      const double im = file.number(words[k + 1], names[k + 1]);
      if (m == 0 && im != 0)
        file.fail(std::string(names[k + 1]) + " = " + TextLines::shown(words[k + 1]) + ": must be 0 for m = 0");
      entry.value[k / 2 - 1] = {re, im};
    }
    const auto [other, is_new] = entries.try_emplace({n, m}, entry);
    if (!is_new)
      file.fail("n = " + std::to_string(n) + ", m = " + std::to_string(m) + ": given before, in line " +
                std::to_string(other->second.line));
    degrees = std::max(degrees, n + 1);
  }
  if (entries.empty()) throw std::runtime_error(path.string() + ": no coefficients: at least one line is needed");
  Coefficients coefficients(degrees, 3);
  coefficients.set_zero();
  for (const auto& [key, entry] : entries)
    for (int field = 0; field < 3; ++field)
      coefficients(field, key.first, key.second) = entry.value[static_cast<std::size_t>(field)];
  return coefficients;
}

void write_surface_coefficients(const std::filesystem::path& path, const Coefficients& coefficients) {
  check_argument(coefficients.fields() == 3, "fields", coefficients.fields(), "3");
  check_argument(coefficients.degrees() <= largest_file_degree + 1, "degrees", coefficients.degrees(), "<= 513");
  std::string text = header;
  for (int n = 0; n < coefficients.degrees(); ++n)
    for (int m = 0; m <= n; ++m) {
      text += std::to_string(n) + " " + std::to_string(m);
      for (int field = 0; field < 3; ++field) {
        const Coefficients::Complex f = coefficients(field, n, m);
        if (!std::isfinite(f.real()) || !std::isfinite(f.imag()))
          throw std::invalid_argument("coefficients: n = " + std::to_string(n) + ", m = " + std::to_string(m) +
                                      " is not finite");
        // The expansion has no imaginary part of order 0.
        text += "  " + digits(f.real()) + " " + digits(m == 0 ? 0.0 : f.imag());
      }
      text += '\n';
    }
  std::ofstream stream(path);
  stream << text << std::flush;
  if (!stream)
    throw std::runtime_error(path.string() + ": cannot be written: no such folder, no permission or no space");
}

}  // namespace vesiflow::vesicle
