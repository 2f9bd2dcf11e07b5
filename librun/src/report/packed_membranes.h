// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "report/coefficient_packing.h"
#include "report/membrane_course.h"

namespace vesiflow::run {

/// The membranes of a run in few bytes.
struct PackedMembranes {
  std::vector<std::size_t> frames;                        ///< numbers of the frames of the course that are kept
  std::vector<std::vector<CoefficientPacking>> packings;  ///< of each vesicle, of each of membrane_fields
  std::vector<std::uint8_t> bytes;  ///< frame by frame, in it vesicle by vesicle, in it field by field
  std::array<double, membrane_fields.size()>
      error;  ///< that is allowed, root mean square over the sphere of the labels
};

/// In about so many bytes: as exact as they allow, between 1e-4 and 1e-3 of a vesicle's size in the positions and 0.2 % and 2 % of the range
/// in the fields. Where even that takes more room, frames are left out, evenly.
PackedMembranes pack_membranes(const MembraneCourse& course, std::size_t most_bytes);

}  // namespace vesiflow::run
