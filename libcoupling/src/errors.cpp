// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace vesiflow::coupling {

std::string ParameterError::joined(const std::vector<std::string>& mistakes) {
  constexpr std::size_t most = 20;  // a screen
  if (mistakes.size() == 1) return mistakes.front();
  std::string text = fmt::format("{} mistakes:", mistakes.size());
  for (std::size_t i = 0; i < std::min(most, mistakes.size()); ++i)
    text += fmt::format("\n  {}. {}", i + 1, mistakes[i]);
  if (mistakes.size() > most) text += "\n  ...";
  return text;
}

}  // namespace vesiflow::coupling
