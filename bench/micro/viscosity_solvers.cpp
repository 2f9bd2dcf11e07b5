// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The velocity problem of a step whose viscosity is implicit, solved by the solvers that can: iterations, seconds per
// step, factors. A blob of another viscosity moves by a fraction of a cell per step.
//   OMP_NUM_THREADS=1 build/release/bench/viscosity_solvers [--cells N...] [--ratio R...] [--reynolds Re...]
//       [--solver pcg+fft cholmod...] [--form stress|scalar] [--steps K] [--tolerance T]
// Prints JSON. A cholmod solver factors once, at the first step: with iterations and seconds of each later step the
// cost of every schedule of refactoring follows, and of the exact factor as well (factorisation and first solve).
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <omp.h>
#include <CLI/CLI.hpp>

#include "fluid/elliptic_solver.h"
#include "support/timing.h"
#include "support/viscous_blob.h"

namespace {

using namespace vesiflow::fluid;
using namespace vesiflow::bench;

// In a cube six wide, with time steps of a third of the number of cells per unit.
struct Setting {
  int cells;
  double ratio, reynolds_number;
  bool stress;
  std::string solver;
  int steps;
  double tolerance;
};

SolverOptions options_of(const Setting& s) {
  CholmodOptions cholmod;
  cholmod.memory_limit = 3e9;
  cholmod.time_limit = 120.0;
  cholmod.refactor.every = 0;
  PcgOptions pcg;
  pcg.tolerance = s.tolerance;
  if (s.solver == "cholmod") pcg.preconditioner = cholmod;
  return pcg;
}

// Seconds of the CPU.
template <class Call>
double cpu_seconds(Call&& call) {
  return 1e-3 * timed(call).cpu;
}

class Study {
 public:
  explicit Study(const Setting& s)
      : setting_(s),
        grid_({-3, -3, -3}, {3, 3, 3}, {s.cells, s.cells, s.cells}),
        dt_(1.0 / (3.0 * s.cells)),
        alpha_(1.5 * s.reynolds_number / dt_),
        mu_(std::make_shared<Field<Cell>>(grid_)),
        rhs_(grid_),
        now_(grid_),
        before_(grid_),
        guess_(grid_) {}

  // One JSON object.
  void run() {
    const double memory = static_cast<double>(estimate_solver_memory(problem(), options_of(setting_)));
    std::printf(
        " {\"cells\": %d, \"ratio\": %g, \"reynolds_number\": %g, \"form\": \"%s\", \"solver\": \"%s\", "
        "\"tolerance\": %g, \"memory_estimate\": %.3g, ",
        setting_.cells, setting_.ratio, setting_.reynolds_number, setting_.stress ? "stress" : "scalar",
        setting_.solver.c_str(), setting_.tolerance, memory);
    try {
      take_steps();
      print("\"update_seconds\": [", updates_, "%.5f");
      print("], \"solve_seconds\": [", solves_, "%.5f");
      print("], \"iterations\": [", iterations_, "%.0f");
      print("], \"cells_moved\": [", moved_, "%.3f");
      std::printf("]}");
    } catch (const std::exception& error) {
      std::printf("\"refused\": \"%s\"}", error.what());
    }
    std::fflush(stdout);
  }

 private:
  EllipticProblem problem() const {
    const EllipticProblem stress = EllipticProblem::velocity(grid_, EllipticForm::stress, alpha_, mu_);
    if (setting_.stress) return stress;
    return {grid_, Centring::face_x, BoundaryCondition::dirichlet, alpha_, mu_};
  }
  ConstBlocks blocks(const FaceVector& u) const {
    return setting_.stress ? ConstBlocks(u.unknowns()) : ConstBlocks(u.x.unknowns());
  }
  Blocks blocks(FaceVector& u) const { return setting_.stress ? Blocks(u.unknowns()) : Blocks(u.x.unknowns()); }

