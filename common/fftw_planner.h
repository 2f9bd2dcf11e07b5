// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// FFTW's planner, of which a process has one. A header for libvesicle and libfluid, which know nothing of each other.
#pragma once

#include <fftw3.h>

namespace vesiflow {

/// Makes FFTW lock its planner itself (FFTW 3.3.5 and later): against ourselves, whichever library and thread plans, and against
/// host programs. To be called before each use of the planner; it can be repeated, by any number of threads (3.3.10 installs
/// its lock once, under a mutex).
inline void lock_fftw_planner() noexcept {
  fftw_make_planner_thread_safe();
}

/// Also before main: a plan that another thread is making while the lock is installed would release at its end what it has not
/// taken, and two could plan at once from then on. That remains for libraries loaded later (dlopen) while a host plans.
inline const bool fftw_planner_is_locked = (lock_fftw_planner(), true);

}  // namespace vesiflow
