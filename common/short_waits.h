// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vesiflow {

/// Keeps OpenMP's threads from spinning while they wait, for the rest of the process. To be called before parallel regions; all
/// but the first call cost next to nothing. Does nothing where the user has chosen (OMP_WAIT_POLICY, GOMP_SPINCOUNT,
/// KMP_BLOCKTIME), and for one thread.
///
/// A step has some hundred regions of 10 to 1000 microseconds. GCC's runtime lets threads spin for milliseconds between them,
/// which on cores that others use is the time of a thread that has work: with two programs on two cores a step takes a hundred
/// times as long. The policy is read from the environment when the runtime is loaded, before any code of a library, and there is
/// no call to change it. But with more OpenMP threads than cores the runtime spins a hundred times only, then sleeps (manual of
/// libgomp, GOMP_SPINCOUNT). So a team is parked: threads that count, and sleep until the process ends; a smaller team later parks more. Where
/// more than 15 would be needed, or a limit of the system (ulimit -u) leaves no room for them and the team itself, nothing is
/// parked, and standard error says once what helps. LLVM's runtime has a call.
///
/// Compiled into each library that has regions; a program has it once, as all define the same. So it is visible outside of a shared
/// library too.
[[gnu::visibility("default")]] void keep_waits_short();

}  // namespace vesiflow
