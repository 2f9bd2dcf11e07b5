// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/binary_file.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_lines.h"

namespace vesiflow::vesicle {
namespace {

constexpr std::string_view blank = " \t\r\n\v\f";

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Type> type_named(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (std::size_t k = 0; k < names.size(); ++k)
    if (name == names[k][0] || name == names[k][1]) return static_cast<Type>(k);
  return std::nullopt;
}

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count;  ///< of a list, the type of its length
};

struct Element {
  std::string name;
  int count;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& path) : path_(path), bytes_(contents_of(path)), rest_(bytes_) {}

  TriangleMesh read() {
    read_header();
    for (const Element& element : elements_)
      for (int i = 0; i < element.count && !element.properties.empty(); ++i) {
        where_ = element.name + " " + std::to_string(i);
        read_item(element, i);
      }
    where_ = "end";
    if (is_text_) rest_.remove_prefix(std::min(rest_.find_first_not_of(blank), rest_.size()));
    if (!rest_.empty()) fail("the file goes on after its last element");
    return builder_.finish(fail_at_face_, 0);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_in(path_, where_ + ": " + what); }

  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blank), rest_.size()));
    const std::string_view result = rest_.substr(0, rest_.find_first_of(blank));
    rest_.remove_prefix(result.size());
    return result;
  }

  std::vector<std::string_view> header_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("the file ends before end_header");
    const std::string_view after = rest_.substr(end + 1);
    rest_ = rest_.substr(0, end);
    std::vector<std::string_view> words;
    for (std::string_view next = word(); !next.empty(); next = word()) words.push_back(next);
    rest_ = after;
    where_ = "line " + std::to_string(++line_);
    return words;
  }

  void read_header() {
    header_line();  // ply
    for (auto words = header_line(); words.size() != 1 || words[0] != "end_header"; words = header_line()) {
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "format" && words.size() == 3)
        read_format(words[1], words[2]);
      else if (words[0] == "element" && words.size() == 3)
        read_element(words[1], words[2]);
      else if (words[0] == "property" && !elements_.empty())
        read_property(words);
      else
        fail(TextLines::shown(words[0]) + ": must be a line of a PLY header: format, element, property, comment");
    }
    if (!has_format_) fail("the header does not say its format");
    for (const Element& element : elements_)
      if (element.name == "tristrips")
        fail("triangle strips are not read here; save the mesh with its faces as lists of vertices");
  }

  void read_format(std::string_view name, std::string_view version) {
    is_text_ = name == "ascii";
    order_ = name == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (!(is_text_ || name == "binary_little_endian" || name == "binary_big_endian") || version != "1.0")
      fail("format " + TextLines::shown(name) + " " + TextLines::shown(version) +
           ": must be ascii, binary_little_endian or binary_big_endian, 1.0");
    has_format_ = true;
  }

  void read_element(std::string_view name, std::string_view count) {
    Element element{std::string(name), 0, {}};
    const auto [stop, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc{} || stop != count.data() + count.size() || element.count < 0)
      fail("number of " + TextLines::shown(name) + " = " + TextLines::shown(count) + ": must be a whole number >= 0");
    elements_.push_back(element);
  }

  void read_property(const std::vector<std::string_view>& words) {
    const auto type = [this](std::string_view name) {
      const std::optional<Type> known = type_named(name);
      if (!known) fail("type " + TextLines::shown(name) + ": must be one of PLY, such as float or int");
      return *known;
    };
    if (words.size() == 3)
      elements_.back().properties.push_back({std::string(words[2]), type(words[1]), std::nullopt});
    else if (words.size() == 5 && words[1] == "list")
      elements_.back().properties.push_back({std::string(words[4]), type(words[3]), type(words[2])});
    else
      fail("a property needs a type and a name, or list, two types and a name");
  }

  template <class Number>
  double binary() {
    if (rest_.size() < sizeof(Number)) fail("the file ends in its middle");
    const Number value = from_bytes<Number>(rest_.data(), order_);
    rest_.remove_prefix(sizeof(Number));
    return static_cast<double>(value);
  }

  double next(Type type) {
    if (is_text_) {
      const std::string_view text = word();
      if (text.empty()) fail("the file ends in its middle");
      return TextLines::parsed(text).value_or(std::nan(""));
    }
    switch (type) {
      case Type::int8:
        return binary<std::int8_t>();
      case Type::uint8:
        return binary<std::uint8_t>();
      case Type::int16:
        return binary<std::int16_t>();
      case Type::uint16:
        return binary<std::uint16_t>();
      case Type::int32:
        return binary<std::int32_t>();
      case Type::uint32:
        return binary<std::uint32_t>();
      case Type::float32:
        return binary<float>();
      case Type::float64:
        break;
    }
    return binary<double>();
  }

  int whole(Type type, const std::string& name, double least) {
    const double value = next(type);
    if (!(value >= least && value <= 2147483647.0 && value == std::floor(value)))
      fail(name + " = " + std::to_string(value) + ": must be a whole number" + (least < 0 ? "" : " >= 0"));
    return static_cast<int>(value);
  }

  void read_item(const Element& element, int number) {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    std::array<double, 3> position{NAN, NAN, NAN};
    std::optional<std::vector<int>> corners;
    for (const Property& property : element.properties) {
      if (property.count) {
        const bool are_corners =
            is_face && (property.name == "vertex_indices" || property.name == "vertex_index") && !corners;
        if (are_corners) corners.emplace();
        for (int left = whole(*property.count, "length of " + property.name, 0); left > 0; --left) {
          if (are_corners)
            corners->push_back(whole(property.type, "corner", -2147483648.0));
          else
            next(property.type);
        }
      } else {
        const double value = next(property.type);
        if (is_vertex && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
          position[std::size_t(property.name[0] - 'x')] = value;
      }
    }
    if (is_vertex) {
      for (std::size_t k = 0; k < 3; ++k)
        if (!std::isfinite(position[k]))
          fail(std::string(1, "xyz"[k]) + " is missing or no finite number: a vertex needs the properties x, y, z");
      builder_.add_vertex(position);
    } else if (is_face) {
      if (!corners) fail("a face needs the property list vertex_indices");
      builder_.add_face(*corners, number, fail_at_face_);
    }
  }

  std::filesystem::path path_;
  std::string bytes_;
  std::string_view rest_;
  std::string where_ = "line 1";
  int line_ = 0;
  bool has_format_ = false, is_text_ = false;
  std::endian order_ = std::endian::little;
  std::vector<Element> elements_;
  MeshBuilder builder_;
  MeshBuilder::Fail fail_at_face_ = [this](int face, const std::string& what) {
    fail_in(path_, "face " + std::to_string(face) + ": " + what);
  };
};

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& path) {
  return PlyReader(path).read();
}

}  // namespace vesiflow::vesicle
