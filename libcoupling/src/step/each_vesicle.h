// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <cstddef>
#include <exception>
#include <string>

#include "coupling/errors.h"

#include "short_waits.h"

namespace vesiflow::coupling {

/// Calls visit(i); where it stops the simulation, as by a marker at a wall, the reason names the vesicle if there are several.
template <class Visit>
void visit_vesicle(std::size_t i, std::size_t count, const Visit& visit) {
  try {
    visit(i);
  } catch (const SimulationStopped& reason) {
    if (count == 1) throw;
    throw SimulationStopped("vesicle " + std::to_string(i) + ": " + reason.what(), reason.advice());
  }
}

/// Calls visit(i) for i < count: side by side where there are as many vesicles as threads, as one membrane is too small to keep
/// several busy; else one after the other, each with all threads. Visits must not share what they change. Of several exceptions
/// that of the first vesicle is thrown, when all are done.
template <class Visit>
void for_each_vesicle(std::size_t count, const Visit& visit) {
  const int threads = omp_get_max_threads();
  if (threads == 1 || count < static_cast<std::size_t>(threads)) {
    for (std::size_t i = 0; i < count; ++i) visit_vesicle(i, count, visit);
    return;
  }
  std::size_t first = count;
  std::exception_ptr thrown;
  keep_waits_short();
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      visit_vesicle(i, count, visit);
    } catch (...) {
#pragma omp critical(vesiflow_first_exception)
      if (i < first) {
        first = i;
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace vesiflow::coupling
