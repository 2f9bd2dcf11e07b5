# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Given as CMAKE_PROJECT_TOP_LEVEL_INCLUDES: find_package(Vesiflow) then builds the source tree inside the consumer.
include(FetchContent)
FetchContent_Declare(Vesiflow SOURCE_DIR ${VESIFLOW_SOURCE} OVERRIDE_FIND_PACKAGE)
