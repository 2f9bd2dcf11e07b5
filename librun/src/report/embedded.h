// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace vesiflow::run {

/// Files that the build has put into the library, cmake/VesiflowEmbed.cmake.

/// How the page looks, librun/src/report/page.css.
std::string embedded_style();
/// The viewer, viewer/dist/viewer.js; empty where the library was built without it.
std::string embedded_viewer();
/// Its SHA-256 in hexadecimal.
std::string embedded_viewer_sha256();

}  // namespace vesiflow::run
