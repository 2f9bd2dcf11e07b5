// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/nearest_nodes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "transfer/shares.h"

namespace vesiflow::coupling {
namespace {

/// Points of a row that are treated at once.
constexpr int lanes = 8;
static_assert(lanes <= NearestNodes::smallest_row);

}  // namespace

void NearestNodes::search(const FineSurface& surface, const GridBox& box, double reach) {
  longitudes_ = surface.longitudes();
  node_bits_ = std::bit_width(static_cast<unsigned>(surface.nodes() - 1));
  reach_ = reach;
  // The sum of two parts that are at most the square of the reach fits.
  const std::uint32_t most = (std::numeric_limits<std::uint32_t>::max() >> node_bits_) / 2U;
  scale_ = (most - 1U) / (reach * reach);
  resize_with_room(keys_, box.size());
  in_shares(box.extent[2], [&](Eigen::Index begin, Eigen::Index end) {
    const int first = box.first[2] + static_cast<int>(begin), last = box.first[2] + static_cast<int>(end) - 1;
    std::fill(keys_.begin() + begin * box.stride(2), keys_.begin() + end * box.stride(2), limit());
    search_planes(surface, box, first, last);
  });
}

void NearestNodes::search_planes(const FineSurface& surface, const GridBox& box, int first, int last) {
  const GridBox points = box;  // no store below changes a copy
  const double square = reach_ * reach_;
  const auto part = [scale = scale_, bits = node_bits_, square](double squared_distance) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(scale * std::min(squared_distance, square))) << bits;
  };
  // As many as are within reach at most, in whole lanes. A box has at least that many.
  const int blocks = (static_cast<int>(2.0 * reach_ / points.spacing[0]) + lanes) / lanes;
  for (int row = 0; row < surface.latitudes(); ++row)
    for (int column = 0; column < surface.longitudes(); column += surface.stride_of_row(row)) {
      const auto x = surface.at_node(column, row, FineSurface::position);
      const auto number = static_cast<std::uint32_t>(row * surface.longitudes() + column);
      const auto from = [&](int axis, int least) {
        return std::max(least, static_cast<int>(std::ceil(points.index_at(axis, x[axis] - reach_))));
      };
      const auto to = [&](int axis, int most) {
        return std::min(most, static_cast<int>(std::floor(points.index_at(axis, x[axis] + reach_))));
      };
      const int j_from = from(1, points.first[1]), j_to = to(1, points.last(1));
      const int k_from = from(2, first), k_to = to(2, last);
      for (int block = 0; block < blocks; ++block) {
        const int i = std::min(from(0, points.first[0]) + block * lanes, points.last(0) - lanes + 1);
        std::array<std::uint32_t, lanes> along_row;
        for (int a = 0; a < lanes; ++a) {
          const double dx = points.coordinate(0, i + a) - x[0];
          along_row[static_cast<std::size_t>(a)] = part(dx * dx) | number;
        }
        for (int k = k_from; k <= k_to; ++k) {
          const double dz = points.coordinate(2, k) - x[2], left = square - dz * dz;
          std::uint32_t* keys = keys_.data() + points.offset(i, j_from, k);
          for (int j = j_from; j <= j_to; ++j, keys += points.extent[0]) {
            const double dy = points.coordinate(1, j) - x[1];
            if (dy * dy > left) continue;
            const std::uint32_t rest = part(dy * dy + dz * dz);
#pragma omp simd
            for (std::size_t a = 0; a < lanes; ++a) {
              const std::uint32_t key = along_row[a] + rest;
              keys[a] = key < keys[a] ? key : keys[a];
            }
          }
        }
      }
    }
}

NearestNodes::Key NearestNodes::limit(double distance) const {
  // What is cut off from both parts of the squared distance is less than two units.
  const double least = std::min(distance, reach_);
  return (static_cast<Key>(scale_ * least * least) + 1U) << node_bits_;
}

}  // namespace vesiflow::coupling
