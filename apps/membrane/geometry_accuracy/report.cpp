// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "paper_table.h"
#include "targets.h"

using namespace vesiflow::vesicle;

namespace {

using Text = std::back_insert_iterator<std::string>;

std::string number(double value) {
  return fmt::format("{:.2e}", value);
}

std::string name_of(LaplacianForm form) {
  switch (form) {
    case LaplacianForm::cartesian:
      return "cartesian";
    case LaplacianForm::christoffel:
      return "christoffel";
    case LaplacianForm::paper:
      return "paper";
  }
  throw std::logic_error("unknown form of the Laplacian");
}

// The Table 1 column that an upsampling factor belongs beside: none has 1.5.
std::string paper_laplacian(const PaperRow* paper, Upsampling upsampling) {
  if (paper == nullptr || upsampling == Upsampling::three_halves) return {};
  return number(upsampling == Upsampling::none ? paper->laplacian : paper->laplacian_upsampled);
}

void print_curvatures(Text text, std::span<const Measurement> grids) {
  fmt::format_to(text, "{:>5}  {:>9} {:>9}  {:>9} {:>9}  {:>9} {:>9}\n", "N", "H", "paper", "K", "paper", "H, cut",
                 "K, cut");
  for (const Measurement& m : grids) {
    const PaperRow* const paper = paper_row(m.surface->name(), m.latitudes);
    fmt::format_to(text, "{:>5}  {:>9} {:>9}  {:>9} {:>9}  {:>9} {:>9}\n", m.latitudes, number(m.mean),
                   paper ? number(paper->mean) : "", number(m.gaussian), paper ? number(paper->gaussian) : "",
                   number(m.truncated_surface.mean), number(m.truncated_surface.gaussian));
  }
}

void print_laplacians(Text text, std::span<const Measurement> grids) {
  constexpr std::array factors = {Upsampling::none, Upsampling::three_halves, Upsampling::twice};
  fmt::format_to(text, "{:>5}  {:<11} {:<9}  {:>9} {:>9}  {:>9}  {:>9} {:>9}\n", "N", "Lap H", "result", "no ups.",
                 "paper", "1.5", "2", "paper");
  for (const Measurement& m : grids) {
    const PaperRow* const paper = paper_row(m.surface->name(), m.latitudes);
    for (const LaplacianForm form : {LaplacianForm::cartesian, LaplacianForm::christoffel, LaplacianForm::paper})
      for (const bool truncated : {false, true}) {
        std::array<std::string, 3> found;
        for (const LaplacianError& laplacian : m.laplacians)
          for (std::size_t k = 0; k < factors.size(); ++k)
            if (laplacian.options.form == form && laplacian.options.truncated == truncated &&
                laplacian.options.upsampling == factors[k])
              found[k] = number(laplacian.error);
        if (found == std::array<std::string, 3>{}) continue;
        const auto beside = [&](int k) { return found[k].empty() ? "" : paper_laplacian(paper, factors[k]); };
        fmt::format_to(text, "{:>5}  {:<11} {:<9}  {:>9} {:>9}  {:>9}  {:>9} {:>9}\n", m.latitudes, name_of(form),
                       truncated ? "truncated" : "full", found[0], beside(0), found[1], found[2], beside(2));
      }
  }
}

// Errors that the reference is not good enough to tell.
std::string unmeasured(const Measurement& m) {
  constexpr double needed = 0.1;
  double laplacian = std::numeric_limits<double>::infinity();
  for (const LaplacianError& found : m.laplacians) laplacian = std::min(laplacian, found.error);
  std::vector<std::string> names;
  if (m.reference_estimate.mean > needed * m.mean) names.push_back("H");
  if (m.reference_estimate.gaussian > needed * m.gaussian) names.push_back("K");
  if (m.reference_estimate.laplacian > needed * laplacian) names.push_back("Lap H");
  if (names.empty()) return {};
  return fmt::format(": too near the errors of {} to measure them", fmt::join(names, ", "));
}

void print_reference(Text text, std::span<const Measurement> grids) {
  for (const Measurement& m : grids) {
    if (m.reference_degrees == 0) continue;
    fmt::format_to(
        text,
        "N = {}: errors are against the expansion of {} degrees; that of {} degrees differs from it by {} in "
        "H, {} in K, {} in Lap H{}\n",
        m.latitudes, m.reference_degrees, m.reference_degrees / 4 * 3, number(m.reference_estimate.mean),
        number(m.reference_estimate.gaussian), number(m.reference_estimate.laplacian), unmeasured(m));
  }
}

void print_verdicts(Text text, std::span<const Measurement> grids) {
  for (const Measurement& m : grids)
    for (const Verdict& verdict : verdicts(m))
      fmt::format_to(text, "target {:<5} N = {:<3}  {} <= {}: {}\n", verdict.quantity, m.latitudes,
                     number(verdict.found), number(verdict.limit), verdict.met() ? "met" : "missed: " + verdict.reason);
}

nlohmann::ordered_json or_null(const PaperRow* paper, double value) {
  return paper == nullptr ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

}  // namespace

std::string text_report(const std::vector<Measurement>& measurements) {
  std::string result;
  const Text text(result);
  for (auto first = measurements.begin(); first != measurements.end();) {
    const auto last =
        std::find_if(first, measurements.end(), [&](const auto& m) { return m.surface != first->surface; });
    const std::span<const Measurement> grids(first, last);
    fmt::format_to(
        text, "{}: {}; sampled on {}\n\n", first->surface->name(), first->surface->description(),
        first->sampling == 1 ? "N latitudes" : "2 N latitudes, without the degrees that hold nothing but rounding");
    print_curvatures(text, grids);
    fmt::format_to(text, "\n");
    print_laplacians(text, grids);
    fmt::format_to(text, "\n");
    print_reference(text, grids);
    print_verdicts(text, grids);
    fmt::format_to(text, "\n");
    first = last;
  }
  fmt::format_to(
      text,
      "Largest errors over the markers of N latitudes and 2 N longitudes. cut: exact geometry of the surface "
      "with its\nexpansion cut to degrees n < N. Lap H, full: all computed degrees evaluated at the markers; "
      "truncated: degrees n < N.\n");
  return result;
}

std::string json_report(const std::vector<Measurement>& measurements) {
  auto list = nlohmann::ordered_json::array();
  for (const Measurement& m : measurements)
    for (const LaplacianError& laplacian : m.laplacians) {
      const PaperRow* const paper = paper_row(m.surface->name(), m.latitudes);
      const Upsampling upsampling = laplacian.options.upsampling;
      const bool has_column = paper != nullptr && upsampling != Upsampling::three_halves;
      list.push_back({
          {"surface", m.surface->name()},
          {"latitudes", m.latitudes},
          {"formula", name_of(laplacian.options.form)},
          {"upsampling", factor(upsampling)},
          {"truncated", laplacian.options.truncated},
          {"sampling", m.sampling},
          {"error_H", m.mean},
          {"error_K", m.gaussian},
          {"error_lapH", laplacian.error},
          {"paper_H", or_null(paper, paper ? paper->mean : 0)},
          {"paper_K", or_null(paper, paper ? paper->gaussian : 0)},
          {"paper_lapH",
           or_null(has_column ? paper : nullptr, !has_column                      ? 0
                                                 : upsampling == Upsampling::none ? paper->laplacian
                                                                                  : paper->laplacian_upsampled)},
          {"truncated_surface_H", m.truncated_surface.mean},
          {"truncated_surface_K", m.truncated_surface.gaussian},
          {"reference_error_H", m.reference_estimate.mean},
          {"reference_error_K", m.reference_estimate.gaussian},
          {"reference_error_lapH", m.reference_estimate.laplacian},
      });
    }
  return list.dump(1) + "\n";
}
