// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Counts the calls of malloc and its relatives by the program, for tests that a warmed-up step allocates nothing.
/// A test program that uses it compiles support/allocation_counter.cpp. Sanitizers replace malloc themselves: under
/// them, and without glibc, nothing is counted.
namespace vesiflow::test {

long allocation_count();
bool allocations_are_counted();

}  // namespace vesiflow::test
