"""The words of docs/frames.md; bench/frames.py prints the numbers."""

HEAD = """# Frames and connective tissue

Written by `python bench/frames.py --write`. Bosman, Duriez and Cotin 2014 in `bosman2014`.

A frame has a place and a rotation; a few of them carry many integration points,

    p = sum_i w_i (x_i + R_i l_i),   F = sum_i (x_i + R_i l_i) (x) grad w_i + w_i R_i,

so that any law of volumes makes forces and moments on them. No mesh is needed. `model: frames`
takes the nodes of a mesh as frames and its shape functions as weights (hexahedra: trilinear, 8
neighbours; tetrahedra: linear, 4); `tissue` samples frames and points inside a surface, or
between two bodies, and ties these together.

```yaml
tissue:
  fascia:
    between: [uterus, bladder]   # or  inside: organ.stl
    reach: 2 cm                  # the longest way from one to the other
    frames: 22
    points: 800
    shape: shepard               # wendland, cubic_spline, linear, trilinear, moving_least_squares
    law: {type: stvk, young: 6 kPa, poisson: 0.3}
    mass: 1 kg
```

What is right to round-off, by test: forces are the gradient of the energy on the rotation group,
products and matrices its second derivative (the geometric part included; `tangent: material`
leaves it out, as published, and is never indefinite), rigid motions cost no energy at any
rotation, momenta are kept, and any number of threads gives the same bits.

**Sheets and lines** are frames as well (`thickness`, `section`). Points on the middle of a sheet
feel no curvature and those on the axis of a line no twist (the errata of the paper); ours stand
through the section, where their moments of area are those of the plate and of a round rod, and
each is free to thin, so that any law of volumes gives plane or uniaxial stress. `section: middle`
is the published one.

**Trilinear and linear weights** hold linear maps by their places alone: a turn that all frames
share changes nothing inside a volume, so that at least one rotation is to be held in a static
step (fixed nodes hold theirs).
"""

STEEL_TEXT = """
## Figures 6 and 7: the steel cantilever, 16 x 0.5 x 0.5 m

The paper measures against the beam formula, 147.19 mm. That is not what a mesh converges to:
150.17 mm (CalculiX, `B` of the reference). Full quadrature; time of one static step from rest.
"""

SOFT_TEXT = """
## Figures 8 and 13: the soft cantilever, 16 x 1 x 1 m, 5 kg, 40 kPa

The end sinks by two fifths of the length; a swing damped to rest, for static steps of
frames are slow here (below). The paper: 21 x 3 x 3 frames within 2 % of 64 x 4 x 4
hexahedra; ours are 0.1 % apart, with a quarter of the unknowns.
"""

TENSION = """
## Table 1: the cylinder in tension

The end face held along x only, as the closed form wants. The paper is within 0.7 %.
"""

SPEED = """
## Table 3: a step with 60 iterations of conjugate gradients, two threads

Points on a grid inside a box, four neighbours, implicit Euler linearised once: the tangent is
assembled into blocks once a step (SIMD over points), and the 60 products are those of a sparse
matrix. Grids hold a few more points than the paper's: "at the paper's points" is our time less
what they are more, in proportion.
"""

NEAR = """
## Table 2: the same against frames, points and neighbours, one thread

Poisson samplings, Shepard's weights. The article prints 45.42 and 55.15 ms for 6 and 8 neighbours,
in an order that its print does not make clear.
"""

COUPLING = """
## What ties bodies together

A point between two bodies listens to the frames near it, and nodes of the bodies are frames too
where they have a rotation. A node without one carries the point by the cell it belongs to: p
moves with x_j + F l, F the cell's, so that the node b of the cell has the weight w_j (delta_jb +
l . grad N_b). Forces and stiffness go back the same way, any resolution to any resolution, and
both bodies and the tissue are one system.

![two sheets and a block](pictures/tissue-sheets.png)

*Figure 11 of the paper: two sheets of shells and a block of tissue between their middles, the
upper sheet held on two edges. The lower one hangs on it by the tissue alone.*

![uterus and bladder](pictures/tissue-organs.png)

*Like figure 12: two hollow organs of shells tied by about 22 frames. The bladder is held below,
the top of the uterus is led aside.*

## What falls short

- Static steps of volumes of frames converge slowly under large bending. The soft cantilever
  above, from rest under its whole weight with `cholesky`, takes 33 Newton iterations with 11
  x 2 x 2 frames and 94 with 21 x 3 x 3, nearly all of them with an indefinite tangent, and
  the lowest node sinks by 5.875 and 6.291 m. It lies in the function: linear weights bend to
  a curvature k without error where neighbours h apart turn by k h / 2, half of what the
  material turns by, so that rotations and material part along the body, and equilibria lie
  close together: the damped swing of the table ends at others, within 0.6 %. A shape function
  with half rotations is not there.
- Some rotations of trilinear and linear frames move no point (a turn about x that depends on x
  alone). The matrix holds them by a millionth of what a point has against turning, which changes
  no equilibrium; conjugate gradients in a static step feel it, so take `solver: cholesky` there.
- A moment on frames: lines of frames take half a turn (20 cells, ten load steps: 63 Newton iterations, turned by 0.93 of half a
  turn, since linear weights are stiff against large turns between neighbours; 10 cells: 0.63). On nodes of volumes of trilinear
  or linear frames a moment does work on rotations that move nearly no point, so that they turn without bound and the result is
  wrong also where it converged: load these by forces or tractions.
- What rotations add to linear fields must be zero in the mean of a cell. Points of a grid stand
  alike in every cell; those of a Poisson sampling do not, and soften trilinear and linear frames:
  take several points for each frame, or another shape function. One point in a tetrahedron is too
  few for linear frames of four neighbours, which the table shows as a sag that is too large.
- Lines take round sections. Viscosity of frames is Rayleigh's. Cells cannot be removed.
"""
