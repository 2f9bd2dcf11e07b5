// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "coupling/mistakes.h"

namespace vesiflow::run {

/// Ends the gathering of what is wrong with a scene. Of what its file brings into the message only text is kept: no end of the message,
/// no commands to a terminal.
/// \param name of the file, said before each mistake; empty where mistakes have their places already
/// \throws SceneError with the mistake, or with all of them, one a line, unless there are none
void refuse_scene(const coupling::Mistakes& mistakes, const std::string& name = "");

}  // namespace vesiflow::run
