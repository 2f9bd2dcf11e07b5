// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>  // defines __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

/// Gives the memory of fields back to the system as soon as they are freed. Left to itself, glibc keeps that of the copies that
/// files are written from, in pieces that other sizes do not fit: a third of the resident size of a run on 64^3 cells.
inline void return_large_blocks() {
#ifdef __GLIBC__
  constexpr int block = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, block);
#endif
}
