#pragma once

#include <string>

#include "coupling/scene.h"

namespace vesiflow::coupling {

/// A vesicle in shear flow small enough for a test: 24^3 cells of the size of the paper's N = 48, 16 latitudes.
inline Scene small_scene(const Overrides& overrides = {}) {
  return parse_scene(R"(
[domain]
lower = [-3, -3, -3]
upper = [3, 3, 3]
cells = 24
[membrane]
g = "25/6"
[mesh]
latitudes = 16
[time]
step = "1/96"
end = 0.5
[output]
diagnostics_every = 0.1
vesicle_every = 0.25
fluid_every = 0.25
checkpoint_every = 0.25
[[vesicles]]
shape = "prolate"
reduced_volume = 0.95
rotation_deg = 60
)",
                     "small scene", overrides);
}

}  // namespace vesiflow::coupling
