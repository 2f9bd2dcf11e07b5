// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "io/binary_file.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_lines.h"

namespace vesiflow::vesicle {
namespace {

/// STL says each corner anew for each triangle: corners at the same point, to the last bit, are one vertex. What then has a
/// corner twice was a triangle without area and is left out.
class Welder {
 public:
  void add(const std::array<std::array<double, 3>, 3>& points, int place, const MeshBuilder::Fail& fail) {
    std::vector<int> corners;
    for (std::array<double, 3> point : points) {
      for (double& coordinate : point) coordinate += 0.0;  // -0 is 0
      const auto [entry, is_new] = numbers_.try_emplace(point, builder_.vertices());
      if (is_new) builder_.add_vertex(point);
      corners.push_back(entry->second);
    }
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      builder_.add_face(corners, place, fail);
  }
  TriangleMesh finish(const MeshBuilder::Fail& fail) const { return builder_.finish(fail, 0); }

 private:
  MeshBuilder builder_;
  std::map<std::array<double, 3>, int> numbers_;
};

}  // namespace

TriangleMesh read_text_stl(const std::filesystem::path& path) {
  TextLines file(path);
  const MeshBuilder::Fail fail = [&file](int line, const std::string& what) { file.fail_at(line, what); };
  Welder welder;
  std::array<std::array<double, 3>, 3> points{};
  std::size_t known = 0;
  bool is_open = false;
  while (file.next()) {
    const std::string word = TextLines::lower_case(file.words()[0]);
    if (word == "vertex") {
      if (known == 3) file.fail("a facet of more than three vertices: must be a triangle");
      points[known++] = file.point(1, "a vertex");
    } else if (word == "endfacet") {
      if (known != 3) file.fail("a facet of " + std::to_string(known) + " vertices: must be a triangle");
      welder.add(points, file.line(), fail);
      known = 0;
    } else if (word == "solid" || word == "endsolid") {
      is_open = word == "solid";
    } else if (word != "facet" && word != "outer" && word != "endloop") {
      file.fail(TextLines::shown(file.words()[0]) +
                ": must be solid, facet, outer, vertex, endloop, endfacet or endsolid");
    }
  }
  if (is_open) file.fail("the file ends where endsolid should be");
  return welder.finish(fail);
}

TriangleMesh read_binary_stl(const std::filesystem::path& path) {
  constexpr std::size_t header = 84, record = 50, normal = 12;
  const std::string bytes = contents_of(path);
  const MeshBuilder::Fail fail = [&path](int triangle, const std::string& what) {
    fail_in(path, "triangle " + std::to_string(triangle) + ": " + what);
  };
  Welder welder;
  int triangle = 0;
  for (std::size_t start = header; start + record <= bytes.size(); start += record, ++triangle) {
    std::array<std::array<double, 3>, 3> points{};
    std::size_t at = start + normal;
    for (auto& point : points)
      for (double& coordinate : point) {
        coordinate = from_bytes<float>(bytes.data() + at, std::endian::little);
        at += sizeof(float);
        if (!std::isfinite(coordinate)) fail(triangle, "a coordinate is not finite");
      }
    welder.add(points, triangle, fail);
  }
  return welder.finish(fail);
}

}  // namespace vesiflow::vesicle
