// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cstdlib>

/// Starts the program again with what libraries read from the environment before main, where the user has not chosen it.
/// OpenBLAS: it is kept to one thread anyway (for the same bits on any machine), but would start one per core with 128 MB of
/// addresses each, and where a limit of memory (ulimit -v) refuses them, the program would not end. No call comes early enough.
/// OpenMP: threads that wait by spinning cost more than they compute when cores are shared. The libraries see to that where a
/// program does not (short_waits.h); they do nothing in a program that this started, which needs no parked threads.
inline void wait_passively(char** argv) {
  const bool chosen = std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr ||
                      std::getenv("KMP_BLOCKTIME") != nullptr;
  if (chosen && std::getenv("OPENBLAS_NUM_THREADS") != nullptr) return;
  if (!chosen && setenv("OMP_WAIT_POLICY", "passive", 1) != 0) return;
  if (setenv("OPENBLAS_NUM_THREADS", "1", 0) != 0) return;
  execv("/proc/self/exe", argv);  // returns only if it fails; then the run is slower, not wrong
}
