// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "run/scene.h"

namespace vesiflow::run {

/// What one phase of a run costs by estimate.
struct PhaseCost {
  std::string phase;     ///< name as in the accounts of summary.json
  double seconds = 0.0;  ///< per step, averaged over the run, by one thread of the reference machine; 0 where it is off
  double share = 0.0;    ///< of the run
  std::string off;       ///< why it is off; empty if it is on
  std::string key;       ///< what switches it off; empty if nothing does
  bool rough = false;    ///< no better than an order of magnitude
};

/// Costs of all phases of a run of the scene, shares adding up to 1: operation counts per unknown times constants that were
/// measured once on the reference machine (docs/plan.md; cost_model.cpp says which). Shares carry over to other machines better
/// than seconds do.
std::vector<PhaseCost> estimate_costs(const Scene& scene);

/// How often in a run something is written that is due at such an interval.
double times_due(const Scene& scene, double every, bool at_start);

/// Steps of a run; adaptive ones are taken to be as long as the first.
double planned_steps(const Scene& scene);

}  // namespace vesiflow::run
