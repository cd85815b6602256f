#include "tissu/base/isa.h"

#include <array>
#include <cstdlib>
#include <string>

#include "compiled_sets.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr std::array kAll = {Isa::avx512, Isa::avx2, Isa::baseline};

}  // namespace

bool runs_here(Isa isa) {
#ifdef TISSU_HAS_AVX512
  if (isa == Isa::avx512) return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
#endif
#ifdef TISSU_HAS_AVX2
  if (isa == Isa::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  return isa == Isa::baseline;
}

std::string_view name(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return "avx512";
    case Isa::avx2:
      return "avx2";
    case Isa::baseline:
      break;
  }
  return "baseline";
}

Isa choose_isa() {
  const char* asked = std::getenv("TISSU_ISA");
  for (const Isa isa : kAll) {
    if (!runs_here(isa)) continue;
    if (asked == nullptr || *asked == '\0' || asked == name(isa)) return isa;
  }
  std::string here;
  for (const Isa isa : kAll) {
    if (runs_here(isa)) here += (here.empty() ? "" : ", ") + std::string(name(isa));
  }
  throw ParameterError("TISSU_ISA is \"" + std::string(asked) +
                       "\", which is not an instruction set that this machine and this build have; leave it "
                       "unset, or use one of: " +
                       here + ".");
}

}  // namespace tissu
