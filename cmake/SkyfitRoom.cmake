# SPDX-License-Identifier: Apache-2.0
# A room of the house is one static library of the .cc files in its folder, and in those that FOLDERS names:
# skyfit_room(model LINK ...) makes skyfit::model.

add_library(skyfit_warnings INTERFACE)
target_compile_options(skyfit_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(SKYFIT_WERROR)
  target_compile_options(skyfit_warnings INTERFACE -Werror)
endif()

function(skyfit_room name)
  cmake_parse_arguments(ROOM "" "" "FOLDERS;LINK;PRIVATE_LINK" ${ARGN})
  set(patterns *.cc)
  foreach(folder IN LISTS ROOM_FOLDERS)
    list(APPEND patterns ${folder}/*.cc)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  add_library(skyfit_${name} STATIC ${sources})
  add_library(skyfit::${name} ALIAS skyfit_${name})
  set_target_properties(skyfit_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(skyfit_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/skyfit>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(skyfit_${name} PUBLIC cxx_std_20)
  target_link_libraries(skyfit_${name} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK}
    $<BUILD_INTERFACE:skyfit_warnings>)
endfunction()

# A module (model/base/module_file.h) of one source file: skyfit_module(render module.cc LIBRARIES...) makes
# skyfit_render_module.so beside the program.
function(skyfit_module name source)
  set(target skyfit_${name}_module)
  add_library(${target} MODULE ${source})
  set_target_properties(${target} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
    CXX_VISIBILITY_PRESET hidden)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
  target_link_libraries(${target} PRIVATE ${ARGN} skyfit_warnings)
  target_link_options(${target} PRIVATE LINKER:--no-undefined)
endfunction()
