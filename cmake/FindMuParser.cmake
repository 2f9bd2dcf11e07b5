# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# muParser, expressions given as text: target MuParser::muparser.
find_path(MUPARSER_INCLUDE_DIR muParser.h)
find_library(MUPARSER_LIBRARY muparser)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuParser REQUIRED_VARS MUPARSER_LIBRARY MUPARSER_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install muParser (Debian: libmuparser-dev)")
mark_as_advanced(MUPARSER_INCLUDE_DIR MUPARSER_LIBRARY)
if(MuParser_FOUND AND NOT TARGET MuParser::muparser)
  add_library(MuParser::muparser UNKNOWN IMPORTED)
  set_target_properties(MuParser::muparser PROPERTIES
    IMPORTED_LOCATION "${MUPARSER_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${MUPARSER_INCLUDE_DIR}")
endif()
