#pragma once

namespace tissu::bench {

/// The rows "target/mixed body, SOLVER/THREADS" (mixed_body.h) and "target/corotational 50k/THREADS" (50,688
/// tetrahedra of the published beam), whole steps by implicit Euler with a conjugate gradient to 1e-6.
void add_target_rows();

}  // namespace tissu::bench
