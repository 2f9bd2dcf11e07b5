// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "coupling/mistakes.h"
#include "coupling/parameter_table.h"
#include "run/scene.h"

namespace vesiflow::run {

/// What can be done with each key of a scene: read it, write it, list it. Most keys are parameters of the simulation, whose names, types and ranges
/// coupling/parameter_table.h has; `visit_keys` below puts those that only scenes have beside them.
class KeyVisitor : public coupling::ParameterVisitor {
 public:
  virtual void text(std::string_view key, std::string& value) = 0;
  virtual void optional_text(std::string_view key, std::optional<std::string>& value) = 0;
};

/// Visits every key but those of the vesicles, in the order of a scene file.
void visit_keys(Scene& scene, KeyVisitor& visitor);
/// Visits the keys of one vesicle, without the leading `vesicles.N.`.
void visit_keys(coupling::VesicleParameters& vesicle, SurfaceFile& file, KeyVisitor& visitor);
/// Only the keys of `method`, which decide the defaults of other keys and so are read first.
void visit_preset(Scene& scene, KeyVisitor& visitor);
/// Sets the defaults of the scene's preset.
void apply_preset(Scene& scene);

/// Adds what is not in its range, of the keys that only scenes have.
void check_ranges_of_scene(const Scene& scene, coupling::Mistakes& mistakes);

/// Every key of a scene with its value as TOML text, vesicles by number; keys without a value are absent.
std::map<std::string, std::string> scene_values(const Scene& scene);

/// A number as TOML writes it, parsing back to the same double.
std::string toml_number(double value);

}  // namespace vesiflow::run
