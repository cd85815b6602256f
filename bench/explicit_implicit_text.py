"""Words of docs/measured/explicit-implicit.md; bench/explicit_implicit.py puts its numbers in."""

HEAD = """# Explicit against implicit, and the fixed point

Faure (2014, section 6.2.1) pulls a cube of 1 m, 10 x 10 x 10 hexahedra of St-Venant–Kirchhoff's law
with nu = 0.3: held at x = 0, led by 5 % at x = 1 over 0.9 s, without damping, for two densities and
two Young's moduli, with explicit Euler (his table 6.1) and implicit Euler (6.2). Here is the same
cube with each of his steps. One thread; wall times are medians of a step, times for 0.9 s that
median times the steps.

## What limits an explicit step

The paper names 2 sqrt(m/E), which has no length in it and so is not a time. The limit is 2 / omega,
omega the largest eigenfrequency of M^-1 K:

"""

EXPLICIT = """Explicit Euler itself has no limit without damping: a vibration grows by (1 + h^2
omega^2)^(1/2) in each step, and the paper's runs last because 0.9 s are short. tissu refuses it
above {limit:.2g} s here (growth by e in 100 s). **Symplectic Euler, at the same cost of one force a
step, holds steps {ratio:.0f} times as large as the paper's 5e-5 s** (bold: nine tenths of its
limit), and all that are listed:

"""

BY_HAND = """Explicit Euler run on regardless, to see where it is lost within the 0.9 s: the paper's
largest step of each pair, and twice as large until a node is more than 100 mm from the even stretch
(12 to 15 mm are what the cross contraction and the waves of the pull make):

"""

IMPLICIT = """Every step that the paper calls not stable lasts the 0.9 s here, and its limits do not
follow omega^2 either: it has the same ones for E = 100 kPa and 10 kPa. Nor can a step's cost fall
to a tenth with the modulus, as in its table, when the cells are the same thousand. What was
different in the paper's runs is not known; that explicit Euler is lost in the end, and at which
growth, is seen here.

## Implicit Euler

Linearised once, conjugate gradient to 1e-6. Steps: of 0.9 s, the last one shorter; the paper counts
one more for some.

"""

TAIL = """An implicit step costs {implicit:.1f} ms and an explicit one {explicit:.2f} ms,
**{ratio:.0f} times as much; the paper has 66**. The paper concludes that the explicit method is
the slower one but for soft and dense bodies, because it must take steps of 5e-5 s. With symplectic
Euler at its own limit the whole pull costs about what a few implicit steps cost, and
follows the waves as well. Implicit steps pay where cells are small or stiff (omega large)
and the motion is slow: their cost does not know omega."""

EQUILIBRIUM = """## Where they come to rest

With a damping of 10/s (`rayleigh: mass`) both reach the equilibrium; 6 s, E = 100 kPa, 1000 kg/m3;
symplectic Euler with its own step beside implicit Euler with 0.1 s. Both have the same
equilibrium; the paper's 6 and 1 um may be what its runs had left to move.

"""

FIXED_POINT = """## Chendeb's fixed point

Chendeb (2007, section 2.4.4) solves BDF2 by iteration, v <- v^ + a M^-1 f(x(v)): no matrix, and in
each iteration the share (2/3 h omega)^2 of the fastest vibration's error is left, (h omega)^2 in
the first step, which is implicit Euler. Measured: the residual after n + 1 iterations over that
after n, the cube moving in its fastest vibration (found by power iteration on accelerations). Then
the cube falls under gravity: iterations of a step to 1e-6, mean of 20 steps after one of at most
0.9 / omega, without and with Anderson's acceleration (five differences); beside `bdf2`
with Newton's method and conjugate gradient. E = 100 kPa, 1000 kg/m3, x = 0 held.

"""

END = """Plain iteration ends where it is predicted to, at h omega = 3/2, and is slow before: a step
is then shorter than what symplectic Euler takes with one force. Anderson's acceleration goes on
beyond it, as a Krylov method would, with iterations about in proportion to h omega; its step then
costs no more than Newton's as long as h omega is below about 4.

This page is printed by `python bench/explicit_implicit.py --write`.
"""
