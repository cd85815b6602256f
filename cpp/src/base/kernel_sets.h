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
