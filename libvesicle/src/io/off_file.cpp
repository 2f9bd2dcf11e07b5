// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_lines.h"

namespace vesiflow::vesicle {
namespace {

/// [ST][C][N][4][n]OFF of Geomview: what a vertex has beyond x y z. Normals, colours and texture coordinates follow them and are
/// skipped.
struct Keyword {
  bool is_valid = false;
  bool homogeneous = false;     ///< 4: x y z w
  bool has_dimensions = false;  ///< n: their number follows

  explicit Keyword(std::string_view word) {
    const auto take = [&word](std::string_view prefix) {
      if (!word.starts_with(prefix)) return false;
      word.remove_prefix(prefix.size());
      return true;
    };
    take("ST");
    take("C");
    take("N");
    homogeneous = take("4");
    has_dimensions = take("n");
    is_valid = word == "OFF";
  }
};

class OffReader {
 public:
  explicit OffReader(const std::filesystem::path& path) : file_(path) {}

  TriangleMesh read() {
    expect_line("OFF");
    const Keyword keyword(file_.words()[0]);
    if (file_.words().size() > 1 && file_.words()[1] == "BINARY")
      file_.fail("binary OFF is not read here; save the mesh as text OFF, PLY, STL or OBJ");
    word_ = 1;
    if (keyword.has_dimensions) {
      const int dimensions = count("the number of dimensions", "number of dimensions");
      if (dimensions != 3)
        file_.fail("number of dimensions = " + std::to_string(dimensions) + ": must be 3, for a surface in space");
    }
    const int vertices = count("the line of counts", "number of vertices");
    if (word_ >= file_.words().size()) file_.fail("the numbers of vertices, faces and edges are needed");
    const int faces = file_.integer(file_.words()[word_], "number of faces");
    if (vertices < 0 || faces < 0) file_.fail("the numbers of vertices and faces must be >= 0");
    while (builder_.vertices() < vertices) read_vertex(keyword);
    while (builder_.faces() < faces) read_face();
    if (file_.next()) file_.fail("the file goes on after its " + std::to_string(faces) + " faces");
    return builder_.finish(fail_, 0);
  }

 private:
  void expect_line(const char* what) {
    if (!file_.next()) file_.fail(std::string("the file ends where ") + what + " should be");
  }

  /// The next number of the header, on this line or the next.
  int count(const char* where, const char* name) {
    if (word_ >= file_.words().size()) {
      expect_line(where);
      word_ = 0;
    }
    return file_.integer(file_.words()[word_++], name);
  }

  void read_vertex(const Keyword& keyword) {
    expect_line("a vertex");
    std::array<double, 3> x = file_.point(0, "a vertex");
    if (keyword.homogeneous) {
      if (file_.words().size() < 4) file_.fail("a vertex of 4OFF needs four coordinates");
      const double w = file_.number(file_.words()[3], "w");
      for (double& coordinate : x) coordinate /= w;
      for (const double coordinate : x)
        if (!std::isfinite(coordinate))
          file_.fail("w = " + std::to_string(w) + ": the vertex is not at a finite place");
    }
    builder_.add_vertex(x);
  }

  void read_face() {
    expect_line("a face");
    const auto& words = file_.words();
    const int corners = file_.integer(words[0], "number of corners");
    if (corners < 3 || static_cast<std::size_t>(corners) >= words.size())
      file_.fail("number of corners = " + std::to_string(corners) + ": must be >= 3, and the corners must follow");
    corners_.clear();
    for (std::size_t k = 1; k <= static_cast<std::size_t>(corners); ++k)
      corners_.push_back(file_.integer(words[k], "corner"));
    builder_.add_face(corners_, file_.line(), fail_);
  }

  TextLines file_;
  MeshBuilder::Fail fail_ = [this](int line, const std::string& what) { file_.fail_at(line, what); };
  MeshBuilder builder_;
  std::vector<int> corners_;
  std::size_t word_ = 0;
};

}  // namespace

bool is_off_keyword(std::string_view word) {
  return Keyword(word).is_valid;
}

TriangleMesh read_off(const std::filesystem::path& path) {
  return OffReader(path).read();
}

}  // namespace vesiflow::vesicle
