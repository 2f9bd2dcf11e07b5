// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/phase_inertia.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fluid/operators.h"
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

/// Bodies in a stream that is the same everywhere and speeds up. All phases go with it, so that their accelerations are
/// those of the stream; w = mu u is another on the two sides of each body, and points of the grid are now on one, now on
/// the other.
struct Stream {
  struct Part {
    Vector half_axes, centre;
    double ratio;
  };
  Vector start, growth;
  std::vector<Part> parts;
  Vector curvature = Vector::Zero();

  PhaseSplitting splitting(double reynolds_number) const {
    const auto [least, greatest] = std::ranges::minmax(parts, {}, &Part::ratio);
    return phase_splitting(reynolds_number, std::min(1.0, least.ratio), std::max(1.0, greatest.ratio), false);
  }
  Vector velocity(double t) const { return start + t * growth + 0.5 * t * t * curvature; }
  Vector acceleration(double t) const { return growth + t * curvature; }
  Ellipsoid body(std::size_t part, double t) const {
    return {parts[part].half_axes, parts[part].centre + t * start + 0.5 * t * t * growth + t * t * t / 6.0 * curvature};
  }
  /// That of the part that a point of the box is in, or 1.
  double viscosity(double t, const Vector& x) const {
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const Ellipsoid ellipsoid = body(part, t);
      Vector from = x - ellipsoid.centre();  // in the image that is nearest
      for (int axis = 0; axis < 3; ++axis) from[axis] = std::remainder(from[axis], 4.0);
      if (from.norm() < parts[part].half_axes.maxCoeff() && ellipsoid.closest(ellipsoid.centre() + from).distance < 0.0)
        return parts[part].ratio;
    }
    return 1.0;
  }
  /// w on the grid.
  fluid::FaceVector scaled(double t) const {
    fluid::FaceVector w(periodic_box);
    const auto set = [&](auto& component, int axis) {
      for (int k = -1; k <= component.extent(2); ++k)
        for (int j = -1; j <= component.extent(1); ++j)
          for (int i = -1; i <= component.extent(0); ++i) {
            const fluid::Vector3 at = component.position(i, j, k);
            component(i, j, k) = viscosity(t, {at[0], at[1], at[2]}) * velocity(t)[axis];
          }
    };
    set(w.x, 0);
    set(w.y, 1);
    set(w.z, 2);
    return w;
  }
};

/// What a simulation has of them.
class BodiesInStream {
 public:
  explicit BodiesInStream(const Stream& stream, double more_reach = PhaseInertia::more_reach) : stream_(stream) {
    for (std::size_t part = 0; part < stream.parts.size(); ++part)
      bodies_.push_back(std::make_unique<SharpBody>(periodic_box, markers_, stream.body(part, 0.0).markers(markers_),
                                                    SharpTransfer::Parameters{.more_reach = more_reach}));
  }

  PhaseInertia inertia(double reynolds_number) const {
    std::vector<PhaseInertia::Body> bodies;
    for (std::size_t part = 0; part < bodies_.size(); ++part)
      bodies.push_back({&bodies_[part]->sharp, stream_.parts[part].ratio});
    return {periodic_box, reynolds_number, stream_.splitting(reynolds_number), std::move(bodies), true};
  }
  /// Moves the bodies there and tells them their jumps, as far as that.
  void meet(double t, double reach = std::numeric_limits<double>::infinity()) {
    for (std::size_t part = 0; part < bodies_.size(); ++part) {
      bodies_[part]->move(stream_.body(part, t).markers(markers_));
      bodies_[part]->sharp.update(bodies_[part]->surface, false, reach);
      VectorField jump(markers_.size(), 3);
      jump.rowwise() = ((1.0 - stream_.parts[part].ratio) * stream_.velocity(t)).transpose().array();
      bodies_[part]->sharp.set_force(VectorField::Zero(jump.rows(), 3), &jump);
    }
  }

 private:
  const Stream& stream_;
  vesicle::SphereGrid markers_{16};
  std::vector<std::unique_ptr<SharpBody>> bodies_;
};

