# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Included by VesiflowConfig.cmake: the targets of the components in Vesiflow_wanted, after what they link to.
foreach(component IN LISTS Vesiflow_wanted)
  include("${CMAKE_CURRENT_LIST_DIR}/Vesiflow_${component}_needs.cmake")
  foreach(need IN LISTS Vesiflow_${component}_needs)
    separate_arguments(need)
    find_dependency(${need})
  endforeach()
  include("${CMAKE_CURRENT_LIST_DIR}/Vesiflow_${component}.cmake")
  set(Vesiflow_${component}_FOUND TRUE)
endforeach()
