#include "vesicle/coefficients.h"

#include <algorithm>
#include <cassert>

#include "check.h"

namespace vesiflow::vesicle {

void Coefficients::resize(int degrees, int fields) {
  check_argument(degrees >= 1, "degrees", degrees, ">= 1");
  check_argument(fields >= 1, "fields", fields, ">= 1");
  degrees_ = degrees;
  fields_ = fields;
  data_.resize(std::size_t(degrees) * (degrees + 1) / 2 * fields);
}

void Coefficients::set_zero() {
  std::fill(data_.begin(), data_.end(), Complex{});
}

void Coefficients::truncate(int k) {
  for (int m = 0; m < degrees_; ++m)
    for (int n = std::max(m, k); n < degrees_; ++n)
      for (int field = 0; field < fields_; ++field) (*this)(field, n, m) = 0;
}

double Coefficients::energy(int first, int last) const {
  double sum = 0;
  for (int m = 0; m < std::min(last, degrees_); ++m)
    for (int n = std::max(m, first); n < std::min(last, degrees_); ++n)
      for (int field = 0; field < fields_; ++field) sum += (m == 0 ? 1 : 2) * std::norm((*this)(field, n, m));
  return sum;
}

std::size_t Coefficients::block_offset(int m, int parity) const {
  const std::size_t order_start = std::size_t(m) * degrees_ - std::size_t(m) * (m - 1) / 2;
  const std::size_t even_rows = (degrees_ - m + 1) / 2;
  return (order_start + (parity == 0 ? 0 : even_rows)) * fields_;
}

std::size_t Coefficients::position(int field, int n, int m) const {
  assert(0 <= field && field < fields_ && 0 <= m && m <= n && n < degrees_);
  return block_offset(m, (n - m) % 2) + std::size_t((n - m) / 2) * fields_ + field;
}

}  // namespace vesiflow::vesicle
