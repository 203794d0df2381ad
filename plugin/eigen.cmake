# SPDX-License-Identifier: GPL-2.0-or-later
# Eigen without m(indices), parts of a matrix at places that a vector names: at each m(i, j) of each kind of expression the compiler would find out anew
# that none of its forms is meant. The headers are copied, but for the file that declares these forms, which is empty: nothing is laid out differently,
# and the compiler makes the same of what does without them. Where code has such parts it finds "no match for call" of a matrix; a loop, or a map with
# strides, does as well. Eigen's unsupported headers stay where they are: include one of Eigen itself before.
get_target_property(eigen_headers Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
list(GET eigen_headers 0 eigen_headers)
set(indexed_views Eigen/src/plugins/IndexedViewMethods.h)
add_library(eigen INTERFACE)
if(Eigen3_VERSION VERSION_LESS 3.5 AND EXISTS ${eigen_headers}/${indexed_views}) # later ones may need it themselves
	set(eigen_copy ${PROJECT_BINARY_DIR}/eigen)
	file(COPY ${eigen_headers}/Eigen DESTINATION ${eigen_copy} PATTERN IndexedViewMethods.h EXCLUDE)
	file(CONFIGURE OUTPUT ${eigen_copy}/${indexed_views} CONTENT "// left out by plugin/eigen.cmake\n")
	set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${eigen_headers}/Eigen/src/Core/util/Macros.h) # where the version stands
	target_include_directories(eigen SYSTEM INTERFACE ${eigen_copy})
endif()
target_link_libraries(eigen INTERFACE Eigen3::Eigen)
