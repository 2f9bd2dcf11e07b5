// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_lines.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "io/binary_file.h"

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

TextLines::TextLines(std::filesystem::path path, Continuation continuation)
    : path_(std::move(path)), stream_(opened(path_)), continuation_(continuation) {}

void TextLines::skip_byte_order_mark() {
  if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
    throw std::runtime_error(path_.string() + ": this is text in UTF-16; save it as UTF-8");
  if (text_.starts_with("\xef\xbb\xbf")) text_.erase(0, 3);
}

bool TextLines::read_line() {
  if (!std::getline(stream_, text_)) return false;
  if (++read_ == 1) skip_byte_order_mark();
  line_ = read_;
  if (continuation_ == Continuation::none) return true;
  std::string more;
  for (;;) {
    if (text_.ends_with('\r')) text_.pop_back();
    if (!text_.ends_with('\\')) return true;
    text_.back() = ' ';
    if (!std::getline(stream_, more)) return true;
    ++read_;
    text_ += more;
  }
}

bool TextLines::next() {
  constexpr std::string_view blank = " \t\r\v\f";
  while (read_line()) {
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

std::optional<double> TextLines::parsed(std::string_view word) {
  double value = 0;
  if (!parse(word, value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

double TextLines::number(std::string_view word, std::string_view name) const {
  const std::optional<double> value = parsed(word);
  if (!value) fail(std::string(name) + " = " + shown(word) + ": must be a finite number");
  return *value;
}

int TextLines::integer(std::string_view word, std::string_view name) const {
  int value = 0;
  if (!parse(word, value)) fail(std::string(name) + " = " + shown(word) + ": must be a whole number");
  return value;
}

std::array<double, 3> TextLines::point(std::size_t first_word, std::string_view name) const {
  if (words_.size() < first_word + 3) fail(std::string(name) + " needs three coordinates");
  std::array<double, 3> x{};
  for (std::size_t k = 0; k < 3; ++k) x[k] = number(words_[first_word + k], std::array{"x", "y", "z"}[k]);
  return x;
}

std::string TextLines::lower_case(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
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
