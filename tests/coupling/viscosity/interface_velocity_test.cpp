// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/interface_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "transfer/ellipsoid.h"
#include "transfer/sharp_body.h"

namespace vesiflow::coupling::interface_velocity_test {
namespace {

using test::Ellipsoid;
using test::SharpBody;
using test::SphereFlow;
using test::SphereInBox;
using test::Traction;
using vesicle::VectorField;
using Vector = Eigen::Vector3d;

constexpr double ratios[] = {0.05, 0.2, 1.0, 5.0, 20.0, 100.0};

vesicle::Surface some_surface() {
  vesicle::Surface surface(20);
  surface.update(Ellipsoid({0.8, 1.0, 1.25}, {0.1, -0.2, 0.05}).markers(surface.grid()));
  return surface;
}

template <class Function>
VectorField at_markers(const vesicle::Surface& surface, const Function& function) {
  VectorField field(surface.positions().rows(), 3);
  for (Eigen::Index m = 0; m < field.rows(); ++m)
    field.row(m) = function(Vector(surface.positions().row(m).transpose())).transpose().array();
  return field;
}

Vector rigid(const Vector& x) {
  return Vector(0.3, -0.2, 0.7) + Vector(-0.4, 0.5, 0.1).cross(x);
}

// A body in a fluid that moves as a whole. For a jump q = (1 - ratio) V of another rigid motion V, w is U outside and U - q
// inside, as a rigid motion has no stress: the mean is U - q/2. From any V the motion of the fluid is found at once.
TEST(InterfaceVelocity, RigidMotionsAreFoundInOnePass) {
  const vesicle::Surface surface = some_surface();
  const VectorField exact = at_markers(surface, rigid);
  for (const double ratio : ratios)
    for (const double wrong : {0.0, -0.7, 3.0}) {
      InterfaceVelocity interface(ratio, exact.rows());
      const VectorField guess = wrong * at_markers(surface, [](const Vector& x) {
                                  return Vector(rigid(x) + rigid({1, 2, 3}));
                                });
      interface.set(guess);
      interface.improve(surface, exact - 0.5 * interface.jump());
      EXPECT_LT((interface.value() - exact).abs().maxCoeff(), 1e-12) << ratio;
      EXPECT_LT(interface.improve(surface, exact - 0.5 * interface.jump()), 1e-13) << ratio;
    }
}

// The fixed point of the map is that of 2 w / (1 + ratio), with no flux through the membrane.
TEST(InterfaceVelocity, AVelocityThatAnswersToItselfIsKept) {
  const vesicle::Surface surface = some_surface();
  VectorField velocity = at_markers(
      surface, [](const Vector& x) { return Vector(x[1] * x[2] + x[0], 1 + x[0] * x[1], std::sin(2 * x[0])); });
  velocity -= surface.normal() * (surface.flux(velocity) / surface.area());
  for (const double ratio : ratios) {
    InterfaceVelocity interface(ratio, velocity.rows());
    interface.set(velocity);
    EXPECT_LT(interface.improve(surface, 0.5 * (1.0 + ratio) * velocity), 1e-14);
    EXPECT_LT((interface.value() - velocity).abs().maxCoeff(), 1e-13);
  }
}

TEST(InterfaceVelocity, HasNoFlux) {
  const vesicle::Surface surface = some_surface();
  const VectorField mean =
      at_markers(surface, [](const Vector& x) { return Vector(x[0] * x[0] + x[0], 1 + x[1], x[2]); });
  ASSERT_GT(std::abs(surface.flux(mean)), 5.0);
  for (const double ratio : ratios) {
    InterfaceVelocity interface(ratio, mean.rows());
    for (int pass = 0; pass < 2; ++pass) {
      interface.improve(surface, mean);
      EXPECT_LT(std::abs(surface.flux(interface.value())), 1e-11) << ratio;
    }
  }
}

// What the map changes, over what there is.
TEST(InterfaceVelocity, SaysHowMuchItHasChanged) {
  const vesicle::Surface surface = some_surface();
  const VectorField swirl = at_markers(surface, [](const Vector& x) { return Vector(x[1] * x[2], -x[0] * x[2], 0.0); });
  InterfaceVelocity interface(1.0, swirl.rows());
  EXPECT_EQ(interface.improve(surface, VectorField::Zero(swirl.rows(), 3)), 0.0);
  const VectorField tangential = swirl - surface.normal() * (surface.flux(swirl) / surface.area());
  interface.begin_iteration();
  EXPECT_NEAR(interface.improve(surface, tangential), 1.0, 1e-14);
  interface.begin_iteration();
  EXPECT_NEAR(interface.improve(surface, 2.0 * tangential), 0.5, 1e-14);
}

// Straight in time, over steps of any length.
TEST(InterfaceVelocity, BeginsAStepExtrapolated) {
  const vesicle::Surface surface = some_surface();
  const VectorField start = at_markers(surface, rigid), rate = at_markers(surface, [](const Vector&x) { return x; });
  const auto at = [&](double time) -> VectorField { return start + time * rate; };
  InterfaceVelocity interface(5.0, start.rows());
  interface.set(at(0.0));
  EXPECT_EQ(interface.previous().rows(), 0);
  interface.begin_step(3.0);  // from one value nothing is known of the rate
  EXPECT_TRUE((interface.value() == at(0.0)).all());
  interface.set(at(0.2), interface.previous());
  interface.begin_step(1.5);
  EXPECT_LT((interface.value() - at(0.5)).abs().maxCoeff(), 1e-14);
  EXPECT_TRUE((interface.previous() == at(0.2)).all());
}

// Of an affine map with three eigenvalues besides zero the fixed point is found in four passes and the next, where repeating the map
// leaves 0.95^5 of the error.
TEST(InterfaceVelocity, KnowsFromTheLastPassesWhereTheMapLeads) {
  const vesicle::Surface surface = some_surface();
  const VectorField exact = at_markers(surface, rigid);
  std::vector<VectorField> modes;
  for (const auto& swirl : {Vector(1, 0, 2), Vector(0, 1, -1), Vector(2, 1, 0)})
    modes.push_back(at_markers(surface, [&](const Vector& x) { return Vector(swirl.dot(x) * swirl.cross(x)); }));
  for (VectorField& mode : modes) mode -= surface.normal() * (surface.flux(mode) / surface.area());
  constexpr double eigenvalues[] = {0.95, -0.8, 0.5};
  // Coordinates of what is left: the error stays in the span of the modes.
  const auto error_of = [&](const VectorField& velocity) {
    Eigen::MatrixXd matrix(3 * exact.rows(), 3);
    for (int k = 0; k < 3; ++k) matrix.col(k) = modes[std::size_t(k)].matrix().reshaped();
    return Eigen::Vector3d(matrix.colPivHouseholderQr().solve((velocity - exact).matrix().reshaped()));
  };
  InterfaceVelocity interface(1.0, exact.rows());
  interface.set(exact + modes[0] + 0.5 * modes[1] - modes[2]);
  double residual = 1.0;
  for (int pass = 1; pass <= 5; ++pass) {
    VectorField mapped = exact;
    const Eigen::Vector3d left = error_of(interface.value());
    for (int k = 0; k < 3; ++k) mapped += eigenvalues[k] * left[k] * modes[std::size_t(k)];
    residual = interface.improve(surface, mapped);
  }
  EXPECT_LT(residual, 1e-11);
  EXPECT_LT((interface.value() - exact).abs().maxCoeff(), 1e-10);
}

/// Solves until the velocity of the membrane answers to itself. Returns the number of solves.
int converge(SharpBody& body, const VectorField& force, fluid::NavierStokes& fluid, InterfaceVelocity& interface,
             double tolerance) {
  for (int pass = 1;; ++pass) {
    body.clear(fluid);
    body.put(force, fluid, &interface.jump());
    if (pass == 1)
      fluid.step(1.0);
    else
      fluid.solve_again();
    if (interface.improve(body.surface, body.read(fluid.velocity())) < tolerance || pass == 60) return pass;
  }
}

// On the grid: D is linear, which all differences and interpolations are exact for.
TEST(TwoViscosities, ABodyIsCarriedAlongByAFluidThatMovesAsAWhole) {
  const fluid::Grid grid({-2, -2.2, -2}, {2, 2.2, 2}, {20, 24, 22});
  const vesicle::SphereGrid markers(20);
  for (const double ratio : {0.2, 20.0}) {
    fluid::NavierStokes fluid(grid, test::without_inertia(), [](const fluid::Vector3& x, double) {
      const Vector u = rigid({x[0], x[1], x[2]});
      return fluid::Vector3{u[0], u[1], u[2]};
    });
    SharpBody body(grid, markers, Ellipsoid({0.8, 1.0, 1.25}, {0.1, -0.2, 0.05}).markers(markers), {.degrees = 8});
    const VectorField exact = at_markers(body.surface, rigid), no_force = VectorField::Zero(exact.rows(), 3);
    InterfaceVelocity interface(ratio, exact.rows());
    const int passes = converge(body, no_force, fluid, interface, 1e-5);
    EXPECT_EQ(passes, 2);
    EXPECT_LT((interface.value() - exact).abs().maxCoeff(), 1e-5);
  }
}

struct Mode {
  Traction traction;
  int degree;
  double ratio;
  double error;  ///< measured at 8 cells per radius, in per cent
};
constexpr Mode modes[] = {
    {Traction::normal, 2, 0.2, 0.22},    {Traction::tension, 2, 0.2, 0.57}, {Traction::normal, 4, 0.2, 1.01},
    {Traction::tension, 4, 0.2, 1.73},   {Traction::normal, 2, 5.0, 0.058}, {Traction::tension, 2, 5.0, 0.114},
    {Traction::normal, 4, 5.0, 1.19},    {Traction::tension, 4, 5.0, 1.74}, {Traction::normal, 2, 20.0, 0.019},
    {Traction::tension, 2, 20.0, 0.035}, {Traction::normal, 4, 20.0, 4.05}, {Traction::tension, 4, 20.0, 6.26}};

// A term of Lamb's solution on either side of a sphere, with its own viscosity.
TEST(TwoViscosities, ASphereMovesAsInLambsSolutionToSecondOrder) {
  for (const Mode& mode : modes) {
    const SphereFlow flow(mode.degree, mode.traction, mode.ratio, SphereInBox{}.centre);
    const auto error = [&](double cells_per_radius) {
      const SphereInBox box{cells_per_radius};
      fluid::NavierStokes fluid = flow.fluid(box.grid());
      SharpBody body = box.body();
      InterfaceVelocity interface(mode.ratio, body.surface.positions().rows());
      EXPECT_LT(converge(body, flow.force(body.surface), fluid, interface, 1e-4), 20);
      return test::relative_error(body.surface, interface.value(), flow.velocity(body.surface));
    };
    const double coarse = error(16.0 / 3.0), fine = error(8.0);
    EXPECT_LT(100.0 * fine, 1.2 * mode.error) << mode.degree << ' ' << mode.ratio;
    EXPECT_GT(std::log(coarse / fine) / std::log(1.5), 1.8) << mode.degree << ' ' << mode.ratio;
  }
}

// A heavy sphere whose membrane keeps its area locally sinks as a rigid one, whatever is inside: gravity g z n and the tension
// g z/3 make the traction g/3 along z, that of Stokes' solution with the velocity 2g/9.
TEST(TwoViscosities, AnInextensibleSphereSinksAsARigidOne) {
  const SphereInBox box{16.0 / 3.0};
  const Vector velocity(0.3, -0.2, 0.9);
  const auto stokes = [&](const Vector& x) {
    const double r = x.norm();
    const Vector along = velocity.dot(x) * x / (r * r);
    return Vector(0.75 / r * (velocity + along) + 0.25 / (r * r * r) * (velocity - 3.0 * along));
  };
  for (const double ratio : {0.2, 5.0, 20.0}) {
    fluid::NavierStokes fluid(box.grid(), test::without_inertia(), [&](const fluid::Vector3& x, double) {
      const Vector u = stokes(Vector(x[0], x[1], x[2]) - box.centre);
      return fluid::Vector3{u[0], u[1], u[2]};
    });
    SharpBody body = box.body();
    const VectorField exact = at_markers(body.surface, [&](const Vector&) { return velocity; });
    InterfaceVelocity interface(ratio, exact.rows());
    const int passes = converge(body, 1.5 * exact, fluid, interface, 1e-3);
    const double error = test::relative_error(body.surface, interface.value(), exact);
    EXPECT_LE(passes, 3) << ratio;
    EXPECT_LT(error, 2e-3) << ratio;
  }
}

}  // namespace
}  // namespace vesiflow::coupling::interface_velocity_test
