// Reading scene files. The only place that knows TOML.
#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <locale>
#include <set>
#include <sstream>

#include "accuracy.h"
#include "coupling/errors.h"
#include "coupling/scene.h"
#include "initial_shape.h"
#include "scene_file.h"
#include "scene_keys.h"

namespace vesiflow::coupling {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// With what the file says in it, of which only text is printed: no end of the message, no commands to a terminal.
[[noreturn]] void refuse_scene(std::string message) {
  std::ranges::replace_if(
      message, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  throw SceneError(message);
}

std::string show(const toml::node& node) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

// The number that is all of the text, whatever the decimal sign of the host program's locale; not a number if there is none.
double number_in(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = nan_value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : nan_value;
}

// Number of single-character edits between two keys; for "did you mean".
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row[b.size()];
}

// A parsed scene file with its overrides, and where each key came from.
class Document {
 public:
  Document(const std::string& text, std::string name, const Overrides& overrides) : name_(std::move(name)) {
    try {
      root_ = toml::parse(text, name_);
    } catch (const toml::parse_error& error) {
      refuse_scene(fmt::format("{}:{}: not valid TOML: {}", name_, error.source().begin.line, error.description()));
    }
    for (const std::string& item : overrides) apply(item);
  }

  toml::table& root() { return root_; }

  const toml::node* find(const std::string& key) const { return root_.at_path(path_of(key)).node(); }

  [[noreturn]] void refuse(const std::string& key, const toml::node& node, const std::string& allowed) const {
    refuse_scene(fmt::format("{}: {} = {}: {}", where(key, node), key, show(node), allowed));
  }

  std::string where(const std::string& key, const toml::node& node) const {
    if (overridden_.contains(key)) return "--set";
    return fmt::format("{}:{}", name_, node.source().begin.line);
  }

 private:
  // vesicles.0.shape -> vesicles[0].shape
  static std::string path_of(const std::string& key) {
    std::string path;
    std::istringstream parts(key);
    for (std::string part; std::getline(parts, part, '.');) {
      const bool index = !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
      if (index) {
        path += fmt::format("[{}]", part);
      } else {
        if (!path.empty()) path += ".";
        path += part;
      }
    }
    return path;
  }

  void apply(const std::string& item) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0)
      refuse_scene(fmt::format("--set {}: expected key=value, such as time.end=2.0", item));
    const std::string key = item.substr(0, equals), value = item.substr(equals + 1);
    toml::table parsed;
    try {
      parsed = toml::parse("value = " + value);
    } catch (const toml::parse_error&) {
      parsed = toml::table{{"value", value}};  // a bare word: a string
    }
    const std::size_t dot = key.rfind('.');
    const std::string leaf = dot == std::string::npos ? key : key.substr(dot + 1);
    toml::table& parent = dot == std::string::npos ? root_ : table_at(key.substr(0, dot), item);
    parent.insert_or_assign(leaf, *parsed.get("value"));
    overridden_.insert(key);
  }

  toml::table& table_at(const std::string& key, const std::string& item) {
    toml::node* node = root_.at_path(path_of(key)).node();
    if (node == nullptr && key.find('.') == std::string::npos && key != "vesicles") {
      root_.insert(key, toml::table{});
      node = root_.get(key);
    }
    if (node == nullptr || !node->is_table())
      refuse_scene(fmt::format("--set {}: there is no '{}' in {}", item, key, name_));
    return *node->as_table();
  }

  std::string name_;
  toml::table root_;
  std::set<std::string> overridden_;
};

class Reader final : public KeyVisitor {
 public:
  Reader(const Document& document, std::string prefix, std::set<std::string>& known)
      : document_(document), prefix_(std::move(prefix)), known_(known) {}

  void text(std::string_view key, std::string& value) override {
    if (const toml::node* node = find(key)) {
      if (!node->is_string()) refuse(key, *node, "must be text in quotes");
      value = node->as_string()->get();
    }
  }

  void optional_text(std::string_view key, std::optional<std::string>& value) override {
    if (find(key) != nullptr) text(key, value.emplace());
  }

  void number(std::string_view key, double& value, const Range& range) override {
    if (const toml::node* node = find(key)) value = checked(key, *node, *node, range);
  }

  void optional_number(std::string_view key, std::optional<double>& value, const Range& range) override {
    if (const toml::node* node = find(key)) value = checked(key, *node, *node, range);
  }

  void integer(std::string_view key, int& value, const Range& range) override {
    if (const toml::node* node = find(key)) value = checked_integer(key, *node, *node, range);
  }

