#include "vesicle/curvature_laplacian.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle {
namespace {

using testing::EllipsoidPoint;

const Vector3 semi_axes(1, 2, 4);

double ellipsoid_error(int latitudes, LaplacianForm form) {
  Surface surface(latitudes);
  surface.update(ellipsoid(surface.grid(), semi_axes, {.effective_radius = 2}));
  ScalarField laplacian;
  CurvatureLaplacian(latitudes, form).evaluate(surface, laplacian);
  double error = 0;
  for (Eigen::Index k = 0; k < laplacian.size(); ++k) {
    const EllipsoidPoint exact(semi_axes, surface.positions().row(k).matrix().transpose());
    error = std::max(error, std::abs(laplacian[k] - exact.laplacian));
  }
  return error;
}

struct ReferencePoint {
  double theta, phi, mean_curvature, gaussian_curvature, laplacian;
};

/// The closed form of this test against values computed independently to 16 digits.
TEST(CurvatureLaplacian, ClosedFormOfTheEllipsoid) {
  constexpr ReferencePoint points[] = {
      {0.001, 0, 2.4999512509021717, 3.9998800027399444, -100.11073297167859},
      {0.15, 2, 2.2469356062863639, 3.2266706456978733, -51.243331423386387},
      {0.8, 5.5, 0.44550584371010937, 0.12552275486287723, 2.2421038532490369},
      {2.4, 2, 0.88663151228323489, 0.3635753281787748, 5.6482778063181858},
      {2.9, 3.9, 1.5208735356038539, 1.7005260513725788, 20.022932957210664},
  };
  for (const ReferencePoint& p : points) {
    const Vector3 x(std::sin(p.theta) * std::cos(p.phi), 2 * std::sin(p.theta) * std::sin(p.phi),
                    4 * std::cos(p.theta));
    const EllipsoidPoint exact(semi_axes, x);
    EXPECT_NEAR(exact.mean_curvature, p.mean_curvature, 1e-13);
    EXPECT_NEAR(exact.gaussian_curvature, p.gaussian_curvature, 1e-13);
    EXPECT_NEAR(exact.laplacian, p.laplacian, 1e-11);
  }
}

TEST(CurvatureLaplacian, CartesianFormIsSpectrallyAccurate) {
  EXPECT_LT(ellipsoid_error(32, LaplacianForm::cartesian), 1e-2);
  EXPECT_LT(ellipsoid_error(64, LaplacianForm::cartesian), 1e-7);
}

/// Table 1 of the paper: 4.16 and 0.230 (with upsampling).
TEST(CurvatureLaplacian, PaperFormReproducesTable1) {
  const double coarse = ellipsoid_error(32, LaplacianForm::paper);
  const double fine = ellipsoid_error(64, LaplacianForm::paper);
  EXPECT_GT(coarse, 4.16 / 2);
  EXPECT_LT(coarse, 4.16 * 2);
  EXPECT_GT(fine, 0.230 / 2);
  EXPECT_LT(fine, 0.230 * 2);
}

/// Zero on the sphere up to the round-off of four derivatives.
TEST(CurvatureLaplacian, VanishesOnTheSphere) {
  for (const LaplacianForm form : {LaplacianForm::cartesian, LaplacianForm::paper}) {
    Surface surface(32);
    surface.update(sphere(surface.grid()));
    ScalarField laplacian;
    CurvatureLaplacian(32, form).evaluate(surface, laplacian);
    EXPECT_LT(laplacian.abs().maxCoeff(), 1e-9);
  }
}

/// Reference values at points off the grid, reached by spectral evaluation.
TEST(CurvatureLaplacian, Y32SurfaceAtReferencePoints) {
  constexpr ReferencePoint points[] = {
      {0.001, 0, 0.49998426271825641, -2.0999771590430676, -4.6991324057348516},
      {0.15, 2, 0.53612557683905826, -1.248087604530933, -4.5990848647766303},
      {0.8, 5.5, 0.17548326392078181, 0.021479392154700329, -0.2332005465125257},
      {1.9, 0.7, 0.45246538665699382, -0.21176981651789339, -0.061875458325577656},
      {2.4, 2, -0.23270505837953798, 0.024406147578640191, -0.2276169197918968},
      {3.12, 5.5, 0.49784333681739928, -2.0773963398054307, -4.5589147172940869},
  };
  constexpr int latitudes = 112;
  Surface surface(latitudes);
  surface.update(testing::y32_surface(surface.grid()));
  ScalarField laplacian;
  CurvatureLaplacian(latitudes, LaplacianForm::cartesian).evaluate(surface, laplacian);
  Coefficients h, k, l;
  surface.harmonics().analysis(surface.mean_curvature(), h);
  surface.harmonics().analysis(surface.gaussian_curvature(), k);
  surface.harmonics().analysis(laplacian, l);
  for (const ReferencePoint& p : points) {
    EXPECT_NEAR(testing::point_value(h, p.theta, p.phi), p.mean_curvature, 1e-7);
    EXPECT_NEAR(testing::point_value(k, p.theta, p.phi), p.gaussian_curvature, 1e-6);
    EXPECT_NEAR(testing::point_value(l, p.theta, p.phi), p.laplacian, 1e-3);
  }
}

TEST(CurvatureLaplacian, RefusesAnotherMesh) {
  Surface surface(8);
  surface.update(sphere(surface.grid()));
  ScalarField laplacian;
  EXPECT_THROW(CurvatureLaplacian(9, LaplacianForm::cartesian).evaluate(surface, laplacian), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle
