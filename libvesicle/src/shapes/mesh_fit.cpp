// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "check.h"
#include "harmonics/harmonics_at.h"
#include "shapes/foot_points.h"
#include "shapes/smooth_interpolant.h"
#include "shapes/smoothing_fit.h"
#include "shapes/sphere_map.h"
#include "vesicle/scale_degrees.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle {
namespace {

using std::numbers::pi;

/// The mesh about its middle, with its farthest vertex at distance one, turned outward.
struct Normalised {
  TriangleMesh mesh;
  Vector3 centre;
  double size;
};

Normalised normalised(const TriangleMesh& mesh) {
  Normalised result{mesh, {}, 0};
  VectorField& x = result.mesh.vertices;
  const Eigen::Array3d low = x.colwise().minCoeff(), high = x.colwise().maxCoeff();
  result.centre = low / 2 + high / 2;
  x.rowwise() -= result.centre.transpose().array();
  result.size = x.abs().maxCoeff();
  x /= result.size;
  if (!(result.size >= 1e-100 && result.size <= 1e100))
    throw std::domain_error("triangle mesh: half its extent is " + std::to_string(result.size) +
                            ": must be in [1e-100, 1e100]");
  const double volume = enclosed_volume(result.mesh).volume;
  constexpr double least_volume = 1e-9;  // of a cube of edge 2: thinner than any membrane that a mesh resolves
  if (!(std::abs(volume) > 8 * least_volume)) throw std::domain_error("triangle mesh: it encloses no volume");
  if (volume < 0) result.mesh.triangles.col(1).swap(result.mesh.triangles.col(2));
  return result;
}

/// Turns the map so that the direction of a vertex on the sphere is that from the middle of the mesh, as far as a rotation can
/// do that: which vertex is at the pole does not depend on the numbering (W. Kabsch, Acta Cryst. A 32 (1976) 922).
void align(const TriangleMesh& mesh, VectorField& map) {
  const Eigen::Matrix3d product = map.matrix().transpose() * mesh.vertices.matrix();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0 ? 1 : -1;
  map = (map.matrix() * (svd.matrixU() * sign * svd.matrixV().transpose())).eval().array();
}

/// A third of the solid angle of its triangles, as their chords span it, for each vertex.
Eigen::VectorXd shares(const TriangleMesh& mesh, const VectorField& map) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(map.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<Vector3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = map.row(mesh.triangles(t, Eigen::Index(k))).matrix().transpose();
    const double area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
    for (const int i : mesh.triangles.row(t)) result[i] += area;
  }
  return result * (4 * pi / result.sum());
}

Coefficients three_fields(const Eigen::MatrixXd& unknowns, int degrees) {
  Coefficients result(degrees, 3);
  for (int field = 0; field < 3; ++field) {
    const Coefficients one = coefficients_of(unknowns.col(field), degrees);
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) result(field, n, m) = one(0, n, m);
  }
  return result;
}

/// As far along the displacement as no triangle folds, at most once.
bool move(const TriangleMesh& mesh, const VectorField& displacement, VectorField& map) {
  for (double length = 1; length > 0.05; length /= 2) {
    VectorField trial = map + length * displacement;
    trial.colwise() /= trial.square().rowwise().sum().sqrt().eval();
    if (!is_one_to_one(mesh, trial)) continue;
    map = trial;
    return true;
  }
  return false;
}

struct Distances {
  double rms = 0, max = 0;
};

/// Of the middles of the interpolant's edges, across the surface.
Distances between(const SmoothInterpolant& interpolant, const VectorField& map, const Coefficients& surface) {
  const auto edges = static_cast<Eigen::Index>(interpolant.edges.size());
  VectorField places(edges, 3), middles(edges, 3);
  for (Eigen::Index k = 0; k < edges; ++k) {
    const auto& edge = interpolant.edges[std::size_t(k)];
    places.row(k) = (map.row(edge.from) + map.row(edge.to)).matrix().normalized().array();
    middles.row(k) = edge.middle.transpose().array();
  }
  VectorField displacement, across;
  FootPoints(surface).find(places, middles, displacement, across);
  const Eigen::ArrayXd squares = across.square().rowwise().sum();
  return {std::sqrt(squares.mean()), std::sqrt(squares.maxCoeff())};
}

