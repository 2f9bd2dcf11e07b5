#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace vesiflow::vesicle {

/// Vectors of doubles: the vector extension of GCC and Clang, which any target has.
template <int count>
using VectorOf __attribute__((vector_size(count * sizeof(double)))) = double;

/// What folding and unfolding work on: four rings.
using Lanes = VectorOf<4>;
inline constexpr int lane_count = 4;

/// Zeros that begin on a cache line: the bits and the speed of a program must not hang on where memory was found.
struct AlignedRelease {
  template <class Value>
  void operator()(Value* memory) const {
    ::operator delete(memory, std::align_val_t{64});
  }
};
template <class Value>
using AlignedArray = std::unique_ptr<Value[], AlignedRelease>;

template <class Value>
AlignedArray<Value> allocate_aligned(std::size_t count) {
  auto* memory = static_cast<Value*>(::operator new(sizeof(Value) * count, std::align_val_t{64}));
  std::uninitialized_fill_n(memory, count, Value{});
  return AlignedArray<Value>(memory);
}

}  // namespace vesiflow::vesicle
