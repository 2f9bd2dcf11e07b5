// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/available_memory.h"

#include <sys/resource.h>

#include <fstream>
#include <limits>

namespace vesiflow::run {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

// Linux's own estimate: free memory and what caches would give back.
double free_bytes() {
  std::ifstream stream("/proc/meminfo");
  std::string key;
  double kilobytes = 0.0;
  while (stream >> key >> kilobytes) {
    if (key == "MemAvailable:") return 1024.0 * kilobytes;
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return unknown;
}

double address_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  return static_cast<double>(limit.rlim_cur);
}

// Of version 2 or 1 of control groups, as a container sees its own.
double container_limit() {
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream stream(file);
    double bytes = 0.0;
    if (stream >> bytes) return bytes;
  }
  return unknown;
}

}  // namespace

AvailableMemory available_memory() {
  AvailableMemory least{free_bytes(), "the machine"};
  if (const double bytes = container_limit(); bytes < least.bytes) least = {bytes, "its container"};
  if (const double bytes = address_limit(); bytes < least.bytes) least = {bytes, "its limit of memory (ulimit -v)"};
  return least;
}

}  // namespace vesiflow::run
