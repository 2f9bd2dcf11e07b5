// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Keeps the BLAS that CHOLMOD calls to one thread.
#pragma once

namespace vesiflow::fluid {

// While it lives, OpenBLAS uses one thread: with several it divides its products otherwise, and the last bits of a
// factor would depend on the number of threads (which it takes from OMP_NUM_THREADS, among others). Does nothing for
// another BLAS, or where OpenBLAS has one thread anyway.
//
// Where OpenBLAS was built for OpenMP it asks for the number of the thread that calls it, and only that is changed.
// Where it has threads of its own (Debian's default) there is but one number, the process's, which it reads at the
// start of each call: calls of a host program that begin meanwhile use one thread too. Where threads of a host program
// factor side by side, the first takes it to one, and the last to leave gives the number back, unless someone has set
// another since.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int openmp_threads_before_ = 0;  // of this thread; 0 if they were left alone
};

}  // namespace vesiflow::fluid
