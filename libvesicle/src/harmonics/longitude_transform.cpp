// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "harmonics/longitude_transform.h"

#include <stdexcept>

#include "fftw_planner.h"

namespace vesiflow::vesicle {
namespace {

fftw_complex* as_fftw(std::complex<double>* data) {
  return reinterpret_cast<fftw_complex*>(data);
}

}  // namespace

LongitudeTransform::LongitudeTransform(int latitudes, int longitudes) : latitudes_(latitudes), longitudes_(longitudes) {
  reserve(1);
  if (blocks() > 1) full_ = make_plans(block_rings);
  last_ = make_plans(rings_of(blocks() - 1));
}

LongitudeTransform::~LongitudeTransform() {
  for (const Plans& plans : {full_, last_})
    for (void* plan : {plans.forward, plans.backward})
      if (plan) fftw_destroy_plan(static_cast<fftw_plan>(plan));
}

LongitudeTransform::Plans LongitudeTransform::make_plans(int rings) {
  // FFTW_ESTIMATE: measured plans differ from process to process, and a restarted run would then not repeat
  // the uninterrupted one bit for bit.
  const Buffer scratch = allocate_rings();
  fftw_complex* const modes = as_fftw(modes_.get());
  fftw_complex* const values = as_fftw(scratch.get());
  const int n[] = {longitudes_};
  lock_fftw_planner();
  const Plans plans{fftw_plan_many_dft(1, n, rings, values, nullptr, 1, longitudes_, modes, nullptr, block_rings, 1,
                                       FFTW_FORWARD, FFTW_ESTIMATE),
                    fftw_plan_many_dft(1, n, rings, modes, nullptr, block_rings, 1, values, nullptr, 1, longitudes_,
                                       FFTW_BACKWARD, FFTW_ESTIMATE)};
  if (!plans.forward || !plans.backward) throw std::runtime_error("FFTW could not plan the longitude transforms");
  return plans;
}

void LongitudeTransform::reserve(int columns) {
  if (columns <= columns_) return;
  modes_ = allocate_aligned<Complex>(std::size_t(columns) * blocks() * block_stride());
  columns_ = columns;
}

void LongitudeTransform::clear_mode(int column, int k) {
  for (int block = 0; block < blocks(); ++block)
    for (const int mode_number : {k, (longitudes_ - k) % longitudes_})
      std::fill_n(mode(column, block, mode_number), block_rings, Complex{});
}

void LongitudeTransform::forward(const double* values, int column, int block, Complex* rings) {
  for (int r = 0; r < rings_of(block); ++r) {
    const std::ptrdiff_t j = block * block_rings + r;
    const double* north = values + j * longitudes_;
    const double* south = values + (latitudes_ - 1 - j) * longitudes_;
    double* ring = reinterpret_cast<double*>(rings + std::ptrdiff_t(r) * longitudes_);
    int i = 0;
    for (; i + lane_count <= longitudes_; i += lane_count)
      store_complex(ring + 2 * i, load<Lanes>(north + i), load<Lanes>(south + i));
    for (; i < longitudes_; ++i) {
      ring[2 * i] = north[i];
      ring[2 * i + 1] = south[i];
    }
  }
  fftw_execute_dft(static_cast<fftw_plan>(plans_of(block).forward), as_fftw(rings), as_fftw(mode(column, block, 0)));
}

void LongitudeTransform::backward(int column, int block, double* values, Complex* rings) {
  fftw_execute_dft(static_cast<fftw_plan>(plans_of(block).backward), as_fftw(mode(column, block, 0)), as_fftw(rings));
  for (int r = 0; r < rings_of(block); ++r) {
    const std::ptrdiff_t j = block * block_rings + r;
    double* north = values + j * longitudes_;
    double* south = values + (latitudes_ - 1 - j) * longitudes_;
    const double* ring = reinterpret_cast<const double*>(rings + std::ptrdiff_t(r) * longitudes_);
    int i = 0;
    for (; i + lane_count <= longitudes_; i += lane_count) {
      const ComplexLanes pair = load_complex(ring + 2 * i);
      store(north + i, pair.real);
      store(south + i, pair.imaginary);
    }
    for (; i < longitudes_; ++i) {
      north[i] = ring[2 * i];
      south[i] = ring[2 * i + 1];
    }
  }
}

}  // namespace vesiflow::vesicle