  void optional_integer(std::string_view key, std::optional<int>& value, const Range& range) override {
    if (const toml::node* node = find(key)) value = checked_integer(key, *node, *node, range);
  }

  void vector(std::string_view key, std::array<double, 3>& value, const Range& range) override {
    if (const toml::node* node = find(key)) value = checked_vector(key, *node, range);
  }

  void optional_vector(std::string_view key, std::optional<std::array<double, 3>>& value, const Range& range) override {
    if (const toml::node* node = find(key)) value = checked_vector(key, *node, range);
  }

  void boolean(std::string_view key, bool& value) override {
    if (const toml::node* node = find(key)) value = checked_boolean(key, *node, *node, "must be true or false");
  }

  void booleans(std::string_view key, std::array<bool, 3>& value) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    constexpr const char* allowed = "must be three of true or false, such as [true, true, false]";
    if (!node->is_array() || node->as_array()->size() != 3) refuse(key, *node, allowed);
    for (std::size_t i = 0; i < 3; ++i) value[i] = checked_boolean(key, *node, *node->as_array()->get(i), allowed);
  }

  void cells(std::string_view key, std::array<int, 3>& value, const Range& range) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    if (node->is_array() && node->as_array()->size() == 3) {
      for (std::size_t i = 0; i < 3; ++i) value[i] = checked_integer(key, *node, *node->as_array()->get(i), range);
    } else if (node->is_integer()) {
      value.fill(checked_integer(key, *node, *node, range));
    } else {
      refuse(key, *node, "must be one whole number or three, such as 64 or [320, 96, 96]");
    }
  }

  void harmonics(std::string_view key, std::vector<vesicle::Harmonic>& value) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    value.clear();
    if (node->is_array())
      for (const toml::node& term : *node->as_array()) value.push_back(checked_harmonic(key, *node, term));
    if (value.empty()) refuse(key, *node, harmonics_form);
  }

  void choice(std::string_view key, int& value, std::span<const std::string_view> names) override {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    // Names that are numbers may be given as such: upsampling = 1.5 for "1.5".
    const auto is_given = [&](std::string_view name) {
      if (!node->is_number()) return node->is_string() && name == node->as_string()->get();
      return number_in(name) == to_number(*node);
    };
    const auto found = std::ranges::find_if(names, is_given);
    if (found == names.end()) refuse(key, *node, fmt::format("allowed are {}", fmt::join(names, ", ")));
    value = static_cast<int>(found - names.begin());
  }

 private:
  static constexpr const char* harmonics_form =
      "must be a list of [degree, order, amplitude], such as [[2, 0, 0.1], [3, -2, 0.05]]";

  const toml::node* find(std::string_view key) {
    const std::string full = prefix_ + std::string(key);
    known_.insert(full);
    return document_.find(full);
  }

  [[noreturn]] void refuse(std::string_view key, const toml::node& node, const std::string& allowed) const {
    document_.refuse(prefix_ + std::string(key), node, allowed);
  }

  // Numbers may be written as fractions in quotes, "1/192", which TOML itself cannot say.
  static double to_number(const toml::node& node) {
    if (node.is_floating_point()) return node.as_floating_point()->get();
    if (node.is_integer()) return static_cast<double>(node.as_integer()->get());
    if (!node.is_string()) return nan_value;
    const std::string_view text = node.as_string()->get();
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return nan_value;
    return number_in(text.substr(0, slash)) / number_in(text.substr(slash + 1));
  }

  double checked(std::string_view key, const toml::node& whole, const toml::node& node, const Range& range) const {
    const bool numeric = node.is_number() || (node.is_string() && !std::isnan(to_number(node)));
    if (!numeric) refuse(key, whole, fmt::format("must be a number {}", range.describe()));
    const double value = to_number(node);
    if (!range.contains(value)) refuse(key, whole, fmt::format("must be {}", range.describe()));
    return value;
  }

  bool checked_boolean(std::string_view key, const toml::node& whole, const toml::node& node,
                       const char* allowed) const {
    if (!node.is_boolean()) refuse(key, whole, allowed);
    return node.as_boolean()->get();
  }

  int checked_integer(std::string_view key, const toml::node& whole, const toml::node& node, const Range& range) const {
    if (!node.is_integer()) refuse(key, whole, fmt::format("must be a whole number {}", range.describe()));
    const auto value = node.as_integer()->get();
    if (!range.contains(static_cast<double>(value)) || value > std::numeric_limits<int>::max())
      refuse(key, whole, fmt::format("must be {}", range.describe()));
    return static_cast<int>(value);
  }

  std::array<double, 3> checked_vector(std::string_view key, const toml::node& node, const Range& range) const {
    if (!node.is_array() || node.as_array()->size() != 3)
      refuse(key, node, "must be three numbers, such as [0.0, 0.0, 0.0]");
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i) value[i] = checked(key, node, *node.as_array()->get(i), range);
    return value;
  }

  vesicle::Harmonic checked_harmonic(std::string_view key, const toml::node& whole, const toml::node& term) const {
    if (!term.is_array() || term.as_array()->size() != 3) refuse(key, whole, harmonics_form);
    const toml::array& entries = *term.as_array();
    if (!entries[0].is_integer() || !entries[1].is_integer()) refuse(key, whole, harmonics_form);
    constexpr int largest_degree = 256;
    const int degree = checked_integer(key, whole, entries[0], Range::between(0, largest_degree));
    return {degree, checked_integer(key, whole, entries[1], Range::between(-degree, degree)),
            checked(key, whole, entries[2], Range::any())};
  }

  const Document& document_;
  std::string prefix_;
  std::set<std::string>& known_;
};

