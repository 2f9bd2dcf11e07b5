// Files of triangle meshes, .off where the first word begins with O and .obj otherwise: each is refused by the errors that
// triangle_mesh_file.h, triangle_mesh.h and star_shaped_fit.h promise, or makes a finite surface.
#include <stdexcept>

#include "check.h"
#include "input_file.h"
#include "vesicle/star_shaped_fit.h"
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
    const vesicle::StarShapedFit fit = vesicle::fit_star_shaped(mesh, degrees);
    check(fit.centre.allFinite() && std::isfinite(fit.mean_radius) && std::isfinite(fit.rms_residual) &&
              std::isfinite(fit.max_residual) && std::isfinite(fit.surface.energy(0, degrees + 1)),
          "the surface that is fitted to a mesh is finite");
  } catch (const std::invalid_argument&) {
  } catch (const std::domain_error&) {
  }
}

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vesiflow::fuzz::InputFile off("mesh.off"), obj("mesh.obj");
  const auto& file = size > 0 && data[0] == 'O' ? off : obj;
  file.write({data, size});
  vesiflow::fuzz::read(file.path());
  return 0;
}
