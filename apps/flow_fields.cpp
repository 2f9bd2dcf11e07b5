// The flow around a viscous ball in shear, by libfluid alone: velocity, pressure and viscosity in a plane as a table, and
// what the solvers report. tools/plot_flow.py draws it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "passive_waiting.h"

namespace {

using namespace vesiflow::fluid;

struct Options {
  int cells = 32;
  double ratio = 20.0;
  double frequency = 0.0;
  double reynolds_number = 1.0;
  double time_step = 1.0;
  double end = 1.0;
  Inertia inertia = Inertia::none;
  ViscousTreatment treatment = ViscousTreatment::extrapolated;
  std::string velocity_solver = "auto";
  std::filesystem::path out = "out/flow_fields";
};

constexpr double half_width = 2.0;

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
  parameters.viscous_treatment = options.treatment;
  parameters.inertia = options.inertia;
  parameters.velocity_solver = solver(options.velocity_solver);
  const double frequency = options.frequency;
  const auto shear = [frequency](const Vector3& r, double t) {
    return Vector3{r[2] * (frequency == 0.0 ? 1.0 : std::sin(frequency * t)), 0.0, 0.0};
  };
  return {grid, parameters, shear, frequency == 0.0};
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
nlohmann::ordered_json run(const Options& options, NavierStokes& flow) {
  const int steps = static_cast<int>(std::lround(options.end / options.time_step));
  const auto start = std::chrono::steady_clock::now();
  int first_iterations = 0;
  for (int n = 0; n < steps; ++n) {
    flow.step(options.time_step);
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

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

void declare(CLI::App& app, Options& options) {
  const std::map<std::string, Inertia> inertia{
      {"full", Inertia::full}, {"unsteady", Inertia::unsteady}, {"none", Inertia::none}};
  const std::map<std::string, ViscousTreatment> treatment{{"explicit", ViscousTreatment::explicit_},
                                                          {"extrapolated", ViscousTreatment::extrapolated},
                                                          {"implicit", ViscousTreatment::implicit}};
  app.add_option("--cells", options.cells, "along each edge of the box [-2, 2]^3; even")
      ->check(CLI::Range(4, 512))
      ->capture_default_str();
  app.add_option("--ratio", options.ratio, "viscosity of the ball of radius 1; 1 outside")->capture_default_str();
  app.add_option("--frequency", options.frequency, "the walls move with z sin(frequency t) along x; 0: with z")
      ->capture_default_str();
  app.add_option("--reynolds", options.reynolds_number, "Reynolds number")->capture_default_str();
  app.add_option("--inertia", options.inertia, "full, unsteady, none (the default: every step is a Stokes problem)")
      ->transform(CLI::CheckedTransformer(inertia).description(""));
  app.add_option("--treatment", options.treatment, "of the viscosity: explicit, extrapolated (default), implicit")
      ->transform(CLI::CheckedTransformer(treatment).description(""));
  app.add_option("--velocity-solver", options.velocity_solver, "auto, fft, pcg, cholmod")
      ->check(CLI::IsMember({"auto", "fft", "pcg", "cholmod"}))
      ->capture_default_str();
  app.add_option("--time-step", options.time_step, "dt")->capture_default_str();
  app.add_option("--time", options.end, "to which time, starting from rest; a multiple of the step")
      ->capture_default_str();
  app.add_option("--out", options.out, "folder")->capture_default_str();
}

void check(const Options& options) {
  if (options.cells % 2 != 0) throw std::runtime_error(fmt::format("--cells {}: must be even", options.cells));
  const double steps = options.end / options.time_step;
  if (!(steps >= 0.5 && steps <= 1e6) || std::abs(steps - std::round(steps)) > 1e-6 * steps) {
    throw std::runtime_error(
        fmt::format("--time {:g}: must be a positive multiple of the time step {:g}", options.end, options.time_step));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  wait_passively(argv);
  Options options;
  CLI::App app{
      "The flow around a viscous ball in shear: fields in the middle plane as CSV; draw with tools/plot_flow.py."};
  declare(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(fmt::format("{} (--help lists the options)", error.what()));
  }
  check(options);
  NavierStokes flow = make_flow(options);
  const nlohmann::ordered_json summary = run(options, flow);
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error)
    throw std::runtime_error(fmt::format("--out {}: cannot be made: {}", options.out.string(), error.message()));
  write(options.out / "plane.csv", middle_plane(flow));
  write(options.out / "summary.json", summary.dump(1) + "\n");
  for (const auto& [name, value] : summary.items()) {
    fmt::print("{:26} {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  fmt::print("tables in {}\n", options.out.string());
} catch (const std::exception& error) {
  fmt::print(stderr, "error: {}\n", error.what());
  return 2;
}
