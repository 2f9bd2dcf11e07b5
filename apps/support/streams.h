#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

/// Text for people, on standard error. Where it cannot be written (closed, a full disk, nobody reads) it is lost, and that is all.
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  const std::string text = fmt::format(format, std::forward<T>(values)...);
  [[maybe_unused]] const std::size_t written = std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// What a program was asked for, on standard output, all of it at once. Returns the system's reason if it cannot be written,
/// nothing otherwise; a reader who has had enough (`| head`) is no failure.
inline std::string put_out(std::string_view text) {
  std::clearerr(stdout);
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return written || errno == EPIPE ? "" : std::generic_category().message(errno);
}

/// Before anything is opened: standard streams that are closed (`2>&-`) become /dev/null, so that no file gets their numbers
/// and with them what is said; and writing what nobody reads any more fails instead of ending the program.
inline void keep_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The lowest free number is this one.
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDWR) < 0) return;
}
