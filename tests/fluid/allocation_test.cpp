// A warmed-up step must not allocate: this program counts the calls of operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "fluid/navier_stokes.h"

namespace {
std::atomic<long> allocations{0};

void* allocate(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

// Fields are allocated with their own alignment.
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}

namespace vesiflow::fluid {
namespace {

TEST(Allocation, NoneInAWarmedUpStep) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {12, 13, 14});
  NavierStokes fluid(
      grid, {},
      [](const Vector3& r, double t) {
        return Vector3{r[2] * t, 0, 0};
      },
      false);
  fluid.step(0.1);
  fluid.step(0.1);
  const long before = allocations;
  fluid.step(0.1);
  fluid.step(0.05);
  EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace vesiflow::fluid
