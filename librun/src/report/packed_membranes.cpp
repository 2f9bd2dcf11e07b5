// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/packed_membranes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/thinning.h"

namespace vesiflow::run {
namespace {

// At a tenth of a pixel of a vesicle of 500, and at half of one; of fields a step of the colours, and five.
constexpr double finest_position = 1e-4, finest_field = 2e-3;
constexpr std::array coarsenings = {1.0, 1.5, 2.2, 3.3, 5.0, 7.0, 10.0};

using Extents = std::vector<std::vector<CoefficientExtent>>;  // of each vesicle, of each field

Extents extents_of(const MembraneCourse& course) {
  Extents extents(course.latitudes.size());
  for (auto& fields : extents)
    for (const MembraneField& field : membrane_fields) fields.emplace_back(field.first, field.components);
  for (const MembraneCourse::Frame& frame : course.frames)
    for (std::size_t v = 0; v < extents.size(); ++v)
      for (CoefficientExtent& extent : extents[v]) extent.observe(frame.vesicles[v]);
  return extents;
}

// The size of the smallest vesicle: root mean square distance of its first shape from its middle.
double smallest_size(const MembraneCourse& course) {
  double size = std::numeric_limits<double>::max();
  for (const RealCoefficients& vesicle : course.frames.front().vesicles) {
    CoefficientExtent positions(0, 3);
    positions.observe(vesicle);
    size = std::min(size, positions.tail(1));
  }
  return size;
}

// A field that is the same everywhere has only round-off to be exact about.
double field_scale(const MembraneCourse& course, std::size_t f) {
  const MembraneCourse::Range& range = course.ranges[f];
  const double largest = std::max({std::abs(range.low), std::abs(range.high), range.high - range.low});
  return std::max({range.typical, 1e-3 * largest, 1e-12});
}

std::vector<std::vector<CoefficientPacking>> packings_of(const Extents& extents,
                                                         const std::array<double, membrane_fields.size()>& error) {
  std::vector<std::vector<CoefficientPacking>> packings(extents.size());
  for (std::size_t v = 0; v < extents.size(); ++v)
    for (std::size_t f = 0; f < membrane_fields.size(); ++f) packings[v].emplace_back(extents[v][f], error[f]);
  return packings;
}

std::size_t bytes_per_frame(const std::vector<std::vector<CoefficientPacking>>& packings) {
  std::size_t bytes = 0;
  for (const auto& fields : packings)
    for (const CoefficientPacking& packing : fields) bytes += packing.bytes_per_frame();
  return bytes;
}

}  // namespace

PackedMembranes pack_membranes(const MembraneCourse& course, std::size_t most_bytes) {
  PackedMembranes packed{};
  if (course.frames.empty() || course.latitudes.empty()) return packed;
  const Extents extents = extents_of(course);
  const double size = std::max(smallest_size(course), 1e-12);
  for (const double coarsening : coarsenings) {
    packed.error[0] = coarsening * finest_position * size;
    for (std::size_t f = 1; f < packed.error.size(); ++f)
      packed.error[f] = coarsening * finest_field * field_scale(course, f);
    packed.packings = packings_of(extents, packed.error);
    if (bytes_per_frame(packed.packings) * course.frames.size() <= most_bytes) break;
  }
  const std::size_t fit = most_bytes / std::max<std::size_t>(1, bytes_per_frame(packed.packings));
  packed.frames = evenly_chosen(course.frames.size(), std::max<std::size_t>(1, fit));
  for (const std::size_t i : packed.frames)
    for (std::size_t v = 0; v < packed.packings.size(); ++v)
      for (const CoefficientPacking& packing : packed.packings[v])
        packing.append(course.frames[i].vesicles[v], packed.bytes);
  return packed;
}

}  // namespace vesiflow::run
