// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

namespace vesiflow::run {

/// The words as one line for a shell, quoted where it would take them for something else.
std::string shell_line(std::span<const std::string> words);

}  // namespace vesiflow::run
