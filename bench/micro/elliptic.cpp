// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "fft" solver of elliptic problems against FFTW's three-dimensional real-to-real transforms and against the memory
// bandwidth, in one run.
//   build/release/bench/elliptic [--cells X Y Z]... [--repetitions R] [--planning estimate|measure|patient] [--json]
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <omp.h>
#include <CLI/CLI.hpp>

#include "fluid/elliptic_solver.h"
#include "support/timing.h"
#include "support/yardsticks.h"

namespace {

using namespace vesiflow::fluid;
using namespace vesiflow::bench;

struct Case {
  const char* name;
  Centring centring;
  BoundaryCondition boundary;
  std::array<bool, 3> periodic;
  std::array<bool, 3> mirror = {false, false, false};
};

constexpr auto dirichlet = BoundaryCondition::dirichlet;
constexpr auto neumann = BoundaryCondition::neumann;
const Case cases[] = {{"pressure", Centring::cell, neumann, {false, false, false}},
                      {"u", Centring::face_x, dirichlet, {false, false, false}},
                      {"v", Centring::face_y, dirichlet, {false, false, false}},
                      {"w", Centring::face_z, dirichlet, {false, false, false}},
                      {"pressure, x periodic", Centring::cell, neumann, {true, false, false}},
                      {"pressure, x y periodic", Centring::cell, neumann, {true, true, false}},
                      {"pressure, all periodic", Centring::cell, neumann, {true, true, true}},
                      {"u, x y periodic", Centring::face_x, dirichlet, {true, true, false}},
                      {"w, x y periodic", Centring::face_z, dirichlet, {true, true, false}},
                      {"u, y mirror", Centring::face_x, dirichlet, {false, false, false}, {false, true, false}},
                      {"w, x y mirror", Centring::face_z, dirichlet, {false, false, false}, {true, true, false}},
                      {"u, y z mirror", Centring::face_x, dirichlet, {false, false, false}, {false, true, true}}};

// Field-like arrays of one problem.
struct Arrays {
  explicit Arrays(const EllipticProblem& problem) {
    const auto n = problem.extent();
    const std::ptrdiff_t row = n[0] + 2;
    const std::ptrdiff_t plane = row * (n[1] + 2);
    values.resize(2 * static_cast<std::size_t>(plane) * n[2]);
    rhs = {values.data(), n, row, plane};
    x = {values.data() + plane * n[2], n, row, plane};
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (double& v : values) v = uniform(generator);
  }
  std::vector<double> values;
  View rhs, x;
};

struct Row {
  std::string name;
  std::vector<Sample> one, two, reference, fftw, triad_one, triad_two;
  std::size_t unknowns;
};

Row measure(const Case& c, const std::array<int, 3>& cells, int repetitions, unsigned planning, Triad& triad) {
  const Grid grid({0, 0, 0}, {1.0 * cells[0], 1.0 * cells[1], 1.0 * cells[2]}, cells,
                  {.periodic = c.periodic, .mirror = c.mirror});
  const EllipticProblem problem(grid, c.centring, c.boundary, c.boundary == neumann ? 0.0 : 0.5, 1.0);
  const auto solver = make_elliptic_solver(problem, FftOptions{});
  const auto reference = make_elliptic_solver(problem, FftOptions{FftOptions::Transforms::fftw_r2r});
  R2rPair fftw(problem, planning);
  Arrays arrays(problem);
  Row row{c.name, {}, {}, {}, {}, {}, {}, problem.unknowns()};
  const auto solve = [&](EllipticSolver& s, int threads) {
    omp_set_num_threads(threads);
    return timed([&] { s.solve(arrays.rhs, arrays.x); });
  };
  for (int r = -1; r < repetitions; ++r) {  // the first does not count
    fftw.clear();
    const Sample samples[] = {solve(*solver, 1),    timed([&] { fftw.execute(); }),   solve(*solver, 2),
                              solve(*reference, 1), timed([&] { triad.execute(1); }), timed([&] { triad.execute(2); })};
    if (r < 0) continue;
    std::vector<Sample>* const to[] = {&row.one, &row.fftw, &row.two, &row.reference, &row.triad_one, &row.triad_two};
    for (int i = 0; i < 6; ++i) to[i]->push_back(samples[i]);
  }
  omp_set_num_threads(2);
  return row;
}

// Numbers that a solve moves between memory and cache if planes and slabs stay in cache: b is read, x written (and its
// lines read before), then twice read and written.
constexpr double bytes_per_unknown = 7 * sizeof(double);

void print(const Row& row, const std::array<int, 3>& cells, bool json, bool first) {
  const auto cpu = &Sample::cpu;
  const auto wall = &Sample::wall;
  const double one = minimum(row.one, cpu);
  const double bandwidth = Triad::rate(minimum(row.triad_one, cpu));
  const double used = 1e-6 * bytes_per_unknown * static_cast<double>(row.unknowns) / one;
  const double speed_up = minimum(row.one, wall) / minimum(row.two, wall);
  const double triad_speed_up = minimum(row.triad_one, wall) / minimum(row.triad_two, wall);
  const char* format =
      json ? "%s\n {\"cells\": [%d, %d, %d], \"case\": \"%s\", \"ms\": %.3f, \"ms_median\": %.3f, \"fftw_ms\": %.3f, "
             "\"fftw_ratio\": %.3f, \"reference_ratio\": %.3f, \"bandwidth_fraction\": %.3f, \"ms_two_threads\": %.3f, "
             "\"speed_up\": %.3f, \"speed_up_median\": %.3f, \"triad_speed_up\": %.3f, \"cpu_speed_up\": %.3f}"
           : "%s%4d x %3d x %3d  %-23s %8.2f %8.2f %8.2f %7.2f %7.2f %7.2f %9.2f %7.2f %7.2f %7.2f %7.2f\n";
  std::printf(format, json && !first ? "," : "", cells[0], cells[1], cells[2], row.name.c_str(), one,
              median(row.one, cpu), minimum(row.fftw, cpu), median_ratio(row.fftw, row.one, cpu),
              median_ratio(row.reference, row.one, cpu), used / bandwidth, minimum(row.two, wall), speed_up,
              median_ratio(row.one, row.two, wall), triad_speed_up, median_ratio(row.one, row.two, cpu));
}

void print_heading() {
  std::printf(
      "One thread, CPU milliseconds: minimum and median of fft, minimum of FFTW's transforms; medians of the ratios\n"
      "transforms / fft and fftw_r2r solver / fft; %.0f bytes per unknown, over the rate of a triad.\n"
      "Two threads, wall milliseconds: minimum; speed-up by minima and by the median of ratios; that of the triad; "
      "one\n"
      "thread's CPU time over that of the first of two.\n",
      bytes_per_unknown);
  std::printf("%-43s %8s %8s %8s %7s %7s %7s %9s %7s %7s %7s %7s\n", "", "fft", "median", "FFTW", "/ fft", "r2r/fft",
              "memory", "2 threads", "min", "median", "triad", "CPU");
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::array<int, 3>> sizes{{64, 64, 64}, {128, 128, 128}, {192, 192, 192}, {256, 64, 64}};
  int repetitions = 15;
  unsigned planning = FFTW_MEASURE;
  bool json = false;
  std::vector<std::string> only;
  CLI::App app("Times of the elliptic solver with fast transforms");
  app.add_option("--cells", sizes, "grids to measure");
  app.add_option("--only", only, "cases to measure, by name");
  app.add_option("--repetitions", repetitions, "interleaved repetitions of each measurement")
      ->check(CLI::PositiveNumber);
  app.add_option("--planning", planning, "of FFTW's transforms")
      ->transform(CLI::CheckedTransformer(std::map<std::string, unsigned>{
          {"estimate", FFTW_ESTIMATE}, {"measure", FFTW_MEASURE}, {"patient", FFTW_PATIENT}}));
  app.add_flag("--json", json, "print JSON instead of a table");
  CLI11_PARSE(app, argc, argv);

  omp_set_num_threads(2);  // solvers prepare for as many threads as there are when they are made
  Triad triad;
  if (json) {
    std::printf("[");
  } else {
    print_heading();
  }
  bool first = true;
  for (const auto& cells : sizes) {
    for (const Case& c : cases) {
      if (!only.empty() && std::find(only.begin(), only.end(), c.name) == only.end()) continue;
      print(measure(c, cells, repetitions, planning, triad), cells, json, first);
      std::fflush(stdout);
      first = false;
    }
  }
  if (json) std::printf("\n]\n");
  return 0;
}
