// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "scene/scene_document.h"
#include "scene/scene_keys.h"

namespace vesiflow::run {

/// Reads the keys that a document gives. A value that is not allowed is a mistake of the document, and leaves the one before.
class SceneReader final : public KeyVisitor {
 public:
  /// `prefix` goes before all keys: "vesicles.0.", or nothing.
  SceneReader(SceneDocument& document, std::string prefix) : document_(document), prefix_(std::move(prefix)) {}

  void text(std::string_view key, std::string& value) override;
  void optional_text(std::string_view key, std::optional<std::string>& value) override;
  void number(std::string_view key, double& value, const coupling::Range& range) override;
  void optional_number(std::string_view key, std::optional<double>& value, const coupling::Range& range) override;
  void integer(std::string_view key, int& value, const coupling::Range& range) override;
  void optional_integer(std::string_view key, std::optional<int>& value, const coupling::Range& range) override;
  void vector(std::string_view key, std::array<double, 3>& value, const coupling::Range& range) override;
  void optional_vector(std::string_view key, std::optional<std::array<double, 3>>& value,
                       const coupling::Range& range) override;
  void boolean(std::string_view key, bool& value) override;
  void booleans(std::string_view key, std::array<bool, 3>& value) override;
  void cells(std::string_view key, std::array<int, 3>& value, const coupling::Range& range) override;
  void harmonics(std::string_view key, std::vector<vesicle::Harmonic>& value) override;
  void choice(std::string_view key, int& value, std::span<const std::string_view> names) override;

 private:
  /// The node of a key and its name, for messages.
  struct Given {
    std::string key;
    const toml::node* node;
  };

  Given find(std::string_view key) const;
  void refuse(const Given& given, const std::string& allowed) { document_.refuse(given.key, *given.node, allowed); }
  // What `part` of the value of a key says, if that is allowed.
  std::optional<double> checked(const Given& given, const toml::node& part, const coupling::Range& range);
  std::optional<bool> checked_boolean(const Given& given, const toml::node& part, const char* allowed);
  std::optional<int> checked_integer(const Given& given, const toml::node& part, const coupling::Range& range);
  std::optional<std::array<double, 3>> checked_vector(const Given& given, const coupling::Range& range);
  std::optional<vesicle::Harmonic> checked_harmonic(const Given& given, const toml::node& term);

  SceneDocument& document_;
  std::string prefix_;
};

}  // namespace vesiflow::run
