#include "longitude_transform.h"

#include <new>
#include <stdexcept>

#include <fftw3.h>

namespace vesiflow::vesicle {
namespace {

fftw_complex* as_fftw(std::complex<double>* data) {
  return reinterpret_cast<fftw_complex*>(data);
}

/// Rows start on cache lines, and never a power of two apart, which would map a column of modes to few cache
/// sets.
std::ptrdiff_t padded_row(int longitudes) {
  return (std::ptrdiff_t{longitudes} + 3) / 4 * 4 + 4;
}

}  // namespace

void LongitudeTransform::Free::operator()(Complex* data) const {
  fftw_free(data);
}

LongitudeTransform::Buffer LongitudeTransform::allocate(std::ptrdiff_t size) {
  // FFTW's own allocation has the alignment that its vector code and the reuse of plans need.
  auto* data = static_cast<Complex*>(fftw_malloc(sizeof(Complex) * size));
  if (!data) throw std::bad_alloc();
  return Buffer(data);
}

LongitudeTransform::LongitudeTransform(int latitudes, int longitudes)
    : latitudes_(latitudes),
      longitudes_(longitudes),
      mode_stride_(padded_row(longitudes)),
      rings_(allocate(std::ptrdiff_t(pairs()) * longitudes)) {
  reserve(1);
  // FFTW_ESTIMATE: measured plans differ from process to process, and a restarted run would then not repeat
  // the uninterrupted one bit for bit.
  const auto plan = [&](Complex* in, int in_stride, Complex* out, int out_stride, int sign) {
    const int n[] = {longitudes_};
    fftw_plan result = fftw_plan_many_dft(1, n, pairs(), as_fftw(in), nullptr, 1, in_stride, as_fftw(out), nullptr, 1,
                                          out_stride, sign, FFTW_ESTIMATE);
    if (!result) throw std::runtime_error("FFTW could not plan the longitude transforms");
    return result;
  };
  const int stride = static_cast<int>(mode_stride_);
  forward_ = plan(rings_.get(), longitudes_, modes_.get(), stride, FFTW_FORWARD);
  backward_ = plan(modes_.get(), stride, rings_.get(), longitudes_, FFTW_BACKWARD);
}

LongitudeTransform::~LongitudeTransform() {
  fftw_destroy_plan(static_cast<fftw_plan>(forward_));
  fftw_destroy_plan(static_cast<fftw_plan>(backward_));
}

void LongitudeTransform::reserve(int fields) {
  if (fields <= fields_) return;
  modes_ = allocate(std::ptrdiff_t(fields) * pairs() * mode_stride_);
  fields_ = fields;
}

void LongitudeTransform::forward(const double* values, int field) {
  for (int j = 0; j < pairs(); ++j) {
    const double* north = values + std::ptrdiff_t(j) * longitudes_;
    const double* south = values + std::ptrdiff_t(latitudes_ - 1 - j) * longitudes_;
    Complex* ring = rings_.get() + std::ptrdiff_t(j) * longitudes_;
    for (int i = 0; i < longitudes_; ++i) ring[i] = {north[i], south[i]};
  }
  fftw_execute_dft(static_cast<fftw_plan>(forward_), as_fftw(rings_.get()), as_fftw(modes(field)));
}

void LongitudeTransform::backward(int field, double* values) {
  fftw_execute_dft(static_cast<fftw_plan>(backward_), as_fftw(modes(field)), as_fftw(rings_.get()));
  for (int j = 0; j < pairs(); ++j) {
    double* north = values + std::ptrdiff_t(j) * longitudes_;
    double* south = values + std::ptrdiff_t(latitudes_ - 1 - j) * longitudes_;
    const Complex* ring = rings_.get() + std::ptrdiff_t(j) * longitudes_;
    for (int i = 0; i < longitudes_; ++i) {
      north[i] = ring[i].real();
      south[i] = ring[i].imag();
    }
  }
}

}  // namespace vesiflow::vesicle