// Refuses every key of the file that no visitor asked for.
void refuse_unknown(const Document& document, const toml::table& table, const std::string& prefix,
                    const std::set<std::string>& known) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (key == "vesicles") continue;
    const bool is_section = std::ranges::any_of(known, [&](const std::string& k) { return k.starts_with(key + "."); });
    if (is_section && node.is_table()) {
      refuse_unknown(document, *node.as_table(), key + ".", known);
    } else if (!known.contains(key)) {
      const auto nearest = std::ranges::min_element(
          known, {}, [&](const std::string& candidate) { return edit_distance(candidate, key); });
      refuse_scene(fmt::format("{}: {}: there is no such key; did you mean {}? (docs/scene.md lists all)",
                               document.where(key, node), key, *nearest));
    }
  }
}

void read_vesicles(Document& document, Scene& scene, const std::string& name) {
  const toml::node* node = document.root().get("vesicles");
  if (node == nullptr) refuse_scene(fmt::format("{}: there is no [[vesicles]]; a scene needs at least one", name));
  if (!node->is_array_of_tables() || node->as_array()->empty())
    document.refuse("vesicles", *node, "must be tables, each headed [[vesicles]]");
  const toml::array& list = *node->as_array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string prefix = fmt::format("vesicles.{}.", i);
    std::set<std::string> known;
    Reader reader(document, prefix, known);
    visit_keys(scene.vesicles.emplace_back(), reader);
    refuse_unknown(document, *list.get(i)->as_table(), prefix, known);
  }
}

// Files are named relative to the folder of the scene.
std::string absolute_file(const std::string& file, const std::string& scene_name) {
  const std::filesystem::path folder = std::filesystem::path(scene_name).parent_path();
  return std::filesystem::absolute(folder / file).lexically_normal().string();
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides,
                  const std::function<void(Scene&)>& load_surfaces) {
  Document document(text, name, overrides);
  Scene scene;
  std::set<std::string> known;
  Reader reader(document, "", known);
  visit_preset(scene, reader);
  apply_preset(scene);
  visit_keys(scene, reader);
  refuse_unknown(document, document.root(), "", known);
  read_vesicles(document, scene, name);
  if (scene.method.accuracy != Accuracy::as_given) {
    check_accuracy(scene, name);
    apply_accuracy(scene);
    visit_keys(scene, reader);  // keys that are given win
  }

  if (scene.membrane.g && document.find("membrane.sigma0") == nullptr)
    scene.membrane.sigma0 = *scene.membrane.g * 4.0 * scene.finest_spacing() / scene.time.step;
  for (VesicleScene& vesicle : scene.vesicles)
    if (vesicle.file) vesicle.file = absolute_file(*vesicle.file, name);
  load_surfaces(scene);
  check_scene(scene, name);
  scene.membrane.g.reset();  // said; sigma0 is what counts from here on
  return scene;
}

Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides) {
  return parse_scene(text, name, overrides, [&name](Scene& scene) { load_surfaces(scene, name); });
}

Scene load_scene(const std::filesystem::path& file, const Overrides& overrides) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    refuse_scene(fmt::format("{}: cannot be read: no such scene file, or no permission", file.string()));
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_scene(text.str(), file.string(), overrides);
}

}  // namespace vesiflow::coupling
