// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/stop_request.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <optional>

namespace vesiflow::run::stop_request_test {
namespace {

using Handler = void (*)(int);

Handler handler_of(int signal) {
  struct sigaction now {};
  sigaction(signal, nullptr, &now);
  return now.sa_handler;
}

void of_the_host(int) {}

TEST(StopRequest, KeepsOrPutsBackTheHandlersOfTheHost) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE}) {
    const Handler before = ::signal(signal, of_the_host);
    {
      const StopRequest request;
      EXPECT_EQ(handler_of(signal) != of_the_host, signal == SIGINT || signal == SIGTERM) << signal;
    }
    EXPECT_EQ(handler_of(signal), of_the_host);
    ::signal(signal, before);
  }
}

TEST(StopRequest, HearsOfASignalOnceAndForgetsItForTheNextRun) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) {
    const Handler before = ::signal(signal, SIG_DFL);
    {
      const StopRequest request;
      EXPECT_EQ(StopRequest::signal(), 0);
      raise(signal);
      raise(signal);  // as timeout(1) does
      EXPECT_EQ(StopRequest::signal(), signal);
    }
    {
      const StopRequest next;
      EXPECT_EQ(StopRequest::signal(), 0);
    }
    ::signal(signal, before);
  }
}

TEST(StopRequest, IgnoresThatNobodyReads) {
  const Handler before = ::signal(SIGPIPE, SIG_DFL);
  {
    const StopRequest request;
    raise(SIGPIPE);
    EXPECT_EQ(StopRequest::signal(), 0);
  }
  EXPECT_EQ(handler_of(SIGPIPE), SIG_DFL);
  ::signal(SIGPIPE, before);
}

TEST(StopRequest, LeavesAloneWhatNohupHasSwitchedOff) {
  const Handler before = ::signal(SIGHUP, SIG_IGN);
  {
    const StopRequest request;
    raise(SIGHUP);
    EXPECT_EQ(StopRequest::signal(), 0);
  }
  EXPECT_EQ(handler_of(SIGHUP), SIG_IGN);
  ::signal(SIGHUP, before);
}

// Runs in two threads overlap in any order.
TEST(StopRequest, OfSeveralRunsEndsWithTheLast) {
  const Handler before = ::signal(SIGTERM, of_the_host);
  std::optional<StopRequest> first(std::in_place), second(std::in_place);
  first.reset();
  raise(SIGTERM);
  EXPECT_EQ(StopRequest::signal(), SIGTERM);
  second.reset();
  EXPECT_EQ(handler_of(SIGTERM), of_the_host);
  ::signal(SIGTERM, before);
}

}  // namespace
}  // namespace vesiflow::run::stop_request_test
