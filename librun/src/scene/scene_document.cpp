// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <locale>
#include <sstream>

#include "scene/key_suggestion.h"
#include "scene/scene_mistakes.h"

namespace vesiflow::run {
namespace {

constexpr std::string_view of_vesicles = "vesicles.";

std::string show(const toml::node& node) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

bool is_number(std::string_view part) {
  return !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// vesicles.0.shape -> vesicles[0].shape
std::string path_of(const std::string& key) {
  std::string path;
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    if (is_number(part)) {
      path += fmt::format("[{}]", part);
    } else {
      if (!path.empty()) path += ".";
      path += part;
    }
  }
  return path;
}

// vesicles.0.shape -> vesicles.shape
std::string without_number(const std::string& key) {
  if (!key.starts_with(of_vesicles)) return key;
  const std::size_t dot = key.find('.', of_vesicles.size());
  if (dot == std::string::npos || !is_number(key.substr(of_vesicles.size(), dot - of_vesicles.size()))) return key;
  return std::string(of_vesicles) + key.substr(dot + 1);
}

std::string table_of(const std::string& key) {
  return key.substr(0, key.find('.'));
}

std::string header_of(const std::string& table) {
  return table == "vesicles" ? "[[vesicles]]" : fmt::format("[{}]", table);
}

// "; did you mean fluid.reynolds_number?", or nothing. Keys of vesicles are named by the number that `key` has.
std::string question(const std::string& key) {
  const std::string given = without_number(key), meant = suggest_key(given);
  if (meant.empty()) return "";
  const std::string table = table_of(meant), leaf = meant.substr(meant.find('.') + 1);
  if (meant == table) return fmt::format("; did you mean {}?", meant);
  const std::string number =
      key == given ? "0" : key.substr(of_vesicles.size(), key.find('.', of_vesicles.size()) - of_vesicles.size());
  const std::string full = table == "vesicles" ? fmt::format("vesicles.{}.{}", number, leaf) : meant;
  return table == table_of(given)
             ? fmt::format("; did you mean {}?", full)
             : fmt::format("; did you mean {}, that is {} under {}?", full, leaf, header_of(table));
}

// What values that are none of TOML's mostly are.
const char* advice_on(std::string_view toml_error) {
  constexpr std::array of_values{"parsing value", "parsing decimal", "expected a comment or whitespace"};
  const bool is_value =
      std::ranges::any_of(of_values, [&](auto text) { return toml_error.find(text) != std::string_view::npos; });
  return is_value ? R"( (words and fractions need quotes, "shear" and "1/384"; decimals a point, 1.5))" : "";
}

// The table with what `text` says as its key "value"; a bare word is a string.
toml::table parsed_value(const std::string& text) {
  try {
    return toml::parse("value = " + text);
  } catch (const toml::parse_error&) {
    return toml::table{{"value", text}};
  }
}

constexpr const char* where_keys_are = " (docs/scene.md lists all)";

}  // namespace

SceneDocument::SceneDocument(const std::string& text, std::string name, const Overrides& overrides)
    : name_(std::move(name)) {
  try {
    root_ = toml::parse(text, name_);
  } catch (const toml::parse_error& error) {
    add_mistake(fmt::format("{}:{}: not valid TOML: {}{}", name_, error.source().begin.line, error.description(),
                            advice_on(error.description())));
    refuse_mistakes();
  }
  if (toml::table* single = root_["vesicles"].as_table()) {
    toml::array list;
    list.push_back(std::move(*single));  // a copy would forget its lines
    root_.insert_or_assign("vesicles", std::move(list));
  }
  for (const std::string& item : overrides) apply(item);
}

void SceneDocument::add_mistake(std::string mistake, unsigned line) {
  mistakes_.emplace(line, std::move(mistake));
}

void SceneDocument::refuse_mistakes() const {
  coupling::Mistakes in_order;
  for (const auto& [line, mistake] : mistakes_) in_order.add(mistake);
  refuse_scene(in_order);
}

const toml::node* SceneDocument::find(const std::string& key) const {
  return root_.at_path(path_of(key)).node();
}

unsigned SceneDocument::line_of(const std::string& key, const toml::node& node) const {
  return overridden_.contains(key) ? 0 : node.source().begin.line;
}

std::string SceneDocument::where(const std::string& key, const toml::node& node) const {
  return overridden_.contains(key) ? "--set" : fmt::format("{}:{}", name_, line_of(key, node));
}

void SceneDocument::refuse(const std::string& key, const toml::node& node, const std::string& allowed) {
  add_mistake(fmt::format("{}: {} = {}: {}", where(key, node), key, show(node), allowed), line_of(key, node));
}

void SceneDocument::refuse_unknown(const std::string& key, const toml::node& node) {
  const std::string place = where(key, node);
  const bool is_list = node.is_array_of_tables();
  if (!node.is_table() && !is_list) {
    add_mistake(fmt::format("{}: {}: there is no such key{}{}", place, key, question(key), where_keys_are),
                line_of(key, node));
    return;
  }
  const std::string meant = key.find('.') == std::string::npos ? suggest_table(key) : "";
  meant_tables_.insert(meant);
  add_mistake(fmt::format("{}: {}: there is no such table{}{}", place,
                          is_list ? fmt::format("[[{}]]", key) : fmt::format("[{}]", key),
                          meant.empty() ? "" : fmt::format("; did you mean {}?", header_of(meant)), where_keys_are),
              line_of(key, node));
}

std::size_t SceneDocument::vesicle_count() const {
  const toml::array* list = root_["vesicles"].as_array();
  return list == nullptr ? 0 : list->size();
}

// The key with the number of a vesicle in it; empty, and a mistake, where it cannot be told which is meant.
std::string SceneDocument::numbered(const std::string& key, const std::string& item) {
  const std::string given = without_number(key), leaf = given.substr(given.find('.') + 1);
  const std::size_t count = vesicle_count();
  if (key == given && count == 1) return fmt::format("vesicles.0.{}", leaf);
  if (count == 0) {
    add_mistake(fmt::format("--set {}: there is no [[vesicles]] in {} to set it of", item, name_));
  } else if (key == given) {
    add_mistake(fmt::format(
        "--set {}: which of the {} vesicles? write vesicles.0.{} for the first, to vesicles.{}.{} for the last", item,
        count, leaf, count - 1, leaf));
  } else {
    std::size_t number = count;
    std::from_chars(key.data() + of_vesicles.size(), key.data() + key.size(), number);
    if (number < count) return fmt::format("vesicles.{}.{}", number, leaf);
    add_mistake(fmt::format("--set {}: there is no such vesicle in {}, whose {} vesicles.0{}", item, name_,
                            count == 1 ? "only one is" : "vesicles are",
                            count == 1 ? "" : fmt::format(" to vesicles.{}", count - 1)));
  }
  return "";
}

void SceneDocument::apply(const std::string& item) {
  const std::size_t equals = item.find('=');
  std::string key = trimmed(item.substr(0, equals));
  if (equals == std::string::npos || key.empty()) {
    add_mistake(fmt::format("--set {}: expected key=value, such as time.end=2.0", item));
    return;
  }
  if (is_scene_table(key)) {
    add_mistake(fmt::format("--set {}: {} is a table of keys: set one of them, as in time.end=2.0{}", item, key,
                            where_keys_are));
    return;
  }
  if (!is_scene_key(without_number(key))) {
    add_mistake(fmt::format("--set {}: there is no key {}{}{}", item, key, question(key), where_keys_are));
    return;
  }
  if (key.starts_with(of_vesicles) && (key = numbered(key, item)).empty()) return;
  const toml::table parsed = parsed_value(trimmed(item.substr(equals + 1)));
  const std::size_t dot = key.rfind('.');
  toml::table* parent = &root_;
  if (dot != std::string::npos) {
    const std::string table = key.substr(0, dot);
    if (table.find('.') == std::string::npos && root_.get(table) == nullptr) root_.insert(table, toml::table{});
    parent = root_.at_path(path_of(table)).as_table();
  }
  overridden_.insert(key);
  // A table that is none is a mistake of the file, found when it is read.
  if (parent != nullptr) parent->insert_or_assign(key.substr(dot + 1), *parsed.get("value"));
}

}  // namespace vesiflow::run
