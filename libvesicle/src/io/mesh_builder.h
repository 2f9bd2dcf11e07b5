// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle {

/// A mesh while its file is being read. `place` is where in the file something is, as its reader counts: the line, or the
/// number of the face.
class MeshBuilder {
 public:
  using Fail = std::function<void(int place, const std::string& what)>;  ///< throws

  int vertices() const { return static_cast<int>(vertices_.size()); }
  int faces() const { return faces_; }

  void add_vertex(const std::array<double, 3>& position) { vertices_.push_back(position); }

  /// Corners numbered from 0, at least three; split into a fan from the first.
  void add_face(const std::vector<int>& corners, int place, const Fail& fail);

  /// first_number: of the first vertex in the file, for messages.
  TriangleMesh finish(const Fail& fail, int first_number) const;

 private:
  struct Triangle {
    std::array<int, 3> corner;
    int place;
  };
  std::vector<std::array<double, 3>> vertices_;
  std::vector<Triangle> triangles_;
  int faces_ = 0;
};

}  // namespace vesiflow::vesicle
