// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "files/snapshot_files.h"

namespace vesiflow::run {
namespace {

std::uint64_t points_of(int latitudes) {
  return 2ULL * latitudes * latitudes + 2;
}
std::uint64_t triangles_of(int latitudes) {
  return 4ULL * latitudes * latitudes;
}

// Two triangles per mesh cell and a fan around each pole, all counter-clockwise seen from outside.
std::vector<std::int32_t> triangles(int latitudes) {
  const int longitudes = 2 * latitudes, north = latitudes * longitudes, south = north + 1;
  std::vector<std::int32_t> list;
  list.reserve(3 * triangles_of(latitudes));
  const auto at = [longitudes](int j, int i) { return j * longitudes + i % longitudes; };
  for (int i = 0; i < longitudes; ++i) list.insert(list.end(), {north, at(0, i), at(0, i + 1)});
  for (int j = 0; j + 1 < latitudes; ++j) {
    for (int i = 0; i < longitudes; ++i) {
      list.insert(list.end(), {at(j, i), at(j + 1, i), at(j + 1, i + 1)});
      list.insert(list.end(), {at(j, i), at(j + 1, i + 1), at(j, i + 1)});
    }
  }
  for (int i = 0; i < longitudes; ++i) list.insert(list.end(), {south, at(latitudes - 1, i + 1), at(latitudes - 1, i)});
  return list;
}

// Values at the markers followed by the two poles. A smooth function at a pole is the mean over a small ring up to the
// square of its radius; two rings remove that term.
class WithPoles {
 public:
  explicit WithPoles(const vesicle::SphereGrid& grid) : grid_(grid) {
    const double a = grid.sin_colatitude()(0), b = grid.sin_colatitude()(1);
    near_ = b * b / (b * b - a * a);
    far_ = -a * a / (b * b - a * a);
  }

  std::vector<double> of(const vesicle::ScalarField& f) const {
    std::vector<double> out(f.data(), f.data() + f.size());
    out.push_back(pole(f.data(), 0, 1));
    out.push_back(pole(f.data(), grid_.latitudes() - 1, grid_.latitudes() - 2));
    return out;
  }

  std::vector<double> of(const vesicle::VectorField& f) const {
    const auto points = static_cast<std::size_t>(f.rows()) + 2;
    std::vector<double> out(3 * points);
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> component = of(vesicle::ScalarField(f.col(c)));
      for (std::size_t m = 0; m < points; ++m) out[3 * m + static_cast<std::size_t>(c)] = component[m];
    }
    return out;
  }

 private:
  double ring_mean(const double* f, int j) const {
    double sum = 0.0;
    for (int i = 0; i < grid_.longitudes(); ++i) sum += f[grid_.index(i, j)];
    return sum / grid_.longitudes();
  }
  double pole(const double* f, int nearest, int next) const {
    return near_ * ring_mean(f, nearest) + far_ * ring_mean(f, next);
  }

  const vesicle::SphereGrid& grid_;
  double near_, far_;
};

void add_vesicle(Hdf5File& file, const std::string& group, const vesicle::Membrane& membrane,
                 const vesicle::VectorField& velocity) {
  const vesicle::Surface& surface = membrane.surface();
  const WithPoles with_poles(surface.grid());
  const std::uint64_t points = points_of(surface.grid().latitudes());
  const auto vector = [&](const char* name, const vesicle::VectorField& f) {
    file.write(group + "/" + name, with_poles.of(f).data(), {points, 3});
  };
  const auto scalar = [&](const char* name, const vesicle::ScalarField& f) {
    file.write(group + "/" + name, with_poles.of(f).data(), {points});
  };
  vector("positions", surface.positions());
  vector("velocity", velocity);
  vector("force", membrane.force());
  scalar("tension", membrane.tension());
  scalar("mean_curvature", surface.mean_curvature());
  scalar("gaussian_curvature", surface.gaussian_curvature());
  scalar("local_area_error", surface.area_weight() / membrane.target_areas() - 1.0);
  file.attribute(group, "latitudes", static_cast<std::int64_t>(surface.grid().latitudes()));
  file.attribute(group, "longitudes", static_cast<std::int64_t>(surface.grid().longitudes()));
}

std::string xdmf_grid(const std::string& file, std::size_t vesicle, int latitudes) {
  const std::string base = fmt::format("{}:/vesicle_{}", file, vesicle);
  const std::uint64_t points = points_of(latitudes);
  std::string text = fmt::format(
      "      <Grid Name=\"vesicle_{}\">\n"
      "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\"><DataItem Format=\"HDF\" NumberType=\"Int\" "
      "Dimensions=\"{} 3\">vesicle.h5:/topology/vesicle_{}</DataItem></Topology>\n"
      "        <Geometry GeometryType=\"XYZ\"><DataItem Format=\"HDF\" Precision=\"8\" Dimensions=\"{} "
      "3\">{}/positions</DataItem></Geometry>\n",
      vesicle, triangles_of(latitudes), triangles_of(latitudes), vesicle, points, base);
  for (const char* name : {"tension", "mean_curvature", "gaussian_curvature", "local_area_error"})
    text += fmt::format(
        "        <Attribute Name=\"{}\" Center=\"Node\"><DataItem Format=\"HDF\" Precision=\"8\" "
        "Dimensions=\"{}\">{}/{}</DataItem></Attribute>\n",
        name, points, base, name);
  for (const char* name : {"velocity", "force"})
    text += fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"Vector\" Center=\"Node\"><DataItem Format=\"HDF\" "
        "Precision=\"8\" Dimensions=\"{} 3\">{}/{}</DataItem></Attribute>\n",
        name, points, base, name);
  return text + "      </Grid>\n";
}

std::string xdmf_grids(const std::string& file, long step, double time, const Scene& scene) {
  std::string text =
      fmt::format("    <Grid Name=\"step_{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n", step);
  text += fmt::format("      <Time Value=\"{}\"/>\n", time);
  for (std::size_t v = 0; v < scene.vesicles.size(); ++v) text += xdmf_grid(file, v, scene.latitudes(v));
  return text + "    </Grid>\n";
}

void write_topology(Hdf5File& list, const Scene& scene) {
  list.attribute("/", "vesicles", static_cast<std::int64_t>(scene.vesicles.size()));
  for (std::size_t v = 0; v < scene.vesicles.size(); ++v)
    list.write(fmt::format("/topology/vesicle_{}", v), triangles(scene.latitudes(v)).data(),
               {triangles_of(scene.latitudes(v)), 3});
}

}  // namespace

SnapshotSeries::Kind vesicle_snapshots(SceneSimulation& simulation) {
  return {.name = "vesicle",
          .head = [&simulation](Hdf5File& list) { write_topology(list, simulation.scene()); },
          .fill =
              [&simulation](Hdf5File& snapshot) {
                for (std::size_t v = 0; v < simulation.vesicle_count(); ++v)
                  add_vesicle(snapshot, fmt::format("/vesicle_{}", v), simulation.membrane(v),
                              simulation.marker_velocity(v));
              },
          .xdmf = [&simulation](const std::string& file, long step,
                                double time) { return xdmf_grids(file, step, time, simulation.scene()); }};
}

}  // namespace vesiflow::run
