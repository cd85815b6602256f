#pragma once

/// The rows of a patch that bear, solved together: what sweeps find slowly where contacts stand close to each
/// other.

#include "tissu/haptic/patch_solver.h"

namespace tissu::haptic {

/// Takes of `lambda` which contacts are open, stick or slip and where to, and solves g = 0 of what bears for
/// all rows at once; what then pulls opens, what is inside closes, and so on, ten times at most (Judice and
/// Pires 1994). Forces that are outside their cones at the end are brought back, so that the next sweep may
/// begin there. Where forces are not unique (A singular) they are shared out evenly: 1e-11 of the trace is
/// added to the diagonal.
void solve_active_rows(const Patch& patch, Rows& lambda) noexcept;

}  // namespace tissu::haptic
