// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace vesiflow::run {

/// A 64-bit checksum of a sequence of numbers and texts. Each step, exclusive or, product with an odd number and
/// xor-shift, is a bijection of the sum: a change of one number always changes it, any other but for one chance in
/// 2^64. Unlike sums modulo 2^k - 1 (Fletcher) it tells words of zeros from words of ones, and sees zeroed data.
class Checksum {
 public:
  void add(const double* values, std::size_t count) {
    add_word(count);
    for (std::size_t i = 0; i < count; ++i) add(values[i]);
  }
  void add(double value) {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    add_word(word);
  }
  void add(std::int64_t value) { add_word(static_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    add_word(text.size());
    for (const char c : text) add_word(static_cast<unsigned char>(c));
  }
  std::int64_t value() const { return static_cast<std::int64_t>(sum_); }

 private:
  void add_word(std::uint64_t word) {
    sum_ = (sum_ ^ word) * 0x9e3779b97f4a7c15ULL;
    sum_ ^= sum_ >> 32;
  }

  std::uint64_t sum_ = 0x243f6a8885a308d3ULL;  // of nothing: any number but 0
};

}  // namespace vesiflow::run
