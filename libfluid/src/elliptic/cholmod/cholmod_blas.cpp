// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/cholmod/cholmod_blas.h"

#include <dlfcn.h>
#include <omp.h>

#include <mutex>

namespace vesiflow::fluid {
namespace {

enum class Threads { none, own, openmp };

// Looked up while running, as BLAS libraries are interchangeable and only this one has the functions.
struct OpenBlas {
  using Get = int (*)();
  using Set = void (*)(int);
  Get get = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  Set set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  Get kind = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_parallel"));  // 0, 1 and 2 as in Threads

  Threads threads() const {
    if (get == nullptr || set == nullptr || kind == nullptr) return Threads::none;
    return static_cast<Threads>(kind());
  }
};

const OpenBlas& open_blas() {
  static const OpenBlas functions;
  return functions;
}

std::mutex mutex;  // over these
int alive = 0;
int threads_before = 1;

}  // namespace

OneBlasThread::OneBlasThread() {
  switch (open_blas().threads()) {
    case Threads::none:
      return;
    case Threads::openmp:
      openmp_threads_before_ = omp_get_max_threads();
      omp_set_num_threads(1);
      return;
    case Threads::own:
      break;
  }
  const std::lock_guard lock(mutex);
  if (alive++ > 0) return;
  threads_before = open_blas().get();
  if (threads_before > 1) open_blas().set(1);
}

OneBlasThread::~OneBlasThread() {
  if (openmp_threads_before_ > 0) omp_set_num_threads(openmp_threads_before_);
  if (open_blas().threads() != Threads::own) return;
  const std::lock_guard lock(mutex);
  if (--alive == 0 && threads_before > 1 && open_blas().get() == 1) open_blas().set(threads_before);
}

}  // namespace vesiflow::fluid
