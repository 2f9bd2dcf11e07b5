// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Plain pointers to the components of a vector field, for fused loops over markers: the compiler vectorises
/// these where expressions would take several passes over memory.
template <class Value, class Field>
struct BasicColumns {
  explicit BasicColumns(Field& field) : x(field.col(0).data()), y(field.col(1).data()), z(field.col(2).data()) {}
  Value* const x;
  Value* const y;
  Value* const z;
};

using Columns = BasicColumns<double, VectorField>;
using ConstColumns = BasicColumns<const double, const VectorField>;

}  // namespace vesiflow::vesicle
