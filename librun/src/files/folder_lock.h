// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vesiflow::run {

/// Keeps a folder for one run: a file `run.lock` that says whose it is. It appears whole, by a hard link (or
/// O_EXCL), which network file systems honour too, and needs no flock. What a process that is gone has left (same machine; no such process, or a later one with its
/// number, or the machine has been started anew since) is taken over; of another machine nobody can tell from here.
class FolderLock {
 public:
  static constexpr const char* name = "run.lock";

  /// Makes the folder if need be.
  /// \throws FileError when it cannot be written, or when another run holds it: which, since when, and what to do
  explicit FolderLock(const std::filesystem::path& folder);
  /// Gives the folder back.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// The folder, absolute and without links: it stays the same wherever the process goes.
  const std::filesystem::path& folder() const { return folder_; }
  /// Who left the lock that was taken over, if there was one.
  const std::optional<std::string>& taken_from() const { return taken_from_; }

  /// \throws FileError when somebody has removed the lock and another run has taken the folder, or the folder is gone, or the lock
  /// cannot be read for some time
  void require_held() const;

 private:
  std::filesystem::path folder_, file_;
  std::string text_;
  std::optional<std::string> taken_from_;
};

}  // namespace vesiflow::run
