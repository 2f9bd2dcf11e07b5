// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Writing a scene back as TOML, and listing its keys.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "run/scene.h"
#include "scene/scene_keys.h"

namespace vesiflow::run {
namespace {

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {  // not allowed as they are
      out += fmt::format("\\u{:04x}", code);
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string array_of(const std::array<double, 3>& v) {
  return fmt::format("[{}, {}, {}]", toml_number(v[0]), toml_number(v[1]), toml_number(v[2]));
}

// Empty where there are none: the key is then left out.
std::string array_of(const std::vector<vesicle::Harmonic>& terms) {
  std::string text;
  for (const vesicle::Harmonic& term : terms)
    text +=
        fmt::format("{}[{}, {}, {}]", text.empty() ? "[" : ", ", term.degree, term.order, toml_number(term.amplitude));
  return text.empty() ? "" : text + "]";
}

// Shows every key with its value as TOML text and its limits in words.
class Lister : public KeyVisitor {
 public:
  void text(std::string_view key, std::string& value) override { show(key, toml_string(value), "text"); }
  void optional_text(std::string_view key, std::optional<std::string>& value) override {
    show(key, value ? toml_string(*value) : "", "text");
  }
  void number(std::string_view key, double& value, const coupling::Range& range) override {
    show(key, toml_number(value), range.describe());
  }
  void optional_number(std::string_view key, std::optional<double>& value, const coupling::Range& range) override {
    show(key, value ? toml_number(*value) : "", range.describe());
  }
  void integer(std::string_view key, int& value, const coupling::Range& range) override {
    show(key, fmt::format("{}", value), range.describe());
  }
  void optional_integer(std::string_view key, std::optional<int>& value, const coupling::Range& range) override {
    show(key, value ? fmt::format("{}", *value) : "", range.describe());
  }
  void vector(std::string_view key, std::array<double, 3>& value, const coupling::Range& range) override {
    show(key, array_of(value), range.describe());
  }
  void optional_vector(std::string_view key, std::optional<std::array<double, 3>>& value,
                       const coupling::Range& range) override {
    show(key, value ? array_of(*value) : "", range.describe());
  }
  void boolean(std::string_view key, bool& value) override { show(key, fmt::format("{}", value), "true, false"); }
  void booleans(std::string_view key, std::array<bool, 3>& value) override {
    show(key, fmt::format("[{}, {}, {}]", value[0], value[1], value[2]), "three of true, false");
  }
  void cells(std::string_view key, std::array<int, 3>& value, const coupling::Range& range) override {
    show(key, fmt::format("[{}, {}, {}]", value[0], value[1], value[2]), range.describe());
  }
  void harmonics(std::string_view key, std::vector<vesicle::Harmonic>& value) override {
    show(key, array_of(value), "a list of [degree, order, amplitude]");
  }
  void choice(std::string_view key, int& value, std::span<const std::string_view> names) override {
    const std::string allowed = fmt::format("{}", fmt::join(names, ", "));
    if (value < 0 || value >= static_cast<int>(names.size()))
      throw SceneError(
          fmt::format("{} is value {} of an enumeration that has {}: {}", key, value, names.size(), allowed));
    show(key, toml_string(names[static_cast<std::size_t>(value)]), allowed);
  }

 private:
  virtual void show(std::string_view key, const std::string& value, const std::string& allowed) = 0;
};

class TomlWriter final : public Lister {
 public:
  std::string result;

 private:
  void show(std::string_view key, const std::string& value, const std::string& /*allowed*/) override {
    if (value.empty()) return;
    const std::size_t dot = key.find('.');
    const std::string_view section = dot == std::string_view::npos ? "" : key.substr(0, dot);
    if (section != section_) {
      result += fmt::format("\n[{}]\n", section);
      section_ = section;
    }
    result += fmt::format("{} = {}\n", dot == std::string_view::npos ? key : key.substr(dot + 1), value);
  }

  std::string section_;
};

class KeyLister final : public Lister {
 public:
  explicit KeyLister(std::string prefix, std::vector<SceneKey>& keys) : prefix_(std::move(prefix)), keys_(keys) {}

 private:
  void show(std::string_view key, const std::string& value, const std::string& allowed) override {
    keys_.push_back({prefix_ + std::string(key), value, allowed});
  }

  std::string prefix_;
  std::vector<SceneKey>& keys_;
};

class ValueCollector final : public Lister {
 public:
  ValueCollector(std::string prefix, std::map<std::string, std::string>& values)
      : prefix_(std::move(prefix)), values_(values) {}

 private:
  void show(std::string_view key, const std::string& value, const std::string& /*allowed*/) override {
    if (!value.empty()) values_[prefix_ + std::string(key)] = value;
  }

  std::string prefix_;
  std::map<std::string, std::string>& values_;
};

}  // namespace

std::map<std::string, std::string> scene_values(const Scene& scene) {
  Scene copy = scene;
  copy.surface_files.resize(copy.vesicles.size());
  std::map<std::string, std::string> values;
  ValueCollector collector("", values);
  visit_keys(copy, collector);
  for (std::size_t i = 0; i < copy.vesicles.size(); ++i) {
    ValueCollector of_vesicle(fmt::format("vesicles.{}.", i), values);
    visit_keys(copy.vesicles[i], copy.surface_files[i], of_vesicle);
  }
  return values;
}

std::string to_toml(const Scene& scene) {
  Scene copy = scene;
  copy.surface_files.resize(copy.vesicles.size());
  TomlWriter writer;
  visit_keys(copy, writer);
  std::string text = writer.result;
  for (std::size_t i = 0; i < copy.vesicles.size(); ++i) {
    TomlWriter of_vesicle;
    visit_keys(copy.vesicles[i], copy.surface_files[i], of_vesicle);
    text += "\n[[vesicles]]\n" + of_vesicle.result;
  }
  return text;
}

std::vector<SceneKey> scene_keys() {
  Scene scene;
  coupling::VesicleParameters vesicle;
  SurfaceFile file;
  std::vector<SceneKey> keys;
  KeyLister scene_lister("", keys), vesicle_lister("vesicles.", keys);
  visit_keys(scene, scene_lister);
  visit_keys(vesicle, file, vesicle_lister);
  return keys;
}

}  // namespace vesiflow::run
