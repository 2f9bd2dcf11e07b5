#include "results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "atomic_file.h"
#include "coupling/errors.h"
#include "vesicle_record.h"

namespace vesiflow::coupling {
namespace {

constexpr std::array result_files = {"summary.json", "diagnostics.csv", "vesicle.h5", "vesicle.xdmf", "fluid.h5",
                                     "fluid.xdmf",   "checkpoint.h5",   "scene.toml", "pictures"};

long step_of(const std::string& row) {
  return std::stol(row);
}

// One write call for all rows: a kill leaves whole lines.
void append_text(const std::filesystem::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const bool written =
      descriptor >= 0 && ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (descriptor >= 0) close(descriptor);
  if (!written) throw FileError(fmt::format("{}: cannot be written: disk full, or no permission", file.string()));
}

std::string column_names(const vesicle::Diagnostics& diagnostics, bool has_distances) {
  std::string names = "step,time,vesicle";
  visit_record(diagnostics, [&](std::string_view name, const double*, int length) {
    if (length == 1)
      names += fmt::format(",{}", name);
    else if (name == "centroid")
      names += ",centroid_x,centroid_y,centroid_z";
    else
      names += ",semi_axis_1,semi_axis_2,semi_axis_3";
  });
  return names + (has_distances ? ",min_distance\n" : "\n");
}

std::string row_of(const vesicle::Diagnostics& diagnostics) {
  std::string row;
  visit_record(diagnostics, [&](std::string_view, const double* values, int length) {
    for (int i = 0; i < length; ++i) row += std::isfinite(values[i]) ? fmt::format(",{:.10g}", values[i]) : ",";
  });
  return row;
}

}  // namespace

void prepare_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  const std::filesystem::path probe = directory / ".vesiflow_probe";
  if (!error) {
    std::ofstream stream(probe);
    if (!stream) error = std::make_error_code(std::errc::permission_denied);
  }
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
  if (error)
    throw FileError(fmt::format("{}: results cannot be written there: {}; choose another folder with --out",
                                directory.string(), error.message()));
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

DiagnosticsTable::DiagnosticsTable(const std::filesystem::path& directory) : file_(directory / "diagnostics.csv") {
  std::ifstream stream(file_);
  std::string row;
  std::getline(stream, row);
  while (std::getline(stream, row)) last_step_ = step_of(row);
}

void DiagnosticsTable::rewind(long step) {
  if (last_step_ <= step) return;
  std::ifstream stream(file_);
  std::string kept, row;
  std::getline(stream, kept);
  kept += '\n';
  last_step_ = -1;
  while (std::getline(stream, row)) {
    if (step_of(row) > step) break;
    last_step_ = step_of(row);
    kept += row + '\n';
  }
  write_text_atomically(file_, kept);
}

void DiagnosticsTable::write(const Simulation& simulation, std::span<const vesicle::Diagnostics> all) {
  const bool has_distances = all.size() > 1;
  const std::vector<double> distances = has_distances ? simulation.nearest_distances() : std::vector<double>{};
  std::string text;
  if (!std::filesystem::exists(file_)) text = column_names(all.front(), has_distances);
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += fmt::format("{},{:.10g},{}", simulation.steps(), simulation.time(), i) + row_of(all[i]);
    text += has_distances ? fmt::format(",{:.10g}\n", distances[i]) : "\n";
  }
  append_text(file_, text);
  last_step_ = simulation.steps();
}

}  // namespace vesiflow::coupling
