// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace vesiflow::run {

/// What is wrong with a scene, gathered so that all of it is said at once.
class SceneMistakes {
 public:
  /// A mistake in a sentence, once however often it is found. Of what a scene file brings into it only text is kept: no end of the
  /// message, no commands to a terminal. Mistakes are said in the order of their lines in the file; line 0 is before all.
  void add(std::string mistake, unsigned line = 0);

  /// Adds the SceneError that `check` throws. Returns whether it threw none.
  bool gather(const std::function<void()>& check);

  bool empty() const { return mistakes_.empty(); }

  /// \throws SceneError with the mistake, or with all of them, one a line, unless there are none
  void refuse() const;

 private:
  struct Mistake {
    std::string text;
    unsigned line;
  };

  std::vector<Mistake> mistakes_;
};

}  // namespace vesiflow::run
