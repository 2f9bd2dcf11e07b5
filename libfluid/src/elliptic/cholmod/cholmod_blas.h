// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Keeps the BLAS that CHOLMOD calls to one thread.
#pragma once

namespace vesiflow::fluid {

// While it lives, OpenBLAS uses one thread: with several it divides its products otherwise, and the last bits of a
// factor would depend on the number of threads (which it takes from OMP_NUM_THREADS, among others). The number of
// before is restored. Does nothing for another BLAS. The number is the process's: where threads of a host program factor side
// by side, the first takes it to one, and the last to leave gives it back.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

}  // namespace vesiflow::fluid
