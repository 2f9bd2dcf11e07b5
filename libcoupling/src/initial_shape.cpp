#include "initial_shape.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <utility>

#include "coupling/errors.h"
#include "coupling/overlap.h"
#include "periodic_images.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/surface.h"
#include "vesicle/surface_file.h"
#include "vesicle/triangle_mesh_file.h"

namespace vesiflow::coupling {
namespace {

/// Fits meshes; one that several vesicles share, once.
class FittedMeshes {
 public:
  /// key: of the file, for the log.
  const vesicle::Coefficients& fit(const std::string& file, std::optional<int> asked, int latitudes,
                                   const std::string& key) {
    if (!meshes_.contains(file)) meshes_.emplace(file, vesicle::read_triangle_mesh(file));
    const vesicle::TriangleMesh& mesh = meshes_.at(file);
    const int degrees = asked.value_or(vesicle::default_fit_degrees(mesh.vertices.rows(), latitudes));
    const auto [entry, is_new] = surfaces_.try_emplace(std::pair{file, degrees});
    if (is_new) {
      vesicle::MeshFit fit = vesicle::fit_mesh(mesh, degrees);
      spdlog::info("{}: {}", key, vesicle::description(fit));
      entry->second = std::move(fit.surface);
    }
    return entry->second;
  }

 private:
  std::map<std::string, vesicle::TriangleMesh> meshes_;
  std::map<std::pair<std::string, int>, vesicle::Coefficients> surfaces_;
};

}  // namespace

void load_surfaces(Scene& scene, const std::string& name) {
  FittedMeshes meshes;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    VesicleScene& vesicle = scene.vesicles[i];
    if (!vesicle.file) continue;
    const std::string key = fmt::format("{}: vesicles.{}.file", name, i);
    try {
      if (vesicle.shape == Shape::coefficients) vesicle.surface = vesicle::read_surface_coefficients(*vesicle.file);
      if (vesicle.shape == Shape::mesh)
        vesicle.surface = meshes.fit(*vesicle.file, vesicle.fit_degrees, scene.latitudes(i), key);
    } catch (const std::invalid_argument& error) {
      throw SceneError(fmt::format("{}: vesicles.{}.fit_degrees: {}", name, i, error.what()));
    } catch (const std::domain_error& error) {
      throw SceneError(fmt::format("{} = \"{}\": {}", key, *vesicle.file, error.what()));
    } catch (const std::runtime_error& error) {
      throw SceneError(fmt::format("{}: {}", key, error.what()));
    }
  }
}

vesicle::VectorField checked_markers(const Scene& scene, std::size_t i, const std::string& name) {
  const VesicleScene& vesicle = scene.vesicles[i];
  try {
    vesicle::VectorField markers = initial_markers(vesicle, scene.latitudes(i));
    // The others are always surfaces.
    const bool is_free_form = vesicle.shape == Shape::harmonics || vesicle.surface;
    if (is_free_form) vesicle::Surface(scene.latitudes(i)).update(markers);
    return markers;
  } catch (const std::logic_error& error) {
    const char* key = vesicle.file ? "file" : vesicle.shape == Shape::harmonics ? "harmonics" : "shape";
    throw SceneError(fmt::format("{}: vesicles.{}.{}: {}", name, i, key, error.what()));
  }
}

vesicle::VectorField initial_markers(const VesicleScene& scene, int latitudes) {
  const vesicle::SphereGrid grid(latitudes);
  vesicle::Placement placement;
  placement.effective_radius = scene.radius;
  placement.centre = vesicle::Vector3(scene.centre.data());
  placement.rotation = Eigen::AngleAxisd(scene.rotation_deg * std::numbers::pi / 180.0,
                                         vesicle::Vector3(scene.rotation_axis.data()).normalized())
                           .toRotationMatrix();
  switch (scene.shape) {
    case Shape::prolate:
      return scene.reduced_volume ? vesicle::prolate(grid, *scene.reduced_volume, placement)
                                  : vesicle::spheroid(grid, *scene.aspect_ratio, placement);
    case Shape::oblate:
      return scene.reduced_volume ? vesicle::oblate(grid, *scene.reduced_volume, placement)
                                  : vesicle::spheroid(grid, 1.0 / *scene.aspect_ratio, placement);
    case Shape::ellipsoid:
      return vesicle::ellipsoid(grid, vesicle::Vector3(scene.axes->data()), placement);
    case Shape::biconcave:
      return vesicle::biconcave_disc(grid, placement);
    case Shape::harmonics:
      return vesicle::perturbed_sphere(grid, scene.harmonics, placement);
    case Shape::coefficients:
    case Shape::mesh:
      return vesicle::shape_from_coefficients(grid, *scene.surface, placement);
    case Shape::sphere:
      break;
  }
  return vesicle::sphere(grid, placement);
}

void check_apart(const Scene& scene, const std::string& name) {
  const fluid::Grid grid(scene.domain.lower, scene.domain.upper, scene.domain.cells, scene.domain.periodic);
  std::vector<vesicle::VectorField> markers;
  std::vector<vesicle::Surface> surfaces;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    markers.push_back(initial_markers(scene.vesicles[i], scene.latitudes(i)));
    surfaces.emplace_back(scene.latitudes(i));
    try {
      surfaces.back().update(markers.back());
    } catch (const std::logic_error& error) {  // too small or too large for its areas to be numbers
      throw SceneError(
          fmt::format("{}: vesicles.{}.radius = {:g}: {}", name, i, scene.vesicles[i].radius, error.what()));
    }
  }
  for (std::size_t a = 0; a < markers.size(); ++a)
    for (std::size_t b = a; b < markers.size(); ++b)
      for_each_image(grid, Bounds(markers[a]), Bounds(markers[b]), 0.0, [&](const vesicle::Vector3& shift) {
        const bool is_itself = a == b && shift.isZero(0.0);
        if (is_itself || !(overlap(surfaces[a], markers[b], shift) || overlap(surfaces[b], markers[a], -shift))) return;
        const char* image = shift.isZero(0.0) ? "" : " (repeated along a periodic axis)";
        throw SceneError(fmt::format("{}: vesicles.{} and vesicles.{}{} overlap; move one of them (centre){}", name, a,
                                     b, image, a == b ? " or enlarge the box" : ""));
      });
}

}  // namespace vesiflow::coupling
