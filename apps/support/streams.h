// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>

#include "standard_streams.h"
#include "system_message.h"

/// Text for people, as vesiflow::say.
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  vesiflow::say(fmt::format(format, std::forward<T>(values)...));
}

/// What a program was asked for, on standard output, all of it at once. Returns the system's reason if it cannot be written,
/// nothing otherwise; a reader who has had enough (`| head`) is no failure.
inline std::string put_out(std::string_view text) {
  std::clearerr(stdout);
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return written || errno == EPIPE ? "" : vesiflow::system_message();
}
