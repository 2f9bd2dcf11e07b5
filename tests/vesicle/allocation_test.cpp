#include <atomic>
#include <cstdlib>

#include <gtest/gtest.h>

#include "vesicle/diagnostics.h"
#include "vesicle/membrane.h"
#include "vesicle/shapes.h"

// Sanitizers interpose malloc themselves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)

namespace {
std::atomic<long> allocations{0};
}

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

namespace vesiflow::vesicle {
namespace {

TEST(Allocation, AWarmedUpStepAllocatesNothing) {
  for (const FilterOrder filter : {FilterOrder::velocity_first, FilterOrder::components})
    for (const LaplacianForm laplacian : {LaplacianForm::cartesian, LaplacianForm::paper}) {
      constexpr int latitudes = 16;
      Membrane membrane(prolate(SphereGrid(latitudes), 0.9), latitudes, {.laplacian = laplacian, .filter = filter});
      const VectorField velocity = membrane.positions();
      VectorField filtered, positions;
      const auto step = [&] {
        membrane.update_geometry();
        membrane.compute_force();
        membrane.filter_velocity(velocity, 1e-3, filtered);
        positions = membrane.positions() + 1e-3 * filtered;
        membrane.advance(positions, velocity, filtered, 1e-3);
        return measure(membrane, velocity, filtered).area;
      };
      step();
      const long before = allocations;
      EXPECT_GT(before, 0) << "malloc is not counted";
      step();
      EXPECT_EQ(allocations - before, 0);
    }
}

}  // namespace
}  // namespace vesiflow::vesicle

#endif
