# Every outside library of the C++ core, in one place: which versions, which licence, which Debian package, and the
# pinned source that is fetched when the package is absent. `.ci/setup.sh` reads the DEBIAN lines of this file.
# The Python packages are in pyproject.toml.
#
# tissu_dependency(name ...) only records; the searches follow below, one per library.
include(FetchContent)
set(FETCHCONTENT_QUIET ON)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})

function(tissu_dependency name)
  cmake_parse_arguments(D "" "VERSIONS;LICENCE;DEBIAN;INSTALL;GIT;TAG" "WHY" ${ARGN})
  foreach(key VERSIONS LICENCE DEBIAN GIT TAG)
    set(TISSU_${name}_${key} "${D_${key}}" PARENT_SCOPE)
  endforeach()
endfunction()

# ---- the table -----------------------------------------------------------------------------------------------------
# INSTALL: does the set-up script install the Debian package: yes, no, or for the tests alone.
tissu_dependency(EIGEN
  VERSIONS ">= 3.4"  # the Python build requirement cmeel-eigen serves where there is neither a package nor a network
  LICENCE "MPL-2.0"
  DEBIAN "libeigen3-dev"
  INSTALL yes
  GIT https://gitlab.com/libeigen/eigen.git
  TAG 3147391d946bb4b6c68edd901f2add6ac1f31f8c  # 3.4.0
  WHY "small dense algebra; the only hard dependency, and the only one in public headers")
