// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace vesiflow::run {

/// The least of what the system has free, of what its container may take, and of the limit of the program's address space.
struct AvailableMemory {
  double bytes;    ///< infinite where nothing is known
  std::string of;  ///< whose it is, for people
};

AvailableMemory available_memory();

}  // namespace vesiflow::run
