// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vesiflow::fluid {

/// What one phase of the steps has taken since construction: wall seconds, and how often it was entered. A phase that
/// is switched off is never entered.
struct PhaseAccount {
  double seconds = 0.0;      ///< wall time
  std::int64_t entries = 0;  ///< how often it was entered
};

}  // namespace vesiflow::fluid
