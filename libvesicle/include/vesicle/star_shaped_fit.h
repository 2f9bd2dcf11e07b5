#pragma once

#include "vesicle/coefficients.h"
#include "vesicle/triangle_mesh.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// A surface X(d) = centre + r(d) d over the unit directions d, fitted to a mesh.
struct StarShapedFit {
  Coefficients radius;   ///< r, one field of the asked degrees
  Coefficients surface;  ///< X, three fields of one degree more, where the mesh lies
  Vector3 centre;        ///< centroid of the volume that the mesh encloses
  double mean_radius;    ///< mean of r over all directions
  double rms_residual;   ///< root mean square of r(d) - |x - centre| over the vertices, over mean_radius
  double max_residual;   ///< its largest magnitude, over mean_radius
};

/// Least squares for the radius of a closed triangle mesh as a function of the direction from the centroid of its volume,
/// in spherical harmonics of degree n < degrees. Vertices are weighted with their third of the solid angle of their
/// triangles, so that the sum approximates the integral over all directions. Solved by Householder QR:
/// 2 vertices degrees^4 operations, 8 vertices degrees^2 bytes. A mesh that turns inward everywhere is taken as if it
/// turned outward. The triangles give the topology, the centre and the weights; the surface is fitted to the vertices.
///
/// @throws std::invalid_argument unless degrees >= 2 and vertices >= 2 degrees^2, naming the largest possible degrees;
/// std::domain_error for a mesh that check_closed_genus_zero refuses, that is not star-shaped about its centroid (naming a
/// triangle that is not seen from inside), whose vertices leave so large gaps that they do not determine the radius, or
/// whose fitted radius is not positive.
StarShapedFit fit_star_shaped(const TriangleMesh& mesh, int degrees);

}  // namespace vesiflow::vesicle
