// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <Eigen/Core>

#include "short_waits.h"

namespace vesiflow::coupling {

/// Calls work(begin, end) for shares of [0, count), one a thread. Inside a parallel region, whose threads have work of their own and where
/// entering another allocates, or with one thread, there is one share.
template <class Work>
void in_shares(Eigen::Index count, const Work& work) {
  if (omp_in_parallel() != 0 || omp_get_max_threads() == 1) {
    work(Eigen::Index{0}, count);
    return;
  }
  keep_waits_short();
#pragma omp parallel
  {
    const Eigen::Index threads = omp_get_num_threads(), thread = omp_get_thread_num();
    work(count * thread / threads, count * (thread + 1) / threads);
  }
}

}  // namespace vesiflow::coupling
