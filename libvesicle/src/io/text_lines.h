// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vesiflow::vesicle {

/// Lines of a text file as words, without `#` comments and without lines that hold no word. A byte order mark of UTF-8 is
/// skipped, text in UTF-16 is refused by name. Errors are std::runtime_error "file:line: what is wrong".
class TextLines {
 public:
  /// Whether a line that ends with a backslash goes on in the next; its number is that of the first.
  enum class Continuation { none, backslash };

  /// @throws std::runtime_error if the file cannot be opened.
  explicit TextLines(std::filesystem::path path, Continuation continuation = Continuation::none);

  /// Moves to the next line with words; false at the end of the file.
  /// @throws std::runtime_error if reading fails.
  bool next();

  /// Words of the present line; they live until next().
  const std::vector<std::string_view>& words() const { return words_; }
  int line() const { return line_; }

  /// The whole word as a finite number, a whole number. `name` says in the message what it stands for.
  double number(std::string_view word, std::string_view name) const;
  int integer(std::string_view word, std::string_view name) const;

  /// The whole word as a finite number; nothing if it is none.
  static std::optional<double> parsed(std::string_view word);

  /// Three words as x, y, z. `name` says in the message what they stand for.
  std::array<double, 3> point(std::size_t first_word, std::string_view name) const;

  static std::string lower_case(std::string_view word);

  /// The word as it can be printed in a message: its beginning, with '?' for what is not text.
  static std::string shown(std::string_view word);

  [[noreturn]] void fail(std::string_view what) const { fail_at(line_, what); }
  [[noreturn]] void fail_at(int line, std::string_view what) const;

 private:
  bool read_line();
  void skip_byte_order_mark();

  std::filesystem::path path_;
  std::ifstream stream_;
  Continuation continuation_;
  std::string text_;
  std::vector<std::string_view> words_;
  int line_ = 0;
  int read_ = 0;  // lines, those that continue another among them
};

}  // namespace vesiflow::vesicle
