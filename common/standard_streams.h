// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string_view>

namespace vesiflow {

/// Text for people, on standard error. Where it cannot be written (closed, a full disk, nobody reads) it is lost, and that is all.
inline void say(std::string_view text) noexcept {
  [[maybe_unused]] const std::size_t written = std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// For programs, before anything is opened: standard streams that are closed (`2>&-`) become /dev/null, so that no file of
/// results gets their numbers and with them what is said; and writing what nobody reads any more fails instead of ending the
/// program.
inline void keep_standard_streams() noexcept {
  std::signal(SIGPIPE, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The lowest free number is this one.
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDWR) < 0) return;
}

}  // namespace vesiflow
