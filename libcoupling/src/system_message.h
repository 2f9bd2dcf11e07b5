#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "coupling/errors.h"

namespace vesiflow::coupling {

/// What the system says of an error number.
inline std::string system_message(int error = errno) {
  return std::generic_category().message(error);
}

/// As an error of results: which file, and the system's reason.
inline FileError file_error(const std::filesystem::filesystem_error& failure) {
  return FileError(failure.path1().string() + ": " + failure.code().message());
}

}  // namespace vesiflow::coupling
