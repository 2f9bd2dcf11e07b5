// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "files/snapshot_files.h"

namespace vesiflow::run {
namespace {

// Velocity at cell centres, the mean of the two faces, three components per cell.
std::vector<float> cell_velocity(const fluid::FaceVector& u) {
  const auto& cells = u.grid().cells;
  std::vector<float> out;
  out.reserve(3 * u.grid().cell_count());
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        out.insert(out.end(), {static_cast<float>(0.5 * (u.x(i, j, k) + u.x(i + 1, j, k))),
                               static_cast<float>(0.5 * (u.y(i, j, k) + u.y(i, j + 1, k))),
                               static_cast<float>(0.5 * (u.z(i, j, k) + u.z(i, j, k + 1)))});
  return out;
}

std::vector<float> cell_values(const fluid::Field<fluid::Cell>& p) {
  std::vector<float> out;
  out.reserve(p.grid().cell_count());
  for (int k = 0; k < p.extent(2); ++k)
    for (int j = 0; j < p.extent(1); ++j)
      for (int i = 0; i < p.extent(0); ++i) out.push_back(static_cast<float>(p(i, j, k)));
  return out;
}

std::string xdmf_grid(const std::string& file, long step, double time, const fluid::Grid& grid) {
  const auto& c = grid.cells;
  std::string text = fmt::format("    <Grid Name=\"step_{}\">\n      <Time Value=\"{}\"/>\n", step, time);
  text += fmt::format(
      "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{} {} {}\"/>\n"
      "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
      "        <DataItem Format=\"XML\" Dimensions=\"3\">{} {} {}</DataItem>\n"
      "        <DataItem Format=\"XML\" Dimensions=\"3\">{} {} {}</DataItem>\n"
      "      </Geometry>\n",
      c[2] + 1, c[1] + 1, c[0] + 1, grid.lower[2], grid.lower[1], grid.lower[0], grid.spacing(2), grid.spacing(1),
      grid.spacing(0));
  text += fmt::format(
      "      <Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Cell\"><DataItem Format=\"HDF\" "
      "Precision=\"4\" Dimensions=\"{} {} {} 3\">{}:/velocity</DataItem></Attribute>\n"
      "      <Attribute Name=\"pressure\" Center=\"Cell\"><DataItem Format=\"HDF\" Precision=\"4\" "
      "Dimensions=\"{} {} {}\">{}:/pressure</DataItem></Attribute>\n    </Grid>\n",
      c[2], c[1], c[0], file, c[2], c[1], c[0], file);
  return text;
}

void write_grid(Hdf5File& file, const fluid::Grid& grid) {
  file.attribute("/", "lower", std::vector<double>(grid.lower.begin(), grid.lower.end()));
  file.attribute("/", "upper", std::vector<double>(grid.upper.begin(), grid.upper.end()));
  file.attribute("/", "cells", std::vector<double>(grid.cells.begin(), grid.cells.end()));
}

void write_fields(Hdf5File& file, const SceneSimulation& simulation) {
  const fluid::Grid& grid = simulation.fluid().grid();
  const Hdf5File::Shape cells{static_cast<std::uint64_t>(grid.cells[2]), static_cast<std::uint64_t>(grid.cells[1]),
                              static_cast<std::uint64_t>(grid.cells[0])};
  write_grid(file, grid);
  file.write("/velocity", cell_velocity(simulation.fluid_velocity()).data(), {cells[0], cells[1], cells[2], 3});
  file.write("/pressure", cell_values(simulation.fluid().pressure()).data(), cells);
}

}  // namespace

SnapshotSeries::Kind fluid_snapshots(const SceneSimulation& simulation) {
  return {.name = "fluid",
          .head = [&simulation](Hdf5File& list) { write_grid(list, simulation.fluid().grid()); },
          .fill = [&simulation](Hdf5File& snapshot) { write_fields(snapshot, simulation); },
          .xdmf = [&simulation](const std::string& file, long step,
                                double time) { return xdmf_grid(file, step, time, simulation.fluid().grid()); }};
}

}  // namespace vesiflow::run
