# SPDX-License-Identifier: Apache-2.0
# Compiles through ccache where there is one and nothing else was chosen.

find_program(SKYFIT_CCACHE ccache)
mark_as_advanced(SKYFIT_CCACHE)
if(SKYFIT_CCACHE AND PROJECT_IS_TOP_LEVEL)
  foreach(language C CXX)
    if(NOT DEFINED CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER ${SKYFIT_CCACHE})
    endif()
  endforeach()
endif()
