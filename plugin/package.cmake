# SPDX-License-Identifier: GPL-2.0-or-later
# cpack makes a package for the release of Debian that it runs on, and a second one of what needs PETSc, if that was built. It needs the packages dpkg-dev and file.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME plugin)
string(REGEX REPLACE "/lib/.*" "" yade_prefix ${YADE_DIR})
file(RELATIVE_PATH yade_folder ${yade_prefix} ${YADE_DIR})
install(TARGETS pkg_mpm LIBRARY DESTINATION ${yade_folder})
install(TARGETS mpm_guard mpm_engine LIBRARY DESTINATION ${yade_folder}/mpm)
if(TARGET mpm_petsc)
	install(TARGETS mpm_petsc LIBRARY DESTINATION ${yade_folder}/mpm COMPONENT petsc)
endif()
install(DIRECTORY python/mpm DESTINATION ${yade_folder}/py/yade FILES_MATCHING PATTERN *.py PATTERN page.*)
configure_file(docs/yade-mpm.7 yade-mpm.7 @ONLY)
add_custom_command(
	OUTPUT yade-mpm.7.gz COMMAND gzip -9n --keep --force yade-mpm.7 DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/yade-mpm.7 VERBATIM
)
add_custom_target(page ALL DEPENDS yade-mpm.7.gz)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/yade-mpm.7.gz DESTINATION share/man/man7)
install(FILES docs/changes.md DESTINATION share/doc/yade-mpm)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/yade-mpm RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME yade-mpm)
set(CPACK_PACKAGE_CONTACT "the authors of the material point plugin <yade-mpm@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "implicit material point method for YADE")
set(CPACK_PACKAGE_DESCRIPTION "Soil at large deformations in the particle code YADE: the generalised interpolation material point method,
implicit and with ghost stabilisation, as engines of YADE's scenes and a Python module.")
set(CPACK_PACKAGING_INSTALL_PREFIX ${yade_prefix})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_NAME yade-mpm)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS "yade (>= ${YADE_VERSION}), python3-numpy, python3-matplotlib, libopenblas0")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_RECOMMENDS python3-scipy) # for mpm.calibrate
set(CPACK_DEBIAN_PETSC_PACKAGE_NAME yade-mpm-petsc)
set(CPACK_COMPONENT_PLUGIN_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_COMPONENT_PETSC_DESCRIPTION "Of the material point plugin of YADE what needs PETSc and MPI: algebraic multigrid, and load steps that several processes share.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${YADE_DIR})
# what Python has compiled is no file of the package
file(CONFIGURE OUTPUT prerm CONTENT "#!/bin/sh\nset -e\nfind @YADE_DIR@/py/yade/mpm -name __pycache__ -prune -exec rm -r {} +\n" @ONLY)
file(CHMOD ${CMAKE_CURRENT_BINARY_DIR}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/prerm)
# not for another release, whose libraries have other names
file(STRINGS /etc/os-release release REGEX "^VERSION_CODENAME=")
string(REGEX REPLACE ".*=" "" release "${release}")
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~${release}")
set(CPACK_DEBIAN_PETSC_PACKAGE_DEPENDS "yade-mpm (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), openmpi-bin, python3-mpi4py")
include(CPack)
