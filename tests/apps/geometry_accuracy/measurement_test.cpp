// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "measurement.h"

#include <gtest/gtest.h>

#include "known_surfaces.h"
#include "paper_table.h"
#include "targets.h"

namespace {

using namespace vesiflow::vesicle;

const LaplacianOptions cartesian = {LaplacianForm::cartesian, Upsampling::twice, false};
const LaplacianOptions paper_raw = {LaplacianForm::paper, Upsampling::none, false};
const LaplacianOptions paper_upsampled = LaplacianOptions::of_the_paper();

Surfaces surfaces_of_the_paper() {
  Surfaces surfaces;
  for (const char* name : {"sphere", "ellipsoid", "y32"}) surfaces.push_back(make_known_surface(name));
  return surfaces;
}

TEST(GeometryAccuracy, TargetsAtThirtyTwoAndSixtyFour) {
  const Surfaces surfaces = surfaces_of_the_paper();
  const auto measurements = measure(surfaces, {32, 64}, 1, {cartesian});
  ASSERT_EQ(measurements.size(), 6u);
  for (const Measurement& m : measurements)
    for (const Verdict& verdict : verdicts(m)) {
      // What N latitudes cannot represent no evaluation from them can give: Verdict names it.
      const bool beyond = m.surface->name() == "y32" && m.latitudes == 32;
      EXPECT_EQ(verdict.met(), !beyond) << m.surface->name() << " " << m.latitudes << " " << verdict.quantity << " "
                                        << verdict.found << " against " << verdict.limit;
      EXPECT_EQ(verdict.reason.empty(), verdict.met());
    }
}

// The surface with exact coefficients, cut to the degrees of the grid, is as far off as the one sampled on it.
TEST(GeometryAccuracy, Y32OnFewLatitudesIsLimitedByItsTruncation) {
  const Surfaces surfaces = surfaces_of_the_paper();
  for (const Measurement& m : measure(surfaces, {16, 32}, 1, {cartesian})) {
    if (m.surface->name() != "y32") continue;
    const double paper = paper_row("y32", m.latitudes)->mean;
    EXPECT_GT(m.truncated_surface.mean, paper / 2);
    EXPECT_LT(m.mean, 2 * m.truncated_surface.mean);
    EXPECT_GT(m.mean, m.truncated_surface.mean / 2);
  }
}

TEST(GeometryAccuracy, FineSamplingMeetsAllTargetsOfCurvature) {
  const Surfaces surfaces = surfaces_of_the_paper();
  for (const Measurement& m : measure(surfaces, {16, 32}, 2, {cartesian}))
    for (const Verdict& verdict : verdicts(m))
      EXPECT_TRUE(verdict.met()) << m.surface->name() << " " << m.latitudes << " " << verdict.quantity << " "
                                 << verdict.found << " against " << verdict.limit;
}

// Table 1 itself, to the digits printed: its columns are Eq. (14) without upsampling and the paper's upsampling algorithm.
TEST(GeometryAccuracy, PaperFormsReproduceTable1) {
  const Surfaces surfaces = surfaces_of_the_paper();
  for (const Measurement& m : measure(surfaces, {64}, 1, {paper_raw, paper_upsampled})) {
    if (m.surface->name() == "sphere") continue;  // rounding alone
    const PaperRow* const paper = paper_row(m.surface->name(), m.latitudes);
    EXPECT_NEAR(m.laplacians[0].error, paper->laplacian, 0.005 * paper->laplacian);
    EXPECT_NEAR(m.laplacians[1].error, paper->laplacian_upsampled, 0.005 * paper->laplacian_upsampled);
  }
}

TEST(GeometryAccuracy, FineSamplingKnowsOnlyTheFormItComputes) {
  EXPECT_TRUE(measurable(cartesian, 2));
  EXPECT_FALSE(measurable(paper_raw, 2));
  EXPECT_FALSE(measurable({LaplacianForm::cartesian, Upsampling::none, false}, 2));
  EXPECT_FALSE(measurable({LaplacianForm::cartesian, Upsampling::twice, true}, 2));
  EXPECT_TRUE(measurable(paper_raw, 1));
}

}  // namespace
