#pragma once

#include <array>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupling/scene.h"

namespace vesiflow::coupling {

/// Allowed numbers, ends included or not.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  bool contains(double value) const;
  std::string describe() const;  ///< "> 0", "in (0, 1]" ...

  static Range any() { return {}; }
  static Range positive() { return {.low = 0.0, .low_open = true}; }
  static Range from(double low) { return {.low = low}; }
  static Range between(double low, double high) { return {.low = low, .high = high}; }
};

/// What can be done with each key of a scene: read it, write it, list it. `visit_keys` below is the one place where
/// keys, their types and their limits are written down.
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;
  virtual void text(std::string_view key, std::string& value) = 0;
  virtual void optional_text(std::string_view key, std::optional<std::string>& value) = 0;
  virtual void number(std::string_view key, double& value, const Range& range) = 0;
  virtual void optional_number(std::string_view key, std::optional<double>& value, const Range& range) = 0;
  virtual void integer(std::string_view key, int& value, const Range& range) = 0;
  virtual void optional_integer(std::string_view key, std::optional<int>& value, const Range& range) = 0;
  virtual void vector(std::string_view key, std::array<double, 3>& value, const Range& range) = 0;
  virtual void optional_vector(std::string_view key, std::optional<std::array<double, 3>>& value,
                               const Range& range) = 0;
  virtual void boolean(std::string_view key, bool& value) = 0;
  /// One for each axis.
  virtual void booleans(std::string_view key, std::array<bool, 3>& value) = 0;
  virtual void cells(std::string_view key, std::array<int, 3>& value, const Range& range) = 0;
  /// A list of [degree, order, amplitude]; absent when empty.
  virtual void harmonics(std::string_view key, std::vector<vesicle::Harmonic>& value) = 0;
  /// `value` is an index into `names`.
  virtual void choice(std::string_view key, int& value, std::span<const std::string_view> names) = 0;
};

/// Visits every key but those of the vesicles, in the order of a scene file.
void visit_keys(Scene& scene, KeyVisitor& visitor);
/// Visits the keys of one vesicle, without the leading `vesicles.N.`.
void visit_keys(VesicleScene& vesicle, KeyVisitor& visitor);
/// Only the keys of `method`, which decide the defaults of other keys and so are read first.
void visit_preset(Scene& scene, KeyVisitor& visitor);
/// Sets the defaults of the scene's preset.
void apply_preset(Scene& scene);

/// Every key of a scene with its value as TOML text, vesicles by number; keys without a value are absent.
std::map<std::string, std::string> scene_values(const Scene& scene);

/// A number as TOML writes it, parsing back to the same double.
std::string toml_number(double value);

}  // namespace vesiflow::coupling
