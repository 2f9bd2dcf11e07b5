#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace vesiflow::vesicle {

/// Lines of a text file as words, without `#` comments and without lines that hold no word. Errors are
/// std::runtime_error "file:line: what is wrong".
class TextLines {
 public:
  /// @throws std::runtime_error if the file cannot be opened.
  explicit TextLines(std::filesystem::path path);

  /// Moves to the next line with words; false at the end of the file.
  /// @throws std::runtime_error if reading fails.
  bool next();

  /// Words of the present line; they live until next().
  const std::vector<std::string_view>& words() const { return words_; }
  int line() const { return line_; }

  /// The whole word as a finite number, a whole number. `name` says in the message what it stands for.
  double number(std::string_view word, std::string_view name) const;
  int integer(std::string_view word, std::string_view name) const;

  /// The word as it can be printed in a message: its beginning, with '?' for what is not text.
  static std::string shown(std::string_view word);

  [[noreturn]] void fail(std::string_view what) const { fail_at(line_, what); }
  [[noreturn]] void fail_at(int line, std::string_view what) const;

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::string text_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

}  // namespace vesiflow::vesicle
