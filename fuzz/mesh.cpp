// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of triangle meshes, OBJ, OFF, PLY or STL by their content: each is refused by the errors that triangle_mesh_file.h,
// triangle_mesh.h and mesh_fit.h promise, or makes a finite surface.
#include <stdexcept>

#include "check.h"
#include "input_file.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/triangle_mesh_file.h"

namespace vesiflow::fuzz {
namespace {

void read(const std::filesystem::path& path) {
  vesicle::TriangleMesh mesh;
  try {
    mesh = vesicle::read_triangle_mesh(path);
  } catch (const std::runtime_error&) {
    return;
  }
  check(mesh.vertices.isFinite().all(), "vertices of a mesh that was read are finite");
  check(mesh.triangles.size() == 0 ||
            (mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertices.rows()),
        "corners of a mesh that was read are vertices");
  constexpr int degrees = 2;
  try {
    const vesicle::MeshFit fit = vesicle::fit_mesh(mesh, degrees);
    check(std::isfinite(fit.radius) && std::isfinite(fit.max_distance) && std::isfinite(fit.max_between) &&
              std::isfinite(fit.fitted.area) && std::isfinite(fit.smooth.volume) &&
              std::isfinite(fit.surface.energy(0, degrees)),
          "the surface that is fitted to a mesh is finite");
  } catch (const std::invalid_argument&) {
  } catch (const std::domain_error&) {
  }
}

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vesiflow::fuzz::InputFile file("mesh");
  file.write({data, size});
  vesiflow::fuzz::read(file.path());
  return 0;
}
