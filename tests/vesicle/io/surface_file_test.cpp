// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/surface_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "support.h"
#include "text_file.h"

namespace vesiflow::vesicle::surface_file_test {
namespace {

using testing::TextFile;

TEST(SurfaceFile, ReadsBackToTheSameBits) {
  const TextFile file("surface.txt");
  Coefficients written = testing::random_coefficients(9, 3, 5);
  written(1, 8, 3) = {-0.0, 5e-324};
  written(2, 8, 8) = {1e300, -1.0 / 3};
  write_surface_coefficients(file.path(), written);
  const Coefficients read = read_surface_coefficients(file.path());
  ASSERT_EQ(read.degrees(), 9);
  ASSERT_EQ(read.fields(), 3);
  for (int field = 0; field < 3; ++field)
    for (int n = 0; n < 9; ++n)
      for (int m = 0; m <= n; ++m) {
        const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
        EXPECT_EQ(bits(read(field, n, m).real()), bits(written(field, n, m).real())) << n << " " << m;
        EXPECT_EQ(bits(read(field, n, m).imag()), bits(written(field, n, m).imag())) << n << " " << m;
      }
}

TEST(SurfaceFile, LinesLeftOutAreZeroAndComeInAnyOrder) {
  const TextFile file("short.txt", "# a comment\n\n2 1  0 0  0 0  3 -4 # another\n0 0  1e0 0  +2 -0  0 0\r\n");
  const Coefficients read = read_surface_coefficients(file.path());
  EXPECT_EQ(read.degrees(), 3);
  EXPECT_EQ(read(2, 2, 1), Coefficients::Complex(3, -4));
  EXPECT_EQ(read(1, 0, 0), Coefficients::Complex(2, 0));
  EXPECT_EQ(read.energy(0, 3), 1 + 4 + 2 * 25);
}

TEST(SurfaceFile, SkipsTheByteOrderMarkOfUtf8AndNamesUtf16) {
  const TextFile file("marked.txt",
                      "\xef\xbb\xbf"
                      "0 0  1 0  2 0  3 0\n");
  EXPECT_EQ(read_surface_coefficients(file.path())(2, 0, 0), Coefficients::Complex(3, 0));
  EXPECT_EQ(testing::complaint_about("wide.txt",
                                     std::string("\xff\xfe"
                                                 "0\0",
                                                 4),
                                     read_surface_coefficients),
            "wide.txt: this is text in UTF-16; save it as UTF-8");
}

/// The unit sphere by hand in the documented convention: x and y from Y_1^1 = sqrt(3/(8 pi)) sin(theta) exp(i phi) by 2
/// Re(c Y) and 2 Re(-i c Y), z from Y_1^0 = sqrt(3/(4 pi)) cos(theta).
TEST(SurfaceFile, ConventionIsTheOneInTheHeader) {
  const TextFile file("sphere.txt",
                      "1 1  1.4472025091165353 0  0 -1.4472025091165353  0 0\n1 0 0 0 0 0 2.0466534158929770 0\n");
  const Coefficients read = read_surface_coefficients(file.path());
  const SphereGrid grid(8);
  VectorField x(grid.size(), 3);
  SphericalHarmonics(2, grid).synthesis(read, x);
  EXPECT_LT((x - sphere(grid)).abs().maxCoeff(), 1e-15);
}

TEST(SurfaceFile, ErrorsNameFileLineValueAndWhatIsAllowed) {
  const auto complaint = [](const std::string& text) {
    return testing::complaint_about("s.txt", text, read_surface_coefficients);
  };
  EXPECT_EQ(complaint("0 0 1 0 0 0 0\n"), "s.txt:1: 7 numbers: must be 8, n m re_x im_x re_y im_y re_z im_z");
  EXPECT_EQ(complaint("#\n-1 0 1 0 0 0 0 0\n"), "s.txt:2: n = -1: must be in [0, 512]");
  EXPECT_EQ(complaint("513 0 1 0 0 0 0 0\n"), "s.txt:1: n = 513: must be in [0, 512]");
  EXPECT_EQ(complaint("1.0 0 1 0 0 0 0 0\n"), "s.txt:1: n = 1.0: must be a whole number");
  EXPECT_EQ(complaint("2 3 1 0 0 0 0 0\n"), "s.txt:1: m = 3: must be in [0, n] = [0, 2]");
  EXPECT_EQ(complaint("2 -1 1 0 0 0 0 0\n"), "s.txt:1: m = -1: must be in [0, n] = [0, 2]");
  EXPECT_EQ(complaint("2 0 1 0 0 1e-9 0 0\n"), "s.txt:1: im_y = 1e-9: must be 0 for m = 0");
  EXPECT_EQ(complaint("2 1 1 0 0 0 nan 0\n"), "s.txt:1: re_z = nan: must be a finite number");
  EXPECT_EQ(complaint("2 1 1 0 x 0 0 0\n"), "s.txt:1: re_y = x: must be a finite number");
  EXPECT_EQ(complaint("2 1 1 0 0 0 0 0\n0 0 0 0 0 0 0 0\n2 1 1 0 0 0 0 0\n"),
            "s.txt:3: n = 2, m = 1: given before, in line 1");
  EXPECT_EQ(complaint("# nothing\n"), "s.txt: no coefficients: at least one line is needed");
  EXPECT_THROW(read_surface_coefficients("no/such/file.txt"), std::runtime_error);
  EXPECT_THROW(read_surface_coefficients(std::filesystem::temp_directory_path()), std::runtime_error);
}

TEST(SurfaceFile, RefusesToWriteWhatItCouldNotReadBack) {
  const TextFile file("refused.txt");
  EXPECT_THROW(write_surface_coefficients(file.path(), testing::random_coefficients(4, 2, 1)), std::invalid_argument);
  Coefficients coefficients = testing::random_coefficients(4, 3, 1);
  EXPECT_THROW(write_surface_coefficients("no/such/folder/file.txt", coefficients), std::runtime_error);
  coefficients(0, 2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_surface_coefficients(file.path(), coefficients), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::surface_file_test
