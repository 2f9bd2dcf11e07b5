// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_mistakes.h"

#include <algorithm>
#include <vector>

#include "run/errors.h"

namespace vesiflow::run {

void refuse_scene(const coupling::Mistakes& mistakes, const std::string& name) {
  if (mistakes.empty()) return;
  const auto is_command = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  std::vector<std::string> texts;
  for (const std::string& mistake : mistakes.all()) {
    std::string& text = texts.emplace_back(name.empty() ? mistake : name + ": " + mistake);
    std::ranges::replace_if(text, is_command, '?');
  }
  throw SceneError(coupling::ParameterError::joined(texts));
}

}  // namespace vesiflow::run
