"""Words of docs/measured/integrators.md; bench/integrators.py puts its numbers in."""

HEAD = """# Integrators

This page shows how fast the error of each method falls with the time step, and how each method
changes the energy. [The guide](../guide/integrators.md) says when to take each of them.

![Errors against the step, energy against time](../pictures/integrators.png)

## Orders

**Linear oscillator.** One node of a hexahedron of Hooke's law may move along one axis: x'' =
-omega^2 x - c x' with omega^2 = 8 (lambda + 4 mu) / (9 rho a^2) and c = 0.2 omega. It is displaced
and released. Entries are the errors of position and velocity after two periods, against the closed
form and relative to the amplitude. The order is that of the last halving of the step.

{oscillator_orders}

**StVK bar.** Four hexahedra, 0.2 m long, E = 60 kPa, are held at one end and struck, so that the
tip swings by a quarter of the length. The bar is damped in proportion to its stiffness (1 ms), so
that explicit Euler can be included. Entries are the largest error of a node after 0.256 s, as a
share of the largest displacement. The reference is `rk4` with a tenth of the smallest step.
Newton's method has a tolerance of 1e-10.

{bar_orders}

**Linearised once** (no `newton:`, the default), the same bar:

{once_orders}

One linear solve keeps the order of a method if the tangent is complete. The tangents of `rayleigh`
with a stiffness term and of `kelvin_voigt` leave out how the damping changes with the shape
([viscosity](../guide/viscosity.md)). Then methods of second order fall to first order, with an
error about a hundred times smaller than that of implicit Euler. With `newton:` they are of second
order again. Without this damping, linearised once, the orders are: {undamped_orders}.

## Energy

Entries are the share of the energy that remains without any damping: its mean over the tenth or the
hundredth period, ± its largest deviation within that period. The exact value is 1.

**Linear oscillator**

{oscillator_energies}

**StVK bar**: T = {swing} s is the period of the slow swing. The fastest vibration has omega =
{bar_omega}/s. Its period takes five steps at h = T/200, and hardly more than one at T/50.

{bar_energies}

An implicit method can take such steps. It either damps the vibrations that it does not resolve
(implicit Euler, BDF2) or carries them along (midpoint, Newmark). In the latter case the energy is
bounded but not exact, because the law is not linear. RK4 loses the fast vibrations in the first
periods and keeps the slow swing.

Explicit methods on the bar with nine tenths of their stable step:

{own_steps}
"""

TAIL = """
## Explicit Euler without damping is refused

Explicit Euler multiplies a vibration by sqrt(1 + h^2 omega^2) in each step, so no step is stable.
tissu accepts a step with which a vibration takes at least a hundred seconds to grow by a factor e,
so h < 0.02 / omega^2. For the oscillator above, omega = {omega:.4g}/s, this is {closed:.4g} s.
Bisection finds {limit:.4g} s. The message for a step one tenth larger is:

> {said}

The same criterion holds for `rk2`, whose growth is h^4 omega^4 / 8 a step: h^3 < 0.08 / omega^4.
With damping both methods have a true limit; that of explicit Euler is h < c / omega^2.

"""

END = """This page and its picture are printed by `python bench/integrators.py --write`.
"""
