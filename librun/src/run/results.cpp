// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

#include "files/atomic_file.h"
#include "files/descriptor.h"
#include "files/folder_lock.h"
#include "files/snapshot_series.h"
#include "files/text_of.h"
#include "run/errors.h"
#include "run/report.h"
#include "run/vesicle_record.h"
#include "system_message.h"

namespace vesiflow::run {
namespace {

constexpr std::array result_files = {"summary.json", "diagnostics.csv", "vesicle.h5",    "vesicle.xdmf",
                                     "fluid.h5",     "fluid.xdmf",      "checkpoint.h5", "scene.toml",
                                     "pictures",     "start.h5",        report_name,     snapshots_folder};

long step_of_row(const std::string& row, const std::filesystem::path& file) {
  long step = 0;
  if (std::from_chars(row.data(), row.data() + row.size(), step).ec != std::errc())
    throw FileError(fmt::format("{}: damaged: a row begins with \"{}\", not with a step; move the file away to go on",
                                file.string(), row.substr(0, 20)));
  return step;
}

FileError not_written(const std::filesystem::path& file) {
  return FileError(fmt::format("{}: cannot be written: {}", file.string(), system_message()));
}

// One write call for all rows; of rows for which there is no room nothing is left.
void append_rows(const std::filesystem::path& file, const std::string& rows) {
  const Descriptor descriptor(open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (!descriptor.valid()) throw not_written(file);
  const off_t size = lseek(descriptor, 0, SEEK_END);
  if (write_all(descriptor, rows)) return;
  const FileError error = not_written(file);
  if (ftruncate(descriptor, size) != 0) throw not_written(file);
  throw error;
}

std::string column_names(bool has_distances, std::span<const OwnDiagnostic> own) {
  std::string names = "step,time,vesicle";
  visit_record(vesicle::Diagnostics{}, [&](std::string_view name, const double*, int length) {
    if (length == 1)
      names += fmt::format(",{}", name);
    else if (name == "centroid")
      names += ",centroid_x,centroid_y,centroid_z";
    else
      names += ",semi_axis_1,semi_axis_2,semi_axis_3";
  });
  if (has_distances) names += ",min_distance";
  for (const OwnDiagnostic& diagnostic : own) {
    const auto is_allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    const bool is_name = !diagnostic.name.empty() && std::ranges::all_of(diagnostic.name, is_allowed);
    if (!is_name || !diagnostic.value || ("," + names + ",").find("," + diagnostic.name + ",") != std::string::npos)
      throw SceneError(
          fmt::format("RunOptions::diagnostics: \"{}\": must be a name of letters, digits and underscores that no "
                      "column of diagnostics.csv has yet, with a function",
                      diagnostic.name));
    names += "," + diagnostic.name;
  }
  return names + "\n";
}

std::string cell_of(double value) {
  return std::isfinite(value) ? fmt::format(",{:.10g}", value) : ",";
}

std::string row_of(const vesicle::Diagnostics& diagnostics) {
  std::string row;
  visit_record(diagnostics, [&](std::string_view, const double* values, int length) {
    for (int i = 0; i < length; ++i) row += cell_of(values[i]);
  });
  return row;
}

}  // namespace

void remove_leftovers(const std::filesystem::path& directory) {
  std::error_code ignored;
  const auto remove_temporary = [&](const std::filesystem::path& folder, std::string_view beginning) {
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
      if (is_temporary(entry.path()) && entry.path().filename().string().starts_with(beginning))
        std::filesystem::remove(entry.path(), ignored);
  };
  for (const char* name : result_files) remove_temporary(directory, name);
  remove_temporary(directory, FolderLock::name);
  remove_temporary(directory / snapshots_folder, "");
}

std::optional<std::filesystem::path> move_earlier_results(const std::filesystem::path& directory) {
  bool found = false;
  for (const char* name : result_files) found = found || std::filesystem::exists(directory / name);
  if (!found) return std::nullopt;
  int number = 1;
  while (std::filesystem::exists(directory / fmt::format("previous_{}", number))) ++number;
  const std::filesystem::path target = directory / fmt::format("previous_{}", number);
  std::filesystem::create_directory(target);
  for (const char* name : result_files)
    if (std::filesystem::exists(directory / name)) std::filesystem::rename(directory / name, target / name);
  return target;
}

// A kill within the write of a row, where it crosses a page of memory, leaves a part of it.
DiagnosticsTable::DiagnosticsTable(const std::filesystem::path& directory, std::size_t vesicles,
                                   std::vector<OwnDiagnostic> own)
    : file_(directory / "diagnostics.csv"), own_(std::move(own)), columns_(column_names(vesicles > 1, own_)) {
  if (!std::filesystem::exists(file_)) return;
  std::string text = text_of(file_);
  const std::size_t whole = text.rfind('\n') + 1;  // 0 if there is none
  if (whole == 0) {
    std::filesystem::remove(file_);
    return;
  }
  if (whole < text.size()) {
    text.resize(whole);
    write_text_atomically(file_, text);
  }
  const std::size_t last_row = text.rfind('\n', whole - 2) + 1;
  if (!text.starts_with(columns_))
    throw SceneError(fmt::format(
        "{}: has the columns {}this run would write {}take the same RunOptions::diagnostics, or another folder",
        file_.string(), text.substr(0, text.find('\n') + 1), columns_));
  if (last_row > 0) last_step_ = step_of_row(text.substr(last_row), file_);
}

void DiagnosticsTable::rewind(long step) {
  if (last_step_ <= step) return;
  std::istringstream rows(text_of(file_));
  std::string kept, row;
  std::getline(rows, kept);
  kept += '\n';
  last_step_ = -1;
  while (std::getline(rows, row)) {
    const long of_row = step_of_row(row, file_);
    if (of_row > step) break;
    last_step_ = of_row;
    kept += row + '\n';
  }
  write_text_atomically(file_, kept);
}

void DiagnosticsTable::flush_to_disk() const {
  const Descriptor descriptor(open(file_.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.valid() && fsync(descriptor) != 0) throw not_written(file_);
}

void DiagnosticsTable::write(SceneSimulation& simulation, std::span<const vesicle::Diagnostics> all,
                             std::span<const double> distances) {
  const bool has_distances = all.size() > 1;
  std::string text;
  if (!std::filesystem::exists(file_)) text = columns_;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += fmt::format("{},{:.10g},{}", simulation.steps(), simulation.time(), i) + row_of(all[i]);
    if (has_distances) text += fmt::format(",{:.10g}", distances[i]);
    for (const OwnDiagnostic& diagnostic : own_) text += cell_of(diagnostic.value(simulation, i));
    text += '\n';
  }
  append_rows(file_, text);
  last_step_ = simulation.steps();
}

}  // namespace vesiflow::run
