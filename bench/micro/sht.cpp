// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Spherical-harmonic transforms of three fields: time per scalar field against FFTW's own transforms of the same data
// and against the rate of multiply-adds of this core.
//   build/release/bench/sht [--latitudes N...] [--repetitions R] [--json]
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <fftw3.h>
#include <omp.h>
#include <CLI/CLI.hpp>

#include "harmonics/legendre_tables.h"
#include "support/timing.h"
#include "vesicle/spherical_harmonics.h"

namespace {

using namespace vesiflow::vesicle;

constexpr int fields = 3;

struct Time {
  double minimum = 0, median = 0;  // microseconds
};

/// One repetition lasts at least half a millisecond.
Time measure(int repetitions, const std::function<void()>& call) {
  const auto microseconds = [&](int calls) {
    const auto repeated = [&] {
      for (int i = 0; i < calls; ++i) call();
    };
    return 1e3 * vesiflow::bench::timed(repeated).wall / calls;
  };
  call();
  const int calls = std::max(1, static_cast<int>(500 / microseconds(1)));
  std::vector<double> times(repetitions);
  for (double& time : times) time = microseconds(calls);
  std::sort(times.begin(), times.end());
  return {times.front(), times[times.size() / 2]};
}

/// Multiply-adds on registers only: as many independent sums as hide the latency of the unit. GF/s.
double multiply_add_rate(int repetitions) {
#if defined(__AVX512F__)
  using Vector = VectorOf<8>;
#elif defined(__AVX__)
  using Vector = VectorOf<4>;
#else
  using Vector = VectorOf<2>;
#endif
  constexpr int sums = 12, steps = 4096;
  // Read at run time: of a start of 1 known when compiling, which 0.999 x + 0.001 keeps, the sum would be left out.
  volatile double start = 1;
  const Time time = measure(repetitions, [&] {
    const Vector factor = Vector{} + 0.999, term = Vector{} + 1e-3;
    Vector sum[sums];
#pragma GCC unroll 16
    for (int s = 0; s < sums; ++s) sum[s] = Vector{} + start * s;
    for (int step = 0; step < steps; ++step)
#pragma GCC unroll 16
      for (int s = 0; s < sums; ++s) sum[s] = sum[s] * factor + term;
    Vector total{};
#pragma GCC unroll 16
    for (int s = 0; s < sums; ++s) total += sum[s];
    asm volatile("" : : "m"(total));  // the sums are wanted
  });
  return 2.0 * sums * steps * double(sizeof(Vector) / sizeof(double)) / time.minimum * 1e-3;
}

/// FFTW's complex transforms, planned by estimate, of N rings of L points, as the ring pairs of two fields would be: time
/// per scalar field.
Time fft(int latitudes, int longitudes, int repetitions) {
  const std::size_t size = std::size_t(latitudes) * longitudes;
  fftw_complex* const in = fftw_alloc_complex(size);
  fftw_complex* const out = fftw_alloc_complex(size);
  std::fill_n(in[0], 2 * size, 1.0);
  const fftw_plan plan = fftw_plan_many_dft(1, &longitudes, latitudes, in, nullptr, 1, longitudes, out, nullptr, 1,
                                            longitudes, FFTW_FORWARD, FFTW_ESTIMATE);
  Time time = measure(repetitions, [&] { fftw_execute(plan); });
  fftw_destroy_plan(plan);
  fftw_free(in);
  fftw_free(out);
  return {time.minimum / 2, time.median / 2};
}

/// The sums over degrees and over latitudes alone: GF/s, counting every function at every northern latitude whether or
/// not the table leaves it out.
double legendre_rate(LegendreSum sum, int latitudes, int repetitions) {
  const auto table = shared_legendre_table(LegendreKind::value, sum, latitudes, latitudes, 2 * latitudes);
  constexpr int width = 2 * fields;
  const int half = (latitudes + 1) / 2;
  const std::ptrdiff_t stride = padded_rows(half);
  std::vector<double> input(std::size_t(width) * (latitudes + stride), 1.0);
  std::vector<double> output(std::size_t(width) * (latitudes + stride));
  const double* const in = input.data();
  double* const out = output.data();
  const Time time = measure(repetitions, [&] {
    for (int m = 0; m < latitudes; ++m)
      for (int parity : {0, 1}) {
        const int count = degree_count(latitudes, m, parity);
        const PanelMatrix& matrix = table->matrix(m, parity);
        if (sum == LegendreSum::over_degrees)
          matrix.multiply(
              width, [=](int k, int c) { return in[k * width + c]; },
              [=](int row, int c, const auto& sums) { store_columns(sums, out + c * stride + row, stride); });
        else
          matrix.multiply(
              width, [=](int k, int c) { return in[c * stride + k]; },
              [=](int row, int c, const auto& sums) {
                store_rows<false>(sums, count - row, out + row * width + c, width);
              });
      }
  });
  const double entries = 0.5 * latitudes * (latitudes + 1) * half;
  return 2 * entries * width / time.minimum * 1e-3;
}

/// SHTns 3.5, one thread, AVX2, on another and unloaded core; microseconds per scalar field. Zero: not measured.
struct Shtns {
  double analysis = 0, synthesis = 0, gradient = 0;
};
Shtns shtns(int latitudes) {
  switch (latitudes) {
    case 32:
      return {4.0, 3.1, 6.1};
    case 64:
      return {23, 20, 39};
    case 128:
      return {127, 117, 225};
    default:
      return {};
  }
}

struct Row {
  std::string name;
  Time time;
  double shtns;
};

std::vector<Row> transforms(int latitudes, int repetitions) {
  const SphereGrid grid(latitudes);
  SphericalHarmonics harmonics(latitudes, grid, fields);
  harmonics.prepare({.analysis = true, .derivatives = true}, fields);
  Coefficients c(latitudes, fields);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int field = 0; field < fields; ++field)
    for (int n = 0; n < latitudes; ++n)
      for (int m = 0; m <= n; ++m) c(field, n, m) = {uniform(generator), m > 0 ? uniform(generator) : 0};
  VectorField f(grid.size(), 3), t = f, p = f, tt = f, tp = f, pp = f;
  const Shtns other = shtns(latitudes);
  const auto per_field = [&](const std::function<void()>& call) {
    const Time time = measure(repetitions, call);
    return Time{time.minimum / fields, time.median / fields};
  };
  std::vector<Row> rows;
  rows.push_back({"synthesis", per_field([&] { harmonics.synthesis(c, f); }), other.synthesis});
  rows.push_back({"analysis", per_field([&] { harmonics.analysis(f, c); }), other.analysis});
  rows.push_back({"gradient", per_field([&] { harmonics.gradient(c, t, p); }), other.gradient});
  rows.push_back({"all derivatives", per_field([&] { harmonics.derivatives(c, t, p, tt, tp, pp); }), 0});
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{32, 64, 128, 256};
  int repetitions = 50;
  bool json = false;
  CLI::App app("Times of the spherical-harmonic transforms");
  app.add_option("--latitudes", sizes, "grids to measure")->check(CLI::Range(2, 512));
  app.add_option("--repetitions", repetitions, "repetitions of each measurement")->check(CLI::PositiveNumber);
  app.add_flag("--json", json, "print JSON instead of tables");
  CLI11_PARSE(app, argc, argv);

