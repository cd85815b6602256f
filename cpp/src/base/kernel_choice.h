#pragma once

/// The choice at run time among the instruction sets that this build has kernels for. Kernels themselves do
/// not include it: another choice of sets does not compile them again.

#include "base/kernel_sets.h"
#include "compiled_sets.h"

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
