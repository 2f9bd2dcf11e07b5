// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of surface coefficients: each is refused by the errors that surface_file.h and shapes.h promise, or reads as a finite
// surface that writes and reads back to the same bits.
#include <stdexcept>

#include "check.h"
#include "input_file.h"
#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/surface_file.h"

namespace vesiflow::fuzz {
namespace {

bool same(const vesicle::Coefficients& a, const vesicle::Coefficients& b) {
  if (a.degrees() != b.degrees() || a.fields() != b.fields()) return false;
  for (int field = 0; field < a.fields(); ++field)
    for (int n = 0; n < a.degrees(); ++n)
      for (int m = 0; m <= n; ++m)
        if (a(field, n, m) != b(field, n, m)) return false;
  return true;
}

void read(const std::filesystem::path& path) {
  vesicle::Coefficients coefficients;
  try {
    coefficients = vesicle::read_surface_coefficients(path);
  } catch (const std::runtime_error&) {
    return;
  }
  constexpr int largest = 16;  // more only takes longer
  if (coefficients.degrees() > largest) coefficients.resample(vesicle::Coefficients(coefficients), largest);

  vesicle::write_surface_coefficients(path, coefficients);
  check(same(vesicle::read_surface_coefficients(path), coefficients), "coefficients read back to the same bits");
  try {
    const auto markers = vesicle::shape_from_coefficients(vesicle::SphereGrid(8), coefficients);
    check(markers.isFinite().all(), "markers of a surface are finite");
  } catch (const std::invalid_argument&) {
  } catch (const std::domain_error&) {
  }
}

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vesiflow::fuzz::InputFile file("surface.txt");
  file.write({data, size});
  vesiflow::fuzz::read(file.path());
  return 0;
}
