// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

/// One line of Table 1 of the paper: largest errors over the markers.
struct PaperRow {
  std::string_view surface;
  int latitudes;
  double mean, gaussian;
  double laplacian, laplacian_upsampled;
};

inline constexpr PaperRow paper_table[] = {
    {"sphere", 16, 4.02e-13, 8.04e-13, 1.26e-10, 1.15e-10}, {"sphere", 32, 4.37e-12, 8.74e-12, 1.59e-8, 6.15e-9},
    {"sphere", 64, 3.17e-11, 6.34e-11, 5.06e-7, 1.46e-7},   {"sphere", 128, 3.98e-10, 7.97e-10, 4.28e-5, 8.35e-6},
    {"ellipsoid", 16, 3.08e-13, 4.58e-13, 5.71e1, 3.59e1},  {"ellipsoid", 32, 7.53e-12, 1.44e-11, 3.27e1, 4.16e0},
    {"ellipsoid", 64, 2.69e-11, 7.84e-11, 2.48e1, 2.30e-1}, {"ellipsoid", 128, 4.83e-10, 1.01e-9, 2.33e1, 2.24e-1},
    {"y32", 16, 8.14e-3, 6.74e-3, 5.82e0, 4.49e0},          {"y32", 32, 4.53e-9, 7.24e-9, 4.20e0, 2.08e0},
    {"y32", 64, 2.91e-11, 3.74e-11, 2.69e0, 6.44e-2},       {"y32", 128, 3.41e-10, 3.70e-10, 2.64e0, 2.69e-2},
};

/// Null where the paper has no such line.
inline const PaperRow* paper_row(std::string_view surface, int latitudes) {
  for (const PaperRow& row : paper_table)
    if (row.surface == surface && row.latitudes == latitudes) return &row;
  return nullptr;
}
