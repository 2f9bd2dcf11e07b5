// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <string>
#include <system_error>

namespace vesiflow {

/// What the system says of a call that failed, the last one unless its errno is given. In English, in any locale.
inline std::string system_message(int error = errno) {
  return std::generic_category().message(error);
}

}  // namespace vesiflow
