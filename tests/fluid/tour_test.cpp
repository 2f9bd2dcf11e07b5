// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What docs/fluid.md shows: its programs run, and what it says of wrong input is what comes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "fluid/stokes.h"

namespace vesiflow::fluid::tour_test {
namespace {

// Without indentation, and without the backslashes that bars need in tables.
std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream stream(path);
  EXPECT_TRUE(stream) << path;
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    for (std::size_t bar; (bar = line.find("\\|")) != std::string::npos;) line.erase(bar, 1);
    const auto first = line.find_first_not_of(' ');
    lines.push_back(first == std::string::npos ? "" : line.substr(first));
  }
  return lines;
}

const std::string page = std::string(VESIFLOW_DOCS) + "/fluid.md";

// Up to indentation, every piece of C++ on the page is in a program that is compiled and run.
TEST(TourOfLibfluid, ShowsWhatIsTested) {
  const auto here = lines_of(VESIFLOW_TESTS "/fluid/tour_test.cpp");
  const auto program = lines_of(VESIFLOW_TESTS "/install_consumer/fluid/main.cpp");
  const auto shown = lines_of(page);
  int pieces = 0;
  for (auto at = shown.begin(); (at = std::find(at, shown.end(), "```cpp")) != shown.end();) {
    const auto end = std::find(at, shown.end(), "```");
    const std::vector<std::string> piece(at + 1, end);
    const auto is_in = [&](const std::vector<std::string>& file) {
      return std::search(file.begin(), file.end(), piece.begin(), piece.end()) != file.end();
    };
    EXPECT_TRUE(is_in(here) || is_in(program)) << "neither here nor in install_consumer:\n" << piece.front();
    at = end;
    ++pieces;
  }
  EXPECT_GE(pieces, 5);
}

TEST(TourOfLibfluid, Fields) {
  // Walls at z = 0 and 1.
  const Grid grid({0, 0, 0}, {2, 2, 1}, {32, 32, 16}, {.periodic = {true, true, false}});
  Field<Cell> p(grid);  // zero, ghosts too
  FaceVector u(grid);   // u.x, u.y, u.z
  const double shear_rate = 3;
  for (int k = 0; k < u.x.extent(2); ++k)
    for (int j = 0; j < u.x.extent(1); ++j)
      for (int i = 0; i < u.x.extent(0); ++i) u.x(i, j, k) = shear_rate * u.x.position(i, j, k)[2];
  divergence(u, p);
  double largest = max_divergence(u);

  EXPECT_EQ(u.x.extent(0), 33);
  EXPECT_EQ(u.x.extent(2), 16);
  EXPECT_EQ(largest, 0.0);
}

TEST(TourOfLibfluid, HalfABox) {
  const auto moving = [](const Vector3& r, double) { return Vector3{r[2] * (4 - r[1] * r[1]), 0, 0}; };
  const Grid whole({-4, -2, -2}, {4, 2, 2}, {32, 24, 16});
  const Grid half({-4, 0, -2}, {4, 2, 2}, {32, 12, 16}, {.mirror = {false, true, false}});
  NavierStokes in_whole(whole, {}, moving), in_half(half, {}, moving);
  for (int step = 0; step < 20; ++step) {
    in_whole.step(0.05);
    in_half.step(0.05);
  }
  const double u = in_whole.velocity().x(16, 12 + 3, 10);
  const double same = in_half.velocity().x(16, 3, 10);  // to round-off

  EXPECT_GT(std::abs(u), 0.1);
  EXPECT_NEAR(u, same, 1e-14);
}

