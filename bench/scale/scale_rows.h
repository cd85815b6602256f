#pragma once

namespace tissu::bench {

/// The rows "scale/WHAT/SIZE/THREADS" of the cube (cube.h) with about SIZE tetrahedra, on one thread and on
/// two. WHAT is "force", "assembly" (of the whole matrix of a step), "tangent product", "matrix product" or
/// "step, SOLVER", by implicit Euler with a conjugate gradient to 1e-6.
void add_scale_rows();

}  // namespace tissu::bench