tissu_dependency(CHOLMOD
  VERSIONS "CHOLMOD >= 3.0 (SuiteSparse >= 5.8)"
  LICENCE "LGPL-2.1+, its modules Supernodal and Modify GPL-2+: a binary that bundles it is GPL as a whole"
  DEBIAN "libsuitesparse-dev"
  INSTALL yes
  WHY "direct solver, 4 to 26 times faster than Eigen's; no source is fetched: without it Eigen's SimplicialLLT serves.
       The shared library, because Debian's libcholmod.a is not position independent")
tissu_dependency(BLAS
  VERSIONS "any; OpenBLAS >= 0.3 for speed"
  LICENCE "BSD-3-Clause"
  DEBIAN "libopenblas-dev"
  INSTALL yes
  WHY "what CHOLMOD computes with; never called directly; run it on one thread (OPENBLAS_NUM_THREADS=1)")
tissu_dependency(FCL
  VERSIONS "0.7"
  LICENCE "BSD-3-Clause (its libccd too)"
  DEBIAN "libfcl-dev"
  INSTALL yes
  GIT https://github.com/flexible-collision-library/fcl.git
  TAG df2702ca5e703dec98ebd725782ce13862e87fc8  # 0.7.0
  WHY "a broad phase, and the oracle of the tests of contact, BVHModel<AABB> only: RSS and OBBRSS give wrong distances
       after a bottom-up refit. On where it is found; wheels go without, for it has 8 MB")
tissu_dependency(CCD
  VERSIONS ">= 2.1"
  LICENCE "BSD-3-Clause"
  DEBIAN "libccd-dev"
  INSTALL yes
  GIT https://github.com/danfis/libccd.git
  TAG 7931e764a19ef6b21b443376c699bbc9c6d4fba8  # the head after 2.1
  WHY "needed by FCL")
tissu_dependency(PYBIND11
  VERSIONS ">= 2.12"
  LICENCE "BSD-3-Clause"
  DEBIAN "none: Debian 12's is too old for numpy 2; a Python build requirement"
  INSTALL no
  GIT https://github.com/pybind/pybind11.git
  TAG a2e59f0e7065404b44dfe92a28aca47ba1378dc4  # 2.13.6
  WHY "the Python module")
tissu_dependency(GTEST
  VERSIONS ">= 1.11"
  LICENCE "BSD-3-Clause"
  DEBIAN "libgtest-dev"
  INSTALL yes
  GIT https://github.com/google/googletest.git
  TAG f8d7d77c06936315286eb55f8de22cd23c188571  # 1.14.0
  WHY "C++ tests")
tissu_dependency(BENCHMARK
  VERSIONS ">= 1.6"
  LICENCE "Apache-2.0"
  DEBIAN "libbenchmark-dev"
  INSTALL yes
  GIT https://github.com/google/benchmark.git
  TAG 344117638c8ff7e239044fd0fa7085839fc03021  # 1.8.3
  WHY "tissu-bench")

# ---- Eigen ---------------------------------------------------------------------------------------------------------
find_package(Eigen3 3.4 QUIET NO_MODULE)
if(NOT TARGET Eigen3::Eigen)
  # The build requirement from PyPI keeps its files under <site-packages>/cmeel.prefix.
  foreach(_prefix IN LISTS CMAKE_PREFIX_PATH)
    if(EXISTS "${_prefix}/cmeel.prefix")
      list(APPEND CMAKE_PREFIX_PATH "${_prefix}/cmeel.prefix")
    endif()
  endforeach()
  find_package(Eigen3 QUIET NO_MODULE)  # no version asked: Eigen 5's version file refuses "3.4", and serves as well
endif()
if(TARGET Eigen3::Eigen AND Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "tissu: Eigen ${Eigen3_VERSION} found in ${Eigen3_DIR}, ${TISSU_EIGEN_VERSIONS} needed; "
                      "install a newer one (Debian: ${TISSU_EIGEN_DEBIAN}) and set -DEigen3_DIR")
endif()
if(NOT TARGET Eigen3::Eigen)
  message(STATUS "tissu: no Eigen (Debian: ${TISSU_EIGEN_DEBIAN}); fetching ${TISSU_EIGEN_TAG}")
  # Headers only: SOURCE_SUBDIR names a folder that is not there, so Eigen's own build is left alone.
  FetchContent_Declare(eigen GIT_REPOSITORY ${TISSU_EIGEN_GIT} GIT_TAG ${TISSU_EIGEN_TAG} SOURCE_SUBDIR headers-only)
  FetchContent_MakeAvailable(eigen)
  add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
  target_include_directories(Eigen3::Eigen SYSTEM INTERFACE ${eigen_SOURCE_DIR})
  set(TISSU_FETCHED_EIGEN ${eigen_SOURCE_DIR})
  set(Eigen3_VERSION "fetched")
endif()
message(STATUS "tissu: Eigen ${Eigen3_VERSION}")

# A project that finds an installed tissu needs the Eigen it was built with.
function(tissu_install_fetched_eigen)
  if(TISSU_FETCHED_EIGEN)
    install(DIRECTORY ${TISSU_FETCHED_EIGEN}/Eigen DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tissu-eigen
            COMPONENT development)
  endif()
endfunction()

# ---- CHOLMOD -------------------------------------------------------------------------------------------------------
set(TISSU_HAVE_CHOLMOD OFF)
if(TISSU_WITH_CHOLMOD)
  find_package(CHOLMOD QUIET MODULE)
  if(TARGET SuiteSparse::CHOLMOD)
    set(TISSU_HAVE_CHOLMOD ON)
    message(STATUS "tissu: CHOLMOD ${CHOLMOD_VERSION}")
  else()
    message(STATUS "tissu: no CHOLMOD (Debian: ${TISSU_CHOLMOD_DEBIAN}): direct solves by Eigen's SimplicialLLT, slower")
  endif()
else()
  message(STATUS "tissu: CHOLMOD off: direct solves by Eigen's SimplicialLLT")
endif()

# ---- FCL -----------------------------------------------------------------------------------------------------------
set(TISSU_HAVE_FCL OFF)
find_package(fcl 0.7 QUIET CONFIG)  # never its .pc file, which forces C++11
set(fcl_is_there OFF)
if(TARGET fcl)
  set(fcl_is_there ON)
endif()
option(TISSU_WITH_FCL "The broad phase of FCL; on where FCL is found; off: it is refused by name" ${fcl_is_there})
if(TISSU_WITH_FCL)
  if(NOT TARGET fcl)
    if(CMAKE_VERSION VERSION_LESS 3.24)
      message(FATAL_ERROR "tissu: no FCL 0.7 (Debian: ${TISSU_FCL_DEBIAN}), and fetching it needs CMake >= 3.24; "
                          "install the package or configure with -DTISSU_WITH_FCL=OFF")
    endif()
    message(STATUS "tissu: no FCL (Debian: ${TISSU_FCL_DEBIAN}); fetching ${TISSU_FCL_TAG}")
    include(${CMAKE_CURRENT_LIST_DIR}/fetch_fcl.cmake)
  endif()
  set(TISSU_HAVE_FCL ON)
  message(STATUS "tissu: FCL ${fcl_VERSION}")
endif()

find_package(Threads REQUIRED)

# ---- only for the Python module, the tests, the benchmarks -----------------------------------------------------------
if(SKBUILD)
  find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.12 QUIET CONFIG)
  if(NOT pybind11_FOUND)
    find_package(pybind11 QUIET CONFIG)
    if(pybind11_FOUND AND pybind11_VERSION VERSION_LESS 2.12)
      message(FATAL_ERROR "tissu: pybind11 ${pybind11_VERSION} found, ${TISSU_PYBIND11_VERSIONS} needed")
    endif()
  endif()
  if(NOT pybind11_FOUND)
    message(STATUS "tissu: no pybind11; fetching ${TISSU_PYBIND11_TAG}")
    FetchContent_Declare(pybind11 GIT_REPOSITORY ${TISSU_PYBIND11_GIT} GIT_TAG ${TISSU_PYBIND11_TAG})
    FetchContent_MakeAvailable(pybind11)
  endif()
endif()

# FCL for the tests, where its package is there: they compare with it, also where the library goes without.
set(TISSU_TEST_FCL OFF)
if(TISSU_BUILD_TESTS)
  if(TARGET fcl)
    set(TISSU_TEST_FCL ON)
  else()
    message(STATUS "tissu: no FCL (Debian: ${TISSU_FCL_DEBIAN}): contact is tested without its answers")
  endif()
  find_package(GTest 1.11 QUIET CONFIG)
  if(NOT TARGET GTest::gtest_main)
    message(STATUS "tissu: no GoogleTest (Debian: ${TISSU_GTEST_DEBIAN}); fetching ${TISSU_GTEST_TAG}")
    set(INSTALL_GTEST OFF)
    set(BUILD_GMOCK OFF)
    FetchContent_Declare(googletest GIT_REPOSITORY ${TISSU_GTEST_GIT} GIT_TAG ${TISSU_GTEST_TAG})
    FetchContent_MakeAvailable(googletest)
  endif()
endif()

if(TISSU_BUILD_BENCH)
  find_package(benchmark 1.6 QUIET CONFIG)
  if(NOT TARGET benchmark::benchmark)
    message(STATUS "tissu: no Google Benchmark (Debian: ${TISSU_BENCHMARK_DEBIAN}); fetching ${TISSU_BENCHMARK_TAG}")
    set(BENCHMARK_ENABLE_TESTING OFF)
    set(BENCHMARK_ENABLE_GTEST_TESTS OFF)
    set(BENCHMARK_ENABLE_INSTALL OFF)
    set(BENCHMARK_ENABLE_WERROR OFF)
    FetchContent_Declare(benchmark GIT_REPOSITORY ${TISSU_BENCHMARK_GIT} GIT_TAG ${TISSU_BENCHMARK_TAG})
    FetchContent_MakeAvailable(benchmark)
  endif()
endif()

# ---- what the core links -------------------------------------------------------------------------------------------
# Eigen is public. The others are private, so that neither their headers nor their definitions leave the library.
function(tissu_link_eigen target)
  # 16 whatever the instruction set: otherwise objects compiled for AVX and Debian's libfcl (or a user's program)
  # disagree about the size and alignment of Eigen's fixed-size types.
  target_compile_definitions(${target} PUBLIC EIGEN_MAX_ALIGN_BYTES=16)
  target_link_libraries(${target} PUBLIC Eigen3::Eigen)
endfunction()

function(tissu_link_dependencies target)
  tissu_link_eigen(${target})
  target_link_libraries(${target} PRIVATE Threads::Threads)
  if(TISSU_HAVE_CHOLMOD)
    target_link_libraries(${target} PRIVATE SuiteSparse::CHOLMOD)
    target_compile_definitions(${target} PRIVATE TISSU_HAVE_CHOLMOD TISSU_CHOLMOD_VERSION="${CHOLMOD_VERSION}")
  endif()
  if(TISSU_HAVE_FCL)
    target_link_libraries(${target} PRIVATE fcl)
    target_compile_definitions(${target} PRIVATE TISSU_HAVE_FCL TISSU_FCL_VERSION="${fcl_VERSION}")
  endif()
endfunction()
