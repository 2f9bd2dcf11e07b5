// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The mark of the public symbols of libvesicle.
#pragma once

/// \def VESIFLOW_VESICLE_EXPORT
/// Marks what a program may use of libvesicle. A shared library is compiled with hidden visibility and shows only what
/// is marked.
#if defined(__GNUC__) && !defined(VESIFLOW_STATIC)
#define VESIFLOW_VESICLE_EXPORT __attribute__((visibility("default")))
#else
#define VESIFLOW_VESICLE_EXPORT
#endif
