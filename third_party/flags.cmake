# Flags of the project's own targets. Nothing here reaches a project that links tissu::tissu.
include(CheckCXXCompilerFlag)

set(TISSU_ARCH_FLAG "")
if(TISSU_NATIVE)
  set(TISSU_ARCH_FLAG -march=native)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  check_cxx_compiler_flag(-march=x86-64-v2 TISSU_COMPILER_KNOWS_X86_64_V2)
  if(TISSU_COMPILER_KNOWS_X86_64_V2)
    set(TISSU_ARCH_FLAG -march=x86-64-v2)
  else()
    set(TISSU_ARCH_FLAG -msse4.2)
  endif()
endif()
message(STATUS "tissu: processor flag: ${TISSU_ARCH_FLAG}")

# tissu_own_target(TARGET): C++20, position independent, hidden symbols, baseline processor, warnings, sanitizers.
function(tissu_own_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(
    ${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                         VISIBILITY_INLINES_HIDDEN ON)
  # BEFORE: a flag given to one source file (a wider instruction set, say) comes later and wins.
  target_compile_options(${target} BEFORE PRIVATE ${TISSU_ARCH_FLAG} -Wall -Wextra -Wconversion)
  target_compile_definitions(${target} PRIVATE TISSU_VERSION="${PROJECT_VERSION}")
  if(TISSU_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      # Guesses of GCC's optimiser, wrong for std::sort on small arrays and for Eigen; they stay warnings.
      target_compile_options(
        ${target} PRIVATE -Wno-error=array-bounds -Wno-error=maybe-uninitialized -Wno-error=stringop-overflow)
    endif()
  endif()
  if(TISSU_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${TISSU_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${TISSU_SANITIZE})
  endif()
endfunction()
