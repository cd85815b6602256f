"""Words of docs/measured/integrators.md; bench/integrators.py puts its numbers in."""

HEAD = """# Methods in time, measured

How fast the error of each method falls with the step, and what each does to the energy. When to
take which: [the guide](../guide/integrators.md).

![Errors against the step, energy against time](../pictures/integrators.png)

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

**Linearised once** (no `newton:`, the default), the same bar:

{once_orders}

One linear solve keeps the order of a method where the tangent is whole. That of `rayleigh` with a
share of the stiffness, and of `kelvin_voigt`, leaves out how the damping changes with the shape
([viscosity](../guide/viscosity.md)); then methods of second order fall to first, with an error some
hundred times smaller than implicit Euler's.
With `newton:` they are of second order again. Without that
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

END = """This page and its picture are printed by `python bench/integrators.py --write`.
"""
