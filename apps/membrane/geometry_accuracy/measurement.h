// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "surface_source.h"
#include "vesicle/laplace_beltrami.h"

struct LaplacianError {
  vesiflow::vesicle::LaplacianOptions options;
  double error;
};

/// Largest errors over the nodes of one surface on one grid.
struct Measurement {
  const SurfaceSource* surface;
  int latitudes;
  int sampling;  ///< the surface is sampled on sampling * latitudes latitudes
  double mean, gaussian;
  std::vector<LaplacianError> laplacians;
  /// Of the exact geometry of the surface with its expansion cut to degrees n < latitudes.
  CurvatureErrors truncated_surface;
  int reference_degrees;
  CurvatureErrors reference_estimate;
};

using Surfaces = std::vector<std::unique_ptr<SurfaceSource>>;

/// Errors of every surface on every grid, in this order. With sampling = 2 H, K and the Cartesian form of Lap H are evaluated
/// from an expansion of 2 latitudes degrees, and only such options are measured (see measurable()).
/// @throws InputError for a surface that is degenerate on a grid.
std::vector<Measurement> measure(const Surfaces& surfaces, const std::vector<int>& latitudes, int sampling,
                                 const std::vector<vesiflow::vesicle::LaplacianOptions>& options);

/// Whether a form of Lap H can be had with this sampling: all with 1; with 2 the Cartesian one on twice the latitudes, not
/// truncated.
bool measurable(const vesiflow::vesicle::LaplacianOptions& options, int sampling);
