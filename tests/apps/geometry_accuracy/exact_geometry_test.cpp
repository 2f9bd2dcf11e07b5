// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "exact_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "known_surfaces.h"
#include "vesicle/support.h"

namespace {

using vesiflow::vesicle::SphereGrid;
using vesiflow::vesicle::Vector3;
using vesiflow::vesicle::VectorField;

constexpr long double pi = std::numbers::pi_v<long double>;

struct ReferencePoint {
  double theta, phi, mean, gaussian, laplacian, area_element;
};

// Independent values with 16 digits (two methods in multiple precision agree to more).
constexpr ReferencePoint ellipsoid_points[] = {
    {0.001, 0.0, 2.4999512509021717, 3.9998800027399444, -100.11073297167859, 0.002000014666602934},
    {0.001, 2.0, 2.499987216826211, 3.9999593752167906, -100.12202083131005, 0.0020000047447959724},
    {0.02, 5.5, 2.4892092173488587, 3.9712745256382456, -97.17336619650736, 0.04006946633507027},
    {0.15, 2.0, 2.246935606286364, 3.2266706456978733, -51.24333142338639, 0.3153681028250196},
    {0.4, 0.7, 0.8859330139720195, 0.6301468710953729, 12.021621961540164, 1.236234761175344},
    {0.8, 5.5, 0.4455058437101094, 0.12552275486287723, 2.242103853249037, 3.408781530474622},
    {1.2, 3.9, 0.305980743558435, 0.04830868381010717, 0.8215540171743696, 5.623061293568166},
    {1.9, 0.7, 0.27494152949792844, 0.040220332497538966, 0.6165105260929884, 5.9767137989169},
    {2.4, 2.0, 0.8866315122832349, 0.3635753281787748, 5.648277806318186, 2.46035668696574},
    {2.9, 3.9, 1.5208735356038539, 1.7005260513725788, 20.022932957210664, 0.5925839709981038},
    {3.12, 5.5, 2.4874313574207605, 3.96654800534869, -96.69161933006521, 0.04327270897891443},
    {3.1405, 0.7, 2.499963351895645, 3.999904301266145, -100.1147310589797, 0.002185319815638547},
};

constexpr ReferencePoint y32_points[] = {
    {0.001, 0.0, 0.4999842627182564, -2.0999771590430676, -4.699132405734852, 0.0040000058695005055},
    {0.001, 2.0, 0.50000251450195, -2.0999708214367883, -4.700128370884603, 0.004000026149673406},
    {0.02, 5.5, 0.49810948763811946, -2.0806037197392135, -4.576627493336518, 0.08014440135891202},
    {0.15, 2.0, 0.5361255768390583, -1.248087604530933, -4.59908486477663, 0.6877088515175402},
    {0.4, 0.7, 0.178426185353235, -0.22038712255495466, 0.025275448137290407, 2.108254707252217},
    {0.8, 5.5, 0.1754832639207818, 0.02147939215470033, -0.2332005465125257, 5.215964569043999},
    {1.2, 3.9, 0.2045987879066047, -0.26870097294003314, 0.17612694156779782, 5.028544523083039},
    {1.9, 0.7, 0.4524653866569938, -0.2117698165178934, -0.061875458325577656, 6.29298502319722},
    {2.4, 2.0, -0.23270505837953798, 0.02440614757864019, -0.2276169197918968, 2.0021074673747683},
    {2.9, 3.9, 0.3550986431732179, -0.6912160918974782, 0.14759526205222312, 1.187560090878614},
    {3.12, 5.5, 0.4978433368173993, -2.0773963398054307, -4.558914717294087, 0.08655338169996174},
    {3.1405, 0.7, 0.49999662844925913, -2.099963071544721, -4.699796852909263, 0.0043706407336213966},
};

// The values above are rounded to double, and so are theta and phi in the formulas: allow a few units in the last place of the
// largest value of each quantity.
void expect_reference(const char* name, std::span<const ReferencePoint> points, double largest_laplacian) {
  const auto surface = make_known_surface(name);
  for (const ReferencePoint& p : points) {
    const PointGeometry found = surface->at(p.theta, p.phi);
    EXPECT_NEAR(double(found.mean_curvature), p.mean, 1e-15) << name << " at " << p.theta << ", " << p.phi;
    EXPECT_NEAR(double(found.gaussian_curvature), p.gaussian, 2e-15) << name << " at " << p.theta << ", " << p.phi;
    EXPECT_NEAR(double(found.curvature_laplacian), p.laplacian, 4e-16 * largest_laplacian)
        << name << " at " << p.theta << ", " << p.phi;
    EXPECT_NEAR(double(found.area_per_solid_angle) * std::sin(p.theta), p.area_element, 4e-16 * p.area_element);
  }
}

TEST(ExactGeometry, EllipsoidAgreesWithIndependentValues) {
  expect_reference("ellipsoid", ellipsoid_points, 100.125);
}

TEST(ExactGeometry, Y32SurfaceAgreesWithIndependentValues) {
  expect_reference("y32", y32_points, 9.42);
}

// The formulas are smooth at the poles, where theta and phi are not.
TEST(ExactGeometry, PoleOfTheEllipsoid) {
  const PointGeometry pole = make_known_surface("ellipsoid")->at(0, 0.3L);
  EXPECT_NEAR(double(pole.mean_curvature), 2.5, 1e-15);
  EXPECT_NEAR(double(pole.gaussian_curvature), 4, 1e-15);
  EXPECT_NEAR(double(pole.curvature_laplacian), -100.125, 1e-13);
}

TEST(ExactGeometry, SphereIsExact) {
  const auto sphere = make_known_surface("sphere");
  for (const double theta : {1e-4, 0.3, 1.5, 3.1})
    for (const double phi : {0.0, 2.2, 5.9}) {
      const PointGeometry found = sphere->at(theta, phi);
      EXPECT_NEAR(double(found.mean_curvature), 1, 1e-17);
      EXPECT_NEAR(double(found.gaussian_curvature), 1, 1e-17);
      EXPECT_NEAR(double(found.curvature_laplacian), 0, 1e-17);
    }
}

// The closed form of an ellipsoid, by derivatives in space instead of parameters, at every node of a grid.
TEST(ExactGeometry, EllipsoidAgreesWithItsClosedFormAtAllNodes) {
  const SphereGrid nodes(24);
  const auto surface = make_known_surface("ellipsoid");
  const VectorField x = surface->sample(nodes);
  const Curvatures exact = surface->reference(nodes).values;
  for (Eigen::Index k = 0; k < nodes.size(); ++k) {
    const vesiflow::vesicle::testing::EllipsoidPoint point(Vector3(1, 2, 4), x.row(k).matrix().transpose());
    EXPECT_NEAR(exact.mean[k], point.mean_curvature, 1e-14);
    EXPECT_NEAR(exact.gaussian[k], point.gaussian_curvature, 1e-14);
    EXPECT_NEAR(exact.laplacian[k], point.laplacian, 1e-12);  // the closed form cancels, in double
  }
}

// int K dA = 4 pi and int Lap H dA = 0 on the surfaces of revolution, by Gauss-Legendre quadrature along one meridian.
TEST(ExactGeometry, IntegralIdentitiesOfSurfacesOfRevolution) {
  const SphereGrid nodes(96);
  for (const char* name : {"prolate", "oblate", "biconcave"}) {
    const auto surface = make_known_surface(name);
    long double total_curvature = 0, total_laplacian = 0, size = 0;
    for (int j = 0; j < nodes.latitudes(); ++j) {
      const PointGeometry p = surface->at(nodes.colatitude()[j], 0.9L);
      const long double area = p.area_per_solid_angle * nodes.weight()[j] * 2 * pi;
      total_curvature += p.gaussian_curvature * area;
      total_laplacian += p.curvature_laplacian * area;
      size += std::abs(p.curvature_laplacian) * area;
    }
    EXPECT_NEAR(double(total_curvature), double(4 * pi), 1e-13) << name;
    EXPECT_NEAR(double(total_laplacian), 0, 1e-13 * double(size)) << name;
  }
}

TEST(ExactGeometry, SizesOfSurfaces) {
  const SphereGrid grid(16);
  for (const char* name : {"prolate", "oblate"}) {
    vesiflow::vesicle::Surface surface(grid);
    surface.update(make_known_surface(name)->sample(grid));
    EXPECT_NEAR(surface.volume(), double(4 * pi / 3), 1e-13) << name;
  }
  const VectorField red_cell = make_known_surface("biconcave")->sample(SphereGrid(201));  // with a ring at the equator
  EXPECT_NEAR(red_cell.col(0).maxCoeff(), 1, 1e-14);
  EXPECT_NEAR(red_cell(0, 2), 0.207161 / 2, 1.5e-4);  // at sin(theta) = 0.012, so 2 sin^2 / 2 thicker than at the pole
}

// Lengths scale: H by 1/s, K by 1/s^2, Lap H by 1/s^3; and the patch may be turned and sheared in its parameters.
TEST(ExactGeometry, ScalingAndParametersOfThePatch) {
  const Jet<4> u = Jet<4>::u(), v = Jet<4>::v();
  const auto graph = [](const Jet<4>& x, const Jet<4>& y, long double scale) {
    const Jet<4> z = -0.5L * (x * x) - 1.5L * (y * y) + 0.2L * (x * x * y) - 0.7L * (x * x * x * x);
    return Point<Jet<4>>{scale * x, scale * y, scale * z};
  };
  const PointGeometry a = geometry_of_patch(graph(u, v, 1));
  const PointGeometry b = geometry_of_patch(graph(u, v, 2));
  const PointGeometry c = geometry_of_patch(graph(2 * u + 0.3L * v + 0.4L * (u * v), v - 0.5L * u - v * v * v, 1));
  EXPECT_NEAR(double(a.mean_curvature), 2, 1e-17);
  EXPECT_NEAR(double(a.gaussian_curvature), 3, 1e-17);
  EXPECT_NEAR(double(b.mean_curvature), 1, 1e-17);
  EXPECT_NEAR(double(b.gaussian_curvature), 0.75, 1e-17);
  EXPECT_NEAR(double(b.curvature_laplacian), double(a.curvature_laplacian) / 8, 1e-16);
  EXPECT_NEAR(double(c.mean_curvature), 2, 1e-17);
  EXPECT_NEAR(double(c.gaussian_curvature), 3, 1e-17);
  EXPECT_NEAR(double(c.curvature_laplacian), double(a.curvature_laplacian), 1e-15);
  EXPECT_GT(std::abs(double(a.curvature_laplacian)), 1);
}

}  // namespace
