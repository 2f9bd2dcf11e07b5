// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "harmonics/harmonic_stages.h"

#include <algorithm>

#include "harmonics/two_stages.h"

namespace vesiflow::vesicle {
namespace {

/// Multiplications of the Legendre sums of one kind below which threads are not used. Synthesis of three fields of 80
/// degrees makes a million of them and takes 90 microseconds with one thread (Zen 3); waking and
/// joining a second thread takes 10 to 18 microseconds if waiting threads sleep and 2 if they spin.
constexpr double least_threaded_work = 1e6;

double south_sign(LegendreKind kind) {
  return kind == LegendreKind::first ? -1 : 1;
}

}  // namespace

HarmonicStages::HarmonicStages(int degrees, const SphereGrid& grid)
    : degrees_(degrees),
      transform_(grid.latitudes(), grid.longitudes()),
      fold_weight_(allocate_aligned<double>(half_stride())) {
  // Of a pair of rings each counts half in sum and difference, and the equator is paired with itself.
  const int latitudes = grid.latitudes();
  for (int j = 0; j < transform_.pairs(); ++j) fold_weight_[j] = 2 * j + 1 == latitudes ? 0.25 : 0.5;
}

void HarmonicStages::reserve(int fields, int derivatives) {
  transform_.reserve(fields * derivatives);
  if (fields <= fields_) return;
  fields_ = fields;
  workspaces_.clear();
  workspaces_.resize(threads(fields));
  for (Workspace& work : workspaces_) {
    for (auto& half : work.half_sums) half = allocate_aligned<double>(std::size_t(2) * fields * half_stride());
    work.rings = transform_.allocate_rings();
  }
}

void HarmonicStages::require(LegendreKind kind, LegendreSum sum) {
  auto& table = tables_[static_cast<int>(kind)][static_cast<int>(sum)];
  if (!table) table = shared_legendre_table(kind, sum, degrees_, transform_.latitudes(), transform_.longitudes());
}

int HarmonicStages::threads(int fields) const {
  const double work = double(degrees_) * degrees_ * transform_.pairs() * fields;
  if (work < least_threaded_work) return 1;
  const int most = workspaces_.empty() ? transform_.longitudes() : static_cast<int>(workspaces_.size());
  return available_threads(most);
}

/// Calls use(group) with the fields of each kind.
template <class Fields, class Use>
void HarmonicStages::for_each_kind(Fields all, const Use& use) {
  for (auto first = all.begin(); first != all.end();) {
    const auto kind = first->kind;
    const auto last = std::find_if(first, all.end(), [kind](const auto& f) { return f.kind != kind; });
    use(Fields(first, last));
    first = last;
  }
}

void HarmonicStages::evaluate(const Coefficients& coefficients, std::span<const NodalFields<double>> results) {
  const int fields = coefficients.fields();
  for_each_kind(results, [&](std::span<const NodalFields<double>> group) {
    const int derivatives = static_cast<int>(group.size());
    reserve(fields, derivatives);
    require(group[0].kind, LegendreSum::over_degrees);
    const auto fill_modes = [&](int thread, int threads) {
      for (int k = thread; k <= transform_.longitudes() / 2; k += threads)
        fill_mode(k, coefficients, group, workspaces_[thread]);
    };
    const auto transform_rings = [&](int thread, int threads) {
      const int blocks = transform_.blocks();
      for (int task = thread; task < derivatives * fields * blocks; task += threads) {
        const int column = task / blocks;
        const NodalFields<double>& result = group[column / fields];
        transform_.backward(column, task % blocks, result.values + column % fields * result.stride,
                            workspaces_[thread].rings.get());
      }
    };
    in_two_stages(threads(fields), fill_modes, transform_rings);
  });
}

/// Orders k, L - k, L + k, 2 L - k, ... equal the modes k and -k at L longitudes.
void HarmonicStages::fill_mode(int k, const Coefficients& coefficients, std::span<const NodalFields<double>> results,
                               Workspace& work) {
  const int longitudes = transform_.longitudes();
  const int fields = coefficients.fields();
  const int columns = static_cast<int>(results.size()) * fields;
  if (k >= degrees_)
    for (int column = 0; column < columns; ++column) transform_.clear_mode(column, k);
  const LegendreTable& functions = table(results[0].kind, LegendreSum::over_degrees);
  const auto add_order = [&](int m) {
    if (m >= degrees_) return;
    sum_degrees(coefficients, functions, m, work);
    for (int column = 0; column < columns; ++column) {
      const NodalFields<double>& result = results[column / fields];
      const int field = column % fields;
      unfold_hemispheres(half_sums(work, 0, field), half_sums(work, 1, field),
                         {m, result.longitude_derivative, south_sign(result.kind)}, m != k, column, transform_);
    }
  };
  add_order(k);
  for (int turn = longitudes; turn - k < degrees_; turn += longitudes) {
    if (k > 0 && 2 * k < longitudes) add_order(turn - k);
    add_order(turn + k);
  }
}

void HarmonicStages::sum_degrees(const Coefficients& coefficients, const LegendreTable& functions, int m,
                                 Workspace& work) {
  const int width = 2 * coefficients.fields();
  const std::ptrdiff_t stride = half_stride();
  for (int parity : {0, 1}) {
    double* const sums = work.half_sums[parity].get();
    for (int c = 0; c < width; ++c) std::fill_n(sums + c * stride, functions.first_latitude(m), 0.0);
    const double* const block = reinterpret_cast<const double*>(coefficients.block(m, parity));
    functions.matrix(m, parity).multiply(
        width, [=](int k, int c) { return block[std::ptrdiff_t(k) * width + c]; },
        [=](int row, int c, const auto& panel) { store_columns(panel, sums + c * stride + row, stride); });
  }
}

void HarmonicStages::project(std::span<const NodalFields<const double>> all, LegendreSum sum,
                             Coefficients& coefficients) {
  const int fields = coefficients.fields();
  for_each_kind(all, [&](std::span<const NodalFields<const double>> group) {
    const int derivatives = static_cast<int>(group.size());
    const bool add = group.data() != all.data();
    reserve(fields, derivatives);
    require(group[0].kind, sum);
    const auto transform_rings = [&](int thread, int threads) {
      const int blocks = transform_.blocks();
      for (int task = thread; task < derivatives * fields * blocks; task += threads) {
        const int column = task / blocks;
        const NodalFields<const double>& given = group[column / fields];
        transform_.forward(given.values + column % fields * given.stride, column, task % blocks,
                           workspaces_[thread].rings.get());
      }
    };
    const auto sum_orders = [&](int thread, int threads) {
      Workspace& work = workspaces_[thread];
      for (int m = thread; m < degrees_; m += threads) {
        for (int column = 0; column < derivatives * fields; ++column) {
          const NodalFields<const double>& given = group[column / fields];
          const int field = column % fields;
          fold_hemispheres(transform_, column, fold_weight_.get(),
                           {m, given.longitude_derivative, south_sign(given.kind)}, column >= fields,
                           half_sums(work, 0, field), half_sums(work, 1, field));
        }
        const LegendreTable& functions = table(group[0].kind, sum);
        if (add)
          sum_latitudes<true>(functions, m, work, coefficients);
        else
          sum_latitudes<false>(functions, m, work, coefficients);
      }
    };
    in_two_stages(threads(fields), transform_rings, sum_orders);
  });
}

template <bool add>
void HarmonicStages::sum_latitudes(const LegendreTable& functions, int m, Workspace& work, Coefficients& coefficients) {
  const int width = 2 * coefficients.fields();
  const std::ptrdiff_t stride = half_stride();
  for (int parity : {0, 1}) {
    const double* const folded = work.half_sums[parity].get() + functions.first_latitude(m);
    double* const block = reinterpret_cast<double*>(coefficients.block(m, parity));
    const int count = degree_count(degrees_, m, parity);
    functions.matrix(m, parity).multiply(
        width, [=](int k, int c) { return folded[c * stride + k]; },
        [=](int row, int c, const auto& panel) {
          store_rows<add>(panel, count - row, block + std::ptrdiff_t(row) * width + c, width);
        });
  }
}

}  // namespace vesiflow::vesicle
