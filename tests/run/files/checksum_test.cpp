// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/checksum.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

namespace vesiflow::run::checksum_test {
namespace {

std::uint64_t sum_of(const auto&... values) {
  Checksum sum;
  (sum.add(values), ...);
  return static_cast<std::uint64_t>(sum.value());
}

std::vector<double> thousand_numbers() {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.25 * i - 7.0);
  return values;
}

// What xxhsum -H3 prints for files of the same bytes, the first being empty: a length, then text or numbers, little-endian.
TEST(Checksum, IsXxh3OfTheBytes) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::int64_t minus_three = -3;
  EXPECT_EQ(sum_of(), 0x2d06800538d394c2U);
  EXPECT_EQ(sum_of(std::string_view("vesiflow")), 0x2497f93f04fbba2eU);
  EXPECT_EQ(sum_of(1.5), 0x2561a4889ff63458U);
  EXPECT_EQ(sum_of(thousand_numbers()), 0xdf07244064c7e875U);
  EXPECT_EQ(sum_of(std::string_view("vesiflow"), 1.5, minus_three, thousand_numbers()), 0x3ffbb31d7f4bea17U);
}

TEST(Checksum, TellsWhereAListEnds) {
  const std::vector<double> one{1.0}, two{1.0, 2.0}, none;
  EXPECT_NE(sum_of(one, std::vector{2.0, 3.0}), sum_of(two, std::vector{3.0}));
  EXPECT_NE(sum_of(one), sum_of(one, none));
  EXPECT_NE(sum_of(std::string_view("ab"), std::string_view("c")),
            sum_of(std::string_view("a"), std::string_view("bc")));
}

// Each bit of a number, those of zero among them, and zeros in place of a block.
TEST(Checksum, TellsBitsAndZeros) {
  const std::vector<double> values = thousand_numbers();
  const std::uint64_t sum = sum_of(values);
  for (int bit = 0; bit < 64; ++bit) {
    std::vector<double> other = values;
    other[777] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(other[777]) ^ (std::uint64_t{1} << bit));
    EXPECT_NE(sum_of(other), sum) << bit;
  }
  EXPECT_NE(sum_of(0.0), sum_of(-0.0));
  EXPECT_NE(sum_of(std::vector<double>(64, 0.0)), sum_of(std::vector<double>(65, 0.0)));
  EXPECT_NE(sum_of(std::vector<double>(64, 0.0)),
            sum_of(std::vector<double>(64, std::bit_cast<double>(~std::uint64_t{0}))));
}

}  // namespace
}  // namespace vesiflow::run::checksum_test
