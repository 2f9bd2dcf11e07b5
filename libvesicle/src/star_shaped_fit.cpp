#include "vesicle/star_shaped_fit.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "check.h"
#include "directions.h"
#include "harmonics_at.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::vesicle {
namespace {

using std::numbers::pi;

/// Signed solid angle of a triangle seen from the origin: A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30
/// (1983) 125.
double solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// Vertices seen from the centre, each with its third of the solid angle of its triangles.
struct View {
  VectorField from_centre;
  Eigen::VectorXd radius;
  Eigen::VectorXd weight;

  Vector3 direction(Eigen::Index i) const { return from_centre.row(i).matrix().transpose() / radius[i]; }
};

View view_from(const Vector3& centre, const TriangleMesh& mesh, double orientation) {
  View view{mesh.vertices.rowwise() - centre.transpose().array(), {}, Eigen::VectorXd::Zero(mesh.vertices.rows())};
  view.radius = view.from_centre.matrix().rowwise().norm();
  const auto vertex = [&view](int i) -> Vector3 { return view.from_centre.row(i).matrix().transpose(); };
  double total = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto corner = mesh.triangles.row(t);
    const double angle = orientation * solid_angle(vertex(corner[0]), vertex(corner[1]), vertex(corner[2]));
    if (!(angle > 0)) {
      std::ostringstream message;
      message << "triangle mesh: not star-shaped: from the centre (" << centre.transpose()
              << ") of its volume triangle " << t
              << " is seen from outside or edge-on, so that the radius is no function "
              << "of the direction; smooth or remesh the surface with other software, or give it by its coefficients";
      throw std::domain_error(message.str());
    }
    for (int i : corner) view.weight[i] += angle / 3;
    total += angle;
  }
  // All triangles face the centre, so the mesh covers the directions a whole number of times; once for genus zero.
  if (std::abs(total - 4 * pi) > 1e-6)
    throw std::domain_error("triangle mesh: not star-shaped: it covers the directions " +
                            std::to_string(total / (4 * pi)) + " times");
  return view;
}

/// Radius in real unknowns, see harmonics_at.
Eigen::VectorXd fit_radius(const View& view, int degrees) {
  const Eigen::Index unknowns = Eigen::Index{degrees} * degrees;
  Eigen::MatrixXd matrix(view.radius.size(), unknowns);
  Eigen::VectorXd basis(unknowns);
  const Eigen::VectorXd root = view.weight.cwiseSqrt();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    harmonics_at(view.direction(i), degrees, basis);
    matrix.row(i) = root[i] * basis.transpose();
  }
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(matrix);
  // The columns are nearly orthogonal with norms 1 or sqrt(2): only gaps between the vertices make R nearly singular.
  // Beyond this bound errors of the vertices would be amplified a thousandfold.
  constexpr double smallest_pivot = 1e-3;
  if (!(qr.matrixQR().diagonal().cwiseAbs().minCoeff() > smallest_pivot))
    throw std::domain_error("triangle mesh: the vertices leave gaps too large for degrees = " +
                            std::to_string(degrees) + "; take fewer degrees or spread the vertices evenly");
  return qr.solve(root.cwiseProduct(view.radius));
}

/// X = centre + r(d) d, of one degree more than r.
Coefficients surface_of(const Coefficients& radius, const Vector3& centre) {
  const int degrees = radius.degrees() + 1;
  const SphereGrid grid(degrees);
  ScalarField r(grid.size());
  SphericalHarmonics(radius.degrees(), grid, 1).synthesis(radius, r);
  if (!(r.minCoeff() > 0))
    throw std::domain_error("triangle mesh: the fitted radius reaches " + std::to_string(r.minCoeff()) +
                            ": must be > 0; take fewer degrees or a finer mesh");
  VectorField x(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const Eigen::Index k = grid.index(i, j);
      x.row(k) << r[k] * direction(grid, i, j).transpose().array();
    }
  x.rowwise() += centre.transpose().array();
  Coefficients surface;
  SphericalHarmonics(degrees, grid).analysis(x, surface);
  return surface;
}

}  // namespace

StarShapedFit fit_star_shaped(const TriangleMesh& mesh, int degrees) {
  check_argument(degrees >= 2, "degrees", degrees, ">= 2");
  check_closed_genus_zero(mesh);
  const Eigen::Index vertices = mesh.vertices.rows();
  if (vertices / 2 < Eigen::Index{degrees} * degrees) {
    std::ostringstream message;
    message << "degrees = " << degrees << ": the fit needs 2 degrees^2 = " << 2L * degrees * degrees
            << " vertices and the mesh has " << vertices << "; at most "
            << static_cast<int>(std::sqrt(static_cast<double>(vertices) / 2)) << " degrees";
    throw std::invalid_argument(message.str());
  }
  const EnclosedVolume enclosed = enclosed_volume(mesh);
  const View view = view_from(enclosed.centroid, mesh, enclosed.volume > 0 ? 1 : -1);
  const Eigen::VectorXd unknowns = fit_radius(view, degrees);

  StarShapedFit fit;
  fit.radius = coefficients_of(unknowns, degrees);
  fit.surface = surface_of(fit.radius, enclosed.centroid);
  fit.centre = enclosed.centroid;
  fit.mean_radius = unknowns[0] / std::sqrt(4 * pi);
  Eigen::VectorXd residual(vertices), basis(unknowns.size());
  for (Eigen::Index i = 0; i < vertices; ++i) {
    harmonics_at(view.direction(i), degrees, basis);
    residual[i] = basis.dot(unknowns) - view.radius[i];
  }
  fit.rms_residual = std::sqrt(residual.squaredNorm() / double(vertices)) / fit.mean_radius;
  fit.max_residual = residual.cwiseAbs().maxCoeff() / fit.mean_radius;
  return fit;
}

}  // namespace vesiflow::vesicle
