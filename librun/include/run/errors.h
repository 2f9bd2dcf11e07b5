// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "coupling/errors.h"
#include "run/export.h"

namespace vesiflow::run {

/// The scene, the command line or the checkpoint asks for something that cannot be done. The message names
/// file, line, key, value and what is allowed.
class VESIFLOW_RUN_EXPORT SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file of results could not be written or read.
class VESIFLOW_RUN_EXPORT FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vesiflow::run
