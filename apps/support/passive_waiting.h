#pragma once

#include <unistd.h>

#include <cstdlib>

/// Threads that wait by spinning cost more than they compute when cores are shared, and the OpenMP runtime reads its wait
/// policy before main: where the user has not chosen one, starts the program again with a passive one.
inline void wait_passively(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv);  // returns only if it fails; then the run is slower, not wrong
}
