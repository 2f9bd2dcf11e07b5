#include "text_lines.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace vesiflow::vesicle {
namespace {

/// Whether the whole word was read. Independent of the locale; a leading plus is allowed, as other programs write it.
template <class Number>
bool parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc{} && stop == end;
}

}  // namespace

TextLines::TextLines(std::filesystem::path path) : path_(std::move(path)), stream_(path_) {
  if (!stream_ || std::filesystem::is_directory(path_))
    throw std::runtime_error(path_.string() + ": cannot be read: no such file, or no permission");
}

bool TextLines::next() {
  constexpr std::string_view blank = " \t\r\v\f";
  while (std::getline(stream_, text_)) {
    ++line_;
    words_.clear();
    std::string_view rest = std::string_view(text_).substr(0, text_.find('#'));
    for (std::size_t start = 0; (start = rest.find_first_not_of(blank)) != std::string_view::npos;) {
      rest.remove_prefix(start);
      const std::size_t length = std::min(rest.find_first_of(blank), rest.size());
      words_.push_back(rest.substr(0, length));
      rest.remove_prefix(length);
    }
    if (!words_.empty()) return true;
  }
  if (stream_.bad()) throw std::runtime_error(path_.string() + ": reading failed");
  return false;
}

double TextLines::number(std::string_view word, std::string_view name) const {
  double value = 0;
  if (!parse(word, value) || !std::isfinite(value))
    fail(std::string(name) + " = " + shown(word) + ": must be a finite number");
  return value;
}

int TextLines::integer(std::string_view word, std::string_view name) const {
  int value = 0;
  if (!parse(word, value)) fail(std::string(name) + " = " + shown(word) + ": must be a whole number");
  return value;
}

std::string TextLines::shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > longest ? text + "..." : text;
}

void TextLines::fail_at(int line, std::string_view what) const {
  throw std::runtime_error(path_.string() + ":" + std::to_string(line) + ": " + std::string(what));
}

}  // namespace vesiflow::vesicle