TEST(TourOfLibfluid, ViscosityThatMoves) {
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {12, 12, 12});
  const auto drop = [&](const Vector3& centre) {
    return [=, &grid](const Vector3& r) {
      const double distance = std::hypot(r[0] - centre[0], r[1] - centre[1], r[2] - centre[2]) - 0.5;
      return 1 + 2 * (1 - std::tanh(distance / grid.spacing(0)));
    };
  };
  const auto shear = [](const Vector3& r, double) { return Vector3{r[2], 0, 0}; };

  const auto mu = sample_viscosity(grid, drop({0, 0, 0}));  // shared: the flow reads it, you may change it
  NavierStokes flow(grid, {.viscosity = mu, .viscous_treatment = ViscousTreatment::implicit}, shear);
  flow.step(0.01);
  const auto moved = sample_viscosity(grid, drop({0.1, 0, 0}));
  std::copy_n(moved->data(), moved->size(), mu->data());  // into the same field, which the flow looks into
  flow.step(0.01);

  EXPECT_EQ(flow.steps(), 2);
  EXPECT_EQ(&flow.parameters().viscosity.field(), mu.get());
}

TEST(TourOfLibfluid, StokesFlow) {
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {12, 12, 12});
  const auto mu = sample_viscosity(grid, [](const Vector3& r) { return r[2] > 0 ? 5.0 : 1.0; });
  const auto shear = [](const Vector3& r, double) { return Vector3{r[2], 0, 0}; };

  StokesSolver stokes(grid, {.tolerance = 1e-8});
  stokes.update(mu);
  FaceVector force(grid), u(grid);
  Field<Cell> p(grid);
  const StokesReport report = stokes.solve(force, WallVelocity(grid, shear), u, p);

  EXPECT_TRUE(report.converged);
}

TEST(TourOfLibfluid, EllipticProblemOfOnesOwn) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {12, 12, 12});
  const auto mu = sample_viscosity(grid, [](const Vector3& r) { return 1 + r[0]; });

  // x - div(mu grad x) = b at the cell centres, no flux through the walls
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 1.0, mu);
  const auto solver = make_elliptic_solver(problem, AutoOptions{});
  Field<Cell> b(grid), x(grid);
  b.fill(2.0);
  const SolveReport report = solver->solve(b.unknowns(), x.unknowns());
  const double residual = relative_residual(problem, b.unknowns(), x.unknowns());

  EXPECT_TRUE(report.converged);
  EXPECT_LT(residual, 1e-9);
  EXPECT_NEAR(x(3, 4, 5), 2.0, 1e-9);
}

TEST(TourOfLibfluid, ChoiceOfASolver) {
  const Grid grid({-3, -3, -3}, {3, 3, 3}, {64, 64, 64});
  const auto mu =
      sample_viscosity(grid, [](const Vector3& r) { return std::hypot(r[0], r[1], r[2]) < 1 ? 20.0 : 1.0; });

  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, mu);
  const ChosenSolver choice = choose_solver(problem, {.memory_limit = 4e9});
  std::string what = name(choice.options), why = choice.reason;

  EXPECT_EQ(what, "pcg+fft");
#ifdef VESIFLOW_WITH_CHOLMOD
  const auto shown = lines_of(page);
  EXPECT_NE(std::find(shown.begin(), shown.end(), why), shown.end()) << why;
#endif
}

