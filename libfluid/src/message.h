// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Text of error messages: values of any printable kinds, one after the other.
#pragma once

#include <sstream>
#include <string>

namespace vesiflow::fluid {

template <class... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream text;
  text.precision(15);
  (text << ... << parts);
  return text.str();
}

}  // namespace vesiflow::fluid
