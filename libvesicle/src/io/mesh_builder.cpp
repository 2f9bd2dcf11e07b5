// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_builder.h"

namespace vesiflow::vesicle {

void MeshBuilder::add_face(const std::vector<int>& corners, int place, const Fail& fail) {
  if (corners.size() < 3) fail(place, "a face of " + std::to_string(corners.size()) + " corners: must be at least 3");
  for (std::size_t k = 2; k < corners.size(); ++k)
    triangles_.push_back({{corners[0], corners[k - 1], corners[k]}, place});
  ++faces_;
}

TriangleMesh MeshBuilder::finish(const Fail& fail, int first_number) const {
  TriangleMesh mesh{VectorField(vertices(), 3), {}};
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices(i, Eigen::Index(k)) = vertices_[std::size_t(i)][k];
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [corner, place] = triangles_[std::size_t(t)];
      if (corner[k] < 0 || corner[k] >= vertices())
        fail(place, "corner " + std::to_string(static_cast<long>(corner[k]) + first_number) + ": must be in [" +
                        std::to_string(first_number) + ", " + std::to_string(vertices() - 1 + first_number) +
                        "], the vertices of the file");
      mesh.triangles(t, Eigen::Index(k)) = corner[k];
    }
  return mesh;
}

}  // namespace vesiflow::vesicle
