#include <fmt/format.h>

#include "atomic_file.h"
#include "snapshot_files.h"
#include "snapshot_series.h"

namespace vesiflow::coupling {
namespace {

constexpr std::int64_t format_version = 1;

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

std::string xdmf(const std::map<long, double>& steps, const fluid::Grid& grid) {
  const auto& c = grid.cells;
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "  <Grid Name=\"fluid\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const auto& [step, time] : steps) {
    const std::string base = "fluid.h5:" + step_group(step);
    text += fmt::format("    <Grid Name=\"step_{}\">\n      <Time Value=\"{}\"/>\n", step, time);
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
        "Precision=\"4\" Dimensions=\"{} {} {} 3\">{}/velocity</DataItem></Attribute>\n"
        "      <Attribute Name=\"pressure\" Center=\"Cell\"><DataItem Format=\"HDF\" Precision=\"4\" "
        "Dimensions=\"{} {} {}\">{}/pressure</DataItem></Attribute>\n    </Grid>\n",
        c[2], c[1], c[0], base, c[2], c[1], c[0], base);
  }
  return text + "  </Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace

FluidSnapshots::FluidSnapshots(std::filesystem::path directory)
    : directory_(std::move(directory)), steps_(stored_steps(directory_ / "fluid.h5")) {}

// The list first: it never names a snapshot that is not there.
void FluidSnapshots::rewind(const Simulation& simulation) {
  const auto later = steps_.upper_bound(simulation.steps());
  if (later == steps_.end()) return;
  steps_.erase(later, steps_.end());
  write_text_atomically(directory_ / "fluid.xdmf", xdmf(steps_, simulation.fluid().grid()));
  drop_after(directory_ / "fluid.h5", simulation.steps());
}

void FluidSnapshots::write(const Simulation& simulation) {
  const fluid::NavierStokes& fluid = simulation.fluid();
  const fluid::Grid& grid = fluid.grid();
  const Hdf5File::Shape cells{static_cast<std::uint64_t>(grid.cells[2]), static_cast<std::uint64_t>(grid.cells[1]),
                              static_cast<std::uint64_t>(grid.cells[0])};
  append_snapshot(
      directory_ / "fluid.h5", simulation.steps(), simulation.time(),
      [&](Hdf5File& file) {
        file.attribute("/", "format", format_version);
        file.attribute("/", "lower", std::vector<double>(grid.lower.begin(), grid.lower.end()));
        file.attribute("/", "upper", std::vector<double>(grid.upper.begin(), grid.upper.end()));
        file.attribute("/", "cells", std::vector<double>(grid.cells.begin(), grid.cells.end()));
      },
      [&](Hdf5File& file, const std::string& group) {
        file.write(group + "/velocity", cell_velocity(fluid.velocity()).data(), {cells[0], cells[1], cells[2], 3});
        file.write(group + "/pressure", cell_values(fluid.pressure()).data(), cells);
      });
  steps_[simulation.steps()] = simulation.time();
  write_text_atomically(directory_ / "fluid.xdmf", xdmf(steps_, grid));
}

}  // namespace vesiflow::coupling