/// A fluid that has come from one time to another.
fluid::NavierStokes fluid_at(const Stream& stream, double before, double now) {
  fluid::NavierStokes fluid(periodic_box, {});
  fluid.restore(stream.scaled(now), stream.scaled(before), fluid::Field<fluid::Cell>(periodic_box),
                {.time = now, .previous_time = before, .time_step = now - before, .steps = 1});
  return fluid;
}

/// Largest error of the acceleration that solver and force give to the fluid, over that of the solver alone, and the
/// largest of that.
struct Errors {
  double of_both = 0.0, swept = 0.0;
};
Errors errors_in(const Stream& stream, bool has_earlier_step = false, double more_reach = PhaseInertia::more_reach,
                 double first_reach = std::numeric_limits<double>::infinity()) {
  constexpr double reynolds_number = 3.0, first_dt = 0.05, dt = 0.08, earlier_dt = 0.06;
  constexpr double times[] = {0.0, first_dt, first_dt + dt};
  BodiesInStream bodies(stream, more_reach);
  PhaseInertia inertia = bodies.inertia(reynolds_number);
  if (has_earlier_step) {
    bodies.meet(times[0] - earlier_dt, first_reach);
    inertia.keep(stream.scaled(times[0] - earlier_dt), 0.0);
  }
  bodies.meet(times[0], first_reach);
  inertia.keep(stream.scaled(times[0]), has_earlier_step ? earlier_dt : 0.0);
  bodies.meet(times[1]);
  if (has_earlier_step) inertia.prepare(fluid_at(stream, times[0] - earlier_dt, times[0]), first_dt);
  inertia.keep(stream.scaled(times[1]), first_dt);
  const fluid::NavierStokes fluid = fluid_at(stream, times[0], times[1]);
  bodies.meet(times[2]);
  const double a = inertia.prepare(fluid, dt);
  const double solved = stream.splitting(reynolds_number).solved_reynolds_number;
  const double r = dt / first_dt, c0 = (1 + 2 * r) / (1 + r) / dt, c1 = -(1 + r) / dt, c2 = r * r / (1 + r) / dt;
  EXPECT_NEAR(a, solved * c0, 1e-12 * a);
  fluid::FaceVector force(periodic_box);
  force.fill(0.0);
  inertia.add_to(force);

  const fluid::FaceVector next = stream.scaled(times[2]);
  fluid::FaceVector convection(periodic_box), earlier_convection(periodic_box);
  fluid::convection(fluid.velocity(), convection);
  fluid::convection(fluid.previous_velocity(), earlier_convection);
  Errors errors;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto f = std::as_const(force).points()[c], w2 = next.points()[c], w1 = fluid.velocity().points()[c],
               w0 = fluid.previous_velocity().points()[c];
    const auto n1 = std::as_const(convection).points()[c], n0 = std::as_const(earlier_convection).points()[c];
    const double acceleration = reynolds_number * stream.acceleration(times[2])[static_cast<Eigen::Index>(c)];
    const auto& n = periodic_box.cells;  // the points that a solver reads
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const double unsteady = solved * (c0 * w2(i, j, k) + c1 * w1(i, j, k) + c2 * w0(i, j, k));
          const double convective = solved * ((1.0 + r) * n1(i, j, k) - r * n0(i, j, k));
          errors.of_both = std::max(errors.of_both, std::abs(unsteady + convective - f(i, j, k) - acceleration) / a);
          errors.swept = std::max(errors.swept, std::abs(unsteady) / a);
        }
  }
  return errors;
}

/// What errors of a phase with the share s of the solved acceleration are multiplied by in a step at most, if viscosity alone would make them
/// fade at a rate of `decay`/dt.
double growth_in_a_step(double s, double curvature, double decay) {
  const double rest = 1.5 * (1.0 - s);
  const Eigen::Matrix3d companion{
      {rest * (2.0 + curvature) + 2.0 * s, -rest * (1.0 + 2.0 * curvature) - 0.5 * s, rest * curvature},
      {1.5 + decay, 0.0, 0.0},
      {0.0, 1.5 + decay, 0.0}};
  return (companion / (1.5 + decay)).eigenvalues().cwiseAbs().maxCoeff();
}

