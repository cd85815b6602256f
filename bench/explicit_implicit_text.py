"""Words of docs/measured/explicit-implicit.md; bench/explicit_implicit.py puts its numbers in."""

HEAD = """# Explicit and implicit steps

When are explicit steps cheaper than implicit ones? For the cube on this page they are: with
symplectic Euler at its stable limit, the whole motion costs about as much as a few implicit steps.
Implicit steps pay off with small or stiff cells and slow motions.

Faure (2014, section 6.2.1) pulls a cube of 1 m, 10 x 10 x 10 hexahedra of St-Venant–Kirchhoff's law
with nu = 0.3. It is held at x = 0, and its face x = 1 is moved by 5 % over 0.9 s, without damping,
for two densities and two Young's moduli. He uses explicit Euler (his table 6.1) and implicit Euler
(6.2). This page repeats the experiment with each of his steps, on one thread. The wall time of a
step is a median; the time for 0.9 s is that median times the number of steps.

## What limits an explicit step

The paper gives the limit 2 sqrt(m/E), which contains no length and so is not a time. The limit is
2 / omega, where omega is the largest angular eigenfrequency of M^-1 K:

"""

EXPLICIT = """Without damping, explicit Euler is not stable at any step: a vibration grows by the
factor (1 + h^2 omega^2)^(1/2) in each step. The paper's runs survive because 0.9 s is short. tissu
refuses steps above {limit:.2g} s here (growth by e in 100 s). **Symplectic Euler computes one force
in a step too, and is stable with steps {ratio:.0f} times as long as the paper's 5e-5 s** (bold:
nine tenths of its limit). It is stable with all steps of the table:

"""

BY_HAND = """The next table shows which steps of explicit Euler fail within the 0.9 s. Each pair
starts with the paper's largest step, which is doubled until a node is more than 100 mm away from a
uniform stretch. (The lateral contraction and the waves of the pull alone cause 12 to 15 mm.)

"""

IMPLICIT = """Every step that the paper calls unstable survives the 0.9 s here. The paper's limits
do not follow omega^2 either: they are the same for E = 100 kPa and 10 kPa. Nor can the cost of a
step fall to a tenth with the modulus, as it does in the paper's table, because the thousand cells
are the same. The reason for these differences is not known. The table shows that explicit Euler
fails in the end, and at which growth.

## Implicit Euler

Steps are linearised once, with conjugate gradients to 1e-6. The last step is shortened to end at
0.9 s; the paper counts one more step in some rows.

"""

TAIL = """An implicit step costs {implicit:.1f} ms and an explicit one {explicit:.2f} ms,
**{ratio:.0f} times as much; the paper has 66**. The paper concludes that the explicit method is
slower except for soft and dense bodies, because it must take steps of 5e-5 s. With symplectic Euler
at its own limit, the whole pull costs about as much as a few implicit steps, and it follows the
waves as well. Implicit steps pay off if the cells are small or stiff (omega is large) and the
motion is slow, since the cost of a step does not depend on omega."""

EQUILIBRIUM = """## Where they come to rest

With a damping of 10/s (`rayleigh: mass`), both methods come to rest within 6 s, at the same
equilibrium: symplectic Euler with its own step, and implicit Euler with 0.1 s. E = 100 kPa,
1000 kg/m3. The paper's 6 and 1 um may be motion that remained at the end of its runs.

"""

FIXED_POINT = """## Chendeb's fixed point

Chendeb (2007, section 2.4.4) solves BDF2 by the iteration v <- v^ + a M^-1 f(x(v)), without a
matrix. Each iteration multiplies the error of the fastest vibration by (2/3 h omega)^2, or by (h
omega)^2 in the first step, which is implicit Euler.

The table has two measurements. In the first, the cube moves in its fastest vibration, found by
power iteration on accelerations; the entry is the residual after n + 1 iterations over that after
n. In the second, the cube falls under gravity; the entries are the iterations of a step to a
tolerance of 1e-6, as a mean of 20 steps. They are given without and with Anderson's acceleration
(five differences), together with the time of `bdf2` with Newton's method and conjugate gradients.
They follow one step of at most 0.9 / omega. The cube has E = 100 kPa and 1000 kg/m3, and is held at
x = 0.

"""

END = """The plain iteration stops converging at h omega = 3/2, as predicted. It does not pay off
below this limit either, where symplectic Euler could take a longer step with a single force. With
Anderson's acceleration the iteration converges beyond the limit, as a Krylov method would, and the
number of iterations grows in proportion to h omega. A step then costs no more than Newton's as long
as h omega is below about 4.

Printed by `python bench/explicit_implicit.py --write`;
"""
