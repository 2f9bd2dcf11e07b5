// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "expansion_geometry.h"
#include "vesicle/surface.h"

using namespace vesiflow::vesicle;

namespace {

double max_difference(const ScalarField& a, const ScalarField& b) {
  return (a - b).abs().maxCoeff();
}

// Runs a computation on the surface of a measurement and says which surface and grid it was that failed.
template <class Computation>
void refuse_degenerate(const Measurement& measurement, const Computation& computation) {
  try {
    computation();
  } catch (const std::domain_error& error) {
    throw InputError(
        fmt::format("{} on {} latitudes: {}", measurement.surface->name(), measurement.latitudes, error.what()));
  }
}

// The computation of a simulation: everything from positions at the nodes.
void measure_sampled_at_nodes(const std::vector<Reference>& references, const std::vector<LaplacianOptions>& options,
                              std::vector<Measurement>& measurements) {
  std::vector<Surface> surfaces;
  for (std::size_t s = 0; s < measurements.size(); ++s) {
    Surface& surface = surfaces.emplace_back(measurements[s].latitudes);
    refuse_degenerate(measurements[s], [&] { surface.update(measurements[s].surface->sample(surface.grid())); });
    measurements[s].mean = max_difference(surface.mean_curvature(), references[s].values.mean);
    measurements[s].gaussian = max_difference(surface.gaussian_curvature(), references[s].values.gaussian);
  }
  ScalarField laplacian;
  for (const LaplacianOptions& choice : options) {
    LaplaceBeltrami laplace_beltrami(surfaces.front().grid(), choice);
    for (std::size_t s = 0; s < measurements.size(); ++s) {
      refuse_degenerate(measurements[s], [&] { laplace_beltrami.of_mean_curvature(surfaces[s], laplacian); });
      measurements[s].laplacians.push_back({choice, max_difference(laplacian, references[s].values.laplacian)});
    }
  }
}

std::vector<Measurement> measure_on_grid(const Surfaces& surfaces, int latitudes, int sampling,
                                         const std::vector<LaplacianOptions>& options) {
  const SphereGrid nodes(latitudes);
  ExpansionGeometry fine(2 * latitudes, nodes);
  std::vector<Reference> references;
  std::vector<Measurement> measurements;
  for (const auto& surface : surfaces) {
    const Reference& reference = references.emplace_back(surface->reference(nodes));
    Measurement& measurement = measurements.emplace_back();
    measurement.surface = surface.get();
    measurement.latitudes = latitudes;
    measurement.sampling = sampling;
    measurement.reference_degrees = reference.degrees;
    measurement.reference_estimate = reference.estimate;
    CurvatureErrors errors;
    refuse_degenerate(measurement, [&] {
      Coefficients positions = expansion_of(*surface, 2 * latitudes);
      errors = max_difference(fine.at_nodes(positions), reference.values);
      positions.truncate(latitudes);
      measurement.truncated_surface = max_difference(fine.at_nodes(positions), reference.values);
    });
    if (sampling == 1) continue;
    measurement.mean = errors.mean;
    measurement.gaussian = errors.gaussian;
    for (const LaplacianOptions& choice : options) measurement.laplacians.push_back({choice, errors.laplacian});
  }
  if (sampling == 1) measure_sampled_at_nodes(references, options, measurements);
  return measurements;
}

}  // namespace

CurvatureErrors max_difference(const Curvatures& a, const Curvatures& b) {
  return {.mean = max_difference(a.mean, b.mean),
          .gaussian = max_difference(a.gaussian, b.gaussian),
          .laplacian = max_difference(a.laplacian, b.laplacian)};
}

std::vector<Measurement> measure(const Surfaces& surfaces, const std::vector<int>& latitudes, int sampling,
                                 const std::vector<LaplacianOptions>& options) {
  std::vector<Measurement> result;
  for (const int n : latitudes)
    std::ranges::move(measure_on_grid(surfaces, n, sampling, options), std::back_inserter(result));
  // Grids outermost above, because an operator is costly to set up; surfaces outermost for the reader.
  const auto position = [&](const Measurement& m) {
    return std::ranges::find_if(surfaces, [&](const auto& surface) { return surface.get() == m.surface; });
  };
  std::ranges::stable_sort(result, {}, position);
  return result;
}

bool measurable(const LaplacianOptions& options, int sampling) {
  return sampling == 1 ||
         (options.form == LaplacianForm::cartesian && options.upsampling == Upsampling::twice && !options.truncated);
}