// Whatever the wave length.
TEST(PhaseInertia, SolvesForAnAccelerationWithWhichBothPhasesForget) {
  for (const double ratio : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 3.0, 5.0, 5.1, 20.0, 100.0}) {
    for (const bool is_slow : {false, true}) {
      const auto [solved, curvature] = phase_splitting(3.0, std::min(1.0, ratio), std::max(1.0, ratio), is_slow);
      for (const double s : {3.0 / solved, 3.0 / ratio / solved}) {
        EXPECT_LE(growth_in_a_step(s, curvature, 0.0), 1.0 + 1e-12) << ratio;
        for (double decay = 1e-4; decay < 1e4; decay *= 1.2)
          EXPECT_LT(growth_in_a_step(s, curvature, decay), 1.0) << ratio << ' ' << decay;
      }
      EXPECT_EQ(curvature == 1.0, !is_slow && ratio >= 0.5 && ratio <= 5.0) << ratio;
      // Where it is that of the outer phase, nothing is put on the grid away from bodies.
      EXPECT_EQ(solved == 3.0,
                is_slow ? ratio >= 0.4 : (ratio >= 0.4 && ratio < 0.5) || (ratio >= 0.72 && ratio <= 3.5))
          << ratio << ' ' << is_slow;
    }
  }
}

const Vector start(0.9, -0.5, 0.7), growth(2.0, 1.0, -3.0);

TEST(PhaseInertia, GivesBothPhasesTheAccelerationOfAStreamThatCarriesThem) {
  for (const double ratio : {0.2, 5.0, 20.0}) {
    const Stream stream{start, growth, {{{0.7, 0.9, 1.1}, {1.5, -0.2, 0.1}, ratio}}};  // across the end of the box
    const Errors errors = errors_in(stream);
    EXPECT_LT(errors.of_both, 1e-8) << ratio;
    EXPECT_GT(errors.swept, 0.1) << "no point has changed sides";
  }
}

// A step is of second order: what it extrapolates is exact for a velocity of second degree in time.
TEST(PhaseInertia, FollowsAStreamOfSecondDegreeFromThreeTimes) {
  for (const double ratio : {0.5, 2.0, 5.0}) {
    const Stream stream{start, growth, {{{0.7, 0.9, 1.1}, {1.5, -0.2, 0.1}, ratio}}, Vector(20.0, -30.0, 15.0)};
    EXPECT_LT(errors_in(stream, true).of_both, 1e-8) << ratio;
    EXPECT_GT(errors_in(stream).of_both, 1e-3) << ratio;
  }
}

// Of one that moves a tenth of a spacing in the two steps, points know enough as far as forces need it.
TEST(PhaseInertia, GivesASlowBodyItsAccelerationWithTheLeastReach) {
  for (const double ratio : {0.2, 20.0}) {
    const Stream stream{0.1 * start, 0.1 * growth, {{{0.7, 0.9, 1.1}, {1.5, -0.2, 0.1}, ratio}}};
    const Errors errors = errors_in(stream, false, 0.0);
    EXPECT_LT(errors.of_both, 1e-8) << ratio;
    EXPECT_GT(errors.swept, 0.01) << "no point has changed sides";
  }
}

// Boxes that must grow do not know at the times before what has come to them.
TEST(PhaseInertia, GivesTheSameAccelerationWhenBoxesGrow) {
  for (const double ratio : {0.2, 20.0})
    for (const bool has_earlier_step : {false, true}) {
      const Stream stream{0.1 * start, 0.1 * growth, {{{0.7, 0.9, 1.1}, {1.5, -0.2, 0.1}, ratio}}};
      EXPECT_LT(errors_in(stream, has_earlier_step, 4.0, 0.0).of_both, 1e-8) << ratio << has_earlier_step;
    }
}

// Each is continued into its surroundings, which are those of the other one too, and into its inside.
TEST(PhaseInertia, GivesBodiesNextToEachOtherTheSameAcceleration) {
  constexpr double spacing = 0.2, radius = 0.8, other_radius = 0.7;
  const Vector place(1.513, -0.187, 0.104),
      direction = Vector(-1.0, 0.3, -0.2).normalized();  // across the end of the box
  for (const double gap : {0.1 * spacing, spacing, 1.5 * spacing, 2.0 * spacing})
    for (const auto& [first, second] : {std::pair{0.2, 5.0}, {20.0, 0.5}}) {
      const Stream stream{
          start,
          growth,
          {{Vector::Constant(radius), place, first},
           {Vector::Constant(other_radius), place + (radius + gap + other_radius) * direction, second}}};
      const Errors errors = errors_in(stream);
      EXPECT_LT(errors.of_both, 1e-8) << gap << ' ' << first << ' ' << second;
      EXPECT_GT(errors.swept, 0.1);
    }
}

