// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/triangle_mesh_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "meshes.h"
#include "text_file.h"

namespace vesiflow::vesicle::triangle_mesh_file_test {
namespace {

using testing::complaint_about;
using testing::TextFile;

void expect_cube(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertices.rows(), 8);
  EXPECT_EQ(mesh.triangles.rows(), 12);
  EXPECT_NO_THROW(check_closed_genus_zero(mesh));
  EXPECT_NEAR(enclosed_volume(mesh).volume, 8, 1e-14);
  EXPECT_LT(enclosed_volume(mesh).centroid.norm(), 1e-14);
}

TEST(TriangleMeshFile, ReadsObjWithPolygonsAndRelativeNumbers) {
  const TextFile file("cube.OBJ",
                      "# a cube of edge 2\r\nmtllib none.mtl\no cube\n"
                      "v -1 -1 -1\nv 1 -1 -1 1.0\nv +1 1.0e0 -1\nv -1 1 -1\n"
                      "v -1 -1 1 # top\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvt 0 0\nvn 0 0 1\ns off\n"
                      "f 4 3 2 1\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1//1 2//1 6//1 5//1\nf -7 -6 -2 -3\n"
                      "f 3 4 8\nf 3 8 7\nf 4 1 5 8\n");
  expect_cube(read_triangle_mesh(file.path()));
}

TEST(TriangleMeshFile, ReadsOffWithColoursAndComments) {
  const std::string body =
      "\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n"
      "4 3 2 1 0 255 0 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n3 2 3 7\n3 2 7 6\n4 3 0 4 7\n";
  expect_cube(read_triangle_mesh(TextFile("a.off", "OFF # cube\n\n8 7 12" + body).path()));
  expect_cube(read_triangle_mesh(TextFile("b.off", "OFF 8 7 12" + body).path()));
}

TEST(TriangleMeshFile, ErrorsNameFileAndLine) {
  const auto obj = [](const std::string& text) { return complaint_about("m.obj", text, read_triangle_mesh); };
  EXPECT_EQ(obj("v 0 0 0\nv 0 1\n"), "m.obj:2: a vertex needs three coordinates");
  EXPECT_EQ(obj("v 0 0 nan\n"), "m.obj:1: z = nan: must be a finite number");
  EXPECT_EQ(obj("v 0 0,5 0\n"), "m.obj:1: y = 0,5: must be a finite number");
  EXPECT_EQ(obj("v 0 0 1e999\n"), "m.obj:1: z = 1e999: must be a finite number");
  EXPECT_EQ(obj("v 0 0 0\n\nf 1 1\n"), "m.obj:3: a face of 2 corners: must be at least 3");
  EXPECT_EQ(obj("v 0 0 0\nf 1 0 1\n"), "m.obj:2: corner 0: numbers count from 1, or from -1 backwards");
  EXPECT_EQ(obj("v 0 0 0\nf 1 1.5 1\n"), "m.obj:2: corner = 1.5: must be a whole number");
  EXPECT_EQ(obj("v 0 0 0\nf 1 1 2\n"), "m.obj:2: corner 2: must be in [1, 1], the vertices of the file");
  EXPECT_EQ(obj("v 0 0 0\nf 1 1 -2\n"), "m.obj:2: corner 0: must be in [1, 1], the vertices of the file");

  const auto off = [](const std::string& text) { return complaint_about("m.off", text, read_triangle_mesh); };
  EXPECT_EQ(off(""), "m.off: the file is empty");
  EXPECT_EQ(off("COFF\n"), "m.off:1: the file ends where the line of counts should be");
  EXPECT_EQ(off("OFF\n4\n"), "m.off:2: the numbers of vertices, faces and edges are needed");
  EXPECT_EQ(off("OFF\n1 1 0\n0 0 0\n"), "m.off:3: the file ends where a face should be");
  EXPECT_EQ(off("OFF\n1 1 0\n0 0 0\n3 0 0\n"),
            "m.off:4: number of corners = 3: must be >= 3, and the corners must follow");
  EXPECT_EQ(off("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), "m.off:4: corner 1: must be in [0, 0], the vertices of the file");

  EXPECT_THROW(read_triangle_mesh("no/such.obj"), std::runtime_error);
}

TEST(TriangleMeshFile, MessagesStayReadableForBinaryFiles) {
  const std::string garbage(100000, '\xff');
  const std::string complaint =
      complaint_about("m.obj", "v 1 2 " + std::string("\0\1", 2) + garbage, read_triangle_mesh);
  EXPECT_EQ(complaint, "m.obj:1: z = " + std::string(40, '?') + "...: must be a finite number");
}

TEST(TriangleMeshFile, CountsThatTheFileExceedsAreAnError) {
  const std::string text = "OFF\n4 3 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  EXPECT_EQ(complaint_about("m.off", text, read_triangle_mesh), "m.off:10: the file goes on after its 3 faces");
}

constexpr const char* mark = "\xef\xbb\xbf";
const std::string tetrahedron_vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string tetrahedron_faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

void expect_tetrahedron(const std::string& name, const std::string& text) {
  SCOPED_TRACE(name);
  const TextFile file(name, text);
  EXPECT_TRUE(is_triangle_mesh_file(file.path()));
  TriangleMesh mesh;
  ASSERT_NO_THROW(mesh = read_triangle_mesh(file.path()));
  EXPECT_EQ(mesh.vertices.rows(), 4);
  EXPECT_NO_THROW(check_closed_genus_zero(mesh));
  EXPECT_NEAR(enclosed_volume(mesh).volume, 1.0 / 6, 1e-15);
}

std::string complaint(const std::string& name, const std::string& text) {
  return complaint_about(name, text, read_triangle_mesh);
}

TEST(TriangleMeshFile, SkipsByteOrderMarksOfUtf8AndNamesUtf16) {
  expect_tetrahedron("a.off", mark + ("OFF\n4 4 6\n" + tetrahedron_vertices + tetrahedron_faces));
  expect_tetrahedron("a.obj",
                     std::string(mark) + "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  EXPECT_EQ(complaint("a.obj", std::string("\xff\xfev\0 \0", 6)), "a.obj: this is text in UTF-16; save it as UTF-8");
  EXPECT_EQ(complaint("a.off", std::string("\xfe\xff\0O", 4)), "a.off: this is text in UTF-16; save it as UTF-8");
}

TEST(TriangleMeshFile, ContinuesLinesOfObj) {
  expect_tetrahedron(
      "a.obj",
      "g group\nv 0 0 0\nv 1 0 \\\r\n0\r\nv 0 1 0\nv 0 \\\n 0 \\\n1\nf 1 3 2\nf 1 2 \\\n4\nf 2 3 4\nf 1 4 3\n");
  EXPECT_EQ(complaint("a.obj", "v 0 0 \\\n0\nv 0\n"), "a.obj:3: a vertex needs three coordinates");
}

TEST(TriangleMeshFile, ReadsTheDialectsOfOff) {
  const auto off = [](const std::string& keyword, const std::string& more, const std::string& dimensions = "") {
    std::string text = keyword + "\n" + dimensions + "4 4 6\n";
    for (std::size_t at = 0; at < tetrahedron_vertices.size(); at += 6)
      text += tetrahedron_vertices.substr(at, 5) + more + "\n";
    return text + tetrahedron_faces;
  };
  expect_tetrahedron("a.off", off("COFF", " 255 0 0 255"));
  expect_tetrahedron("a.off", off("NOFF", " 0 0 1"));
  expect_tetrahedron("a.off", off("CNOFF", " 0 0 1 0.5 0.5 0.5 1"));
  expect_tetrahedron("a.off", off("STOFF", " 0.5 0.5"));
  expect_tetrahedron("a.off", off("STCNOFF", " 0 0 1 1 1 1 1 0.5 0.5"));
  expect_tetrahedron("a.off", off("4OFF", " 1"));
  expect_tetrahedron("a.off", off("nOFF", "", "3\n"));
  expect_tetrahedron("a.off", off("nOFF 3", ""));
  expect_tetrahedron("a.txt", off("OFF", ""));
  const TextFile file("a.off", off("4OFF", " 2"));
  EXPECT_NEAR(enclosed_volume(read_triangle_mesh(file.path())).volume, 1.0 / 48, 1e-15);

  EXPECT_EQ(complaint("a.off", off("nOFF", " 0", "4\n")),
            "a.off:2: number of dimensions = 4: must be 3, for a surface in space");
  EXPECT_EQ(complaint("a.off", off("4OFF", " 0")), "a.off:3: w = 0.000000: the vertex is not at a finite place");
  EXPECT_EQ(complaint("a.off", off("4OFF", "")), "a.off:3: a vertex of 4OFF needs four coordinates");
  EXPECT_EQ(complaint("a.off", "OFF BINARY\n\1\2\3"),
            "a.off:1: binary OFF is not read here; save the mesh as text OFF, PLY, STL or OBJ");
}

template <class Number>
std::string bytes_of(Number value, bool swapped = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

const int tetrahedron_corners[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

std::string binary_stl(const std::string& header) {
  std::string text = header + std::string(80 - header.size(), ' ') + bytes_of(std::uint32_t{4});
  for (const auto& corners : tetrahedron_corners) {
    text += std::string(12, '\0');
    for (const int corner : corners)
      for (int k = 1; k <= 3; ++k) text += bytes_of(corner == k ? 1.0F : corner == 0 && k == 1 ? -0.0F : 0.0F);
    text += std::string(2, '\0');
  }
  return text;
}

std::string text_stl() {
  std::string text = "solid a name of words\n";
  for (const auto& corners : tetrahedron_corners) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int corner : corners) {
      text += "   vertex";
      for (int k = 1; k <= 3; ++k) text += corner == k ? " 1.0e0" : " 0";
      text += "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid a name of words\n";
}

TEST(TriangleMeshFile, ReadsStlByItsContentAndWeldsIt) {
  expect_tetrahedron("a.stl", text_stl());
  expect_tetrahedron("a.STL", mark + text_stl());
  expect_tetrahedron("a.stl", binary_stl("made by a program"));
  expect_tetrahedron("a.stl", binary_stl("solid like text, and yet"));
  expect_tetrahedron("a.obj", binary_stl("solid"));
  std::string needle = text_stl();
  needle.insert(needle.rfind("endsolid"),
                "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n");
  expect_tetrahedron("a.stl", needle);
}

TEST(TriangleMeshFile, RefusesDamagedStl) {
  const std::string whole = binary_stl("solid");
  EXPECT_EQ(
      complaint("a.stl", whole.substr(0, 200)),
      "a.stl: neither text STL nor whole binary STL: by the number of its triangles that would have 284 bytes, and the "
      "file has 200");
  std::string infinite = whole;
  infinite.replace(84 + 50 + 12, 4, bytes_of(INFINITY));
  EXPECT_EQ(complaint("a.stl", infinite), "a.stl: triangle 1: a coordinate is not finite");
  EXPECT_EQ(
      complaint("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n"),
      "a.stl:7: a facet of 2 vertices: must be a triangle");
  EXPECT_EQ(complaint("a.stl", "solid\nfacet normal 0 0 1\nvertex 0 0 x\n"), "a.stl:3: z = x: must be a finite number");
  EXPECT_EQ(complaint("a.stl", "solid\nfacet normal 0 0 1\ncolour\n"),
            "a.stl:3: colour: must be solid, facet, outer, vertex, endloop, endfacet or endsolid");
  const std::string text = text_stl();
  EXPECT_NE(complaint("a.stl", text.substr(0, text.rfind("endsolid"))).find("the file ends where endsolid should be"),
            std::string::npos);
}

enum class PlyForm { ascii, little, big };

std::string ply(PlyForm form) {
  const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string text =
      std::string("ply\r\nformat ") + names[int(form)] +
      " 1.0\ncomment by hand\nelement camera 1\nproperty list uchar short dials\nelement vertex 4\nproperty "
      "float nx\nproperty double x\nproperty float32 y\nproperty float z\nproperty uchar red\nelement face "
      "4\nproperty list uint8 int32 vertex_indices\nproperty uchar flag\nend_header\n";
  const auto put = [&](auto value) {
    if (form == PlyForm::ascii)
      text += std::to_string(value) + " ";
    else
      text += bytes_of(value, (form == PlyForm::big) != (std::endian::native == std::endian::big));
  };
  put(std::uint8_t{2});
  put(std::int16_t{-5});
  put(std::int16_t{7});
  for (int i = 0; i < 4; ++i) {
    put(0.5F);
    put(i == 1 ? 1.0 : 0.0);
    put(i == 2 ? 1.0F : 0.0F);
    put(i == 3 ? 1.0F : 0.0F);
    put(std::uint8_t{200});
  }
  for (const auto& corners : tetrahedron_corners) {
    put(std::uint8_t{3});
    for (const int corner : corners) put(std::int32_t{corner});
    put(std::uint8_t{1});
  }
  return text;
}

TEST(TriangleMeshFile, ReadsPlyInItsThreeForms) {
  expect_tetrahedron("a.ply", ply(PlyForm::ascii));
  expect_tetrahedron("a.ply", ply(PlyForm::little));
  expect_tetrahedron("a.ply", ply(PlyForm::big));
  expect_tetrahedron("a.dat", ply(PlyForm::big));
  expect_tetrahedron("a.ply", ply(PlyForm::ascii).insert(3, " \t"));
}

// They may never end, and a pipe waits for who writes.
TEST(TriangleMeshFile, RefusesWhatIsNoFileOfADisk) {
  const std::string reason = "cannot be read: a folder, a pipe or a device; give a file on a disk";
  const TextFile file("pipe.ply");
  std::filesystem::remove(file.path());
  ASSERT_EQ(mkfifo(file.path().c_str(), 0600), 0);
  for (const std::filesystem::path& path :
       {file.path(), std::filesystem::path("/dev/zero"), std::filesystem::temp_directory_path()})
    try {
      read_triangle_mesh(path);
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), path.string() + ": " + reason);
    }
}

TEST(TriangleMeshFile, RefusesDamagedPly) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_index\n";
  EXPECT_EQ(complaint("a.ply", head + "end_header\n0 0\n"),
            "a.ply: vertex 0: z is missing or no finite number: a vertex needs the properties x, y, z");
  const std::string whole = head + "property float z\n" + face + "end_header\n";
  EXPECT_EQ(complaint("a.ply", whole + "0 0 nan\n"),
            "a.ply: vertex 0: z is missing or no finite number: a vertex needs the properties x, y, z");
  EXPECT_EQ(complaint("a.ply", whole + "0 0 0\n3 0 0\n"), "a.ply: face 0: the file ends in its middle");
  EXPECT_EQ(complaint("a.ply", whole + "0 0 0\n2 0 0\n"), "a.ply: face 0: a face of 2 corners: must be at least 3");
  EXPECT_EQ(complaint("a.ply", whole + "0 0 0\n3 0 0 1\n"),
            "a.ply: face 0: corner 1: must be in [0, 0], the vertices of the file");
  EXPECT_EQ(complaint("a.ply", whole + "0 0 0\n3 0 0.5 0\n"),
            "a.ply: face 0: corner = 0.500000: must be a whole number");
  EXPECT_EQ(complaint("a.ply", whole + "0 0 0\n3 0 0 0 0\n"), "a.ply: end: the file goes on after its last element");
  EXPECT_EQ(complaint("a.ply", "ply\nformat ascii 2.0\n"),
            "a.ply: line 2: format ascii 2.0: must be ascii, binary_little_endian or binary_big_endian, 1.0");
  EXPECT_EQ(complaint("a.ply", "ply\nend_header\n"), "a.ply: line 2: the header does not say its format");
  EXPECT_EQ(complaint("a.ply", "ply\nformat ascii 1.0\n"), "a.ply: line 2: the file ends before end_header");
  EXPECT_EQ(complaint("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"),
            "a.ply: line 3: number of vertex = -1: must be a whole number >= 0");
  EXPECT_EQ(complaint("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
            "a.ply: line 4: type half: must be one of PLY, such as float or int");
  EXPECT_EQ(complaint("a.ply",
                      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"),
            "a.ply: line 5: triangle strips are not read here; save the mesh with its faces as lists of vertices");
  const std::string binary = ply(PlyForm::little);
  EXPECT_EQ(complaint("a.ply", binary.substr(0, binary.size() - 1)), "a.ply: face 3: the file ends in its middle");
}

TEST(TriangleMeshFile, RefusesOtherFormatsByTheirName) {
  const std::string formats = "; meshes are read from OBJ, OFF, PLY and STL";
  EXPECT_EQ(complaint("a.vtk", "# vtk DataFile Version 3.0\n"), "a.vtk: this is VTK" + formats);
  EXPECT_EQ(complaint("a.glb", "glTF\2"), "a.glb: this is binary glTF" + formats);
  EXPECT_EQ(complaint("a.gltf", "{\"asset\": 1}"), "a.gltf: this is JSON (glTF)" + formats);
  EXPECT_EQ(complaint("a.3mf", "PK\3\4"), "a.3mf: this is a zip archive (3MF)" + formats);
  EXPECT_EQ(complaint("a.msh", "$MeshFormat\n"), "a.msh: this is Gmsh MSH" + formats);
  EXPECT_EQ(complaint("a.off", "4 4 6\n").substr(0, 27), "a.off: not known as a mesh:");
  const TextFile numbers("a.txt", "0 0 1 0 0 0 0 0\n"), vtk("a", "# vtk DataFile Version 3.0\n"),
      named("b.off", "4 4 6\n");
  EXPECT_FALSE(is_triangle_mesh_file(numbers.path()));
  EXPECT_TRUE(is_triangle_mesh_file(vtk.path()));
  EXPECT_TRUE(is_triangle_mesh_file(named.path()));
}

}  // namespace
}  // namespace vesiflow::vesicle::triangle_mesh_file_test
