#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "hdf5_file.h"

namespace vesiflow::coupling {

/// Name of the group of a step: /steps/000000192.
std::string step_group(long step);

/// Step -> time of the snapshots in a file; empty when there is no file.
std::map<long, double> stored_steps(const std::filesystem::path& file);

/// Adds a group to a series by copying the file, extending the copy and renaming it over the original, so that a
/// kill at any moment leaves a complete file. `begin` fills a new file, `add` the group of the step.
void append_snapshot(const std::filesystem::path& file, long step, double time,
                     const std::function<void(Hdf5File&)>& begin,
                     const std::function<void(Hdf5File&, const std::string& group)>& add);

/// Removes the snapshots after `step`.
void drop_after(const std::filesystem::path& file, long step);

}  // namespace vesiflow::coupling
