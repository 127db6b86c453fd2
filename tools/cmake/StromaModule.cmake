# SPDX-License-Identifier: Apache-2.0
# stroma_add_module(NAME SOURCES file... [TESTABLE file...] [LINK target...])
#
# Builds a module: a shared library of components with a manifest <name>.plugin.json beside it, which
# names its components so that a scene can use them without listing plugins. SOURCES holds the one file
# with PLUGIN(...). TESTABLE files are also built as the static library stroma-NAME for unit tests.
#
# Both land in the build folder's lib/stroma; `stroma run --plugins` or STROMA_PLUGIN_PATH finds them there.
# Installing copies them into lib/stroma of the prefix: where that is Stroma's own, nothing needs to be set.
function(stroma_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;TESTABLE;LINK" ${ARGN})
  set(target stroma-module-${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  if(ARG_TESTABLE)
    add_library(stroma-${name} STATIC ${ARG_TESTABLE})
    target_link_libraries(stroma-${name} PUBLIC Stroma::core ${ARG_LINK})
    set_target_properties(stroma-${name} PROPERTIES CXX_VISIBILITY_PRESET hidden
                          VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${target} PRIVATE stroma-${name})
  endif()
  target_link_libraries(${target} PRIVATE Stroma::core ${ARG_LINK})
  if(TARGET stroma-warnings)
    target_link_libraries(${target} PRIVATE stroma-warnings)
    if(ARG_TESTABLE)
      target_link_libraries(stroma-${name} PRIVATE stroma-warnings)
    endif()
  endif()
  set(folder ${CMAKE_BINARY_DIR}/lib/stroma)
  set_target_properties(${target} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${folder}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    INSTALL_RPATH "$ORIGIN/..")
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND Stroma::stroma describe $<TARGET_FILE:${target}> --out ${folder}/${name}.plugin.json
    COMMENT "Manifest of module ${name}")
  # outside the project the program is installed: it needs no building
  get_target_property(installed Stroma::stroma IMPORTED)
  if(NOT installed)
    add_dependencies(${target} Stroma::stroma)
  endif()
  set_property(GLOBAL APPEND PROPERTY STROMA_MODULES ${target})
  install(TARGETS ${target} LIBRARY DESTINATION lib/stroma)
  install(FILES ${folder}/${name}.plugin.json DESTINATION lib/stroma)
endfunction()
