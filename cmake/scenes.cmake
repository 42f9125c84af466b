# Carries the files scenes/NAME.toml of the calling folder inside the program: writes
# builtin_scenes.cpp into its build folder, which defines conebench::ENGINE::builtin_scenes().
function(conebench_embed_scenes engine)
  list(SORT ARGN)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/scenes/ OUTPUT_VARIABLE files)
  list(TRANSFORM files APPEND .toml)
  string(REPLACE ";" "|" list "${files}")
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_scenes.cmake)
  add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/builtin_scenes.cpp
    COMMAND ${CMAKE_COMMAND} -DENGINE=${engine} -DSCENES=${list}
      -DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/builtin_scenes.cpp -P ${script}
    DEPENDS ${files} ${script}
    VERBATIM)
endfunction()
