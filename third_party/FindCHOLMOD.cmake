# FindCHOLMOD: the imported target SuiteSparse::CHOLMOD and CHOLMOD_VERSION.
# SuiteSparse >= 7 brings a CMake configuration, which is tried first. SuiteSparse 5 brings neither that nor a .pc
# file: then the header and the shared library are looked for. The static libcholmod.a of Debian is not position
# independent and cannot go into a Python module.
if(TARGET SuiteSparse::CHOLMOD)
  set(CHOLMOD_FOUND TRUE)
  return()
endif()

find_package(CHOLMOD QUIET CONFIG)
if(TARGET SuiteSparse::CHOLMOD)
  set(CHOLMOD_FOUND TRUE)
  return()
endif()

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY NAMES ${CMAKE_SHARED_LIBRARY_PREFIX}cholmod${CMAKE_SHARED_LIBRARY_SUFFIX} cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

# The version lies in cholmod_core.h (SuiteSparse 5) or cholmod.h (7).
set(CHOLMOD_VERSION "")
foreach(_header cholmod_core.h cholmod.h)
  if(NOT CHOLMOD_VERSION AND EXISTS "${CHOLMOD_INCLUDE_DIR}/${_header}")
    file(READ "${CHOLMOD_INCLUDE_DIR}/${_header}" _text)
    set(_numbers "")
    foreach(_part MAIN_VERSION SUB_VERSION SUBSUB_VERSION)
      if(_text MATCHES "#define CHOLMOD_${_part} +([0-9]+)")
        list(APPEND _numbers ${CMAKE_MATCH_1})
      endif()
    endforeach()
    list(JOIN _numbers "." CHOLMOD_VERSION)
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR VERSION_VAR CHOLMOD_VERSION)
if(CHOLMOD_FOUND)
  add_library(SuiteSparse::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(
    SuiteSparse::CHOLMOD PROPERTIES IMPORTED_LOCATION "${CHOLMOD_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES
                                                                           "${CHOLMOD_INCLUDE_DIR}")
endif()
