// Planned sine and cosine transforms of a plane (FFTW real-to-real), and the aligned memory they work in.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace vesiflow::fluid {

struct AlignedRelease {
  void operator()(double* memory) const;
};
using AlignedArray = std::unique_ptr<double[], AlignedRelease>;

// count zeros, aligned for FFTW's vector instructions.
AlignedArray allocate_aligned(std::size_t count);

// The forward transform's basis along one axis of a plane.
enum class Basis {
  sine_points,  // DST-I: zero on points one step outside
  sine_cells,   // DST-II: odd about walls half a step outside
  cosine_cells  // DCT-II: even about walls half a step outside
};

enum class Direction { forward, backward };

// Transforms nx x ny numbers with rows row_stride apart, in place. forward then backward multiplies by
// pair_factor() of each axis.
class TransformPlan {
 public:
  TransformPlan(std::array<int, 2> extent, std::ptrdiff_t row_stride, std::array<Basis, 2> basis, Direction direction);
  ~TransformPlan();
  TransformPlan(const TransformPlan&) = delete;
  TransformPlan& operator=(const TransformPlan&) = delete;

  // plane comes from allocate_aligned. Any number of threads may do this at once, each with its own plane.
  void execute(double* plane) const;

  static double pair_factor(Basis basis, int extent);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace vesiflow::fluid
