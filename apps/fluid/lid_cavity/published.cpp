// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "published.h"

#include <array>

namespace cavity::albensoeder_kuhlmann {
namespace {

// As in the table, in the paper's coordinates.
constexpr std::array<PublishedPoint, 15> table_5{{{-0.4766, 0.58964},
                                                  {-0.4688, 0.48443},
                                                  {-0.4609, 0.39821},
                                                  {-0.4531, 0.33171},
                                                  {-0.3516, 0.12183},
                                                  {-0.2344, 0.07334},
                                                  {-0.1172, 0.03905},
                                                  {0.0000, 0.00802},
                                                  {0.0469, -0.00612},
                                                  {0.2187, -0.10999},
                                                  {0.3281, -0.25160},
                                                  {0.3984, -0.27293},
                                                  {0.4297, -0.23696},
                                                  {0.4375, -0.22283},
                                                  {0.4453, -0.20623}}};
constexpr std::array<PublishedPoint, 15> table_6{{{-0.4375, -0.21738},
                                                  {-0.4297, -0.22746},
                                                  {-0.4219, -0.23503},
                                                  {-0.4062, -0.24407},
                                                  {-0.3437, -0.22924},
                                                  {-0.2734, -0.17580},
                                                  {-0.2656, -0.16987},
                                                  {0.0000, -0.03674},
                                                  {0.3047, 0.15223},
                                                  {0.3594, 0.31117},
                                                  {0.4063, 0.43423},
                                                  {0.4453, 0.33511},
                                                  {0.4531, 0.29032},
                                                  {0.4609, 0.24095},
                                                  {0.4688, 0.18864}}};

constexpr auto transformed(std::array<PublishedPoint, 15> table, double position_sign, double value_sign) {
  for (PublishedPoint& point : table) point = {0.5 + position_sign * point.position, value_sign * point.value};
  return table;
}

constexpr auto u = transformed(table_5, -1, 1);
constexpr auto v = transformed(table_6, 1, -1);

}  // namespace

std::span<const PublishedPoint> u_along_y() {
  return u;
}

std::span<const PublishedPoint> v_along_x() {
  return v;
}

}  // namespace cavity::albensoeder_kuhlmann
