// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/nearest_nodes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "transfer/roomy.h"
#include "transfer/shares.h"

namespace vesiflow::coupling {
namespace {

/// Points of a row that are treated at once, and rows of a plane.
constexpr int lanes = 8, most_rows = 8;
static_assert(lanes <= NearestNodes::smallest_row);

struct PointRange {
  int from, to;
};

}  // namespace

void NearestNodes::search(const FineSurface& surface, const GridBox& box, double reach) {
  longitudes_ = surface.longitudes();
  node_bits_ = std::bit_width(static_cast<unsigned>(surface.nodes() - 1));
  reach_ = reach;
  // What three axes add up to fits.
  most_units_ = (limit() >> node_bits_) / 3U;
  units_ = most_units_ / (reach * reach);
  resize_with_room(keys_, box.size());
  in_shares(box.extent[2], [&](Eigen::Index begin, Eigen::Index end) {
    std::fill(keys_.begin() + begin * box.stride(2), keys_.begin() + end * box.stride(2), limit());
    search_planes(surface, box, box.first[2] + static_cast<int>(begin), box.first[2] + static_cast<int>(end) - 1);
  });
}

void NearestNodes::search_planes(const FineSurface& surface, const GridBox& whole, int first, int last) {
  const GridBox box = whole;  // a copy, which no store below changes
  // What a distance along an axis adds to a key.
  const auto part = [units = units_, most = static_cast<double>(most_units_), bits = node_bits_](double distance) {
    return static_cast<Key>(static_cast<std::int32_t>(std::min(units * distance * distance, most))) << bits;
  };
  for (const FineSurface::Node node : surface.sparse_nodes()) {
    const auto& x = surface.at(node).position_and_normal;
    const auto number = static_cast<Key>(node.row * surface.longitudes() + node.column);
    const auto range = [&](int axis, int least, int greatest) {
      return PointRange{std::max(least, static_cast<int>(std::ceil(box.index_at(axis, x[axis] - reach_)))),
                        std::min(greatest, static_cast<int>(std::floor(box.index_at(axis, x[axis] + reach_))))};
    };
    const PointRange planes = range(2, first, last);
    if (planes.from > planes.to) continue;
    const PointRange rows = range(1, box.first[1], box.last(1)), points = range(0, box.first[0], box.last(0));
    for (int point = points.from; point <= points.to; point += lanes)
      for (int first_row = rows.from; first_row <= rows.to; first_row += most_rows) {
        const int i = std::min(point, box.last(0) - lanes + 1);
        std::array<Key, lanes> along_x;
#pragma omp simd
        for (int a = 0; a < lanes; ++a) along_x[a] = part(box.coordinate(0, i + a) - x[0]) | number;
        std::array<Key, most_rows> along_y;
#pragma omp simd
        for (int b = 0; b < most_rows; ++b) along_y[b] = part(box.coordinate(1, first_row + b) - x[1]);
        const int count = std::min(most_rows, rows.to - first_row + 1);
        for (int k = planes.from; k <= planes.to; ++k) {
          const Key along_z = part(box.coordinate(2, k) - x[2]);
          Key* keys = keys_.data() + box.offset(i, first_row, k);
          // Rows beyond the reach are not left out: a branch that is hard to foresee costs more.
          for (int b = 0; b < count; ++b, keys += box.extent[0]) {
            const Key rest = along_y[b] + along_z;
#pragma omp simd
            for (int a = 0; a < lanes; ++a) {
              const Key key = along_x[a] + rest;
              keys[a] = key < keys[a] ? key : keys[a];
            }
          }
        }
      }
  }
}

NearestNodes::Key NearestNodes::limit(double distance) const {
  // What is cut off makes keys smaller.
  const double least = std::min(distance, reach_);
  return (static_cast<Key>(units_ * least * least) + 1U) << node_bits_;
}

}  // namespace vesiflow::coupling
