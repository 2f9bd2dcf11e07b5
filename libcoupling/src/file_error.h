#pragma once

#include <filesystem>

#include "coupling/errors.h"

namespace vesiflow::coupling {

/// As an error of results: which file, and the system's reason.
inline FileError file_error(const std::filesystem::filesystem_error& failure) {
  return FileError(failure.path1().string() + ": " + failure.code().message());
}

}  // namespace vesiflow::coupling
