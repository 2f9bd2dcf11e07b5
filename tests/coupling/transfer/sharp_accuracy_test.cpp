// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// How good the velocity of a sharp membrane is: against flows in closed form, and as the membrane moves through the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "transfer/sharp_body.h"
#include "transfer/sharp_transfer.h"

namespace vesiflow::coupling::sharp_accuracy_test {
namespace {

using test::SharpBody;
using test::SphereFlow;
using test::SphereInBox;
using test::Traction;
using vesicle::VectorField;

double sharp_error(const SphereInBox& box, const SphereFlow& flow) {
  fluid::NavierStokes fluid = flow.fluid(box.grid());
  SharpBody body = box.body();
  body.put(flow.force(body.surface), fluid);
  fluid.step(1.0);
  return test::relative_error(body.surface, body.read(fluid.velocity()), flow.velocity(body.surface));
}

double delta_error(const SphereInBox& box, const SphereFlow& flow) {
  fluid::NavierStokes fluid = flow.fluid(box.grid());
  SharpBody body = box.body();
  body.delta.spread(flow.force(body.surface), body.surface.area_weight(), fluid.force());
  fluid.step(1.0);
  VectorField velocity = VectorField::Zero(body.surface.positions().rows(), 3);
  body.delta.interpolate(fluid.velocity(), velocity);
  return test::relative_error(body.surface, velocity, flow.velocity(body.surface));
}

struct Mode {
  Traction traction;
  int degree;
  double error;  ///< measured at 8 cells per radius, in per cent
};
// Where all is exact but the method, walls included.
constexpr Mode modes[] = {{Traction::normal, 2, 0.14},
                          {Traction::normal, 4, 0.72},
                          {Traction::tension, 2, 0.29},
                          {Traction::tension, 4, 1.27}};

/// Root mean square over places of the sphere between the points of the grid, on which the error depends.
double sharp_error(double cells_per_radius, const Mode& mode) {
  double squares = 0.0;
  constexpr int places = 4;
  for (int place = 0; place < places; ++place) {
    const double part = (place + 0.5) / (places * cells_per_radius);
    const SphereInBox box{cells_per_radius, {part, -0.7 * part, 0.4 * part}};
    const double error = sharp_error(box, SphereFlow(mode.degree, mode.traction, 1.0, box.centre));
    squares += error * error;
  }
  return std::sqrt(squares / places);
}

TEST(SharpAccuracy, ASphereMovesAsInLambsSolutionToSecondOrder) {
  for (const Mode& mode : modes) {
    const double coarse = sharp_error(16.0 / 3.0, mode), middle = sharp_error(8.0, mode);
    const double fine = sharp_error(32.0 / 3.0, mode);
    EXPECT_LT(100.0 * middle, 1.2 * mode.error) << mode.degree;
    EXPECT_GT(std::log2(coarse / fine), 1.8) << mode.degree;
  }
}

TEST(SharpAccuracy, IsFarAboveThatOfADeltaFunction) {
  for (const Mode& mode : modes) {
    const SphereFlow flow(mode.degree, mode.traction, 1.0, SphereInBox{}.centre);
    const double d = delta_error({8.0}, flow);
    EXPECT_GT(100.0 * d, 10.0 * mode.error) << mode.degree;
  }
}

}  // namespace
}  // namespace vesiflow::coupling::sharp_accuracy_test
