// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/coefficient_packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace vesiflow::run {
namespace {

constexpr double sphere = 4.0 * std::numbers::pi;

// Bytes for integers up to that multiple of the quantum.
char width_of(double multiple) {
  if (multiple < 0.5) return '0';
  if (multiple <= 127.0) return '1';
  return multiple <= 32767.0 ? '2' : '4';
}

void append_bytes(std::uint32_t value, int count, std::vector<std::uint8_t>& bytes) {
  for (int b = 0; b < count; ++b) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * b) & 255U));
}

// Calls visit(row, column, width) in the order of the packed bytes.
template <class Visit>
void visit_packed(const std::string& widths, int first, int components, Visit&& visit) {
  for (int c = first; c < first + components; ++c)
    for (int n = 0; n < static_cast<int>(widths.size()); ++n)
      for (int row = n * n; row < (n + 1) * (n + 1); ++row) visit(row, c, widths[static_cast<std::size_t>(n)] - '0');
}

}  // namespace

void CoefficientExtent::observe(const RealCoefficients& frame) {
  const auto degrees = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(frame.rows()))));
  if (largest_.size() < degrees) {
    largest_.resize(degrees, 0.0);
    tail_.resize(degrees + 1, 0.0);
  }
  double energy = 0.0;
  for (int n = static_cast<int>(degrees) - 1; n >= 0; --n) {
    const auto of_degree = frame.block(n * n, first_, 2 * n + 1, components_).cast<double>();
    const auto at = static_cast<std::size_t>(n);
    largest_[at] = std::max(largest_[at], of_degree.abs().maxCoeff());
    energy += of_degree.square().sum();
    tail_[at] = std::max(tail_[at], std::sqrt(energy / sphere));
  }
}

CoefficientPacking::CoefficientPacking(const CoefficientExtent& extent, double tolerance)
    : first_(extent.first()), components_(extent.components()) {
  int degrees = extent.degrees();
  while (degrees > 1 && extent.tail(degrees - 1) <= tolerance / std::numbers::sqrt2) --degrees;
  quantum_ = tolerance * std::sqrt(6.0 * sphere / components_) / degrees;
  for (int n = 0; n < degrees; ++n) widths_ += width_of(extent.largest(n) / quantum_);
}

std::size_t CoefficientPacking::bytes_per_frame() const {
  std::size_t bytes = 0;
  visit_packed(widths_, 0, components_, [&](int, int, int width) { bytes += static_cast<std::size_t>(width); });
  return bytes;
}

void CoefficientPacking::append(const RealCoefficients& frame, std::vector<std::uint8_t>& bytes) const {
  visit_packed(widths_, first_, components_, [&](int row, int column, int width) {
    const float value = row < frame.rows() ? frame(row, column) : 0.0F;
    if (width == 4)
      append_bytes(std::bit_cast<std::uint32_t>(value), 4, bytes);
    else
      append_bytes(static_cast<std::uint32_t>(std::lround(value / quantum_)), width, bytes);
  });
}

void CoefficientPacking::unpack(std::span<const std::uint8_t> bytes, RealCoefficients& frame) const {
  std::size_t at = 0;
  frame.middleCols(first_, components_).setZero();
  visit_packed(widths_, first_, components_, [&](int row, int column, int width) {
    std::uint32_t value = 0;
    for (int b = 0; b < width; ++b) value |= static_cast<std::uint32_t>(bytes[at++]) << (8 * b);
    if (width == 4)
      frame(row, column) = std::bit_cast<float>(value);
    else if (width == 2)
      frame(row, column) = static_cast<float>(quantum_ * static_cast<std::int16_t>(value));
    else if (width == 1)
      frame(row, column) = static_cast<float>(quantum_ * static_cast<std::int8_t>(value));
  });
}

}  // namespace vesiflow::run
