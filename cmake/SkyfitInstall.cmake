# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: the program, its modules, one library per room, their headers, and a package for
# find_package(skyfit), whose targets are skyfit::model, skyfit::refs, skyfit::fit, skyfit::render and skyfit::plot.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/skyfit)

install(TARGETS skyfit_model skyfit_refs skyfit_fit skyfit_render_glsl skyfit_render skyfit_plot EXPORT skyfit_targets)
install(TARGETS skyfit COMPONENT program)
install(TARGETS skyfit_dem_module skyfit_image_module skyfit_netcdf_module skyfit_render_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/skyfit
  COMPONENT program)
install(EXPORT skyfit_targets NAMESPACE skyfit:: FILE skyfit_targets.cmake DESTINATION ${package_dir})

install(DIRECTORY model data_refs fit render DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skyfit
  FILES_MATCHING PATTERN "*.h" PATTERN "model/shared/*.glsl")
install(FILES ${PROJECT_BINARY_DIR}/generated/model/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skyfit/model)
install(DIRECTORY data_refs/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/skyfit COMPONENT program FILES_MATCHING PATTERN "*.json")
install(FILES data_refs/preset.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/skyfit COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
# The last for the licence in its first lines.
install(FILES LICENSE README.md CHANGELOG.md docs/preset.md model/literature/hosek_wilkie_2012_xyz.csv DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/skyfit_config.cmake.in
  ${PROJECT_BINARY_DIR}/generated/skyfit-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/skyfit-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/skyfit-config.cmake
  ${PROJECT_BINARY_DIR}/generated/skyfit-config-version.cmake DESTINATION ${package_dir})