std::string message_of(const std::function<void()>& wrong) {
  try {
    wrong();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing is thrown";
}

// The answers in the table of the page, word by word.
TEST(TourOfLibfluid, AnswersWrongInputAsItSays) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {8, 8, 8});
  const Grid large({-1, -1, -1}, {1, 1, 1}, {128, 128, 128});
  const Grid channel({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {true, false, false}});
  const Grid half({-1, 0, -1}, {1, 1, 1}, {8, 4, 8}, {.mirror = {false, true, false}});
  const auto rest = [](const Vector3&, double) { return Vector3{}; };
  const auto field = [&](double value) {
    const auto mu = sample_viscosity(grid, [](const Vector3&) { return 2.0; });
    (*mu)(3, 4, 5) = value;
    return mu;
  };
  const auto no_ghosts = [&] {
    const auto mu = std::make_shared<Field<Cell>>(grid);
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) (*mu)(i, j, k) = 1.0;
    return mu;
  };
  const auto stress = [](const Grid& g, Viscosity mu) {
    return EllipticProblem::velocity(g, EllipticForm::stress, 1.0, mu);
  };
  const std::function<void()> wrong[] = {
      [&] {
        Grid({0, 0, 0}, {1, 0, 1}, {8, 8, 8});
      },
      [&] {
        Grid({0, 0, 0}, {1, 1, 1}, {8, 3, 8});
      },
      [&] {
        Grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {false, true, false}, .mirror = {false, true, false}});
      },
      [&] { NavierStokes(half, {}, [](const Vector3&, double) {
              return Vector3{0, 1, 0};
            }); },
      [&] { NavierStokes(grid, {.reynolds_number = 0}, rest); },
      [&] { NavierStokes(grid, {.viscosity = -1}, rest); },
      [&] { NavierStokes(grid, {.viscosity = field(nan)}, rest); },
      [&] { NavierStokes(grid, {.viscosity = field(0)}, rest); },
      [&] { NavierStokes(grid, {.viscosity = no_ghosts()}, rest); },
      [&] { NavierStokes(large, {.viscosity = field(2)}, rest); },
      [&] { NavierStokes(grid, {}); },
      [&] { NavierStokes(grid, {}, [](const Vector3& r, double) {
              return Vector3{r[0], 0, 0};
            }); },
      [&] { NavierStokes(channel, {}, [](const Vector3& r, double) {
              return Vector3{0, 0, r[0]};
            }); },
      [&] { NavierStokes(grid, {}, [](const Vector3&, double) {
              return Vector3{nan, 0, 0};
            }); },
      [&] { NavierStokes(grid, {}, rest).step(0); },
      [&] {
        NavierStokes flow(grid, {}, rest);
        flow.force().x(3, 3, 3) = nan;
        flow.step(0.01);
      },
      [&] { make_elliptic_solver(stress(grid, 1), FftOptions{}); },
      [&] {
        make_elliptic_solver(EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, 0, field(2)),
                             FftOptions{});
      },
      [&] { EllipticProblem(grid, Centring::face_x, BoundaryCondition::neumann, 0, 1); },
      [&] {
        const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 0, 1);
        Field<Cell> b(grid);
        b(1, 2, 3) = nan;
        make_elliptic_solver(problem, FftOptions{})->solve(b.unknowns(), b.unknowns());
      },
      [&] { make_elliptic_solver(stress(grid, 1), PcgOptions{.tolerance = 0}); },
#ifdef VESIFLOW_WITH_CHOLMOD
      [&] {
        make_elliptic_solver(EllipticProblem(large, Centring::cell, BoundaryCondition::neumann, 0, 1),
                             CholmodOptions{});
      },
      [&] { make_elliptic_solver(stress(large, 1), CholmodOptions{}); },
#endif
      [&] {
        NavierStokes flow(grid,
                          {.viscosity = field(2),
                           .viscous_treatment = ViscousTreatment::implicit,
                           .velocity_solver = PcgOptions{.max_iterations = 1}},
                          [](const Vector3& r, double) {
                            return Vector3{std::sin(r[2]), 0, 0};
                          });
        flow.step(1.0);
      },
      [&] {
        NavierStokes flow(grid, {.viscosity = field(20), .inertia = Inertia::none, .stokes = {.max_iterations = 2}},
                          [](const Vector3& r, double) {
                            return Vector3{std::sin(r[2]), 0, 0};
                          });
        flow.step(1.0);
      },
      [&] { StokesSolver(grid, {.tolerance = 0}); },
  };
  const auto shown = lines_of(page);
  for (const auto& make : wrong) {
    const std::string message = message_of(make);
    // Up to the digits of residuals, which depend on the compiler.
    const auto residual = message.find("residual of ");
    std::string quoted = "`";
    quoted.append(message, 0, residual);
    if (residual == std::string::npos) quoted += '`';
    const bool found = std::any_of(shown.begin(), shown.end(),
                                   [&](const std::string& line) { return line.find(quoted) != std::string::npos; });
    EXPECT_TRUE(found) << "not in docs/fluid.md:\n" << message;
  }
}

}  // namespace
}  // namespace vesiflow::fluid::tour_test
