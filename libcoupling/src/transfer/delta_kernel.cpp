// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/delta_kernel.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "transfer/delta_functions.h"

namespace vesiflow::coupling {

DeltaKernel delta_kernel(std::string_view name) {
  const auto found = std::find(delta_kernel_names.begin(), delta_kernel_names.end(), name);
  if (found != delta_kernel_names.end()) return static_cast<DeltaKernel>(found - delta_kernel_names.begin());
  std::string message = "delta kernel \"" + std::string(name) + "\": must be one of";
  for (const std::string_view known : delta_kernel_names) message += " \"" + std::string(known) + '"';
  throw std::invalid_argument(message);
}

Interpolation interpolation(DeltaKernel kernel) {
  return with_functions_of(kernel, [](auto functions) {
    using Functions = decltype(functions);
    return std::is_same_v<typename Functions::Normal, typename Functions::Tangential>
               ? Interpolation::plain
               : Interpolation::divergence_preserving;
  });
}

int support_width(DeltaKernel kernel, Direction direction) {
  return with_function_of(kernel, direction, [](auto function) { return decltype(function)::width; });
}

double wall_clearance(DeltaKernel kernel) {
  const int faces = support_width(kernel, Direction::normal), centres = support_width(kernel, Direction::tangential);
  return 0.5 * (std::max(faces - 1, centres) - 1);  // faces lie on the wall, centres half a spacing off it
}

double delta(DeltaKernel kernel, double r, Direction direction) {
  return with_function_of(kernel, direction, [&](auto function) { return value_of<decltype(function)>(r); });
}

void delta_weights(DeltaKernel kernel, double t, std::span<double> weights, Direction direction) {
  with_function_of(kernel, direction, [&](auto function) {
    constexpr int width = decltype(function)::width;
    if (weights.size() != width)
      throw std::invalid_argument("delta_weights: room for " + std::to_string(weights.size()) + " weights; \"" +
                                  std::string(name(kernel)) + "\" has " + std::to_string(width));
    std::ranges::copy(function.weights(t), weights.begin());
  });
}

double thickening(DeltaKernel kernel) {
  switch (kernel) {
    case DeltaKernel::three_point:
      return 0.3116070201871157;
    case DeltaKernel::four_point:
      return 0.4136911152469348;
    case DeltaKernel::smoothed_four_point:
      return 0.3513514055480362;
    case DeltaKernel::six_point:
      return 0.4805975053861579;
    case DeltaKernel::composite_bspline_32:
      return 7.0 / 30.0;
    case DeltaKernel::composite_bspline_43:
      return 239.0 / 840.0;
    case DeltaKernel::composite_bspline_54:
      return 0.3278218694885362;
  }
  throw std::invalid_argument("delta kernel: not one of the enumeration");
}

}  // namespace vesiflow::coupling
