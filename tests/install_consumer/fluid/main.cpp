// Flow of one's own in a box: a cube whose lid moves.
#include <cstdio>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"

int main() {
  using namespace vesiflow::fluid;
  const Grid grid({0, 0, 0}, {1, 1, 1}, {24, 24, 24});
  const auto lid = [](const Vector3& position, double) { return Vector3{position[2] == 1.0 ? 1.0 : 0.0, 0.0, 0.0}; };
  NavierStokes flow(grid, {.reynolds_number = 100}, lid);
  for (int step = 0; step < 100; ++step) flow.step(0.02);

  std::printf("     z    u on the axis at t = %g\n", flow.time());
  for (int k = 0; k < grid.cells[2]; k += 3) {
    const Field<FaceX>& u = flow.velocity().x;
    std::printf("%6.3f  %9.5f\n", u.position(12, 12, k)[2], u(12, 12, k));
  }
  const double divergence = max_divergence(flow.velocity());
  std::printf("largest divergence %.1e\n", divergence);
  return divergence < 1e-11 ? 0 : 1;
}
