#pragma once

// Stand-in until vesicle/surface_file.h is there.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "vesicle/coefficients.h"

inline vesiflow::vesicle::Coefficients read_surface_coefficients(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  struct Line {
    int n, m;
    std::array<double, 6> values;
  };
  std::vector<Line> lines;
  int number = 0, largest = 0;
  for (std::string text; std::getline(file, text);) {
    ++number;
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream items(text);
    Line line{};
    items >> line.n >> line.m;
    for (double& value : line.values) items >> value;
    if (!items || line.n < 0 || line.m < 0 || line.m > line.n || line.n > 512)
      throw std::runtime_error(fmt::format("{}:{}: must be n m re_x im_x re_y im_y re_z im_z", path.string(), number));
    largest = std::max(largest, line.n);
    lines.push_back(line);
  }
  if (lines.empty()) throw std::runtime_error(fmt::format("{}: has no coefficients", path.string()));
  vesiflow::vesicle::Coefficients result(largest + 1, 3);
  result.set_zero();
  for (const Line& line : lines)
    for (int field = 0; field < 3; ++field)
      result(field, line.n, line.m) = {line.values[2 * field], line.values[2 * field + 1]};
  return result;
}
