// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/allocation_counter.h"
#include "vesicle/diagnostics.h"
#include "vesicle/membrane.h"
#include "vesicle/shapes.h"

namespace vesiflow::vesicle::allocation_test {
namespace {

TEST(Allocation, AWarmedUpStepAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
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
        return membrane.surface().area();
      };
      step();
      const long before = test::allocation_count();
      step();
      EXPECT_EQ(test::allocation_count() - before, 0);
    }
}

}  // namespace
}  // namespace vesiflow::vesicle::allocation_test
