#pragma once

/// The instruction set that the hot kernels run with, chosen once for each world at run time.

#include <string_view>

namespace tissu {

enum class Isa { baseline, avx2, avx512 };

/// The best set that this machine and this build both have, or the one that the environment variable
/// TISSU_ISA names (baseline, avx2, avx512); a name that cannot run here is a ParameterError.
Isa choose_isa();

/// This machine and this build both have it.
bool runs_here(Isa isa);

std::string_view name(Isa isa);

}  // namespace tissu
