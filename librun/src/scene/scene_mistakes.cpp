// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_mistakes.h"

#include <fmt/format.h>

#include <algorithm>

#include "run/errors.h"

namespace vesiflow::run {

void SceneMistakes::add(std::string mistake, unsigned line) {
  std::ranges::replace_if(
      mistake, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  if (std::ranges::find(mistakes_, mistake, &Mistake::text) != mistakes_.end()) return;
  const auto place = std::ranges::upper_bound(mistakes_, line, {}, &Mistake::line);
  mistakes_.insert(place, {std::move(mistake), line});
}

bool SceneMistakes::gather(const std::function<void()>& check) {
  try {
    check();
    return true;
  } catch (const SceneError& error) {
    add(error.what());
    return false;
  }
}

void SceneMistakes::refuse() const {
  constexpr std::size_t most = 20;  // a screen
  if (mistakes_.empty()) return;
  if (mistakes_.size() == 1) throw SceneError(mistakes_.front().text);
  std::string text = fmt::format("{} mistakes:", mistakes_.size());
  for (std::size_t i = 0; i < std::min(most, mistakes_.size()); ++i)
    text += fmt::format("\n  {}. {}", i + 1, mistakes_[i].text);
  if (mistakes_.size() > most) text += "\n  ...";
  throw SceneError(text);
}

}  // namespace vesiflow::run
