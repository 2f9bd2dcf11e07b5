// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "run/errors.h"

namespace vesiflow::run {

/// As an error of results: which file, and the system's reason.
inline FileError file_error(const std::filesystem::filesystem_error& failure) {
  return FileError(failure.path1().string() + ": " + failure.code().message());
}

}  // namespace vesiflow::run
