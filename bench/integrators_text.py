"""Words of docs/measured/integrators.md; bench/integrators.py puts its numbers in."""

HEAD = """# Methods in time, measured

A scene's `step` names one of nine methods in time, or `static`. This page says how fast each one's
error falls with the step, what each does to the energy, and when to take it.

![Errors against the step, energy against time](../pictures/integrators.png)

## Which one

| what you want | `step` |
|---|---|
| the most robust choice, at a step you choose | `implicit_euler` |
| the same with vibrations that last | `bdf2` |
| no loss of energy, at a step you choose | `implicit_midpoint`, `newmark` or `energy_momentum` |
| small steps, and no system to solve | `auto` (`symplectic_euler`) |
| many right digits, small steps | `rk4` |
| where it comes to rest, and nothing in between | `static` |

## Orders

**Linear oscillator.** One hexahedron of Hooke's law with one node that may move, along one axis:
x'' = -omega^2 x - c x' with omega^2 = 8 (lambda + 4 mu) / (9 rho a^2) and c = 0.2 omega, drawn out
and let go. Error of place and speed after two periods against the closed form, in amplitudes; the
order is that of the last halving.

{oscillator_orders}

**StVK bar.** Four hexahedra, 0.2 m long, E = 60 kPa, held at one end and struck so that its tip
swings a quarter of its length; damped in proportion to its stiffness (1 ms), so that explicit Euler
can be shown beside the others. Largest error of a node after 0.256 s, in the largest displacement;
the reference is `rk4` with a tenth of the smallest step. Newton's method to 1e-10.

{bar_orders}

**Linearised once** (no `newton:`, what a scene has if it does not ask), the same bar:

{once_orders}

One linear solve keeps the order of a method where the tangent is whole. That of `rayleigh` with a
share of the stiffness, and of `kelvin_voigt`, leaves out how the damping changes with the shape
([viscosity](viscosity.md)); then methods of second order fall to first, with an error some hundred
times smaller than implicit Euler's. With `newton:` they are of second order again. Without that
damping, linearised once: {undamped_orders}.

## Energy

Share of the energy that is left without any damping: its mean over the tenth and the hundredth
period ± how far it strays within that period. 1 is right.

**Linear oscillator**

{oscillator_energies}

**StVK bar**: T = {swing} s is the slow swing. Its fastest vibration has omega = {bar_omega}/s: five
steps in its period at h = T/200, hardly more than one at T/50.

{bar_energies}

An implicit method takes such steps and damps what it does not resolve (implicit Euler, BDF2) or
carries it along (midpoint, Newmark: bounded, not exact, as the law is not linear). RK4 loses what
is left of the fast vibrations in the first periods and keeps the slow swing.

Explicit methods on the bar with nine tenths of their stable step (`dt: auto`):

{own_steps}
"""

TAIL = """
## Explicit Euler without damping is refused

It multiplies a vibration by sqrt(1 + h^2 omega^2) in each step: no step is stable. tissu
accepts what takes a hundred seconds to grow by a factor e, h < 0.02 / omega^2. For the oscillator
above, omega = {omega:.4g}/s, that is {closed:.4g} s; found by bisection: {limit:.4g} s; said of a
step one tenth larger:

> {said}

The same criterion holds for `rk2`, whose growth is h^4 omega^4 / 8 a step: h^3 < 0.08 / omega^4.
With damping both have a real limit; for explicit Euler h < c / omega^2.

"""

METHODS_TEXT = """## One by one

**`explicit_euler`**: first order, one force a step. Take it only to reproduce published work;
without damping its step is 100 s omega times smaller than that of symplectic Euler, which costs the
same: thousands of times and more.

**`symplectic_euler`** (`step: auto`): first order, one force a step, stable below 2 / omega. Its
energy strays within a period, by about h omega / 2 of the vibration's, and does not drift. The
cheapest method per step; take it where steps are small anyhow: stiff contact, haptics, soft and
coarse bodies, or waves that you want to see.

**`rk2`**: second order, two forces a step. Every undamped vibration grows a little; its step is
bounded by that. Take it for damped bodies only; else `rk4` or `symplectic_euler`.

**`rk4`**: fourth order, four forces a step, stable below 2.8 / omega. Take it as a reference, and
where many digits are wanted over a short time. It damps what it does not resolve.

**`implicit_euler`**: first order, one linear solve a step. It damps every vibration, by more
than half its energy in a period of 50 steps; nothing else here goes so surely through bad
states. Take it for interaction, for the way to an equilibrium, and when in doubt; not to
measure vibrations.

**`implicit_midpoint`**: second order; keeps the energy of a linear body exactly and the linear
momentum of any. Angular momentum is kept with `newton`; linearised once, a spinning block of 100
kPa loses 0.67 % of it in 500 steps of 1 ms. Take it for vibrations over long times. Nothing damps
what the step does not resolve: give the body a viscosity, or start it smoothly.

**`energy_momentum`**: the midpoint rule with a discrete gradient (Gonzalez 1996); second order;
keeps energy and momenta of any law to Newton's tolerance, at two solves an iteration. Take it in
large strains, where the midpoint rule or Newmark's method report that the energy grows
([hard-cases.md](hard-cases.md)).

**`newmark`**: with beta = 1/4, gamma = 1/2 as accurate as the midpoint rule, equal to it for a
linear body; gamma above 1/2 damps and falls to first order. Take it to compare with other programs
of structural dynamics.

**`bdf2`**: second order; damps fast vibrations strongly and slow ones little: a period of 200 steps
costs a slow swing about 1e-4 of its energy. The best first choice where implicit Euler is too
sluggish.

**`bdf2_fixed_point`**: the same steps by iteration, without a matrix; only below h omega = 3/2, 1
in its first step, with Anderson's acceleration above. See
[explicit against implicit](explicit-implicit.md). Take it where a matrix does not fit in memory, or
to reproduce Chendeb 2007.

This page and its picture are printed by `python bench/integrators.py --write`.
"""
