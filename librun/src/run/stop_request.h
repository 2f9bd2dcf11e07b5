// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vesiflow::run {

/// While one lives, Ctrl-C (SIGINT), SIGTERM, SIGHUP, SIGUSR1 and SIGUSR2 are requests to stop after the step under way; the same
/// one again, two seconds later, kills as usual. SIGPIPE is ignored: that
/// nobody reads the progress any more is no reason to end. But for SIGINT and SIGTERM this holds only where the process does what is
/// usual: what nohup has switched off, or a host program handles itself, stays so. Several may live at once, in threads; with the
/// last of them all signals are what they were.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// The signal that has come; 0 if none has.
  static int signal();
};

}  // namespace vesiflow::run
