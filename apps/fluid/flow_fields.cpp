// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The flow around a viscous ball in shear, by libfluid alone: velocity, pressure and viscosity in a plane as a table, and
// what the solvers report. tools/plot_flow.py draws it.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "output_files.h"
#include "program.h"
#include "streams.h"

namespace {

using namespace vesiflow::fluid;

struct Options {
  int cells = 32;
  double ratio = 20.0;
  double frequency = 0.0;
  double reynolds_number = 1.0;
  double time_step = 1.0;
  double end = 1.0;
  std::string inertia = "none";
  std::string treatment = "extrapolated";
  std::string velocity_solver = "auto";
  std::string out = "out/flow_fields";
  bool json = false;
};

constexpr double half_width = 2.0;
constexpr int least_cells = 4, most_cells = 512;

const std::map<std::string, Inertia> inertias{
    {"full", Inertia::full}, {"unsteady", Inertia::unsteady}, {"none", Inertia::none}};
const std::map<std::string, ViscousTreatment> treatments{{"explicit", ViscousTreatment::explicit_},
                                                         {"extrapolated", ViscousTreatment::extrapolated},
                                                         {"implicit", ViscousTreatment::implicit}};

template <class Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

// 1 outside the unit sphere and the ratio inside, across a layer of about two cells.
Viscosity ball(const Grid& grid, double ratio) {
  return sample_viscosity(grid, [&](const Vector3& r) {
    const double distance = std::hypot(r[0], r[1], r[2]) - 1.0;
    return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh(distance / grid.spacing(0)));
  });
}

SolverOptions solver(const std::string& name) {
  if (name == "fft") return FftOptions{};
  if (name == "cholmod") return CholmodOptions{};
  if (name == "pcg") return PcgOptions{};
  return AutoOptions{};
}

NavierStokes make_flow(const Options& options) {
  const Grid grid({-half_width, -half_width, -half_width}, {half_width, half_width, half_width},
                  {options.cells, options.cells, options.cells});
  FluidParameters parameters;
  parameters.reynolds_number = options.reynolds_number;
  parameters.viscosity = ball(grid, options.ratio);
  parameters.viscous_treatment = treatments.at(options.treatment);
  parameters.inertia = inertias.at(options.inertia);
  parameters.velocity_solver = solver(options.velocity_solver);
  const double frequency = options.frequency;
  const auto shear = [frequency](const Vector3& r, double t) {
    return Vector3{r[2] * (frequency == 0.0 ? 1.0 : std::sin(frequency * t)), 0.0, 0.0};
  };
  return {grid, parameters, shear, frequency == 0.0 ? WallMotion::steady : WallMotion::unsteady};
}

// At cell centres of the plane y = 0, between the two middle layers of cells.
std::string middle_plane(const NavierStokes& flow) {
  const Grid& grid = flow.grid();
  const FaceVector& u = flow.velocity();
  const Field<Cell>& mu = flow.parameters().viscosity.field();
  const Field<Cell>& p = flow.pressure();
  const int j = grid.cells[1] / 2;
  std::string text = "x,z,u,v,w,pressure,viscosity\n";
  const auto mean = [&](const auto& field, int i, int di, int k, int dk) {
    return 0.25 * (field(i, j - 1, k) + field(i + di, j - 1, k + dk) + field(i, j, k) + field(i + di, j, k + dk));
  };
  for (int k = 0; k < grid.cells[2]; ++k) {
    for (int i = 0; i < grid.cells[0]; ++i) {
      const Vector3 r = p.position(i, j, k);
      text +=
          fmt::format("{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g}\n", r[0], r[2], mean(u.x, i, 1, k, 0),
                      u.y(i, j, k), mean(u.z, i, 0, k, 1), mean(p, i, 0, k, 0), mean(mu, i, 0, k, 0));
    }
  }
  return text;
}

int iterations(const NavierStokes& flow) {
  const FluidReport& report = flow.report();
  return flow.parameters().inertia == Inertia::none ? report.stokes.iterations : report.momentum.iterations;
}

