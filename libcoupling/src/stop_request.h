#pragma once

namespace vesiflow::coupling {

/// While one lives, Ctrl-C (SIGINT), SIGTERM, SIGHUP, SIGUSR1 and SIGUSR2 are requests to stop after the step under way; the same
/// one again, two seconds later, kills as usual. SIGHUP, SIGUSR1 and SIGUSR2 that the process ignores (nohup) stay ignored. SIGPIPE is
/// ignored: that nobody reads the progress any more is no reason to end. Several may live at once, in threads; with the last
/// of them all signals are what they were.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// The signal that has come; 0 if none has.
  static int signal();
};

}  // namespace vesiflow::coupling
