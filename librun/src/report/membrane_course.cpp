// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/membrane_course.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "files/hdf5_file.h"
#include "report/thinning.h"
#include "run/errors.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::run {
namespace {

// Finer structure than this is not to be seen on a page.
constexpr int most_degrees = 64;
constexpr int most_latitudes = 512;
constexpr double most_value = 1e30;

using Values = Eigen::ArrayXXd;  // (markers, membrane_columns)

// Snapshots of any meshes, one after the other.
class Reader {
 public:
  MembraneCourse::Frame read(const std::filesystem::path& path, long step);
  std::array<MembraneCourse::Range, membrane_fields.size()> ranges();
  const std::vector<int>& latitudes() const { return latitudes_; }

 private:
  Values read_values(const Hdf5File& file, const std::string& group, int latitudes) const;
  void observe(const Values& values);
  const vesicle::SphericalHarmonics& harmonics(int latitudes);

  std::map<int, std::unique_ptr<vesicle::SphericalHarmonics>> harmonics_;
  std::vector<int> latitudes_;
  std::array<std::vector<double>, membrane_fields.size()> samples_, spans_;
};

const vesicle::SphericalHarmonics& Reader::harmonics(int latitudes) {
  auto& found = harmonics_[latitudes];
  if (!found)
    found = std::make_unique<vesicle::SphericalHarmonics>(latitudes, vesicle::SphereGrid(latitudes), membrane_columns);
  return *found;
}

Values Reader::read_values(const Hdf5File& file, const std::string& group, int latitudes) const {
  const auto markers = 2ULL * static_cast<std::uint64_t>(latitudes) * static_cast<std::uint64_t>(latitudes);
  const auto count = static_cast<Eigen::Index>(markers);
  Values values(count, membrane_columns);
  using Rows = Eigen::Array<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const std::vector<double> positions = file.read_block(group + "/positions", {0, 0}, {markers, 3});
  values.leftCols(3) = Eigen::Map<const Rows>(positions.data(), count, 3);
  const std::vector<double> velocity = file.read_block(group + "/velocity", {0, 0}, {markers, 3});
  values.col(membrane_fields[4].first) =
      Eigen::Map<const Rows>(velocity.data(), count, 3).square().rowwise().sum().sqrt();
  for (std::size_t f = 1; f < 4; ++f) {
    const std::vector<double> field =
        file.read_block(fmt::format("{}/{}", group, membrane_fields[f].name), {0}, {markers});
    values.col(membrane_fields[f].first) = Eigen::Map<const Eigen::ArrayXd>(field.data(), count);
  }
  return values;
}

// A sample of the values is enough for the scale of the colours.
void Reader::observe(const Values& values) {
  constexpr Eigen::Index most_samples = 256;
  const Eigen::Index stride = 1 + values.rows() / most_samples;
  for (std::size_t f = 1; f < membrane_fields.size(); ++f) {
    const auto column = values.col(membrane_fields[f].first);
    for (Eigen::Index k = 0; k < column.size(); k += stride) samples_[f].push_back(column[k]);
    spans_[f].push_back(column.maxCoeff() - column.minCoeff());
  }
}

MembraneCourse::Frame Reader::read(const std::filesystem::path& path, long step) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  MembraneCourse::Frame frame{.time = file.read_number("/", "time"), .step = step, .vesicles = {}};
  std::vector<int> latitudes;
  for (std::size_t v = 0; file.exists(fmt::format("/vesicle_{}", v)); ++v) {
    const std::string group = fmt::format("/vesicle_{}", v);
    const std::int64_t rows = file.read_integer(group, "latitudes");
    if (rows < 2 || rows > most_latitudes || file.read_integer(group, "longitudes") != 2 * rows)
      throw FileError(fmt::format("{}: {} has latitudes = {}, which must be from 2 to {} with twice as many longitudes",
                                  path.filename().string(), group, rows, most_latitudes));
    latitudes.push_back(static_cast<int>(rows));
    const Values values = read_values(file, group, latitudes.back());
    // What a float of the page cannot hold is as good as infinite.
    if (!values.allFinite() || values.abs().maxCoeff() > most_value)
      throw FileError(fmt::format("{}: {} has values that are not finite, or beyond {:g}", path.filename().string(),
                                  group, most_value));
    vesicle::Coefficients coefficients;
    harmonics(latitudes.back()).analysis(values, coefficients);
    frame.vesicles.push_back(real_coefficients(coefficients, std::min(latitudes.back(), most_degrees)));
    observe(values);
  }
  if (!latitudes_.empty() && latitudes.size() != latitudes_.size())
    throw FileError(fmt::format("{}: has {} vesicles, others have {}", path.filename().string(), latitudes.size(),
                                latitudes_.size()));
  latitudes_ = latitudes;
  return frame;
}

double at_share(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

std::array<MembraneCourse::Range, membrane_fields.size()> Reader::ranges() {
  std::array<MembraneCourse::Range, membrane_fields.size()> all;
  for (std::size_t f = 1; f < all.size(); ++f)
    if (!samples_[f].empty())
      all[f] = {.low = at_share(samples_[f], 0.005),
                .high = at_share(samples_[f], 0.995),
                .typical = at_share(spans_[f], 0.5)};
  return all;
}

}  // namespace

MembraneCourse read_membranes(const StoredRun& run, std::size_t most_frames) {
  MembraneCourse course;
  course.stored = run.membranes.size();
  std::vector<std::pair<long, std::filesystem::path>> files(run.membranes.begin(), run.membranes.end());
  Reader reader;
  for (const std::size_t i : evenly_chosen(files.size(), most_frames)) {
    try {
      course.frames.push_back(reader.read(files[i].second, files[i].first));
    } catch (const std::exception& reason) {  // of the file, or of a mesh that the library cannot take
      course.missing.push_back(fmt::format("A snapshot of the membranes: {}.", reason.what()));
    }
  }
  course.latitudes = reader.latitudes();
  course.ranges = reader.ranges();
  return course;
}

}  // namespace vesiflow::run
