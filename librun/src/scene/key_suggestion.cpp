// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/key_suggestion.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "run/scene.h"

namespace vesiflow::run {
namespace {

struct Name {
  std::string_view table, leaf;
};

Name split(std::string_view key) {
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return {"", key};
  return {key.substr(0, dot), key.substr(dot + 1)};
}

const std::vector<std::string>& all_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> names;
    for (const SceneKey& key : scene_keys()) names.push_back(key.name);
    return names;
  }();
  return keys;
}

const std::set<std::string, std::less<>>& all_tables() {
  static const std::set<std::string, std::less<>> tables = [] {
    std::set<std::string, std::less<>> names;
    for (const std::string& key : all_keys())
      if (const Name name = split(key); !name.table.empty()) names.emplace(name.table);
    return names;
  }();
  return tables;
}

// Number of single characters that are missing, too many, other ones, or exchanged with the next, between two names.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return table[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j < width; ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      const std::size_t substituted = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return table.back();
}

constexpr std::size_t far = 1000;

// A beginning or an end counts as one edit, a name that has less than half of its letters in common as none.
std::size_t distance(std::string_view given, std::string_view meant) {
  if (given.size() > 40) return far;  // no name is that long
  if (given == meant) return 0;
  const bool is_part =
      given.size() >= 3 && (meant.starts_with(given) || meant.ends_with(given) || given.starts_with(meant));
  if (is_part) return 1;
  const std::size_t edits = edit_distance(given, meant);
  return edits <= std::max<std::size_t>(1, std::min(given.size(), meant.size()) / 2) ? edits : far;
}

// What users of the paper and of other programs write.
std::string_view other_name(std::string_view leaf) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> names{{{"dt", "time.step"},
                                                                                {"Re", "fluid.reynolds_number"},
                                                                                {"Ca", "membrane.capillary_number"},
                                                                                {"lambda", "fluid.viscosity_ratio"},
                                                                                {"position", "vesicles.centre"},
                                                                                {"duration", "time.end"},
                                                                                {"type", "vesicles.shape"}}};
  const auto* const found = std::ranges::find(names, leaf, [](const auto& entry) { return entry.first; });
  return found == names.end() ? "" : found->second;
}

}  // namespace

bool is_scene_key(std::string_view key) {
  return std::ranges::find(all_keys(), key) != all_keys().end();
}

bool is_scene_table(std::string_view name) {
  return all_tables().contains(name);
}

std::string suggest_key(std::string_view key) {
  const Name given = split(key);
  constexpr std::size_t another_table = 2;
  std::size_t least = far;
  std::string nearest;
  for (const std::string& candidate : all_keys()) {
    const Name meant = split(candidate);
    const std::size_t leaf = distance(given.leaf, meant.leaf);
    const std::size_t total = leaf + std::min(another_table, edit_distance(given.table, meant.table));
    if (leaf < far && total < least) {
      least = total;
      nearest = candidate;
    }
  }
  // Two names far from each other in two tables are no likeness.
  const std::string_view synonym = other_name(given.leaf);
  if (!synonym.empty() && least > another_table) return std::string(synonym);
  return least <= another_table + 1 || split(nearest).table == given.table ? nearest : "";
}

std::string suggest_table(std::string_view name) {
  std::size_t least = far;
  std::string nearest;
  for (const std::string& candidate : all_tables())
    if (const std::size_t edits = distance(name, candidate); edits < least) {
      least = edits;
      nearest = candidate;
    }
  return nearest;
}

}  // namespace vesiflow::run
