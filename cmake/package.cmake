# Debian packages, made in the build folder by `cpack -G DEB`: conebench, the program, and
# libconebench-dev, the libraries for programs of one's own. Configure without CONEBENCH_NATIVE.
set(CONEBENCH_MAINTAINER "conebench packager <root@localhost>" CACHE STRING
  "Who answers for the packages: Name <address>")

set(CPACK_PACKAGE_NAME conebench)
set(CPACK_PACKAGE_CONTACT "${CONEBENCH_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME conebench)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libconebench-dev, python3-h5py")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Two engines for granular matter, solvers for their contact
 problems, and campaigns that compare the solvers.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libconebench-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(development_packages libeigen3-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev libhdf5-dev
  libssl-dev libsqlitecpp-dev libsqlite3-dev zlib1g-dev libbullet-dev libnlopt-dev
  coinor-libipopt-dev libmumps-seq-dev pkg-config)
if(CONEBENCH_SUITESPARSE)
  list(APPEND development_packages libsuitesparse-dev)
endif()
if(TARGET conebench_siconos)
  list(APPEND development_packages libsiconos-numerics-dev)
endif()
list(JOIN development_packages ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries and headers of conebench for programs of
 one's own: problems and their files, solvers, both engines, results.")

if(CONEBENCH_SUITESPARSE)
  set(CONEBENCH_LICENCE_OF_BINARIES "These binaries use parts of SuiteSparse under the GNU General Public License (supernodal
 CHOLMOD, SPQR; GPL-2+), and Ipopt under the Common Public License, which the Free
 Software Foundation holds to be incompatible with it. Use them as you like; before you pass them
 on, build them with -DCONEBENCH_SUITESPARSE=OFF, which leaves the GPL parts out. The sources of
 conebench are under the Apache License 2.0 in either case.")
else()
  set(CONEBENCH_LICENCE_OF_BINARIES "These binaries were made without the parts of SuiteSparse that are under the GNU General Public
 License (-DCONEBENCH_SUITESPARSE=OFF).")
endif()
configure_file(cmake/copyright.in copyright @ONLY)
foreach(package conebench:program libconebench-dev:development)
  string(REPLACE ":" ";" package ${package})
  list(POP_FRONT package name component)
  install(FILES ${PROJECT_BINARY_DIR}/copyright COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name})
endforeach()

include(CPack)
