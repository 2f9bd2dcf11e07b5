// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_lines.h"

namespace vesiflow::vesicle {

TriangleMesh read_obj(const std::filesystem::path& path) {
  TextLines file(path, TextLines::Continuation::backslash);
  const MeshBuilder::Fail fail = [&file](int line, const std::string& what) { file.fail_at(line, what); };
  MeshBuilder builder;
  std::vector<int> corners;
  while (file.next()) {
    const auto& words = file.words();
    if (words[0] == "v") {
      builder.add_vertex(file.point(1, "a vertex"));
    } else if (words[0] == "f") {
      corners.clear();
      for (std::size_t k = 1; k < words.size(); ++k) {
        const int number = file.integer(words[k].substr(0, words[k].find('/')), "corner");
        if (number == 0) file.fail("corner 0: numbers count from 1, or from -1 backwards");
        corners.push_back(number > 0 ? number - 1 : builder.vertices() + number);
      }
      builder.add_face(corners, file.line(), fail);
    }
  }
  return builder.finish(fail, 1);
}

}  // namespace vesiflow::vesicle
