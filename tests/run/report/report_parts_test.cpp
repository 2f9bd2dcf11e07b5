// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The parts of a report that are made of numbers: rows, planes of the fluid, cuts through membranes, texts.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "files/hdf5_file.h"
#include "report/base64.h"
#include "report/diagnostics_rows.h"
#include "report/escaped_text.h"
#include "report/fluid_planes.h"
#include "report/svg_plots.h"
#include "report/thinning.h"
#include "run/run_in_folder.h"
#include "vesicle/shapes.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::run::report_parts_test {
namespace {

TEST(Thinning, KeepsTheEndsAndIsEven) {
  EXPECT_EQ(evenly_chosen(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(evenly_chosen(9, 5), (std::vector<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_EQ(evenly_chosen(5, 1), (std::vector<std::size_t>{4}));
  EXPECT_TRUE(evenly_chosen(0, 5).empty());
  const std::vector<std::size_t> kept = evenly_chosen(1000, 37);
  ASSERT_EQ(kept.size(), 37U);
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), 999U);
  for (std::size_t k = 1; k < kept.size(); ++k)
    EXPECT_NEAR(static_cast<double>(kept[k] - kept[k - 1]), 999.0 / 36.0, 1.0);
}

// The vectors of RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandard) {
  const auto of = [](std::string_view text) {
    return base64(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_size(4), of("foob").size());
}

TEST(EscapedText, LeavesNoMarkup) {
  EXPECT_EQ(escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  EXPECT_EQ(json_in_html(R"({"a": "</script><!--"})"), R"({"a": "\u003c/script>\u003c!--"})");
}

TEST(DiagnosticsRows, KeepsAllVesiclesOfATime) {
  std::string text = "step,time,vesicle,a\n";
  for (int t = 0; t < 100; ++t)
    for (int v = 0; v < 3; ++v)
      text += std::to_string(t) + "," + std::to_string(0.5 * t) + "," + std::to_string(v) + "," +
              std::to_string(t * v) + "\n";
  text += "100,50,0\n";  // a row that was cut off
  const DiagnosticsRows all = diagnostics_rows(text, 1'000'000);
  EXPECT_EQ(all.stored_times, 100U);
  EXPECT_EQ(all.times, 100U);
  EXPECT_EQ(all.text + "100,50,0\n", text);
  const DiagnosticsRows few = diagnostics_rows(text, text.size() / 10);
  EXPECT_EQ(few.stored_times, 100U);
  EXPECT_NEAR(static_cast<double>(few.times), 10.0, 1.0);
  EXPECT_LE(few.text.size(), text.size() / 10 + 20);
  const std::vector<double>&time = *few.column("time"), &vesicle = *few.column("vesicle"), &a = *few.column("a");
  ASSERT_EQ(a.size(), 3 * few.times);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(vesicle[k], static_cast<double>(k % 3));
    EXPECT_EQ(a[k], 2.0 * time[k] * vesicle[k]);
  }
  EXPECT_EQ(time.front(), 0.0);
  EXPECT_EQ(time.back(), 49.5);
  EXPECT_EQ(few.column("b"), nullptr);
  EXPECT_EQ(diagnostics_rows("", 1000).times, 0U);
}

TEST(DiagnosticsRows, WhatIsNotDefinedIsNotANumber) {
  const DiagnosticsRows rows = diagnostics_rows("step,time,vesicle,a\n0,0,0,\n1,0.5,0,2.5\n", 1000);
  EXPECT_TRUE(std::isnan((*rows.column("a"))[0]));
  EXPECT_EQ((*rows.column("a"))[1], 2.5);
}

class FluidPlanesTest : public RunInFolder {
 protected:
  void SetUp() override {
    if (!have_hdf5()) GTEST_SKIP() << "built without HDF5";
    fs::create_directories(at("snapshots"));
  }

  // u = (z, 2x, y) and p = x - 3z on a box of different edges, at the centres of cells.
  fs::path write(int number, const std::array<int, 3>& n, double factor = 1.0) {
    const std::array<double, 3> lower = {-1.0, -2.0, -3.0};
    std::vector<float> velocity, pressure;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const double x = lower[0] + 2.0 * (i + 0.5) / n[0], y = lower[1] + 4.0 * (j + 0.5) / n[1],
                       z = lower[2] + 6.0 * (k + 0.5) / n[2];
          for (const double u : {z, 2.0 * x, y}) velocity.push_back(static_cast<float>(factor * u));
          pressure.push_back(static_cast<float>(x - 3.0 * z));
        }
    const fs::path path = folder_ / "snapshots" / ("fluid_00000000" + std::to_string(number) + ".h5");
    Hdf5File file(path, Hdf5File::Mode::create);
    file.attribute("/", "time", 0.5 * number);
    file.attribute("/", "lower", std::vector<double>(lower.begin(), lower.end()));
    file.attribute("/", "upper", std::vector<double>{1.0, 2.0, 3.0});
    file.attribute("/", "cells", std::vector<double>(n.begin(), n.end()));
    const Hdf5File::Shape shape = {static_cast<std::uint64_t>(n[2]), static_cast<std::uint64_t>(n[1]),
                                   static_cast<std::uint64_t>(n[0])};
    file.write("/velocity", velocity.data(), {shape[0], shape[1], shape[2], 3});
    file.write("/pressure", pressure.data(), shape);
    file.close();
    run_.fluid[number] = path;
    return path;
  }

  static double value(const FluidPlanes::Plane& plane, std::size_t snapshot, std::size_t quantity, int i, int j) {
    const auto size = static_cast<std::size_t>(plane.points[0]) * static_cast<std::size_t>(plane.points[1]);
    const std::size_t k = 2 * ((4 * snapshot + quantity) * size + static_cast<std::size_t>(j * plane.points[0] + i));
    const auto integer = static_cast<std::int16_t>(plane.bytes[k] | plane.bytes[k + 1] << 8);
    return (quantity < 3 ? plane.velocity_quantum : plane.pressure_quantum) * integer;
  }

  StoredRun run_;
};

TEST_F(FluidPlanesTest, HasTheFluidWhereItSays) {
  write(0, {4, 6, 8});
  write(1, {4, 6, 8}, 2.0);
  const FluidPlanes fluid = read_fluid_planes(run_, 1'000'000);
  EXPECT_TRUE(fluid.missing.empty());
  EXPECT_EQ(fluid.times, (std::vector<double>{0.0, 0.5}));
  ASSERT_EQ(fluid.planes.size(), 3U);
  for (const FluidPlanes::Plane& plane : fluid.planes) {
    const std::array<int, 2> axes = plane.axis == 0   ? std::array{1, 2}
                                    : plane.axis == 1 ? std::array{0, 2}
                                                      : std::array{0, 1};
    for (int j = 0; j < plane.points[1]; ++j)
      for (int i = 0; i < plane.points[0]; ++i) {
        std::array<double, 3> at = {};
        at[static_cast<std::size_t>(plane.axis)] = plane.position;
        const auto place = [&](std::size_t d, int point) {
          return plane.lower[d] + (point + 0.5) * (plane.upper[d] - plane.lower[d]) / plane.points[d];
        };
        at[static_cast<std::size_t>(axes[0])] = place(0, i);
        at[static_cast<std::size_t>(axes[1])] = place(1, j);
        // Half a quantum, and what is left of the mean of two layers is exact for fields that are linear.
        EXPECT_NEAR(value(plane, 0, 0, i, j), at[2], 0.51 * plane.velocity_quantum);
        EXPECT_NEAR(value(plane, 1, 1, i, j), 4.0 * at[0], 0.51 * plane.velocity_quantum);
        EXPECT_NEAR(value(plane, 0, 2, i, j), at[1], 0.51 * plane.velocity_quantum);
        EXPECT_NEAR(value(plane, 1, 3, i, j), at[0] - 3.0 * at[2], 0.51 * plane.pressure_quantum);
      }
  }
}

// A plane of symmetry is itself what is shown, and a grid finer than a page is shown by means over blocks.
TEST_F(FluidPlanesTest, MirrorsAndFineGrids) {
  write(0, {128, 6, 128});
  run_.summary["parameters"]["domain.mirror"] = {false, true, false};
  const FluidPlanes fluid = read_fluid_planes(run_, 1'000'000);
  ASSERT_EQ(fluid.planes.size(), 3U);
  const FluidPlanes::Plane& plane = fluid.planes.front();
  EXPECT_EQ(plane.axis, 1);
  EXPECT_EQ(plane.position, -2.0);
  EXPECT_EQ(plane.points, (std::array{64, 64}));
  EXPECT_NEAR(value(plane, 0, 2, 10, 20), -2.0 + 4.0 * 0.5 / 6.0,
              0.51 * plane.velocity_quantum);  // the layer beside the mirror
  EXPECT_NEAR(value(plane, 0, 0, 10, 20), -3.0 + 6.0 * 20.5 / 64.0, 0.51 * plane.velocity_quantum);
}

TEST_F(FluidPlanesTest, TakesWhatThereIsRoomFor) {
  for (int k = 0; k < 9; ++k) write(k, {8, 8, 8});
  const std::size_t of_plane = 2UL * 4 * 64;
  EXPECT_EQ(read_fluid_planes(run_, 27 * of_plane).planes.size(), 3U);
  const FluidPlanes one = read_fluid_planes(run_, 26 * of_plane);
  EXPECT_EQ(one.planes.size(), 1U);
  EXPECT_EQ(one.times.size(), 9U);
  const FluidPlanes few = read_fluid_planes(run_, 3 * of_plane);
  EXPECT_EQ(few.stored, 9U);
  EXPECT_EQ(few.times, (std::vector<double>{0.0, 2.0, 4.0}));
  EXPECT_EQ(few.planes.front().bytes.size(), 3 * of_plane);
}

TEST_F(FluidPlanesTest, SnapshotsThatCannotBeReadAreLeftOut) {
  write(0, {8, 8, 8});
  fs::resize_file(write(1, {8, 8, 8}), 2000);
  write(2, {8, 8, 9});
  const FluidPlanes fluid = read_fluid_planes(run_, 1'000'000);
  EXPECT_EQ(fluid.times, (std::vector<double>{0.0}));
  ASSERT_EQ(fluid.missing.size(), 2U);
  EXPECT_NE(fluid.missing[0].find("fluid_000000001.h5"), std::string::npos) << fluid.missing[0];
  EXPECT_NE(fluid.missing[1].find("another grid"), std::string::npos) << fluid.missing[1];
}

// The cut through the middle of an ellipsoid is an ellipse, drawn at one scale: all its points, and in one closed line.
TEST(SvgOutlines, AreCutsThroughTheMiddle) {
  constexpr int latitudes = 16;
  const vesicle::SphereGrid grid(latitudes);
  const vesicle::SphericalHarmonics harmonics(latitudes, grid, membrane_columns);
  Eigen::ArrayXXd values = Eigen::ArrayXXd::Zero(grid.size(), membrane_columns);
  for (int j = 0; j < latitudes; ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double theta = grid.colatitude()[j], phi = grid.longitude(i);
      values.row(grid.index(i, j)).head(3) << 2.0 * std::sin(theta) * std::cos(phi) + 7.0,
          0.5 * std::sin(theta) * std::sin(phi) - 1.0, 1.0 * std::cos(theta) + 3.0;
    }
  vesicle::Coefficients coefficients;
  harmonics.analysis(values, coefficients);
  MembraneCourse course;
  course.latitudes = {latitudes};
  course.frames.push_back({.time = 1.5, .step = 3, .vesicles = {real_coefficients(coefficients, latitudes)}});
  const std::string svg = svg_outlines(course);
  EXPECT_NE(svg.find("t = 1.5"), std::string::npos);
  const std::regex path("<path class=\"membrane\" d=\"M([^Z]*)Z\"");
  const auto begin = std::sregex_iterator(svg.begin(), svg.end(), path);
  ASSERT_EQ(std::distance(begin, std::sregex_iterator()), 1);
  std::istringstream numbers((*begin)[1].str());
  double x = 0.0, y = 0.0, least_x = 1e9, most_x = 0.0;
  int points = 0;
  while (numbers >> x >> y) {
    // 260 pixels for the longer axis, 12 around.
    const double a = (x - 142.0) / 130.0, b = (y - 77.0) / 65.0;
    EXPECT_NEAR(std::hypot(a, b), 1.0, 0.01);
    least_x = std::min(least_x, x);
    most_x = std::max(most_x, x);
    ++points;
  }
  EXPECT_GE(points, 64);
  EXPECT_NEAR(most_x - least_x, 260.0, 1.0);
}

TEST(SvgPlots, DrawsWhatIsMoreThanRoundOff) {
  const std::string svg = svg_plots(diagnostics_rows(
      "step,time,vesicle,inclination_angle_deg,area_error\n0,0,0,90,0\n1,1,0,30,1e-14\n2,2,0,28,-1e-14\n", 10'000));
  EXPECT_NE(svg.find("inclination (degrees)"), std::string::npos);
  EXPECT_EQ(svg.find("error of the area"), std::string::npos);
  // The largest value at the top of the frame, the last at the bottom and to the right.
  EXPECT_NE(svg.find("points=\"58.0,26.0 "), std::string::npos) << svg;
  EXPECT_NE(svg.find("328.0,140.0 \""), std::string::npos) << svg;
  EXPECT_EQ(svg_plots(diagnostics_rows("", 10'000)), "");
}

}  // namespace
}  // namespace vesiflow::run::report_parts_test
