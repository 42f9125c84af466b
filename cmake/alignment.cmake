# Eigen aligns memory for the widest vectors that a translation unit is compiled for. A program that
# hands Eigen objects to our libraries must align them alike, whatever its own -march is: so a build
# that is not for one processor takes the widest alignment, and the installed targets tell theirs.
#
# Sets CONEBENCH_ALIGN_HEAP and CONEBENCH_ALIGN_STATIC [bytes].
set(CONEBENCH_ALIGN_HEAP 64)
set(CONEBENCH_ALIGN_STATIC 16)
if(NOT CONEBENCH_NATIVE)
  target_compile_definitions(conebench_build INTERFACE EIGEN_MAX_ALIGN_BYTES=64
    EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  return()
endif()

set(probe ${PROJECT_BINARY_DIR}/alignment.cpp)
file(WRITE ${probe} "#include <Eigen/Core>
heap EIGEN_DEFAULT_ALIGN_BYTES
static EIGEN_MAX_STATIC_ALIGN_BYTES
")
separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
get_target_property(options conebench_build INTERFACE_COMPILE_OPTIONS)
list(FILTER options INCLUDE REGEX "^-m")
get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${flags} ${options} -I${eigen} -E -P ${probe}
  OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
foreach(kind heap static)
  if(NOT text MATCHES "\n${kind} ([0-9]+)")
    message(FATAL_ERROR "Eigen does not say how it aligns its ${kind} memory")
  endif()
  string(TOUPPER ${kind} name)
  set(CONEBENCH_ALIGN_${name} ${CMAKE_MATCH_1})
endforeach()
