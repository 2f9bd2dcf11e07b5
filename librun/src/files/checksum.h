// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

struct XXH3_state_s;

namespace vesiflow::run {

/// A 64-bit checksum, XXH3 of xxHash without a seed, of the bytes of a sequence of numbers and texts as they lie in memory.
/// Lists and texts are preceded by their length, so that values that move from one to the next change the sum. Unlike sums
/// modulo 2^k - 1 (Fletcher) it tells words of zeros from words of ones, and sees zeroed data.
class Checksum {
 public:
  Checksum();
  void add(std::span<const double> values);
  void add(double value);
  void add(std::int64_t value);
  void add(std::string_view text);
  std::int64_t value() const;

 private:
  void add_bytes(const void* bytes, std::size_t count);

  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

}  // namespace vesiflow::run
