# SPDX-License-Identifier: Apache-2.0
# Compiles through ccache where there is one and nothing else was chosen. Paths below the checkout are cached relative
# to it, so that two checkouts share what either has compiled.

find_program(SKYFIT_CCACHE ccache)
mark_as_advanced(SKYFIT_CCACHE)
if(SKYFIT_CCACHE AND PROJECT_IS_TOP_LEVEL)
  foreach(language C CXX)
    if(NOT DEFINED CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${SKYFIT_CCACHE})
    endif()
  endforeach()
endif()
