// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <map>
#include <set>
#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// A parsed scene file with its overrides, where each key came from, and what was found wrong so far. The one header that knows
/// TOML.
class SceneDocument {
 public:
  /// Overrides that are no key, or no key of a scene, are mistakes. A single table [vesicles] is one vesicle.
  /// \throws SceneError where the text is not TOML
  SceneDocument(const std::string& text, std::string name, const Overrides& overrides);

  const toml::table& root() const { return root_; }
  /// The value of a dotted key, vesicles by number; nullptr if it is not given.
  const toml::node* find(const std::string& key) const;

  /// Adds the mistake that the value is not what is allowed.
  void refuse(const std::string& key, const toml::node& node, const std::string& allowed);
  /// Adds that there is no such key or table, and which was probably meant.
  void refuse_unknown(const std::string& key, const toml::node& node);

  const std::string& name() const { return name_; }
  /// Adds a mistake, in a sentence. Mistakes are said in the order of their lines in the file; line 0 is before all.
  void add_mistake(std::string mistake, unsigned line = 0);
  /// \throws SceneError of all mistakes so far, unless there are none
  void refuse_mistakes() const;
  /// Whether a table was probably meant to be this one.
  bool misspells(const std::string& table) const { return meant_tables_.contains(table); }

 private:
  /// Where a key was given: "FILE:LINE", or "--set".
  std::string where(const std::string& key, const toml::node& node) const;
  unsigned line_of(const std::string& key, const toml::node& node) const;
  void apply(const std::string& item);
  std::string numbered(const std::string& key, const std::string& item);
  std::size_t vesicle_count() const;

  std::string name_;
  toml::table root_;
  std::set<std::string> overridden_;
  std::set<std::string> meant_tables_;
  std::multimap<unsigned, std::string> mistakes_;  // by line
};

}  // namespace vesiflow::run
