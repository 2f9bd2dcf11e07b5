// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/scale_degrees.h"

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::scale_degrees_test {
namespace {

using testing::random_coefficients;

TEST(ScaleDegrees, MultipliesEveryOrderOfADegreeInAllFields) {
  const Coefficients before = random_coefficients(7, 2, 1);
  Coefficients after = before;
  int asked = 0;
  scale_degrees(after, [&](int n) { return ++asked, 0.5 * n - 1; });
  EXPECT_EQ(asked, 7);
  for (int n = 0; n < 7; ++n)
    for (int m = 0; m <= n; ++m)
      for (int field = 0; field < 2; ++field) EXPECT_EQ(after(field, n, m), (0.5 * n - 1) * before(field, n, m));
}

TEST(ScaleDegrees, MultipliesFieldsByNumbersOfTheirOwn) {
  const Coefficients before = random_coefficients(6, 4, 2);
  Coefficients after = before;
  scale_degrees(after, [](int field, int n) { return field == 3 ? 0.0 : 10.0 * field + n; });
  for (int n = 0; n < 6; ++n)
    for (int m = 0; m <= n; ++m) {
      for (int field = 0; field < 3; ++field) EXPECT_EQ(after(field, n, m), (10.0 * field + n) * before(field, n, m));
      EXPECT_EQ(after(3, n, m), Coefficients::Complex{});
    }
}

}  // namespace
}  // namespace vesiflow::vesicle::scale_degrees_test
