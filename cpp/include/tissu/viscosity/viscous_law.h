#pragma once

/// Kelvin–Voigt's stress at many points, compiled for each instruction set.

#include "tissu/law/law_kernels.h"

namespace tissu {

/// Kelvin–Voigt's stress for a reference dimension: constants zeta and eta, dF the rate of F; neither energy
/// nor stress, which are null.
const LawKernels* find_viscous_law(Isa isa, int dimension);

}  // namespace tissu
