// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_surfaces.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <map>
#include <utility>

#include "run/errors.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/surface_file.h"
#include "vesicle/triangle_mesh_file.h"

namespace vesiflow::run {
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
    coupling::VesicleParameters& vesicle = scene.vesicles[i];
    const SurfaceFile& file = scene.surface_file(i);
    if (!file.file) continue;
    const std::string key = fmt::format("{}: vesicles.{}.file", name, i);
    try {
      if (vesicle.shape == coupling::Shape::coefficients)
        vesicle.surface = vesicle::read_surface_coefficients(*file.file);
      if (vesicle.shape == coupling::Shape::mesh)
        vesicle.surface = meshes.fit(*file.file, file.fit_degrees, scene.latitudes(i), key);
    } catch (const std::invalid_argument& error) {
      throw SceneError(fmt::format("{}: vesicles.{}.fit_degrees: {}", name, i, error.what()));
    } catch (const std::domain_error& error) {
      throw SceneError(fmt::format("{} = \"{}\": {}", key, *file.file, error.what()));
    } catch (const std::runtime_error& error) {
      throw SceneError(fmt::format("{}: {}", key, error.what()));
    }
  }
}

}  // namespace vesiflow::run