// Flat sides a hundredth of a spacing apart: points are inside of one and within the smooth step of the other.
TEST(PhaseInertia, GivesBodiesInContactTheSameAcceleration) {
  const Vector half_axes(1.0, 1.0, 0.6), place(0.513, -0.187, 0.104);
  const Ellipsoid first(half_axes, place);
  // Its shortest axis: where the surface is closest to a point next to the centre.
  const Vector side = (first.point(first.closest(place + Vector(1e-6, 2e-6, 3e-6)).direction) - place).normalized();
  for (const auto& [inner, other] : {std::pair{0.2, 5.0}, {20.0, 0.5}}) {
    const Stream stream{start, growth, {{half_axes, place, inner}, {half_axes, place + 1.202 * side, other}}};
    EXPECT_LT(errors_in(stream).of_both, 1e-8) << inner << ' ' << other;
  }
}

// Nearly as wide as the period: half a spacing from its own images.
TEST(PhaseInertia, GivesABodyNextToItsImagesTheSameAcceleration) {
  for (const double ratio : {0.2, 20.0}) {
    const Errors errors = errors_in({start, growth, {{Vector::Constant(1.95), {1.513, -0.187, 0.104}, ratio}}});
    EXPECT_LT(errors.of_both, 1e-8) << ratio;
    EXPECT_GT(errors.swept, 0.1);
  }
}

TEST(PhaseInertia, GoesOnFromItsStateAndIsTakenBack) {
  constexpr double dt = 0.05;
  const Stream stream{
      start, growth, {{{0.7, 0.9, 1.1}, {1.5, -0.2, 0.1}, 5.0}, {{0.6, 1.0, 0.8}, {0.0, -0.1, 0.1}, 2.0}}};
  BodiesInStream bodies(stream);
  PhaseInertia whole = bodies.inertia(1.0), restored = bodies.inertia(1.0);
  for (const double t : {-0.8 * dt, 0.0, dt}) {
    bodies.meet(t);
    if (t > 0.0) whole.prepare(fluid_at(stream, -0.8 * dt, 0.0), dt);
    whole.keep(stream.scaled(t), t < 0.0 ? 0.0 : t > 0.0 ? dt : 0.8 * dt);
  }
  const fluid::NavierStokes fluid = fluid_at(stream, 0.0, dt);
  const auto force_of = [&](PhaseInertia& inertia) {
    bodies.meet(2 * dt);
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
  auto outer = whole.outer_state(fluid);
  ASSERT_EQ(outer.size(), 3U);
  auto first = whole.inner_state(0), second = whole.inner_state(1);
  double earlier_step = whole.earlier_step();
  EXPECT_EQ(earlier_step, 0.8 * dt);
  const auto restore = [&] {
    const std::vector<std::vector<double>> inner[] = {first, second};
    restored.restore(outer, inner, earlier_step, fluid);
  };
  restore();
  expect_same(force_of(restored));
  whole.remember();
  whole.keep(stream.scaled(2 * dt), dt);
  whole.prepare(fluid_at(stream, dt, 2 * dt), dt);
  whole.take_back();
  expect_same(force_of(whole));

  EXPECT_THROW(restored.restore({}, {}, 0.0, fluid), std::invalid_argument);
  const auto refuses = [&](double& value, double other) {
    const double before = std::exchange(value, other);
    EXPECT_THROW(restore(), std::invalid_argument) << before << ' ' << other;
    value = before;
  };
  refuses(outer[1].y(3, 4, 5), NAN);
  refuses(second[1][200], INFINITY);
  refuses(earlier_step, -dt);
  refuses(earlier_step, 0.0);               // of two times, and three are given
  refuses(first[0][0], 0.5);                // a box begins at a point
  refuses(first[0][4], 1e5);                // and is no larger than its numbers,
  refuses(first[1][4], first[1][4] + 1.0);  // at both times
  first[0].pop_back();
  EXPECT_THROW(restore(), std::invalid_argument);
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
