// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vesiflow::coupling {

/// Of lists that are now longer and now shorter as a body moves and turns: with room to spare.
template <class List>
void reserve_with_room(List& list, std::size_t size) {
  if (list.capacity() < size) list.reserve(size + size / 2);
}
template <class List>
void resize_with_room(List& list, std::size_t size) {
  reserve_with_room(list, size);
  list.resize(size);
}

}  // namespace vesiflow::coupling