  const double peak = multiply_add_rate(repetitions);
  if (json)
    std::printf("{\"fields\": %d, \"multiply_add_GFs\": %.2f, \"sizes\": [", fields, peak);
  else
    std::printf("multiply-adds on registers: %.1f GF/s\ntimes: microseconds per scalar field, %d fields per call\n",
                peak, fields);
  bool first = true;
  for (const int latitudes : sizes) {
    const Time one_fft = fft(latitudes, 2 * latitudes, repetitions);
    const double degrees_rate = legendre_rate(LegendreSum::over_degrees, latitudes, repetitions);
    const double latitudes_rate = legendre_rate(LegendreSum::over_latitudes, latitudes, repetitions);
    if (json)
      std::printf(
          "%s\n {\"latitudes\": %d, \"fft_us\": %.3f, \"legendre_GFs\": {\"over_degrees\": %.2f, "
          "\"over_latitudes\": %.2f}, \"transforms\": [",
          first ? "" : ",", latitudes, one_fft.minimum, degrees_rate, latitudes_rate);
    else
      std::printf(
          "\nN = %d: FFT alone %.2f; Legendre sums over degrees %.1f GF/s (%.2f of multiply-adds), over "
          "latitudes %.1f (%.2f)\n%-16s %8s %9s %9s %7s %7s %8s\n",
          latitudes, one_fft.minimum, degrees_rate, degrees_rate / peak, latitudes_rate, latitudes_rate / peak, "",
          "threads", "minimum", "median", "/ FFT", "SHTns", "/ SHTns");
    bool first_row = true;
    for (const int threads : {1, 2}) {
      omp_set_num_threads(threads);
      for (const Row& row : transforms(latitudes, repetitions)) {
        if (json) {
          std::printf(
              "%s\n  {\"name\": \"%s\", \"threads\": %d, \"minimum_us\": %.3f, \"median_us\": %.3f, "
              "\"per_fft\": %.3f",
              first_row ? "" : ",", row.name.c_str(), threads, row.time.minimum, row.time.median,
              row.time.minimum / one_fft.minimum);
          if (row.shtns > 0) std::printf(", \"shtns_us\": %.1f", row.shtns);
          std::printf("}");
        } else {
          std::printf("%-16s %8d %9.2f %9.2f %7.2f", row.name.c_str(), threads, row.time.minimum, row.time.median,
                      row.time.minimum / one_fft.minimum);
          if (row.shtns > 0) std::printf(" %7.1f %8.2f", row.shtns, row.time.minimum / row.shtns);
          std::printf("\n");
        }
        first_row = false;
      }
    }
    if (json) std::printf("]}");
    first = false;
  }
  if (json) std::printf("]}\n");
}
