// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/mistakes.h"

#include <algorithm>
#include <utility>

namespace vesiflow::coupling {

void Mistakes::add(std::string mistake) {
  if (std::ranges::find(all_, mistake) == all_.end()) all_.push_back(std::move(mistake));
}

bool Mistakes::gather(const std::function<void()>& check) {
  try {
    check();
    return true;
  } catch (const ParameterError& error) {
    for (const std::string& mistake : error.mistakes()) add(mistake);
    return false;
  }
}

void Mistakes::refuse() const {
  if (!all_.empty()) throw ParameterError(all_);
}

}  // namespace vesiflow::coupling
