#pragma once

namespace vesiflow::coupling {

/// While it lives, Ctrl-C and SIGTERM are requests to stop after the step under way. A second one kills as usual.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// The signal that has come, SIGINT or SIGTERM; 0 if none has.
  static int signal();

 private:
  void (*old_interrupt_)(int);
  void (*old_terminate_)(int);
};

}  // namespace vesiflow::coupling
