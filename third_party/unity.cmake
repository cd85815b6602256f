# Sources that are compiled together: a full build takes about half the time, a change of one source more.
option(TISSU_UNITY "Compile sources of one folder together: off for work on the core, and for the sanitizers" ON)

if(TISSU_UNITY)
  find_package(Python3 QUIET COMPONENTS Interpreter)
endif()

# tissu_compile_together(TARGET): call it last, when the sources have their properties. A source with flags of its own
# stays alone.
function(tissu_compile_together target)
  if(NOT TISSU_UNITY OR NOT Python3_Interpreter_FOUND)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(together "")
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    get_source_file_property(definitions ${source} TARGET_DIRECTORY ${target} COMPILE_DEFINITIONS)
    if(source MATCHES "\\.cpp$" AND NOT options AND NOT definitions)
      get_filename_component(path ${source} ABSOLUTE BASE_DIR ${folder})
      list(APPEND together ${path})
    endif()
  endforeach()
  # The names that a source defines decide with which others it goes.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${together})
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/third_party/unity_groups.py ${together}
                  OUTPUT_VARIABLE groups OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" groups "${groups}")
  foreach(line IN LISTS groups)
    string(REGEX MATCH "^([0-9]+) (.*)$" line "${line}")
    set_property(SOURCE ${CMAKE_MATCH_2} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${target}_${CMAKE_MATCH_1})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # It takes a private name of a source for one of a header, as the source is included.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()
