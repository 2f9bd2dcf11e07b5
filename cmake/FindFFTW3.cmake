# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# FFTW in double precision: target FFTW3::fftw3, and FFTW3::threads with what makes its planner safe for threads. (The package's
# own configuration file is not usable on Debian 12. Of an FFTW with combined threads say -DFFTW3_THREADS_LIBRARY=.../libfftw3.so.)
find_path(FFTW3_INCLUDE_DIR fftw3.h)
find_library(FFTW3_LIBRARY fftw3)
find_library(FFTW3_THREADS_LIBRARY NAMES fftw3_threads)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW3 REQUIRED_VARS FFTW3_LIBRARY FFTW3_THREADS_LIBRARY FFTW3_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install FFTW with its library for threads (Debian: libfftw3-dev)")
mark_as_advanced(FFTW3_INCLUDE_DIR FFTW3_LIBRARY FFTW3_THREADS_LIBRARY)
if(FFTW3_FOUND AND NOT TARGET FFTW3::fftw3)
  add_library(FFTW3::fftw3 UNKNOWN IMPORTED)
  set_target_properties(FFTW3::fftw3 PROPERTIES
    IMPORTED_LOCATION "${FFTW3_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${FFTW3_INCLUDE_DIR}")
  add_library(FFTW3::threads UNKNOWN IMPORTED)
  set_target_properties(FFTW3::threads PROPERTIES
    IMPORTED_LOCATION "${FFTW3_THREADS_LIBRARY}" INTERFACE_LINK_LIBRARIES FFTW3::fftw3)
endif()
