# Flags of the project's own targets. Nothing here reaches a project that links tissu::tissu.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceRuns)

# ---- a compiler cache, where there is one and the builder named none
option(TISSU_CCACHE "Compile through ccache where it is installed" ON)
if(TISSU_CCACHE AND TISSU_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  if(TISSU_CCACHE_PROGRAM AND NOT EXISTS "${TISSU_CCACHE_PROGRAM}")
    unset(TISSU_CCACHE_PROGRAM CACHE)  # it was removed since the last configuration
  endif()
  find_program(TISSU_CCACHE_PROGRAM ccache)
  mark_as_advanced(TISSU_CCACHE_PROGRAM)
  if(TISSU_CCACHE_PROGRAM)
    # What ccache has to be lenient about before it stores what a precompiled header goes into.
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
        ${TISSU_CCACHE_PROGRAM})
    message(STATUS "tissu: compiler cache: ${TISSU_CCACHE_PROGRAM}")
  endif()
endif()

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
      # Guesses of GCC's optimiser, wrong for std::sort on small arrays, for Eigen and for "text" + std::string
      # (GCC's bug 105651); they stay warnings.
      target_compile_options(${target} PRIVATE -Wno-error=array-bounds -Wno-error=maybe-uninitialized
                                               -Wno-error=stringop-overflow -Wno-error=restrict)
    endif()
  endif()
  if(TISSU_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${TISSU_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${TISSU_SANITIZE})
  endif()
endfunction()

# tissu_precompile(TARGET HEADERS...): reads the headers once for all sources of the target. For outside headers, which
# do not change; every source still includes what it needs, as clang-tidy, which does without, checks.
function(tissu_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # or ccache cannot see what the header holds
  endif()
endfunction()

# ---- sources that are compiled once for each instruction set, in a namespace of its name (TISSU_KERNELS)
set(TISSU_KERNEL_FLAGS -O3)
if(TISSU_SANITIZE)
  set(TISSU_KERNEL_FLAGS -O1)  # -O3 with checks takes very long to compile
endif()
list(APPEND TISSU_KERNEL_FLAGS -fno-math-errno -fno-trapping-math -ffp-contract=fast)
# GCC takes the undefined upper halves of its own AVX-512 casts for a mistake.
set(TISSU_QUIET -Wno-maybe-uninitialized -Wno-uninitialized)
set(TISSU_FLAGS_baseline ${TISSU_QUIET} -Wno-psabi)
set(TISSU_FLAGS_avx2 -mavx2 -mfma)
set(TISSU_FLAGS_avx512 ${TISSU_QUIET} -mavx512f -mavx512vl -mavx512dq -mfma)

# tissu_best_isa(VARIABLE): the widest set that runs on this machine, by the question that choose_isa() asks.
function(tissu_best_isa variable)
  set(best baseline)
  check_cxx_source_runs("int main() { return !(__builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\")); }"
                        TISSU_RUNS_AVX2)
  check_cxx_source_runs(
    "int main() { return !(__builtin_cpu_supports(\"avx512f\") && __builtin_cpu_supports(\"avx512vl\")); }"
    TISSU_RUNS_AVX512)
  if(TISSU_RUNS_AVX512)
    set(best avx512)
  elseif(TISSU_RUNS_AVX2)
    set(best avx2)
  endif()
  set(${variable} ${best} PARENT_SCOPE)
endfunction()

# TISSU_KERNEL_ISAS: the sets that TISSU_ISAS asks for; the baseline is always among them.
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(TISSU_KERNEL_ISAS baseline)
elseif(TISSU_ISAS STREQUAL "all")
  set(TISSU_KERNEL_ISAS baseline avx2 avx512)
elseif(TISSU_ISAS STREQUAL "native")
  tissu_best_isa(best)
  set(TISSU_KERNEL_ISAS baseline ${best})
else()
  set(TISSU_KERNEL_ISAS baseline ${TISSU_ISAS})
endif()
list(REMOVE_DUPLICATES TISSU_KERNEL_ISAS)
set(TISSU_KERNEL_DEFINES "")
foreach(isa IN LISTS TISSU_KERNEL_ISAS)
  if(NOT DEFINED TISSU_FLAGS_${isa})
    message(FATAL_ERROR "tissu: TISSU_ISAS is \"${TISSU_ISAS}\"; all, native, or a list of baseline, avx2 and avx512 "
                        "is accepted.")
  endif()
  string(TOUPPER ${isa} upper)
  string(APPEND TISSU_KERNEL_DEFINES "#define TISSU_HAS_${upper}\n")
endforeach()
# A header and no definitions on every command: another choice of sets compiles again what chooses among them, not all.
# Written only where it changed.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/compiled_sets.h
     CONTENT "#pragma once\n\n/// The instruction sets that this build has kernels for.\n${TISSU_KERNEL_DEFINES}")
message(STATUS "tissu: kernels for ${TISSU_KERNEL_ISAS}")

# tissu_for_each_isa(TARGET NAME SOURCES...): adds the sources to TARGET once for each set, as tissu_NAME_<set>.
function(tissu_for_each_isa target name)
  foreach(isa IN LISTS TISSU_KERNEL_ISAS)
    add_library(tissu_${name}_${isa} OBJECT ${ARGN})
    tissu_own_target(tissu_${name}_${isa})
    target_compile_definitions(tissu_${name}_${isa} PRIVATE TISSU_KERNELS=${isa})
    target_compile_options(tissu_${name}_${isa} PRIVATE ${TISSU_KERNEL_FLAGS} ${TISSU_FLAGS_${isa}})
    target_include_directories(
      tissu_${name}_${isa} PRIVATE ${PROJECT_SOURCE_DIR}/cpp/include ${PROJECT_SOURCE_DIR}/cpp/src)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:tissu_${name}_${isa}>)
  endforeach()
endfunction()
