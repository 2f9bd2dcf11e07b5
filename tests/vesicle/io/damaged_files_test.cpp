// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "meshes.h"
#include "support.h"
#include "text_file.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/shapes.h"
#include "vesicle/surface_file.h"
#include "vesicle/triangle_mesh_file.h"

namespace vesiflow::vesicle::damaged_files_test {
namespace {

using testing::TextFile;

/// The text with a few random edits: bytes changed, removed, inserted, the end cut off, lines exchanged or repeated, numbers
/// replaced by awkward ones.
std::string damaged(std::string text, std::mt19937& generator) {
  const auto below = [&generator](std::size_t n) { return generator() % std::max<std::size_t>(n, 1); };
  const auto start_of_line = [&text](std::size_t at) { return at == 0 ? 0 : text.rfind('\n', at - 1) + 1; };
  constexpr const char* awkward[] = {"nan", "-inf", "1e308", "-1e-320",   "2147483647", "-2147483648", "99999999999",
                                     "0x1", "#",    "\n",    "",          "+-1",        "1e999",       "-0",
                                     "512", "1,5",  "3/",    "f 1 2 3\n", "OFF",        "\t\r\v",      "5 5"};
  for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
    const std::size_t at = below(text.size());
    switch (below(7)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, 1 + below(8));
        break;
      case 2:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 3:
        text.resize(at);
        break;
      case 4: {
        const std::size_t line = start_of_line(at);
        text.insert(line, text.substr(line, text.find('\n', line) - line) + "\n");
        break;
      }
      case 5: {
        const std::size_t line = start_of_line(at);
        text.erase(line, text.find('\n', line) - line);
        break;
      }
      default: {
        const std::size_t word = text.find_first_of(" \n", at);
        if (word == std::string::npos) break;
        text.replace(word + 1, text.find_first_of(" \n", word + 1) - word - 1, awkward[below(std::size(awkward))]);
      }
    }
  }
  return text;
}

/// Reads damaged files: each gives a readable error of the promised types, or a result that `use` accepts.
void try_damaged(const std::string& name, const std::string& text, int count, unsigned seed,
                 const std::function<void(const std::filesystem::path&)>& use) {
  std::mt19937 generator(seed);
  for (int k = 0; k < count; ++k) {
    const TextFile file(name, damaged(text, generator));
    std::string what;
    try {
      use(file.path());
      continue;
    } catch (const std::runtime_error& error) {
      what = error.what();
    } catch (const std::domain_error& error) {
      what = error.what();
    } catch (const std::invalid_argument& error) {
      what = error.what();
    }
    EXPECT_TRUE(what.size() > 20 && what.size() < 500 && what.find('\n') == std::string::npos) << what;
  }
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// More of them by hand: VESIFLOW_FUZZ_RUNS=100000.
int runs() {
  const char* const given = std::getenv("VESIFLOW_FUZZ_RUNS");
  return given ? std::atoi(given) : 200;
}

TEST(DamagedFiles, CoefficientsAreReadOrRefused) {
  const TextFile file("whole.txt");
  Surface surface(6);
  surface.update(ellipsoid(surface.grid(), {1, 1.2, 1.5}));
  write_surface_coefficients(file.path(), surface.position_coefficients());
  try_damaged("damaged.txt", text_of(file.path()), runs(), 1, [](const std::filesystem::path& path) {
    const VectorField x = shape_from_coefficients(SphereGrid(6), read_surface_coefficients(path));
    EXPECT_TRUE(x.isFinite().all());
  });
}

class DamagedMeshes : public ::testing::TestWithParam<const char*> {};

std::string bytes_of(float value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string text_of(const TriangleMesh& mesh, const std::string& format) {
  std::ostringstream text;
  const Eigen::Index vertices = mesh.vertices.rows(), triangles = mesh.triangles.rows();
  const auto point = [&](Eigen::Index i) -> std::ostream& {
    return text << mesh.vertices(i, 0) << ' ' << mesh.vertices(i, 1) << ' ' << mesh.vertices(i, 2) << '\n';
  };
  if (format == "stl") {
    text << "solid\n";
    for (Eigen::Index t = 0; t < triangles; ++t) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const int corner : mesh.triangles.row(t)) {
        text << "vertex ";
        point(corner);
      }
      text << "endloop\nendfacet\n";
    }
    text << "endsolid\n";
    return text.str();
  }
  const bool is_binary = format == "ply";
  if (format == "off") text << "OFF\n" << vertices << ' ' << triangles << " 0\n";
  if (is_binary)
    text << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << triangles
         << "\nproperty list uchar uchar vertex_indices\nend_header\n";
  for (Eigen::Index i = 0; i < vertices; ++i) {
    if (is_binary) {
      for (int k = 0; k < 3; ++k) text << bytes_of(float(mesh.vertices(i, k)));
      continue;
    }
    text << (format == "obj" ? "v " : "");
    point(i);
  }
  for (Eigen::Index t = 0; t < triangles; ++t) {
    text << (is_binary ? "\3" : format == "off" ? "3" : "f");
    for (const int corner : mesh.triangles.row(t)) {
      if (is_binary)
        text << static_cast<char>(corner);
      else
        text << ' ' << corner + (format == "off" ? 0 : 1);
    }
    if (!is_binary) text << '\n';
  }
  return text.str();
}

TEST_P(DamagedMeshes, AreReadOrRefused) {
  const std::string format = GetParam();
  const std::string text = text_of(testing::octasphere(2), format);
  try_damaged("damaged." + format, text, runs(), 2, [](const std::filesystem::path& path) {
    const MeshFit fit = fit_mesh(read_triangle_mesh(path), 4);
    EXPECT_TRUE(shape_from_coefficients(SphereGrid(6), fit.surface).isFinite().all());
    EXPECT_TRUE(std::isfinite(fit.rms_distance) && std::isfinite(fit.max_between));
  });
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedMeshes, ::testing::Values("obj", "off", "ply", "stl"));

}  // namespace
}  // namespace vesiflow::vesicle::damaged_files_test
