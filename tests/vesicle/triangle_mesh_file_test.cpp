#include "vesicle/triangle_mesh_file.h"

#include <gtest/gtest.h>

#include "meshes.h"
#include "text_file.h"

namespace vesiflow::vesicle {
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
  EXPECT_EQ(off(""), "m.off:0: the file ends where OFF should be");
  EXPECT_EQ(off("COFF\n"), "m.off:1: the first word must be OFF, the plain text form");
  EXPECT_EQ(off("OFF\n4\n"), "m.off:2: the numbers of vertices, faces and edges are needed");
  EXPECT_EQ(off("OFF\n1 1 0\n0 0 0\n"), "m.off:3: the file ends where a face should be");
  EXPECT_EQ(off("OFF\n1 1 0\n0 0 0\n3 0 0\n"),
            "m.off:4: number of corners = 3: must be >= 3, and the corners must follow");
  EXPECT_EQ(off("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), "m.off:4: corner 1: must be in [0, 0], the vertices of the file");

  EXPECT_THROW(read_triangle_mesh("no/such.obj"), std::runtime_error);
  EXPECT_NE(complaint_about("m.stl", "", read_triangle_mesh).find(".obj or .off"), std::string::npos);
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

}  // namespace
}  // namespace vesiflow::vesicle
