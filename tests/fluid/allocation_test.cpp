// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fluid/navier_stokes.h"
#include "support/allocation_counter.h"
#include "thread_count.h"

namespace vesiflow::fluid::allocation_test {
namespace {

TEST(Allocation, NoneInAWarmedUpStep) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);     // with one the OpenMP library itself allocates a team for every loop
  for (const int cells : {12, 28}) {  // with one thread and with all
    const Grid grid({0, 0, 0}, {1, 1, 1}, {cells, cells + 1, cells + 2});
    NavierStokes fluid(
        grid, {},
        [](const Vector3& r, double t) {
          return Vector3{r[2] * t, 0, 0};
        },
        WallMotion::unsteady);
    fluid.step(0.1);
    fluid.step(0.1);
    const long before = vesiflow::test::allocation_count();
    fluid.step(0.1);
    fluid.step(0.05);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
  }
}

}  // namespace
}  // namespace vesiflow::fluid::allocation_test
