// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace vesiflow::run {

/// Whether scenes have this key, vesicles without their number: "time.end", "vesicles.radius".
bool is_scene_key(std::string_view key);

/// Whether scenes have a table of this name: "time", "vesicles".
bool is_scene_table(std::string_view name);

/// The key that was probably meant: of the same name or nearly, in this table or another one. Empty if none is near.
std::string suggest_key(std::string_view key);

/// The same of the name of a table.
std::string suggest_table(std::string_view name);

}  // namespace vesiflow::run
