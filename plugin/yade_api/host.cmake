# SPDX-License-Identifier: GPL-2.0-or-later
# The YADE that the plugin is built for: its libraries, the Python and boost that they are linked with, and what decides the layout of its
# classes. All is read from the installed files, not concluded from a version number.
#
#   YADE_DIR   folder of libyade.so, of a package or of YADE built from source
set(YADE_DIR /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/yade-double CACHE PATH "Folder of libyade.so")
find_library(YADE_CORE_LIBRARY yade PATHS ${YADE_DIR} NO_DEFAULT_PATH NO_CACHE REQUIRED)
find_library(YADE_COMMON_LIBRARY pkg_common PATHS ${YADE_DIR} NO_DEFAULT_PATH NO_CACHE REQUIRED)

# Two boost.python in one process would crash it: the headers must be of the one that YADE needs.
file(STRINGS ${YADE_COMMON_LIBRARY} YADE_BOOST_PYTHON LIMIT_COUNT 1 REGEX "^libboost_python3[0-9]+[.]so")
if(NOT YADE_BOOST_PYTHON MATCHES "^libboost_python3([0-9]+)[.]so[.]([0-9]+[.][0-9]+)")
	message(FATAL_ERROR "${YADE_COMMON_LIBRARY} is not linked with boost.python: is ${YADE_DIR} the folder of a YADE?")
endif()
set(minor ${CMAKE_MATCH_1})
find_package(Boost ${CMAKE_MATCH_2} EXACT REQUIRED COMPONENTS python3${minor} serialization log thread)
set(Python3_FIND_STRATEGY VERSION)
set(Python3_FIND_VIRTUALENV STANDARD) # the system's, wherever PATH leads
set(Python3_EXECUTABLE /usr/bin/python3.${minor})
find_package(Python3 3.${minor} EXACT REQUIRED COMPONENTS Interpreter Development)
add_library(boost_python ALIAS Boost::python3${minor})

file(STRINGS ${YADE_DIR}/py/yade/config.py config REGEX "^(version|features)=")
string(REGEX MATCH "version='([^']*)'" matched "${config}")
set(YADE_VERSION ${CMAKE_MATCH_1})
string(REGEX MATCH "features='([^']*)'" matched "${config}")
string(REPLACE " " ";" features "${CMAKE_MATCH_1}")
if(NOT "OPENMP" IN_LIST features)
	message(FATAL_ERROR "YADE ${YADE_VERSION} in ${YADE_DIR} is built without OPENMP, which the plugin needs. It has: ${features}")
endif()
foreach(feature SPH DEFORM LIQMIGRATION MASK_ARBITRARY)
	if(${feature} IN_LIST features)
		message(FATAL_ERROR "YADE ${YADE_VERSION} in ${YADE_DIR} is built with ${feature}, which adds members to its classes that the plugin does not declare")
	endif()
endforeach()
set(yade_layout YADE_API_VERSION="${YADE_VERSION}")
foreach(feature MPI QT5 FEMLIKE)
	if(${feature} IN_LIST features)
		list(APPEND yade_layout YADE_API_${feature})
	endif()
endforeach()
file(STRINGS ${YADE_CORE_LIBRARY} has_volume LIMIT_COUNT 1 REGEX "^_ZN4yade5Shape9getVolumeEv$")
if(has_volume)
	list(APPEND yade_layout YADE_API_SHAPE_HAS_VOLUME)
endif()
message(STATUS "YADE in ${YADE_DIR}: ${yade_layout}")