  void take_steps() {
    std::unique_ptr<EllipticSolver> solver;
    for (int k = 0; k < setting_.steps; ++k) {
      const double t = k * dt_;
      set_viscosity(ViscousBlob(setting_.ratio, grid_.spacing(0), t), *mu_);
      set_right_hand_side(t);
      updates_.push_back(cpu_seconds([&] {
        if (solver) {
          solver->update(problem());
        } else {
          solver = make_elliptic_solver(problem(), options_of(setting_));
        }
      }));
      SolveReport report;
      solves_.push_back(cpu_seconds([&] {
        extrapolate();
        report = solver->solve(blocks(std::as_const(rhs_)), blocks(guess_));
      }));
      iterations_.push_back(report.converged ? report.iterations : -report.iterations);
      moved_.push_back(std::hypot(0.3, 0.1) * t / grid_.spacing(0));
      std::swap(before_, now_);
      std::swap(now_, guess_);
    }
  }

  // The force of the blob, and inertia: a times a smooth flow.
  void set_right_hand_side(double t) {
    set_force(ViscousBlob(setting_.ratio, grid_.spacing(0), t), 1.0, rhs_);
    const double a = alpha_;
    const auto add = [&](auto& field, auto function) {
      for (int k = 0; k < field.extent(2); ++k) {
        for (int j = 0; j < field.extent(1); ++j) {
          for (int i = 0; i < field.extent(0); ++i) field(i, j, k) += a * function(field.position(i, j, k));
        }
      }
    };
    add(rhs_.x, [t](const Vector3& r) { return std::cos(r[1]) * std::sin(r[2] + t); });
    add(rhs_.y, [t](const Vector3& r) { return 0.3 * std::sin(r[0] - t) * std::cos(r[2]); });
    add(rhs_.z, [](const Vector3& r) { return 0.2 * std::sin(r[0]) * std::cos(r[1]); });
  }

  // 2 u^k - u^{k-1}, as the step does; zero at the first step.
  void extrapolate() {
    const auto field = [](const auto& now, const auto& before, auto& guess) {
      for (std::size_t i = 0; i < now.size(); ++i) guess.data()[i] = 2.0 * now.data()[i] - before.data()[i];
    };
    field(now_.x, before_.x, guess_.x);
    field(now_.y, before_.y, guess_.y);
    field(now_.z, before_.z, guess_.z);
  }

  static void print(const char* heading, const std::vector<double>& values, const char* format) {
    std::printf("%s", heading);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) std::printf(", ");
      std::printf(format, values[i]);
    }
  }

  Setting setting_;
  Grid grid_;
  double dt_, alpha_;
  std::shared_ptr<Field<Cell>> mu_;
  FaceVector rhs_, now_, before_, guess_;
  std::vector<double> updates_, solves_, iterations_, moved_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{32, 64, 128};
  std::vector<double> ratios{5, 20, 100};
  std::vector<double> reynolds_numbers{1e-3, 1.0};
  std::vector<std::string> solvers{"pcg+fft", "cholmod"};
  std::string form = "stress";
  int steps = 6;
  double tolerance = 1e-10;
  CLI::App app("Solvers of the implicit velocity problem with a field of viscosity");
  app.add_option("--cells", sizes, "cells along each axis");
  app.add_option("--ratio", ratios, "of viscosities");
  app.add_option("--reynolds", reynolds_numbers, "Reynolds numbers");
  app.add_option("--solver", solvers, "solvers")->check(CLI::IsMember({"pcg+fft", "cholmod"}));
  app.add_option("--form", form, "the coupled velocity problem, or one component with div(mu grad u)")
      ->check(CLI::IsMember({"stress", "scalar"}));
  app.add_option("--steps", steps, "time steps")->check(CLI::PositiveNumber);
  app.add_option("--tolerance", tolerance, "of the iteration")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);

  omp_set_num_threads(1);
  std::printf("[\n");
  bool first = true;
  for (const int cells : sizes) {
    for (const std::string& solver : solvers) {
      for (const double ratio : ratios) {
        for (const double reynolds_number : reynolds_numbers) {
          if (!first) std::printf(",\n");
          first = false;
          Study({cells, ratio, reynolds_number, form == "stress", solver, steps, tolerance}).run();
        }
      }
    }
  }
  std::printf("\n]\n");
  return 0;
}
