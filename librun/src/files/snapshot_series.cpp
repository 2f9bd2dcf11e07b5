// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/snapshot_series.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "files/atomic_file.h"
#include "files/file_error.h"
#include "run/errors.h"

namespace vesiflow::run {
namespace {

constexpr std::int64_t series_format = 2;  // 1 had the snapshots themselves in NAME.h5

// A list is written anew when it lacks more than this share of the snapshots: then its cost per snapshot does not grow either.
constexpr std::size_t share_not_listed = 50;

// The step in a name such as fluid_000000192.h5.
std::optional<long> step_of(std::string_view name, std::string_view kind) {
  constexpr std::string_view ending = ".h5";
  if (!name.starts_with(kind) || !name.ends_with(ending)) return std::nullopt;
  name.remove_suffix(ending.size());
  name.remove_prefix(kind.size());
  if (!name.starts_with('_')) return std::nullopt;
  name.remove_prefix(1);
  long step = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), step);
  return error == std::errc() && end == name.data() + name.size() ? std::optional(step) : std::nullopt;
}

void refuse_earlier_format(const std::filesystem::path& list) {
  if (!std::filesystem::exists(list)) return;
  const Hdf5File file(list, Hdf5File::Mode::read);
  if (const std::int64_t format = file.read_integer("/", "format"); format != series_format)
    throw FileError(
        fmt::format("{}: format {}, this version goes on with format {} only; restart into another folder with --out",
                    list.string(), format, series_format));
}

}  // namespace

std::map<long, std::filesystem::path> stored_snapshots(const std::filesystem::path& directory, std::string_view kind) {
  std::map<long, std::filesystem::path> files;
  const std::filesystem::path folder = directory / snapshots_folder;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (const auto step = step_of(entry.path().filename().string(), kind)) files[*step] = entry.path();
  return files;
}

SnapshotSeries::SnapshotSeries(std::filesystem::path directory, Kind kind)
    : directory_(std::move(directory)), kind_(std::move(kind)) {
  try {
    find();
  } catch (const std::filesystem::filesystem_error& failure) {
    throw file_error(failure);
  }
}

void SnapshotSeries::find() {
  const std::filesystem::path list = directory_ / (kind_.name + ".h5");
  refuse_earlier_format(list);
  if (std::filesystem::exists(list)) listed_.reset();
  for (const auto& [step, file] : stored_snapshots(directory_, kind_.name))
    steps_[step] = Hdf5File(file, Hdf5File::Mode::read).read_number("/", "time");
}

std::string SnapshotSeries::file_of(long step) const {
  return fmt::format("{}/{}_{:09d}.h5", snapshots_folder, kind_.name, step);
}

void SnapshotSeries::write(long step, double time) {
  std::error_code told_by_writing;
  std::filesystem::create_directory(directory_ / snapshots_folder, told_by_writing);
  write_atomically(directory_ / file_of(step), [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, Hdf5File::Mode::create);
    file.attribute("/", "format", series_format);
    file.attribute("/", "step", static_cast<std::int64_t>(step));
    file.attribute("/", "time", time);
    kind_.fill(file);
    file.close();
  });
  steps_[step] = time;
  const std::size_t listed = listed_.value_or(0);
  if (steps_.size() > listed + listed / share_not_listed) list();
}

void SnapshotSeries::drop_after(long step) {
  const auto later = steps_.upper_bound(step);
  const std::map<long, double> dropped(later, steps_.end());
  steps_.erase(later, steps_.end());
  if (!dropped.empty()) listed_.reset();
  list();
  // The last first, so that a kill leaves no gap.
  for (auto it = dropped.rbegin(); it != dropped.rend(); ++it) {
    const std::filesystem::path file = directory_ / file_of(it->first);
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error) throw FileError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
  }
}

void SnapshotSeries::list() {
  if (listed_ == steps_.size()) return;
  write_atomically(directory_ / (kind_.name + ".h5"), [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, Hdf5File::Mode::create);
    file.attribute("/", "format", series_format);
    kind_.head(file);
    for (const auto& [step, time] : steps_) file.link(fmt::format("/steps/{:09d}", step), file_of(step));
    file.close();
  });
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      kind_.name);
  for (const auto& [step, time] : steps_) text += kind_.xdmf(file_of(step), step, time);
  write_text_atomically(directory_ / (kind_.name + ".xdmf"), text + "  </Grid>\n</Domain>\n</Xdmf>\n");
  listed_ = steps_.size();
}

}  // namespace vesiflow::run
