// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Parts of symmetric boxes (domain.mirror) beside the whole.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/small_scene.h"

namespace vesiflow::coupling::mirrored {

inline void advance(SceneSimulation& simulation, long count) {
  for (long i = 0; i < count; ++i) simulation.step();
}

/// One side of the planes of the axes, which are in the middle of the box.
inline Scene side_of(Scene scene, const std::array<bool, 3>& mirror) {
  scene.domain.mirror = mirror;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (mirror[axis]) {
      scene.domain.lower[axis] = 0.0;
      scene.domain.cells[axis] /= 2;
    }
  return scene;
}

/// The greatest difference of velocities at the points of the part.
inline double difference(const fluid::FaceVector& whole, const fluid::FaceVector& part) {
  std::array<int, 3> shift{};
  for (int axis = 0; axis < 3; ++axis) shift[axis] = whole.grid().cells[axis] - part.grid().cells[axis];
  double worst = 0.0;
  for (int component = 0; component < 3; ++component) {
    const fluid::ConstView all = whole.points()[component], some = part.points()[component];
    for (int k = 0; k < some.extent[2]; ++k)
      for (int j = 0; j < some.extent[1]; ++j)
        for (int i = 0; i < some.extent[0]; ++i)
          worst = std::max(worst, std::abs(some(i, j, k) - all(i + shift[0], j + shift[1], k + shift[2])));
  }
  return worst;
}

/// Markers, and the velocity at the points of the part; both are of size 1.
inline void expect_same(SceneSimulation& whole, SceneSimulation& part, double tolerance) {
  for (std::size_t i = 0; i < part.vesicle_count(); ++i)
    EXPECT_LT((whole.membrane(i).positions() - part.membrane(i).positions()).abs().maxCoeff(), tolerance);
  EXPECT_LT(difference(whole.fluid().velocity(), part.fluid().velocity()), tolerance);
}

}  // namespace vesiflow::coupling::mirrored
