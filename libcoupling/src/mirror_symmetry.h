#pragma once

#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Whether the markers (markers x 3) are, as a set, their own mirror image in the plane where the coordinate of the axis is
/// `plane`: each of them has another, or itself, within the tolerance of its image.
bool is_symmetric(const vesicle::VectorField& markers, int axis, double plane, double tolerance);

}  // namespace vesiflow::coupling
