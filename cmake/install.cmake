# What `cmake --install` puts where, and find_package(conebench).
#
# Component `program`: what a user of the program needs, the header for solvers of one's own
# included. Component `development`: the libraries and their headers for programs of one's own.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(conebench_include ${CMAKE_INSTALL_INCLUDEDIR}/conebench)  # then "problems/problem.h" is found
set(conebench_package ${CMAKE_INSTALL_LIBDIR}/cmake/conebench)

install(TARGETS conebench COMPONENT program)
install(FILES harness/plugin_api.h DESTINATION ${conebench_include}/harness COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program)
install(DIRECTORY examples/export tests/out_of_tree_engine/pushed_blocks USE_SOURCE_PERMISSIONS
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT program)

# The manual and the completion are what the program says of itself.
find_program(GZIP gzip REQUIRED)
set(manual ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
add_custom_command(OUTPUT ${manual}/conebench.1.gz ${manual}/conebench.bash
  COMMAND conebench manual -o ${manual}/conebench.1
  COMMAND ${GZIP} -9nf ${manual}/conebench.1
  COMMAND conebench completion -o ${manual}/conebench.bash
  DEPENDS conebench
  VERBATIM)
add_custom_target(conebench_manual ALL DEPENDS ${manual}/conebench.1.gz ${manual}/conebench.bash)
# OPTIONAL: a build of the program alone has made neither.
install(FILES ${manual}/conebench.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program
  OPTIONAL)
install(FILES ${manual}/conebench.bash RENAME conebench COMPONENT program
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions OPTIONAL)

include(cmake/public_headers.cmake)

# A library as find_package() gives it: conebench::NAME, its headers under ${conebench_include}.
function(conebench_install_library name)
  set_target_properties(conebench_${name} PROPERTIES EXPORT_NAME ${name})
  target_sources(conebench_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}
    FILES ${conebench_${name}_headers})
  install(TARGETS conebench_${name} EXPORT conebenchTargets
    ARCHIVE COMPONENT development
    FILE_SET HEADERS DESTINATION ${conebench_include} COMPONENT development)
endfunction()
foreach(name problems solvers dem mpm results)
  conebench_install_library(${name})
endforeach()

# Libraries without a package file of their own are named as they were found here.
foreach(name suitesparse mumps bullet siconos)
  if(TARGET conebench_${name})
    set_target_properties(conebench_${name} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS conebench_${name} EXPORT conebenchTargets)
  endif()
endforeach()

target_compile_features(conebench_problems INTERFACE cxx_std_20)
target_compile_definitions(conebench_problems INTERFACE
  $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=${CONEBENCH_ALIGN_HEAP}>
  $<INSTALL_INTERFACE:EIGEN_MAX_STATIC_ALIGN_BYTES=${CONEBENCH_ALIGN_STATIC}>)

install(EXPORT conebenchTargets NAMESPACE conebench:: DESTINATION ${conebench_package}
  COMPONENT development)
configure_package_config_file(cmake/conebenchConfig.cmake.in conebenchConfig.cmake
  INSTALL_DESTINATION ${conebench_package})
write_basic_package_version_file(conebenchConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/conebenchConfig.cmake
  ${PROJECT_BINARY_DIR}/conebenchConfigVersion.cmake DESTINATION ${conebench_package}
  COMPONENT development)
