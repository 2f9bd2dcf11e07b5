// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_folder.h"

#include <spdlog/spdlog.h>

namespace vesiflow::run {

bool RunFolder::has_its_checkpoint() const {
  std::error_code error;
  return options_.checkpoint && std::filesystem::equivalent(*options_.checkpoint, checkpoint(), error);
}

bool RunFolder::has_the_beginning() const {
  const auto& beginning = options_.checkpoint ? options_.checkpoint : options_.start_from;
  if (!beginning) return false;
  std::error_code error;
  const auto same = [&](const std::filesystem::path& a, const std::filesystem::path& b) {
    return std::filesystem::equivalent(a, b, error);
  };
  return same(*beginning, path_) || same(*beginning, checkpoint()) ||
         same(std::filesystem::absolute(*beginning).parent_path(), path_);
}

void RunFolder::take() {
  if (lock_) return;
  lock_.emplace(options_.directory);
  path_ = lock_->folder();
  if (const auto& owner = lock_->taken_from()) spdlog::info("taken over from a run that is gone ({})", *owner);
}

}  // namespace vesiflow::run
