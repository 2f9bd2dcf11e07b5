// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/fluid_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "files/hdf5_file.h"
#include "report/thinning.h"
#include "run/errors.h"

namespace vesiflow::run {
namespace {

constexpr int most_points = 64;  // along an edge
constexpr int quantities = 4;    // velocity and pressure
constexpr double largest_integer = 32767.0;

struct Box {
  std::vector<double> lower, upper;
  std::array<int, 3> cells = {};
};

Box read_box(const Hdf5File& file, const std::string& name) {
  Box box{.lower = file.read_numbers("/", "lower", 3), .upper = file.read_numbers("/", "upper", 3)};
  const std::vector<double> cells = file.read_numbers("/", "cells", 3);
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(cells[d] >= 1.0 && cells[d] <= 1e5) || !(box.upper[d] > box.lower[d]))
      throw FileError(fmt::format("{}: the box along axis {} has {} cells from {} to {}", name, d, cells[d],
                                  box.lower[d], box.upper[d]));
    box.cells[d] = static_cast<int>(cells[d]);
  }
  return box;
}

// The layers of cells whose mean is the plane through the middle, or the first beside a mirror.
struct Layers {
  int first = 0, count = 1;
};
Layers middle_layers(int cells, bool mirrored) {
  if (mirrored) return {};
  return cells % 2 == 0 ? Layers{.first = cells / 2 - 1, .count = 2} : Layers{.first = cells / 2, .count = 1};
}

// A plane of one snapshot: each quantity (rows along the higher axis, columns along the lower one), as means over blocks of cells.
struct Cut {
  std::array<int, 2> points = {0, 0};
  std::vector<double> values;
};

Cut cut(const Hdf5File& file, const Box& box, int axis, bool mirrored) {
  const Layers layers = middle_layers(box.cells[static_cast<std::size_t>(axis)], mirrored);
  const int low = axis == 0 ? 1 : 0, high = axis == 2 ? 1 : 2;
  const int nl = box.cells[static_cast<std::size_t>(low)], nh = box.cells[static_cast<std::size_t>(high)];
  const int block = (std::max(nl, nh) + most_points - 1) / most_points;
  Cut result{.points = {(nl + block - 1) / block, (nh + block - 1) / block}, .values = {}};
  const auto size = static_cast<std::size_t>(result.points[0]) * static_cast<std::size_t>(result.points[1]);
  result.values.assign(quantities * size, 0.0);
  // Arrays have z first.
  Hdf5File::Shape start = {0, 0, 0}, count(3);
  for (std::size_t d = 0; d < 3; ++d) count[2 - d] = static_cast<std::uint64_t>(box.cells[d]);
  start[static_cast<std::size_t>(2 - axis)] = static_cast<std::uint64_t>(layers.first);
  count[static_cast<std::size_t>(2 - axis)] = static_cast<std::uint64_t>(layers.count);
  const std::vector<double> pressure = file.read_block("/pressure", start, count);
  start.push_back(0);
  count.push_back(3);
  const std::vector<double> velocity = file.read_block("/velocity", start, count);
  std::vector<double> cells_in(size, 0.0);
  std::size_t cell = 0;
  std::array<int, 3> at = {};
  const auto end = [&](int d) { return static_cast<int>(count[static_cast<std::size_t>(2 - d)]); };
  for (at[2] = 0; at[2] < end(2); ++at[2])
    for (at[1] = 0; at[1] < end(1); ++at[1])
      for (at[0] = 0; at[0] < end(0); ++at[0], ++cell) {
        const auto point = static_cast<std::size_t>(at[static_cast<std::size_t>(high)] / block * result.points[0] +
                                                    at[static_cast<std::size_t>(low)] / block);
        ++cells_in[point];
        for (std::size_t c = 0; c < 3; ++c) result.values[c * size + point] += velocity[3 * cell + c];
        result.values[3 * size + point] += pressure[cell];
      }
  for (std::size_t k = 0; k < result.values.size(); ++k) result.values[k] /= cells_in[k % size];
  if (!std::ranges::all_of(result.values, [](double v) { return std::isfinite(v); }))
    throw FileError("the fluid is not finite");
  return result;
}

void append(const Cut& cut, FluidPlanes::Plane& plane) {
  const std::size_t size = cut.values.size() / quantities;
  for (std::size_t k = 0; k < cut.values.size(); ++k) {
    const double quantum = k < 3 * size ? plane.velocity_quantum : plane.pressure_quantum;
    const auto value = static_cast<std::uint32_t>(quantum > 0.0 ? std::lround(cut.values[k] / quantum) : 0L);
    plane.bytes.push_back(static_cast<std::uint8_t>(value & 255U));
    plane.bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 255U));
  }
}