/// A fit with its distances.
struct Trial {
  Coefficients surface;
  Distances at_vertices, between;
  double roughness = 0;  ///< area that the mesh has more than the surface since its vertices lie on either side of it
};

/// (1/2) int |grad r|^2 of the residual at the vertices, linear in the triangles: the area that it adds to first order.
double roughness(const TriangleMesh& mesh, const VectorField& residual) {
  double area = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int at = mesh.triangles(t, k), next = mesh.triangles(t, (k + 1) % 3), last = mesh.triangles(t, (k + 2) % 3);
      const Vector3 a = (mesh.vertices.row(next) - mesh.vertices.row(at)).matrix().transpose();
      const Vector3 b = (mesh.vertices.row(last) - mesh.vertices.row(at)).matrix().transpose();
      const double twice_area = a.cross(b).norm();
      if (twice_area > 0) area += a.dot(b) / twice_area * (residual.row(next) - residual.row(last)).square().sum() / 4;
    }
  return area;
}

/// Fit and foot points in turn for as long as the surface comes nearer to what lies between the vertices. Those themselves do
/// not tell: with places that move to them, the surface can be drawn to every one and swing from one to the next.
Trial fit_in_turn(const TriangleMesh& mesh, const SmoothInterpolant& interpolant, int degrees, VectorField map) {
  // A round takes distances to about 0.7 of what they were; what eight leave is a tenth.
  constexpr int most_rounds = 8;
  constexpr double least_gain = 0.95;
  Trial best;
  SmoothingRange range;
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXd share = shares(mesh, map);
    const SmoothingFit fit =
        fit_smoothly(map, share, mesh.vertices.matrix(), degrees, range, [&](const Eigen::MatrixXd& unknowns) {
          const double distance = between(interpolant, map, three_fields(unknowns, degrees)).rms;
          return distance * distance;
        });
    // As places get better, so may the surface follow them, a decade of lambda in a round.
    range = {10 * fit.smoothing, fit.smoothing / 10};
    Trial trial{three_fields(fit.unknowns, degrees), {}, {}, 0};
    VectorField displacement, across;
    FootPoints(trial.surface).find(map, mesh.vertices, displacement, across);
    const Eigen::ArrayXd squares = across.square().rowwise().sum();
    trial.at_vertices = {std::sqrt((share.array() * squares).sum() / (4 * pi)), std::sqrt(squares.maxCoeff())};
    trial.between = between(interpolant, map, trial.surface);
    trial.roughness = roughness(mesh, across);
    if (round > 0 && !(trial.between.rms < least_gain * best.between.rms)) break;
    best = std::move(trial);
    if (!move(mesh, displacement, map)) break;
  }
  return best;
}

AreaAndVolume measured(const Coefficients& coefficients) {
  Surface surface(std::clamp(2 * coefficients.degrees(), 8, Surface::largest_latitudes));
  VectorField x(surface.grid().size(), 3);
  SphericalHarmonics(coefficients.degrees(), surface.grid()).synthesis(coefficients, x);
  surface.update(x);
  return {surface.area(), surface.volume()};
}

/// NaN for a surface inside out.
double reduced(const AreaAndVolume& of) {
  return of.volume > 0 ? reduced_volume(of.area, of.volume) : NAN;
}

/// "area +1.2 %, volume -0.3 %, reduced volume 0.641 for 0.645"
std::string comparison(const AreaAndVolume& a, const AreaAndVolume& b) {
  std::ostringstream text;
  text.precision(2);
  text << std::showpos << "area " << 100 * (a.area / b.area - 1) << " %, volume " << 100 * (a.volume / b.volume - 1)
       << " %, reduced volume " << std::noshowpos;
  text.precision(4);
  text << reduced(a) << " for " << reduced(b);
  return text.str();
}

