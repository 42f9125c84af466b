# Debian 12 packages; conebench.sh lists their names. Each becomes one target.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(SQLiteCpp REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(hdf5 REQUIRED IMPORTED_TARGET hdf5-serial)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
find_package(benchmark REQUIRED)
find_package(NLopt REQUIRED)
pkg_check_modules(ipopt REQUIRED IMPORTED_TARGET ipopt)

# MUMPS for one process; Ipopt brings it.
find_path(MUMPS_INCLUDE dmumps_c.h PATH_SUFFIXES mumps_seq REQUIRED)
find_library(MUMPS_LIBRARY dmumps_seq REQUIRED)
add_library(conebench_mumps INTERFACE)
target_include_directories(conebench_mumps SYSTEM INTERFACE ${MUMPS_INCLUDE})
target_link_libraries(conebench_mumps INTERFACE ${MUMPS_LIBRARY})

# Of Bullet the collision library alone, in doubles.
pkg_check_modules(bullet REQUIRED bullet-float64)
add_library(conebench_bullet INTERFACE)
target_include_directories(conebench_bullet SYSTEM INTERFACE ${bullet_INCLUDE_DIRS})
target_compile_options(conebench_bullet INTERFACE ${bullet_CFLAGS_OTHER})
foreach(name BulletCollision LinearMath)
  find_library(BULLET_${name} ${name}-float64 HINTS ${bullet_LIBRARY_DIRS} REQUIRED)
  target_link_libraries(conebench_bullet INTERFACE ${BULLET_${name}})
endforeach()

# The parts of SuiteSparse that are GPL: supernodal CHOLMOD, SPQR. Without them Eigen's own sparse
# factorisations serve.
add_library(conebench_suitesparse INTERFACE)
if(CONEBENCH_SUITESPARSE)
  find_path(SUITESPARSE_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  target_include_directories(conebench_suitesparse SYSTEM INTERFACE ${SUITESPARSE_INCLUDE})
  foreach(name cholmod spqr)
    find_library(SUITESPARSE_${name} ${name} REQUIRED)
    target_link_libraries(conebench_suitesparse INTERFACE ${SUITESPARSE_${name}})
  endforeach()
  target_compile_definitions(conebench_suitesparse INTERFACE CONEBENCH_SUITESPARSE)
endif()

# Siconos Numerics. Its own package file is of no use: it insists on the parts of Siconos that
# libsiconos-numerics-dev does not bring, and sets the C++ standard of whoever asks.
if(CONEBENCH_SICONOS)
  find_path(SICONOS_INCLUDE numerics/fc3d_Solvers.h PATH_SUFFIXES siconos)
  find_library(SICONOS_NUMERICS siconos_numerics)
  if(SICONOS_INCLUDE AND SICONOS_NUMERICS)
    add_library(conebench_siconos INTERFACE)
    target_include_directories(conebench_siconos SYSTEM INTERFACE ${SICONOS_INCLUDE}
      ${SICONOS_INCLUDE}/numerics)
    target_link_libraries(conebench_siconos INTERFACE ${SICONOS_NUMERICS})
    target_compile_definitions(conebench_siconos INTERFACE CONEBENCH_SICONOS)
  else()
    message(STATUS "Siconos Numerics not found: its solvers are left out")
  endif()
endif()