// Takes the steps, and tells what happened.
nlohmann::ordered_json take_steps(const Options& options, NavierStokes& flow) {
  const int steps = static_cast<int>(std::lround(options.end / options.time_step));
  const auto start = std::chrono::steady_clock::now();
  int first_iterations = 0;
  for (int n = 0; n < steps; ++n) {
    try {
      flow.step(options.time_step);
    } catch (const std::runtime_error& error) {  // a solver that does not converge
      throw Stopped(error.what());
    }
    if (n == 0) first_iterations = iterations(flow);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {{"cells", options.cells},
          {"viscosity_ratio", options.ratio},
          {"velocity_solver", flow.velocity_solver_name()},
          {"pressure_solver", flow.pressure_solver_name()},
          {"steps", flow.steps()},
          {"time", flow.time()},
          {"iterations_of_first_step", first_iterations},
          {"iterations_of_last_step", iterations(flow)},
          {"seconds_per_step", seconds.count() / steps},
          {"divergence", max_divergence(flow.velocity())}};
}

void declare(CommandLine& command_line, Options& options) {
  command_line.add_option("--cells", options.cells, "along each edge of the box [-2, 2]^3; even")
      ->capture_default_str();
  command_line.add_option("--ratio", options.ratio, "viscosity of the ball of radius 1; 1 outside")
      ->capture_default_str();
  command_line
      .add_option("--frequency", options.frequency, "the walls move with z sin(frequency t) along x; 0: with z")
      ->capture_default_str();
  command_line.add_option("--reynolds-number", options.reynolds_number, "Reynolds number")->capture_default_str();
  command_line.add_choice("--inertia", options.inertia, names_of(inertias), "none: every step is a Stokes problem")
      ->capture_default_str();
  command_line.add_choice("--treatment", options.treatment, names_of(treatments), "of the viscosity")
      ->capture_default_str();
  command_line
      .add_choice("--velocity-solver", options.velocity_solver, {"auto", "fft", "pcg", "cholmod"}, "of the momentum")
      ->capture_default_str();
  command_line.add_option("--time-step", options.time_step, "dt")->capture_default_str();
  command_line.add_option("--end", options.end, "to which time, starting from rest; a multiple of the step")
      ->capture_default_str();
  command_line.add_out(options.out, "the tables and a summary")->capture_default_str();
  command_line.add_json(options.json);
}

void check(const Options& options) {
  require(options.cells >= least_cells && options.cells <= most_cells, "--cells", options.cells,
          fmt::format("from {} to {}", least_cells, most_cells));
  require(options.cells % 2 == 0, "--cells", options.cells, "even");
  require_positive("--ratio", options.ratio);
  require_positive("--reynolds-number", options.reynolds_number);
  require(std::isfinite(options.frequency), "--frequency", options.frequency, "finite");
  require_positive("--time-step", options.time_step);
  const double steps = options.end / options.time_step;
  require(steps >= 0.5 && steps <= 1e6 && std::abs(steps - std::round(steps)) <= 1e-6 * steps, "--end", options.end,
          fmt::format("a positive multiple of the time step {:g}", options.time_step));
}

std::string table(const nlohmann::ordered_json& summary) {
  std::string text;
  for (const auto& [name, value] : summary.items())
    text += fmt::format("{:26} {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

ExitCode run(int argc, char** argv) {
  Options options;
  CommandLine command_line(
      "flow_fields",
      "The flow around a viscous ball in shear: fields in the middle plane as CSV; draw with tools/plot_flow.py.");
  declare(command_line, options);
  if (!command_line.read(argc, argv)) return success;
  check(options);
  NavierStokes flow = make_flow(options);
  const nlohmann::ordered_json summary = take_steps(options, flow);
  const std::filesystem::path folder = options.out;
  make_folder(folder);
  write_text(folder / "plane.csv", middle_plane(flow));
  write_text(folder / "summary.json", summary.dump(1) + "\n");
  print_result(options.json ? summary.dump(1) + "\n" : table(summary));
  if (!command_line.is_quiet()) say("tables in {}\n", folder.string());
  return success;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program([&] { return run(argc, argv); });
}
