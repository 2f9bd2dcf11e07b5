#pragma once

#include <string_view>

namespace vesiflow::coupling {

/// Text for people, on standard error. Where it cannot be written (closed, a full disk, nobody reads) it is lost, and that is all.
void say(std::string_view text) noexcept;

/// For programs, before anything is opened: standard streams that are closed (`2>&-`) become /dev/null, so that no file of
/// results gets their numbers and with them what is said.
void keep_standard_streams() noexcept;

}  // namespace vesiflow::coupling
