// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// A time for people: "15 ms", "24 s", "3.2 min", "1.5 h", "4 days".
std::string duration(double seconds);

/// Bytes of all files that a run leaves, and of the second checkpoint while one is written: rows of the table, snapshots of
/// markers and of cells, a checkpoint.
double output_bytes(const Scene& scene);

/// Lines that end a plan: what the whole run takes, of time with so many threads, of memory beside what there is, and of the disk
/// that `directory` is on (or will be) beside what is free there.
std::string describe_totals(const Scene& scene, int threads, const std::filesystem::path& directory);

}  // namespace vesiflow::run
