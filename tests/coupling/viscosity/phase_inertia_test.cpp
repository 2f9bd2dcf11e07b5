// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/phase_inertia.h"

#include <gtest/gtest.h>

#include <cmath>

#include "transfer/ellipsoid.h"
#include "transfer/sharp_body.h"
#include "viscosity/rigid_response.h"

namespace vesiflow::coupling::phase_inertia_test {
namespace {

using test::Ellipsoid;
using test::SharpBody;
using vesicle::VectorField;
using Vector = Eigen::Vector3d;

const fluid::Grid periodic_box({-2, -2, -2}, {2, 2, 2}, {20, 20, 20}, {true, true, true});

/// A body in a stream that is the same everywhere and speeds up. Both phases go with it, so that their accelerations are those
/// of the stream; w = mu u is another on its two sides, and points of the grid are now on one, now on the other.
struct Stream {
  Vector start, growth;
  double ratio;

  Vector velocity(double t) const { return start + t * growth; }
  Ellipsoid body(double t) const {
    // Across the end of the box.
    return {{0.7, 0.9, 1.1}, Vector(1.5, -0.2, 0.1) + t * start + 0.5 * t * t * growth};
  }
  /// w on the grid.
  fluid::FaceVector scaled(double t) const {
    fluid::FaceVector w(periodic_box);
    const auto set = [&](auto& component, int axis) {
      const double u = velocity(t)[axis];
      for (int k = -1; k <= component.extent(2); ++k)
        for (int j = -1; j <= component.extent(1); ++j)
          for (int i = -1; i <= component.extent(0); ++i) {
            const fluid::Vector3 at = component.position(i, j, k);
            bool inside = false;
            for (const double image : {-4.0, 0.0, 4.0})
              inside = inside || body(t).closest(Vector(at[0] + image, at[1], at[2])).distance < 0.0;
            component(i, j, k) = inside ? ratio * u : u;
          }
    };
    set(w.x, 0);
    set(w.y, 1);
    set(w.z, 2);
    return w;
  }
  /// Moves the body there and tells it its jump.
  void meet(double t, SharpBody& at) const {
    at.move(body(t).markers(at.surface.grid()));
    VectorField jump(at.surface.positions().rows(), 3);
    jump.rowwise() = ((1.0 - ratio) * velocity(t)).transpose().array();
    at.sharp.set_force(VectorField::Zero(jump.rows(), 3), &jump);
  }
};

TEST(PhaseInertia, GivesBothPhasesTheAccelerationOfAStreamThatCarriesThem) {
  constexpr double reynolds_number = 3.0, first_dt = 0.05, dt = 0.08;
  constexpr double times[] = {0.0, first_dt, first_dt + dt};
  const vesicle::SphereGrid markers(16);
  for (const double ratio : {0.2, 5.0, 20.0}) {
    const Stream stream{{0.9, -0.5, 0.7}, {2.0, 1.0, -3.0}, ratio};
    SharpBody body(periodic_box, markers, stream.body(0.0).markers(markers), {.more_reach = PhaseInertia::more_reach});
    PhaseInertia inertia(periodic_box, reynolds_number, {{&body.sharp, ratio}}, true);
    for (const double t : {times[0], times[1]}) {
      stream.meet(t, body);
      inertia.keep(stream.scaled(t));
    }
    fluid::NavierStokes fluid(periodic_box, {});
    fluid.restore(stream.scaled(times[1]), stream.scaled(times[0]), fluid::Field<fluid::Cell>(periodic_box),
                  {.time = times[1], .previous_time = times[0], .time_step = first_dt, .steps = 1});
    stream.meet(times[2], body);
    const double a = inertia.prepare(fluid, dt);
    const double solved = PhaseInertia::solved_reynolds_number(reynolds_number, ratio);
    const double r = dt / first_dt, c0 = (1 + 2 * r) / (1 + r) / dt, c1 = -(1 + r) / dt, c2 = r * r / (1 + r) / dt;
    EXPECT_NEAR(a, solved * c0, 1e-12 * a);
    fluid::FaceVector force(periodic_box);
    force.fill(0.0);
    inertia.add_to(force);

    const fluid::FaceVector next = stream.scaled(times[2]);
    double error = 0.0, swept = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto f = std::as_const(force).points()[c], w2 = next.points()[c], w1 = fluid.velocity().points()[c],
                 w0 = fluid.previous_velocity().points()[c];
      const double acceleration = reynolds_number * stream.growth[static_cast<Eigen::Index>(c)];
      for (int k = 0; k < f.extent[2]; ++k)
        for (int j = 0; j < f.extent[1]; ++j)
          for (int i = 0; i < f.extent[0]; ++i) {
            const double of_solver = solved * (c0 * w2(i, j, k) + c1 * w1(i, j, k) + c2 * w0(i, j, k));
            error = std::max(error, std::abs(of_solver - f(i, j, k) - acceleration));
            swept = std::max(swept, std::abs(of_solver));
          }
    }
    EXPECT_LT(error, 1e-8 * a) << ratio;
    EXPECT_GT(swept, 0.1 * a) << "no point has changed sides";
  }
}

TEST(PhaseInertia, GoesOnFromItsStateAndIsTakenBack) {
  constexpr double dt = 0.05, ratio = 5.0;
  const vesicle::SphereGrid markers(16);
  const Stream stream{{0.9, -0.5, 0.7}, {2.0, 1.0, -3.0}, ratio};
  SharpBody body(periodic_box, markers, stream.body(0.0).markers(markers), {.more_reach = PhaseInertia::more_reach});
  const auto make = [&] { return PhaseInertia(periodic_box, 1.0, {{&body.sharp, ratio}}, true); };
  PhaseInertia whole = make(), restored = make();
  for (const double t : {0.0, dt}) {
    stream.meet(t, body);
    whole.keep(stream.scaled(t));
  }
  fluid::NavierStokes fluid(periodic_box, {});
  fluid.restore(stream.scaled(dt), stream.scaled(0.0), fluid::Field<fluid::Cell>(periodic_box),
                {.time = dt, .previous_time = 0.0, .time_step = dt, .steps = 1});
  const auto force_of = [&](PhaseInertia& inertia) {
    stream.meet(2 * dt, body);
    inertia.prepare(fluid, dt);
    fluid::FaceVector force(periodic_box);
    force.fill(0.0);
    inertia.add_to(force);
    return force;
  };
  const fluid::FaceVector expected = force_of(whole);
  const auto expect_same = [&](const fluid::FaceVector& found) {
    EXPECT_TRUE(std::equal(found.x.data(), found.x.data() + found.x.size(), expected.x.data()));
    EXPECT_TRUE(std::equal(found.z.data(), found.z.data() + found.z.size(), expected.z.data()));
  };
  restored.restore(whole.state(), fluid);
  expect_same(force_of(restored));
  whole.remember();
  whole.keep(stream.scaled(2 * dt));
  whole.take_back();
  expect_same(force_of(whole));

  EXPECT_THROW(restored.restore({}, fluid), std::invalid_argument);
  auto spoilt = whole.state();
  spoilt[2].y(3, 4, 5) = NAN;
  EXPECT_THROW(restored.restore(spoilt, fluid), std::invalid_argument);
}

TEST(RigidResponse, HasTheLimitsOfViscousAndIdealFluids) {
  for (const double a : {0.0, 1e-9, 1e-6}) {
    EXPECT_NEAR(rigid_response(a).translation, -0.5, 1e-6);
    EXPECT_NEAR(rigid_response(a).rotation, -0.5, 1e-6);
  }
  // Potential flow: -1/3 of the jump inside and 2/3 outside along the normal, and -1/3 on both sides along the sphere, with layers that
  // share the rest evenly: (1/6 - 2/3)/3 of it. Nothing turns.
  EXPECT_NEAR(rigid_response(1e10).translation, -1.0 / 6.0, 1e-4);
  EXPECT_NEAR(rigid_response(1e10).rotation, 0.0, 1e-4);
}

/// What a step from rest makes of the jump of a sphere that turns, or moves along: the mean of both sides over the jump.
double share_on_grid(double half, int cells, double a, bool turns) {
  const fluid::Grid box({-half, -half, -half}, {half, half, half}, {cells, cells, cells}, {true, true, true});
  const vesicle::SphereGrid markers(16);
  SharpBody body(box, markers, vesicle::sphere(markers, {}));
  const VectorField& x = body.surface.positions();
  VectorField jump = VectorField::Zero(x.rows(), 3);
  if (turns) {
    jump.col(0) = -x.col(1);
    jump.col(1) = x.col(0);
  } else {
    jump.col(2) = 1.0;
  }
  fluid::FluidParameters parameters;
  parameters.inertia = fluid::Inertia::unsteady;
  fluid::NavierStokes fluid(box, parameters);
  body.put(VectorField::Zero(x.rows(), 3), fluid, &jump);
  fluid.step(1.0 / a);
  const VectorField mean = body.read(fluid.velocity());
  return ((mean * jump).rowwise().sum() * body.surface.area_weight()).sum() /
         (jump.square().rowwise().sum() * body.surface.area_weight()).sum();
}

// The problem that the response solves. To first order in the spacing, as jumps of second derivatives are taken for those of two phases
// whose accelerations agree, and here a [w] is between them. The flow of a sphere that moves along is a dipole, which a periodic box of
// zero mean flow weakens by 2/3 of the volume of the sphere over that of the box.
TEST(RigidResponse, IsThatOfASphereOnAGrid) {
  for (const double a : {6.0, 20.0})
    for (const bool turns : {false, true}) {
      const double half = turns ? 3.0 : 4.0;
      const RigidResponse response = rigid_response(a);
      const double of_box = turns ? 0.0 : 2.0 / 3.0 * (4.0 / 3.0 * M_PI) / std::pow(2.0 * half, 3);
      EXPECT_NEAR(share_on_grid(half, 72, a, turns), (turns ? response.rotation : response.translation) + of_box, 0.01)
          << a << turns;
    }
}

}  // namespace
}  // namespace vesiflow::coupling::phase_inertia_test
