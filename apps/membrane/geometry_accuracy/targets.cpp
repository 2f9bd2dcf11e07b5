// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

#include <fmt/format.h>

#include <optional>

#include "paper_table.h"

using namespace vesiflow::vesicle;

namespace {

std::string reason_of(const Measurement& measurement, double found, double limit, double truncated_surface) {
  if (found <= limit) return {};
  if (truncated_surface > limit)
    return fmt::format("the surface cut to degrees n < {} has itself an error of {:.2e}{}", measurement.latitudes,
                       truncated_surface, measurement.sampling == 1 ? "; --sampling 2 takes twice the samples" : "");
  return fmt::format(
      "rounding, not resolution: the surface cut to degrees n < {}, without the degrees that hold nothing "
      "but rounding, has an error of {:.2e}",
      measurement.latitudes, truncated_surface);
}

std::optional<double> laplacian_limit(const Measurement& measurement) {
  const std::string& surface = measurement.surface->name();
  if (surface == "ellipsoid" && (measurement.latitudes == 64 || measurement.latitudes == 128)) return 1e-7;
  if (surface == "y32" && measurement.latitudes == 64) return 5e-5;
  if (surface == "y32" && measurement.latitudes == 128) return 1e-7;
  return std::nullopt;
}

}  // namespace

std::vector<Verdict> verdicts(const Measurement& measurement) {
  const PaperRow* const paper = paper_row(measurement.surface->name(), measurement.latitudes);
  if (paper == nullptr) return {};
  std::vector<Verdict> result;
  const auto add = [&](const char* quantity, double found, double limit, double truncated_surface) {
    result.push_back({.quantity = quantity,
                      .found = found,
                      .limit = limit,
                      .reason = reason_of(measurement, found, limit, truncated_surface)});
  };
  add("H", measurement.mean, paper->mean / 10, measurement.truncated_surface.mean);
  add("K", measurement.gaussian, paper->gaussian / 10, measurement.truncated_surface.gaussian);
  if (const auto limit = laplacian_limit(measurement))
    for (const LaplacianError& laplacian : measurement.laplacians) {
      const LaplacianOptions& options = laplacian.options;
      if (options.form == LaplacianForm::cartesian && options.upsampling == Upsampling::twice && !options.truncated)
        add("Lap H", laplacian.error, *limit, measurement.truncated_surface.laplacian);
    }
  return result;
}
