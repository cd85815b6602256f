"""The words of docs/measured/frames.md; bench/frames.py prints the numbers."""

HEAD = """# Frames

This page compares frames with the tables and figures of Bosman, Duriez and Cotin (2014). [The
guide](../guide/tissue.md) describes frames and when to take them. Printed by
`python bench/frames.py --write`.
"""

STEEL_TEXT = """
## Figures 6 and 7: the steel cantilever, 16 x 0.5 x 0.5 m

The paper compares with the beam formula, 147.19 mm. Meshes converge to another value, 150.17 mm
(CalculiX, `B` of the reference). The quadrature is `full`. Times are those of one static step from
rest.
"""

SOFT_TEXT = """
## Figures 8 and 13: the soft cantilever, 16 x 1 x 1 m, 5 kg, 40 kPa

The end sinks by two fifths of the length. The bar swings and is damped to rest, because static
steps of frames with whole levers are slow here (next section). In the paper, 21 x 3 x 3 frames
come within 2 % of 64 x 4 x 4 hexahedra. Ours are 0.1 % apart, with a quarter of the unknowns.
"""

STATIC_TEXT = """
## The soft cantilever in one static step

Which frames converge in a single static step? The same bar is solved from rest by `static` with
`cholesky`, under a part of its weight and under its whole weight. Entries are the sag of the end
and the number of Newton iterations to a residual of 1e-8 of the load. The reference is a mesh of 24
x 2 x 2 quadratic hexahedra.
"""

TENSION = """
## Table 1: the cylinder in tension

The end face is held only along x, as in the closed form. The paper's results are within 0.7 %.
"""

SPEED = """
## Table 3: a step with 60 iterations of conjugate gradients, two threads

The points lie on a grid inside a box, and each has four neighbours. The method is implicit Euler,
linearised once. The tangent is assembled into blocks once a step (SIMD over points), and the 60
products are those of a sparse matrix. Our grids have a few more points than the paper's. "At the
paper's points" is our time, scaled to the paper's number of points.
"""

NEAR = """
## Table 2: the same against frames, points and neighbours, one thread

Points are Poisson samplings with Shepard's weights. The article prints 45.42 and 55.15 ms for 6 and
8 neighbours, but does not say clearly which is which.
"""
