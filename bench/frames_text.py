"""The words of docs/measured/frames.md; bench/frames.py prints the numbers."""

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
through the section, where their moments of area are those of the plate and of the rod, and
each is free to thin, so that any law of volumes gives plane or uniaxial stress. `section: middle`
is the published one.

**Rods** are the lines of a body: `section` is an area (round), or says a shape. `up` is the
direction in space along which the height stands; what of it lies along a line is left out.

```yaml
section: {type: rectangle, height: 2 mm, width: 1 mm, up: [0, 0, 1]}   # round, tube, general
```

A rod has the stiffnesses E A, E I about both axes, k G A along both and G J. Shear factors are
Cowper's (J. Appl. Mech. 33, 1966): 6 (1 + nu) / (7 + 6 nu) of a circle, 10 (1 + nu) / (12 + 11 nu)
of a rectangle, and his of a tube; J of a rectangle is Saint-Venant's series. `general` takes all
of these numbers. Four points around the axis carry them, with E, G and nu of the law at rest; what
the section adds to the shear, 1/2 c g^2 with g twice Green's strain, is quadratic for every law.
Stress and strain at the points are the law's of their deformation, without that part.

**Half levers** (`model: {type: frames, lever: half}`) are what bending of volumes wants. With
linear weights a curvature k asks that frames h apart turn by k h / 2, half of what the material
turns by: rotations part from it, and in large bending the published function finds many
equilibria or none. With half of the way from frame to point as the lever,

    p = sum_i w_i (x_i + 1/2 R_i l_i),   F = sum_i (x_i + 1/2 R_i l_i) (x) grad w_i + 1/2 w_i R_i,

they turn by k h, as the material does (linked interpolation: Taylor and Auricchio 1993), and a
tie of 1/4 G |s|^2, s the axial vector of (sum_i w_i R_i)^T F, holds them to it at no cost of
accuracy (Hughes and Brezzi 1989). No rotation is free then, except in a tetrahedron or a pyramid
that stands alone. Hexahedra and wedges take the points of `quadrature: over`, for those of `full`
do not see all of a quadratic field. Meshes of tetra, hexahedron, wedge and pyramid are accepted;
sheets and lines have half levers along themselves already.

**Trilinear and linear weights** with whole levers hold linear maps by their places alone: a turn
that all frames share changes nothing inside a volume, so that at least one rotation is to be held
in a static step (fixed nodes hold theirs).
"""

STEEL_TEXT = """
## Figures 6 and 7: the steel cantilever, 16 x 0.5 x 0.5 m

The paper measures against the beam formula, 147.19 mm. That is not what a mesh converges to:
150.17 mm (CalculiX, `B` of the reference). Full quadrature; time of one static step from rest.
"""

SOFT_TEXT = """
## Figures 8 and 13: the soft cantilever, 16 x 1 x 1 m, 5 kg, 40 kPa

The end sinks by two fifths of the length; a swing damped to rest, for static steps of frames with
whole levers are slow here (below). The paper: 21 x 3 x 3 frames within 2 % of 64 x 4 x 4
hexahedra; ours are 0.1 % apart, with a quarter of the unknowns.
"""

STATIC_TEXT = """
## The soft cantilever in one static step

The same bar from rest by `static` with `cholesky`, under a share of its weight and under all of
it: sag of the end and Newton iterations, to a residual of 1e-8 of the load. Quadratic hexahedra,
24 x 2 x 2 cells, are what it is measured against.
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

![two sheets and a block](../pictures/tissue-sheets.png)

*Figure 11 of the paper: two sheets of shells and a block of tissue between their middles, the
upper sheet held on two edges. The lower one hangs on it by the tissue alone.*

![uterus and bladder](../pictures/tissue-organs.png)

*Like figure 12: two hollow organs of shells tied by about 22 frames. The bladder is held below,
the top of the uterus is led aside.*

## What falls short

- Static steps of volumes of frames with whole levers converge slowly under large bending, or not
  at all: the table of static steps. It lies in the function, above: equilibria lie close
  together, and the damped swing of the soft cantilever ends at others than static steps, within
  0.6 %. Take `lever: half` there.
- With half levers tetrahedra and wedges are stiff, less than linear cells are: the soft
  cantilever of 32 x 3 x 3 cells sinks by 9 % and 11 % too little. `tissue` has whole levers only.
- Some rotations of trilinear and linear frames with whole levers move no point (a turn about x
  that depends on x alone). The matrix holds them by a millionth of what a point has against
  turning, which changes no equilibrium; conjugate gradients in a static step feel it, so take
  `solver: cholesky` there.
- A moment on lines of frames: half a turn of a cantilever takes 20 cells 63 Newton iterations in
  ten load steps, and its end turns by 0.93 of half a turn, since linear weights are stiff against
  large turns between neighbours. On volumes of trilinear or linear frames with whole levers a
  moment would do work on rotations that move nearly no point; scenes refuse it there: load these by
  forces or tractions, or take `lever: half`.
- What rotations add to linear fields must be zero in the mean of a cell. Points of a grid stand
  alike in every cell; those of a Poisson sampling do not, and soften trilinear and linear frames:
  take several points for each frame, or another shape function. One point in a tetrahedron is too
  few for linear frames of four neighbours, which the table shows as a sag that is too large.
- Rods twist by Saint-Venant's torsion: where a clamp holds the warping of a section, as of an
  I-beam, they are too soft. The centre of shear is that of the area. Points on the middle
  (`section: middle`) take round sections alone, with a shear factor of one. Viscosity of frames
  is Rayleigh's. Cells cannot be removed.
"""