void check_shape(const MeshFit& fit) {
  constexpr double tolerance = 0.01;
  const auto differs = [&](double fitted, double smooth, double triangles, double more) {
    return !(std::abs(fitted / smooth - 1) <= tolerance + std::abs(smooth / triangles - 1) + more);
  };
  const double rough = fit.roughness / fit.triangles.area;
  const bool is_another = !(fit.fitted.volume > 0) ||
                          differs(fit.fitted.area, fit.smooth.area, fit.triangles.area, rough) ||
                          differs(fit.fitted.volume, fit.smooth.volume, fit.triangles.volume, 0) ||
                          differs(reduced(fit.fitted), reduced(fit.smooth), reduced(fit.triangles), 1.5 * rough) ||
                          !(fit.rms_between <= tolerance + fit.rms_sagitta);
  if (!is_another) return;
  std::ostringstream message;
  message.precision(2);
  message << "triangle mesh: the surface of " << fit.surface.degrees()
          << " degrees is another shape than the mesh: " << comparison(fit.fitted, fit.smooth) << ", "
          << 100 * fit.rms_between << " % of the radius off between the vertices (rms; " << 100 * fit.rms_distance
          << " % at them); take more degrees, or a mesh with more or more evenly spread vertices";
  throw std::domain_error(message.str());
}

void check_degrees(int degrees, Eigen::Index vertices) {
  check_argument(degrees >= 2, "degrees", degrees, ">= 2");
  if (vertices / 2 >= Eigen::Index{degrees} * degrees) return;
  std::ostringstream message;
  message << "degrees = " << degrees << ": the fit needs 2 degrees^2 = " << 2L * degrees * degrees
          << " vertices and the mesh has " << vertices << "; at most "
          << static_cast<int>(std::sqrt(static_cast<double>(vertices) / 2)) << " degrees";
  throw std::invalid_argument(message.str());
}

}  // namespace

int default_fit_degrees(Eigen::Index vertices, int latitudes) {
  constexpr int most = 32;
  const int determined = static_cast<int>(std::sqrt(static_cast<double>(vertices) / 2));
  return std::max(2, std::min({determined, latitudes - 1, most}));
}

MeshFit fit_mesh(const TriangleMesh& mesh, int degrees) {
  check_closed_genus_zero(mesh);
  check_degrees(degrees, mesh.vertices.rows());
  const Normalised unit = normalised(mesh);
  check_no_crossings(unit.mesh);
  const SmoothInterpolant interpolant(unit.mesh);
  VectorField map = sphere_map(unit.mesh);
  align(unit.mesh, map);

  MeshFit fit;
  fit.triangles = interpolant.triangles;
  fit.smooth = interpolant.smooth;
  fit.radius = std::cbrt(fit.triangles.volume * 3 / (4 * pi));
  const Trial trial = fit_in_turn(unit.mesh, interpolant, degrees, map);
  fit.surface = trial.surface;
  double sagittas = 0;
  for (const auto& edge : interpolant.edges) sagittas += edge.sagitta * edge.sagitta;
  fit.rms_distance = trial.at_vertices.rms / fit.radius;
  fit.max_distance = trial.at_vertices.max / fit.radius;
  fit.rms_between = trial.between.rms / fit.radius;
  fit.max_between = trial.between.max / fit.radius;
  fit.rms_sagitta = std::sqrt(sagittas / double(interpolant.edges.size())) / fit.radius;
  fit.roughness = trial.roughness;
  fit.fitted = measured(fit.surface);
  check_shape(fit);

  // Back to the place and the size of the mesh.
  const double size = unit.size;
  scale_degrees(fit.surface, [size](int) { return size; });
  for (int field = 0; field < 3; ++field) fit.surface(field, 0, 0) += unit.centre[field] * std::sqrt(4 * pi);
  fit.radius *= size;
  fit.roughness *= size * size;
  for (AreaAndVolume* of : {&fit.fitted, &fit.triangles, &fit.smooth}) {
    of->area *= size * size;
    of->volume *= size * size * size;
  }
  return fit;
}

std::string description(const MeshFit& fit) {
  std::ostringstream text;
  text.precision(2);
  text << "the surface of " << fit.surface.degrees() << " degrees misses the vertices by " << fit.rms_distance
       << " of the radius (rms), " << fit.max_distance << " at most, and a smooth surface through them by "
       << fit.rms_between << " between them (rms), " << fit.max_between
       << " at most; against the triangles: " << comparison(fit.fitted, fit.triangles)
       << "; against a smooth surface through the vertices: " << comparison(fit.fitted, fit.smooth);
  return text.str();
}

}  // namespace vesiflow::vesicle
