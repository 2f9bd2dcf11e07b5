// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/cholmod/cholmod_blas.h"

#include <dlfcn.h>

#include <mutex>

namespace vesiflow::fluid {
namespace {

// Looked up while running, as BLAS libraries are interchangeable and only this one has the functions.
struct OpenBlas {
  using Get = int (*)();
  using Set = void (*)(int);
  Get get = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  Set set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));

  bool found() const { return get != nullptr && set != nullptr; }
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
  if (!open_blas().found()) return;
  const std::lock_guard lock(mutex);
  if (alive++ > 0) return;
  threads_before = open_blas().get();
  if (threads_before > 1) open_blas().set(1);
}

OneBlasThread::~OneBlasThread() {
  if (!open_blas().found()) return;
  const std::lock_guard lock(mutex);
  if (--alive == 0 && threads_before > 1) open_blas().set(threads_before);
}

}  // namespace vesiflow::fluid
