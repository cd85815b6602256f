#pragma once

/// What is compiled once for each instruction set, in a namespace of the set's name, and chosen at run time.

#include <cstddef>

#include "tissu/base/isa.h"

namespace tissu {

/// The kernels of one kind that a set has. A plain pair: a function of std::span compiled for a wider set
/// could be the one that the linker keeps for all.
template <class Kernels>
struct KernelList {
  const Kernels* first;
  std::size_t count;
};

/// The first kernels of a list with a property; null when there are none.
template <class Kernels, class Property>
const Kernels* find_kernels(KernelList<Kernels> list, const Property& has) {
  for (std::size_t i = 0; i < list.count; ++i) {
    if (has(list.first[i])) return list.first + i;
  }
  return nullptr;
}

}  // namespace tissu

/// The same declarations in the namespace of every set.
#define TISSU_DECLARE_KERNELS(...) \
  namespace tissu {                \
  namespace baseline {             \
  __VA_ARGS__                      \
  }                                \
  namespace avx2 {                 \
  __VA_ARGS__                      \
  }                                \
  namespace avx512 {               \
  __VA_ARGS__                      \
  }                                \
  }

#ifdef TISSU_HAS_AVX2
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name behind :: stands without them
#define TISSU_UNLESS_AVX2(isa, name, other) ((isa) == Isa::avx2 ? avx2::name : other)
#else
#define TISSU_UNLESS_AVX2(isa, name, other) other
#endif
#ifdef TISSU_HAS_AVX512
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name behind :: stands without them
#define TISSU_UNLESS_AVX512(isa, name, other) ((isa) == Isa::avx512 ? avx512::name : other)
#else
#define TISSU_UNLESS_AVX512(isa, name, other) other
#endif

/// What `name` is in the namespace of the set `isa`, one of those that were compiled: name() calls it, &name
/// is not meant.
#define TISSU_KERNELS_OF(isa, name) \
  TISSU_UNLESS_AVX512(isa, name, TISSU_UNLESS_AVX2(isa, name, (static_cast<void>(isa), baseline::name)))
