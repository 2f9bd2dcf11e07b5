// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Of each target that includes it, once: what a run on damaged input does must not depend on the machine's threads.
#pragma once

#include <omp.h>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  omp_set_num_threads(1);
  return 0;
}
