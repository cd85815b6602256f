"""Statics and energy in docs/measured/hard-cases.md; bench/hard.py prints them."""

CHAPTERS = """## Statics

A static step solves f(x) = 0. Five things decide whether it does.

**By what equilibrium is judged.** The residual on free rows is held against the load that acts:
the norm of the external forces on free rows and, where nodes are led or nothing acts from
outside, of the reactions at the same state. It is never held against the residual of an earlier
iteration: in bending the first iteration stretches the body, and its residual is orders above
the load. Beside it the last correction is at most a hundredth of the displacement. A residual
that is round-off (epsilon |diag(K) x|: what half a unit in the last place of the positions makes
of the forces) is accepted, and the report's message says so with the share of the load that it
leaves. `contrast` stops there, at 1e-4 of its load. Steps in time are judged in the same way, by
external impulse, reactions and change of momentum.

**How the load comes.** In the first step the external loads grow in proportion; in later steps
time goes on and they follow their histories. Led nodes follow their motion in every step,
rotations along their arc. A step has at least `load_steps` parts, and no part leads a node
round by more than 30 degrees. A part that fails is halved; after one that took six iterations
or fewer the next is twice as long, up to the first length.

**Newton's method.** Whole steps come first: in bending they pass through worse states on the
way to a better one. Where they do not converge, the part begins anew with steps along which the
potential energy falls (Armijo). Where the tangent is not definite they go by a mean of it and of
the definite matrix. The share of the definite matrix falls to a quarter after a whole step and
rises until the mean is positive definite; a small share keeps the long directions in which a
body topples. A whole step by the exact tangent comes first, and is taken where it halves the
residual; after one in vain the next is tried 1, 3, 7, ... 63 iterations later. Half of the
iterations that are left serve a descent, the rest smaller parts. Where
the linear solver finds the tangent indefinite, or where a moment with a fixed axis makes it
unsymmetric, generalised conjugate residuals work on the exact tangent, with that solver as
their preconditioner, to 1e-3 where it is indefinite only. They stop after eight iterations that
do not take nine tenths of the residual, and the definite matrix serves that step.

**Unstable equilibria.** Whole steps may converge to a saddle of the energy. A converged report
says so if the tangent there is found indefinite; a conjugate gradient sees this only in
directions that its residual has, Cholesky's factor always. A soft cube twice as heavy as stiff
stands on such a saddle with 8 and 12 cells an edge. With 16 its lower corners crease as well,
the descent leaves the saddle, and the cube topples and hangs beside its support, which does not
touch it: a minimum of the energy, after 186 iterations.

**Where the load turns.** When parts of 1/4096 of the first fail too, the path is followed by
its arc length (Riks 1979). `arc_length: true` does so from the start. Two bars with a flat top
(the truss of von Mises) are followed through both limit points to the closed form
(`tests/cpp/step/arc_length_test.cpp`). Limit points are supported. At a bifurcation the path
goes straight on: a column under an exactly central load stays straight. By parts of the load, a
body that snaps through is found on the other side by the fall of its energy.

**The message names what gave up.** `total_iterations` bounds the Newton iterations of a step:
iterations x (load_steps + 19) unless said otherwise, which is room for twenty parts that need
all of theirs. The message says beyond which share of the load nothing was found, and which of
load, Newton's method and linear solver gave up. A static step that converged with cells inside
out (det F <= 0 at a quadrature point) names them in its report: St-Venant-Kirchhoff has such
equilibria beyond a pressure of E / (3 sqrt 3).

| scene of `bench/cases` | Newton iterations | residual over the load |
|---|---|---|
| `strip`: dead shear at its end | 17 | 1e-8 |
| `half_turn` in one step | 42 | 2e-13 |
| `soft_cube` under its weight, 8 cells an edge, unstable | 8 | 6e-7 |
| `cook`: Cook's membrane, mean dilatation | 5 | 1e-9 |
| `rolled`: a strip of shells, 40 load steps | 160 | 2e-10 |

## Energy

The implicit midpoint rule and Newmark's method keep the energy of linear bodies. In large
strains they can gain it, with every step converged: a bar of St-Venant-Kirchhoff that hits its
held half at 500 m/s multiplies it. So where nothing in the scene can give energy (no led nodes,
pressure, run-time springs, frames, Prony series or loads that change with time) these methods
watch it. A growth of more than a tenth of the largest kinetic and elastic energy that the
bodies had of their own makes a step report that it has not converged, with the remedy; more
than ten times as much raises `Diverged`, at the last good step. What is written into the state
between steps, a load that is changed too, does not count; a checkpoint carries what the watch has
seen. The watch costs one energy a step, for undamped implicit methods
only.

The cure is `energy_momentum`, the midpoint rule with Gonzalez's discrete gradient (1996): the
work of its force over a step is the change of the stored energy, for any law. The correction
has no resultant on a free body, so that linear and angular momentum are kept as well. The
thrown bar keeps its energy to 1e-6 in a hundred steps of 0.1 ms, a tumbling block energy and
momenta to 1e-7 (`tests/cpp/step/energy_momentum_test.cpp`). Each iteration solves with one
matrix twice; a step whose equation is not solved is taken in halves, eight times at most. It
takes no frames or shells, and no Prony series.
"""
