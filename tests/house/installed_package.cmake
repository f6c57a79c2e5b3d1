# SPDX-License-Identifier: Apache-2.0
# Installs the build to a prefix of its own, builds the consumer against it and runs it, and looks at what was installed.
# Arguments: BUILD_DIR, CONSUMER (its source), WORK_DIR (emptied), VERSION, CXX_FLAGS, COMPILER.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}\n${output}")
  endif()
  set(run_output "${output}" PARENT_SCOPE)
endfunction()

set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

run(${prefix}/bin/skyfit --version)
if(NOT run_output STREQUAL "skyfit ${VERSION}\n")
  message(FATAL_ERROR "the installed skyfit --version prints \"${run_output}\", expected \"skyfit ${VERSION}\"")
endif()

# The installed program finds the module that it renders with.
run(${prefix}/bin/skyfit render --preset earth-clear --size 32x18 --samples-per-side 1 --out ${WORK_DIR}/frame.exr)
if(NOT EXISTS ${WORK_DIR}/frame.exr)
  message(FATAL_ERROR "the installed skyfit render left no frame")
endif()

# And the one that it reads images with.
run(${prefix}/bin/skyfit check ${CONSUMER}/../../../data_refs/examples/fisheye.exr)

run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK_DIR}/build -G Ninja -D CMAKE_PREFIX_PATH=${prefix}
  -D CMAKE_CXX_FLAGS=${CXX_FLAGS} -D CMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
if(NOT run_output MATCHES "^earth-clear ${VERSION} [0-9.]+ cd/m\\^2\n$")
  message(FATAL_ERROR "the consumer prints \"${run_output}\"")
endif()

# The installed files name neither the source nor the build directory.
file(GLOB_RECURSE package ${prefix}/*.cmake)
foreach(file IN LISTS package)
  file(READ ${file} text)
  string(FIND "${text}" "${BUILD_DIR}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} names the build directory")
  endif()
endforeach()
file(REMOVE_RECURSE ${WORK_DIR})
