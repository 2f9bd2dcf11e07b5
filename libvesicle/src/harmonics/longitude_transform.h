// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>

#include "harmonics/lanes.h"

namespace vesiflow::vesicle {

/// Fourier transforms along the latitudes of several real fields. A northern ring f and its southern mirror
/// image g make one complex ring f + i g, so that its modes are Z_k = F_k + i G_k, 0 <= k < longitudes
/// (mode L - k is -k), where F and G are the unnormalised transforms (exp(-i k phi) forward).
/// Complex transforms are vectorised in FFTW, real ones hardly. The equator of an odd number of latitudes is
/// paired with itself.
///
/// Modes are stored with the rings of a block of eight contiguous, [column][block][mode][ring]: two cache lines per
/// mode, which the Legendre stage fills and reads with whole vectors, and a block whose transform stays in cache.
///
/// The transforms of different columns or blocks may run at the same time, each with its own rings().
class LongitudeTransform {
 public:
  using Complex = std::complex<double>;
  using Buffer = AlignedArray<Complex>;

  /// Rings of a block.
  static constexpr int block_rings = 8;

  LongitudeTransform(int latitudes, int longitudes);
  ~LongitudeTransform();
  LongitudeTransform(const LongitudeTransform&) = delete;
  LongitudeTransform& operator=(const LongitudeTransform&) = delete;

  int latitudes() const { return latitudes_; }
  int longitudes() const { return longitudes_; }

  /// Ring pairs: the northern latitudes, with the equator.
  int pairs() const { return (latitudes_ + 1) / 2; }
  int blocks() const { return (pairs() + block_rings - 1) / block_rings; }

  /// Makes room for that many fields.
  void reserve(int columns);

  /// The rings of a block at mode k of a field.
  Complex* mode(int column, int block, int k) {
    return modes_.get() + (std::ptrdiff_t(column) * blocks() + block) * block_stride() +
           std::ptrdiff_t(k) * block_rings;
  }

  /// Zeros for the modes k and -k of a field.
  void clear_mode(int column, int k);

  /// Scratch for one thread.
  Buffer allocate_rings() const { return allocate_aligned<Complex>(std::size_t(block_rings) * longitudes_); }

  /// Values (latitudes rings of longitudes) to the modes of a block, and back.
  void forward(const double* values, int column, int block, Complex* rings);
  void backward(int column, int block, double* values, Complex* rings);

 private:
  /// One cache line more than the data: blocks a power of two apart would compete for the same cache sets.
  std::ptrdiff_t block_stride() const { return std::ptrdiff_t(longitudes_) * block_rings + 4; }
  int rings_of(int block) const { return std::min(block_rings, pairs() - block * block_rings); }

  /// Plans for a full block and for the last one.
  struct Plans {
    void* forward = nullptr;
    void* backward = nullptr;
  };
  Plans make_plans(int rings);
  const Plans& plans_of(int block) const { return block + 1 < blocks() ? full_ : last_; }

  int latitudes_;
  int longitudes_;
  int columns_ = 0;
  Buffer modes_;
  Plans full_, last_;
};

}  // namespace vesiflow::vesicle
