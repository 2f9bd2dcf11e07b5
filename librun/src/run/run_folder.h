// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "files/folder_lock.h"
#include "run/run.h"

namespace vesiflow::run {

/// The folder of a run's results, and what the run begins with as seen from there.
class RunFolder {
 public:
  /// \param options outlive this
  explicit RunFolder(const RunOptions& options) : options_(options), path_(options.directory) {}

  /// Whether what the run begins with is in its folder, where another run may be writing it.
  bool has_the_beginning() const;
  /// Whether the run goes on from the checkpoint that it will write itself.
  bool has_its_checkpoint() const;

  /// Takes the folder for this run alone, unless it has it.
  /// \throws FileError where another run has it
  void take();
  /// \throws FileError where another run has taken it since
  void require_held() const { lock_->require_held(); }

  /// Where it is, wherever the process goes, once it is taken; before, as the user has named it.
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path checkpoint() const { return path_ / checkpoint_name; }
  /// The same as the user would name it.
  std::filesystem::path named_checkpoint() const { return options_.directory / checkpoint_name; }

 private:
  static constexpr const char* checkpoint_name = "checkpoint.h5";

  const RunOptions& options_;
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
};

}  // namespace vesiflow::run
