#include "vesicle/triangle_mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <vector>

#include "text_lines.h"

namespace vesiflow::vesicle {
namespace {

/// A mesh while its file is being read.
class MeshBuilder {
 public:
  int vertices() const { return static_cast<int>(vertices_.size()); }
  int faces() const { return faces_; }

  void add_vertex(const TextLines& file, std::size_t first_word) {
    if (file.words().size() < first_word + 3) file.fail("a vertex needs three coordinates");
    std::array<double, 3> x{};
    for (std::size_t k = 0; k < 3; ++k) x[k] = file.number(file.words()[first_word + k], std::array{"x", "y", "z"}[k]);
    vertices_.push_back(x);
  }

  /// Corners numbered from 0.
  void add_face(const std::vector<int>& corners, const TextLines& file) {
    if (corners.size() < 3) file.fail("a face of " + std::to_string(corners.size()) + " corners: must be at least 3");
    for (std::size_t k = 2; k < corners.size(); ++k)
      triangles_.push_back({{corners[0], corners[k - 1], corners[k]}, file.line()});
    ++faces_;
  }

  /// first_number: of the first vertex in the file, for messages.
  TriangleMesh finish(const TextLines& file, int first_number) const {
    TriangleMesh mesh{VectorField(vertices(), 3), {}};
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
      for (std::size_t k = 0; k < 3; ++k) mesh.vertices(i, Eigen::Index(k)) = vertices_[std::size_t(i)][k];
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& [corner, line] = triangles_[std::size_t(t)];
        if (corner[k] < 0 || corner[k] >= vertices())
          file.fail_at(line, "corner " + std::to_string(corner[k] + first_number) + ": must be in [" +
                                 std::to_string(first_number) + ", " + std::to_string(vertices() - 1 + first_number) +
                                 "], the vertices of the file");
        mesh.triangles(t, Eigen::Index(k)) = corner[k];
      }
    return mesh;
  }

 private:
  struct Triangle {
    std::array<int, 3> corner;
    int line;
  };
  std::vector<std::array<double, 3>> vertices_;
  std::vector<Triangle> triangles_;
  int faces_ = 0;
};

TriangleMesh read_obj(const std::filesystem::path& path) {
  TextLines file(path);
  MeshBuilder builder;
  std::vector<int> corners;
  while (file.next()) {
    const auto& words = file.words();
    if (words[0] == "v") {
      builder.add_vertex(file, 1);
    } else if (words[0] == "f") {
      corners.clear();
      for (std::size_t k = 1; k < words.size(); ++k) {
        const int number = file.integer(words[k].substr(0, words[k].find('/')), "corner");
        if (number == 0) file.fail("corner 0: numbers count from 1, or from -1 backwards");
        corners.push_back(number > 0 ? number - 1 : builder.vertices() + number);
      }
      builder.add_face(corners, file);
    }
  }
  return builder.finish(file, 1);
}

TriangleMesh read_off(const std::filesystem::path& path) {
  TextLines file(path);
  const auto expect_line = [&file](const char* what) {
    if (!file.next()) file.fail(std::string("the file ends where ") + what + " should be");
  };
  expect_line("OFF");
  if (file.words()[0] != "OFF") file.fail("the first word must be OFF, the plain text form");
  std::size_t first = 1;
  if (file.words().size() == 1) {
    expect_line("the line of counts");
    first = 0;
  }
  if (file.words().size() < first + 2) file.fail("the numbers of vertices, faces and edges are needed");
  const int vertices = file.integer(file.words()[first], "number of vertices");
  const int faces = file.integer(file.words()[first + 1], "number of faces");
  if (vertices < 0 || faces < 0) file.fail("the numbers of vertices and faces must be >= 0");

  MeshBuilder builder;
  while (builder.vertices() < vertices) {
    expect_line("a vertex");
    builder.add_vertex(file, 0);
  }
  std::vector<int> corners;
  while (builder.faces() < faces) {
    expect_line("a face");
    const int count = file.integer(file.words()[0], "number of corners");
    if (count < 3 || static_cast<std::size_t>(count) >= file.words().size())
      file.fail("number of corners = " + std::to_string(count) + ": must be >= 3, and the corners must follow");
    corners.clear();
    for (std::size_t k = 1; k <= static_cast<std::size_t>(count); ++k)
      corners.push_back(file.integer(file.words()[k], "corner"));
    builder.add_face(corners, file);
  }
  if (file.next()) file.fail("the file goes on after its " + std::to_string(faces) + " faces");
  return builder.finish(file, 0);
}

std::string lower_case_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

bool is_triangle_mesh_name(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".obj" || ending == ".off";
}

TriangleMesh read_triangle_mesh(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".obj") return read_obj(path);
  if (ending == ".off") return read_off(path);
  throw std::runtime_error(path.string() + ": the name of a mesh must end in .obj or .off");
}

}  // namespace vesiflow::vesicle
