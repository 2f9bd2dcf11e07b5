// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/triangle_mesh_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "io/binary_file.h"
#include "io/mesh_readers.h"
#include "io/text_lines.h"

namespace vesiflow::vesicle {
namespace {

enum class Format { obj, off, ply, text_stl, binary_stl, foreign, unknown };

struct Content {
  Format format = Format::unknown;
  std::string_view name;  ///< of a foreign format
};

std::string first_bytes(const std::filesystem::path& path, std::size_t count) {
  std::ifstream stream = opened(path);
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

std::uintmax_t size_of_binary_stl(const std::string& head) {
  return 84 + std::uintmax_t{50} * from_bytes<std::uint32_t>(head.data() + 80, std::endian::little);
}

/// The size says it, not the first bytes: many binary files begin with "solid" too.
bool is_binary_stl(const std::filesystem::path& path, const std::string& head) {
  std::error_code error;
  return head.size() == 84 && std::filesystem::file_size(path, error) == size_of_binary_stl(head) && !error;
}

/// Formats that begin with a signature of theirs.
std::string_view foreign_format(std::string_view head) {
  struct Signature {
    std::string_view bytes, name;
  };
  constexpr std::array<Signature, 14> signatures{{{"# vtk", "VTK"},
                                                  {"<?xml", "XML (VTU, VTP, COLLADA, X3D)"},
                                                  {"<VTKFile", "VTK XML"},
                                                  {"glTF", "binary glTF"},
                                                  {"{", "JSON (glTF)"},
                                                  {"PK\3\4", "a zip archive (3MF)"},
                                                  {"\x1f\x8b", "gzip; unpack it first"},
                                                  {"\x89HDF", "HDF5"},
                                                  {"$MeshFormat", "Gmsh MSH"},
                                                  {"MeshVersionFormatted", "Medit MESH"},
                                                  {"ISO-10303-21", "STEP"},
                                                  {"Kaydara FBX", "FBX"},
                                                  {"BLENDER", "a file of Blender"},
                                                  {"#VRML", "VRML"}}};
  for (const Signature& signature : signatures)
    if (head.starts_with(signature.bytes)) return signature.name;
  return {};
}

/// The first line says it, and nothing else.
bool is_ply(std::string_view head) {
  const std::string_view line = head.substr(0, head.find_first_of("\r\n"));
  return line.size() < head.size() && line.starts_with("ply") &&
         line.find_first_not_of(" \t", 3) == std::string_view::npos;
}

bool is_obj_keyword(std::string_view word) {
  constexpr std::array<std::string_view, 16> keywords{"v", "vt", "vn",     "vp",     "f",      "l",  "p",   "o",
                                                      "g", "s",  "usemtl", "mtllib", "usemap", "mg", "lod", "maplib"};
  return std::ranges::find(keywords, word) != keywords.end();
}

Content content_of(const std::filesystem::path& path) {
  const std::string head = first_bytes(path, 84);
  if (is_binary_stl(path, head)) return {Format::binary_stl, {}};
  if (const std::string_view name = foreign_format(head); !name.empty()) return {Format::foreign, name};
  if (is_ply(head)) return {Format::ply, {}};
  TextLines file(path);
  if (!file.next()) return {};
  if (is_off_keyword(file.words()[0])) return {Format::off, {}};
  if (is_obj_keyword(file.words()[0])) return {Format::obj, {}};
  if (TextLines::lower_case(file.words()[0]) != "solid" || !file.next()) return {};
  const std::string second = TextLines::lower_case(file.words()[0]);
  return {second == "facet" || second == "endsolid" ? Format::text_stl : Format::unknown, {}};
}

std::string ending_of(const std::filesystem::path& path) {
  return TextLines::lower_case(path.extension().string());
}

[[noreturn]] void refuse(const std::filesystem::path& path, const Content& content) {
  const std::string formats = "meshes are read from OBJ, OFF, PLY and STL";
  if (content.format == Format::foreign) fail_in(path, "this is " + std::string(content.name) + "; " + formats);
  const std::string head = first_bytes(path, 84);
  if (head.empty()) fail_in(path, "the file is empty");
  if (ending_of(path) == ".stl" && head.size() == 84) {
    std::error_code error;
    fail_in(path, "neither text STL nor whole binary STL: by the number of its triangles that would have " +
                      std::to_string(size_of_binary_stl(head)) + " bytes, and the file has " +
                      std::to_string(std::filesystem::file_size(path, error)));
  }
  fail_in(path,
          "not known as a mesh: OFF begins with the word OFF, PLY with ply, text STL with solid and facet, OBJ with "
          "a line of its own such as v; " +
              formats);
}

}  // namespace

bool is_triangle_mesh_file(const std::filesystem::path& path) {
  if (content_of(path).format != Format::unknown) return true;
  constexpr std::array<std::string_view, 4> endings{".obj", ".off", ".ply", ".stl"};
  return std::ranges::find(endings, ending_of(path)) != endings.end();
}

TriangleMesh read_triangle_mesh(const std::filesystem::path& path) {
  const Content content = content_of(path);
  switch (content.format) {
    case Format::obj:
      return read_obj(path);
    case Format::off:
      return read_off(path);
    case Format::ply:
      return read_ply(path);
    case Format::text_stl:
      return read_text_stl(path);
    case Format::binary_stl:
      return read_binary_stl(path);
    case Format::foreign:
    case Format::unknown:
      break;
  }
  refuse(path, content);
}

}  // namespace vesiflow::vesicle
