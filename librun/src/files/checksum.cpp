// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/checksum.h"

#include <xxhash.h>

#include <new>

namespace vesiflow::run {

void Checksum::Free::operator()(XXH3_state_s* state) const {
  XXH3_freeState(state);
}

// Beginning and adding fail only for states and bytes that are null.
Checksum::Checksum() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_64bits_reset(state_.get());
}

void Checksum::add_bytes(const void* bytes, std::size_t count) {
  if (count > 0) XXH3_64bits_update(state_.get(), bytes, count);
}

void Checksum::add(std::span<const double> values) {
  add(static_cast<std::int64_t>(values.size()));
  add_bytes(values.data(), values.size_bytes());
}

void Checksum::add(double value) {
  add_bytes(&value, sizeof value);
}

void Checksum::add(std::int64_t value) {
  add_bytes(&value, sizeof value);
}

void Checksum::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  add_bytes(text.data(), text.size());
}

std::int64_t Checksum::value() const {
  return static_cast<std::int64_t>(XXH3_64bits_digest(state_.get()));
}

}  // namespace vesiflow::run