void quantise(const std::vector<Cut>& cuts, FluidPlanes::Plane& plane) {
  double fastest = 0.0, highest = 0.0;
  for (const Cut& one : cuts) {
    const std::size_t size = one.values.size() / quantities;
    for (std::size_t k = 0; k < one.values.size(); ++k) {
      double& largest = k < 3 * size ? fastest : highest;
      largest = std::max(largest, std::abs(one.values[k]));
    }
  }
  plane.velocity_quantum = fastest / largest_integer;
  plane.pressure_quantum = highest / largest_integer;
  for (const Cut& one : cuts) append(one, plane);
}

std::size_t bytes_of(const Box& box, int axis) {
  std::array<int, 2> n{};
  int most = 0, k = 0;
  for (int d = 0; d < 3; ++d)
    if (d != axis) most = std::max(most, n[static_cast<std::size_t>(k++)] = box.cells[static_cast<std::size_t>(d)]);
  const int block = (most + most_points - 1) / most_points;
  return 2UL * quantities * static_cast<std::size_t>((n[0] + block - 1) / block) *
         static_cast<std::size_t>((n[1] + block - 1) / block);
}

bool is_mirrored(const StoredRun& run, int axis) {
  const StoredRun::Json mirror = run.parameter("domain.mirror");
  const auto at = static_cast<std::size_t>(axis);
  return mirror.is_array() && mirror.size() == 3 && mirror[at].is_boolean() && mirror[at].get<bool>();
}

FluidPlanes::Plane plane_of(const Box& box, int axis, bool mirrored) {
  const auto at = static_cast<std::size_t>(axis);
  FluidPlanes::Plane plane;
  plane.axis = axis;
  plane.position = mirrored ? box.lower[at] : (box.lower[at] + box.upper[at]) / 2.0;
  for (std::size_t d = 0, k = 0; d < 3; ++d)
    if (d != at) {
      plane.lower[k] = box.lower[d];
      plane.upper[k++] = box.upper[d];
    }
  return plane;
}

// What is wrong with one snapshot leaves that one out.
void try_to(std::vector<std::string>& missing, const std::function<void()>& read) {
  try {
    read();
  } catch (const std::exception& reason) {
    missing.push_back(fmt::format("A snapshot of the fluid: {}.", reason.what()));
  }
}

using Files = std::vector<std::filesystem::path>;

// That of the first snapshot that can be read.
std::optional<Box> box_of(const Files& files, std::vector<std::string>& missing) {
  std::optional<Box> box;
  for (std::size_t i = 0; i < files.size() && !box; ++i)
    try_to(missing, [&] { box = read_box(Hdf5File(files[i], Hdf5File::Mode::read), files[i].filename().string()); });
  return box;
}

// The cuts of a snapshot across these axes.
std::vector<Cut> read_cuts(const Hdf5File& file, const std::string& name, const Box& box, const std::vector<int>& axes,
                           const StoredRun& run) {
  if (read_box(file, name).cells != box.cells) throw FileError(name + ": has another grid than the others");
  std::vector<Cut> cuts;
  cuts.reserve(axes.size());
  for (const int axis : axes) cuts.push_back(cut(file, box, axis, is_mirrored(run, axis)));
  return cuts;
}

}  // namespace

FluidPlanes read_fluid_planes(const StoredRun& run, std::size_t most_bytes) {
  FluidPlanes fluid;
  fluid.stored = run.fluid.size();
  Files files;
  files.reserve(run.fluid.size());
  for (const auto& entry : run.fluid) files.push_back(entry.second);
  const std::optional<Box> box = box_of(files, fluid.missing);
  if (!box) return fluid;
  std::size_t bytes = bytes_of(*box, 0) + bytes_of(*box, 1) + bytes_of(*box, 2);
  std::vector<int> axes = {1, 0, 2};
  if (bytes * files.size() > most_bytes) {
    axes = {1};
    bytes = bytes_of(*box, 1);
  }
  std::vector<std::vector<Cut>> cuts(axes.size());  // of each axis, of each snapshot
  for (const std::size_t i : evenly_chosen(files.size(), std::max<std::size_t>(1, most_bytes / bytes)))
    try_to(fluid.missing, [&] {
      const Hdf5File file(files[i], Hdf5File::Mode::read);
      std::vector<Cut> of_snapshot = read_cuts(file, files[i].filename().string(), *box, axes, run);
      fluid.times.push_back(file.read_number("/", "time"));
      for (std::size_t a = 0; a < axes.size(); ++a) cuts[a].push_back(std::move(of_snapshot[a]));
    });
  for (std::size_t a = 0; a < axes.size() && !fluid.times.empty(); ++a) {
    FluidPlanes::Plane plane = plane_of(*box, axes[a], is_mirrored(run, axes[a]));
    plane.points = cuts[a].front().points;
    quantise(cuts[a], plane);
    fluid.planes.push_back(std::move(plane));
  }
  return fluid;
}

}  // namespace vesiflow::run
