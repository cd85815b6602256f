#include "tissu/base/build.h"

#include <Eigen/Core>

#include "compiled_sets.h"

namespace tissu {

BuildInfo build_info() {
  BuildInfo info;
  info.version = TISSU_VERSION;
#if defined(__clang__)
  info.compiler = "Clang " + std::string(__clang_version__);
#else
  info.compiler = "GCC " + std::string(__VERSION__);
#endif
  const auto number = [](int n) { return std::to_string(n); };
  info.libraries.emplace_back("Eigen", number(EIGEN_WORLD_VERSION) + "." + number(EIGEN_MAJOR_VERSION) + "." +
                                           number(EIGEN_MINOR_VERSION));
#ifdef TISSU_CHOLMOD_VERSION
  info.libraries.emplace_back("CHOLMOD", TISSU_CHOLMOD_VERSION);
#endif
#ifdef TISSU_FCL_VERSION
  info.libraries.emplace_back("FCL", TISSU_FCL_VERSION);
#endif
  return info;
}

std::string_view kernel_flags(Isa isa) {
#ifdef TISSU_HAS_AVX512
  if (isa == Isa::avx512) return TISSU_FLAGS_AVX512;
#endif
#ifdef TISSU_HAS_AVX2
  if (isa == Isa::avx2) return TISSU_FLAGS_AVX2;
#endif
  (void)isa;
  return TISSU_FLAGS_BASELINE;
}

}  // namespace tissu
