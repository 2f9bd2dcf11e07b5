// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#ifdef _OPENMP
#include <omp.h>

#include "short_waits.h"
#endif

namespace vesiflow::vesicle {

/// Threads worth starting by a caller that could use up to `most`: one inside a parallel region, whose threads are
/// each busy with work of their own.
inline int available_threads(int most) {
#ifdef _OPENMP
  if (omp_in_parallel()) return 1;
  return std::max(1, std::min({most, omp_get_max_threads(), omp_get_num_procs()}));
#else
  return std::min(most, 1);
#endif
}

/// Calls first(thread, threads) on each thread and, when all are done, second(thread, threads).
template <class First, class Second>
void in_two_stages([[maybe_unused]] int threads, const First& first, const Second& second) {
#ifdef _OPENMP
  if (threads > 1) {
    keep_waits_short();
#pragma omp parallel num_threads(threads)
    {
      first(omp_get_thread_num(), omp_get_num_threads());
#pragma omp barrier
      second(omp_get_thread_num(), omp_get_num_threads());
    }
    return;
  }
#endif
  first(0, 1);
  second(0, 1);
}

}  // namespace vesiflow::vesicle
