# SPDX-License-Identifier: Apache-2.0
# OpenImageIO::OpenImageIO. Debian's names an include directory that its package does not depend on.
find_package(OpenImageIO REQUIRED GLOBAL)
get_target_property(directories OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER directories EXCLUDE REGEX "opencv4")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${directories}")
