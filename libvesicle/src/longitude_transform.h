#pragma once

#include <complex>
#include <cstddef>
#include <memory>

namespace vesiflow::vesicle {

/// Fourier transforms along the latitudes of several real fields. A northern ring f and its southern mirror
/// image g make one complex ring f + i g, so that a row of modes holds Z_m = F_m + i G_m for all 0 <= m <
/// longitudes (mode L - m is -m), where F and G are the unnormalised transforms (exp(-i m phi) forward).
/// Complex transforms are vectorised in FFTW, real ones hardly. The equator of an odd number of latitudes is
/// paired with itself.
class LongitudeTransform {
 public:
  using Complex = std::complex<double>;

  LongitudeTransform(int latitudes, int longitudes);
  ~LongitudeTransform();
  LongitudeTransform(const LongitudeTransform&) = delete;
  LongitudeTransform& operator=(const LongitudeTransform&) = delete;

  /// Ring pairs: the northern latitudes, with the equator.
  int pairs() const { return (latitudes_ + 1) / 2; }

  /// Makes room for the modes of that many fields.
  void reserve(int fields);

  /// Modes of a field: pairs() rows, mode_stride() apart.
  Complex* modes(int field) { return modes_.get() + std::ptrdiff_t(field) * pairs() * mode_stride_; }
  std::ptrdiff_t mode_stride() const { return mode_stride_; }

  /// Values (latitudes rings of longitudes) to the modes of a field, and back.
  void forward(const double* values, int field);
  void backward(int field, double* values);

 private:
  struct Free {
    void operator()(Complex* data) const;
  };
  using Buffer = std::unique_ptr<Complex[], Free>;
  static Buffer allocate(std::ptrdiff_t size);

  int latitudes_;
  int longitudes_;
  std::ptrdiff_t mode_stride_;
  int fields_ = 0;
  Buffer rings_;
  Buffer modes_;
  void* forward_ = nullptr;
  void* backward_ = nullptr;
};

}  // namespace vesiflow::vesicle
