#pragma once

/// The rows "kernel/ELEMENT/LAW/JOB" and "baseline/WHO/ELEMENT/stvk/JOB", one thread.

namespace tissu::bench {

/// Every element that the core has kernels for with every law of its dimension, quadrature "full", on meshes
/// of about `count` elements.
void add_kernel_rows(int count);

/// The rows "corotational/ELEMENT/ROTATION/TANGENT/JOB" on the same meshes.
void add_corotational_rows(int count);

/// The rows "definite/MODEL/ELEMENT/LAW/exact" and ".../definite": the assembly of a squeezed mesh as it is,
/// and projected.
void add_definite_rows(int count);

/// The textbook's loops and the expanded mass-tensor on the same meshes.
void add_baseline_rows(int count);

}  // namespace tissu::bench
