// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/triangle_mesh.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Area and volume of a closed surface.
struct AreaAndVolume {
  double area = 0;    ///< area A
  double volume = 0;  ///< enclosed volume V
};

/// A smooth surface fitted to a triangle mesh, and how well it meets it. Lengths are over `radius`.
struct MeshFit {
  Coefficients surface;  ///< X, three fields, where the mesh lies
  double radius = 0;     ///< of the sphere that has the volume of the mesh
  double rms_distance =
             0,            ///< distance of the vertices to X: root mean square, by their shares of the parameter sphere
      max_distance = 0;    ///< largest distance of a vertex to X
  double rms_between = 0,  ///< the same of the middles of the edges of `smooth`: what X does between vertices
      max_between = 0;     ///< largest of them

  /// How far those middles are from the edges, root mean square: what the triangles leave open.
  double rms_sagitta = 0;
  /// Area that the mesh has more than X because its vertices lie on either side of X, to first order.
  double roughness = 0;
  AreaAndVolume fitted;     ///< of X
  AreaAndVolume triangles;  ///< of the mesh as it is; its error is of second order in the edges
  AreaAndVolume smooth;     ///< of a smooth interpolant of its vertices
};

/// Degrees that a fit to so many vertices takes unless told: as many as the vertices determine, vertices >= 2
/// degrees^2, at most `latitudes` - 1, and at most 32, with which red cells and stomatocytes are met far better than
/// meshes give them.
VESIFLOW_VESICLE_EXPORT int default_fit_degrees(Eigen::Index vertices, int latitudes);

/// Fits spherical harmonics of degree n < degrees to a closed triangle mesh of genus zero, star-shaped or not:
///
///     minimise sum_i w_i |X(y_i) - x_i|^2 + lambda sum_{n,m} a_n |X_n^m|^2
///
/// over X and the places y_i of the vertices x_i on the unit sphere. The y_i start as a map of the mesh to the sphere
/// that neither folds nor crowds (src/shapes/sphere_map.h) and move to the foot points of the x_i on X; w_i is the
/// share of a vertex of the sphere, a_n the weight of the mesh energy (mesh_energy.h), and lambda makes the error of
/// prediction least, at the vertices by generalised cross validation and between them against a smooth interpolant: a
/// thin-plate spline on the sphere (G. Wahba, SIAM J. Sci. Stat. Comput. 2 (1981) 5) of few degrees. A mesh that turns
/// inward everywhere is taken as if it turned outward. vertices degrees^4 operations in each of at most eight rounds
/// and degrees^6 / 3 for each of at most thirty lambda, 8 vertices degrees^2 bytes.
/// \throws std::invalid_argument unless degrees >= 2 and vertices >= 2 degrees^2, naming the largest possible degrees.
/// \throws std::domain_error for a mesh that check_closed_genus_zero or check_no_crossings refuses, whose size
/// overflows or whose volume vanishes, that cannot be mapped to the sphere, or whose fit folds or is another shape: the
/// area, volume or reduced volume of the surface differs from that of the smooth interpolant by more than 1 %, what the
/// triangles leave open (the difference between interpolant and triangles) and the roughness, or rms_between is above
/// 1 % and rms_sagitta.
VESIFLOW_VESICLE_EXPORT MeshFit fit_mesh(const TriangleMesh& mesh, int degrees);

/// One sentence for people: how far the surface is from the vertices and between them, its area, volume and reduced
/// volume against those of the triangles.
VESIFLOW_VESICLE_EXPORT std::string description(const MeshFit& fit);

}  // namespace vesiflow::vesicle
