// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "files/hdf5_file.h"

namespace vesiflow::run {

/// Snapshots of one kind, a file each: snapshots/NAME_000000192.h5, written once and never touched again, so that one costs the
/// same however many there are. Two lists are made of them: NAME.h5, in which /steps/000000192 is a link to that file, and
/// NAME.xdmf for ParaView. A list never names a snapshot that is not there.
class SnapshotSeries {
 public:
  struct Kind {
    std::string name;
    /// What the list NAME.h5 has beside /steps.
    std::function<void(Hdf5File& list)> head;
    /// The data of a snapshot, of the present state.
    std::function<void(Hdf5File& snapshot)> fill;
    /// The <Grid> of a snapshot; `file` is its name as the list has it.
    std::function<std::string(const std::string& file, long step, double time)> xdmf;
  };

  /// Goes on with the snapshots that are in the directory.
  /// \throws FileError when NAME.h5 is of an earlier version, which kept the snapshots in it, or a snapshot or its folder cannot be read
  SnapshotSeries(std::filesystem::path directory, Kind kind);

  /// -1 if there is none.
  long last_step() const { return steps_.empty() ? -1 : steps_.rbegin()->first; }
  /// The lists follow now or, of many snapshots, a little later.
  void write(long step, double time);
  /// Brings the lists up to date, then removes the snapshots after `step`.
  /// \throws FileError when one cannot be removed
  void drop_after(long step);
  /// Brings the lists up to date.
  void list();

 private:
  void find();
  std::string file_of(long step) const;

  std::filesystem::path directory_;
  Kind kind_;
  std::map<long, double> steps_;           // step -> time
  std::optional<std::size_t> listed_ = 0;  // how many the lists name; nothing where they may name others
};

/// The folder of the snapshots.
inline constexpr const char* snapshots_folder = "snapshots";

/// The snapshots of a kind that the folder of a run has, by step: also those that its list does not name yet.
/// \throws std::filesystem::filesystem_error when the folder cannot be read
std::map<long, std::filesystem::path> stored_snapshots(const std::filesystem::path& directory, std::string_view kind);

}  // namespace vesiflow::run
