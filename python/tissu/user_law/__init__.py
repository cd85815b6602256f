"""Laws of one's own, made while the program runs: a formula goes in, a law of the scene comes out.

    from sympy import symbols
    from tissu.formula import I_C, J, ln

    mu, kappa = symbols("mu kappa")
    Soft = tissu.law(
        "soft",
        energy=mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * (J - 1) ** 2,
        parameters={"mu": "Pa", "kappa": "Pa"},
    )
    body = tissu.Body(mesh=..., law=Soft(mu="1 kPa", kappa="20 kPa"), density=1000.0)

The stages, each in its own module:

    formula     what the user wrote  -> SymPy in the generator's words
    define      formula, parameters  -> a codegen.Law, refused with the reason or accepted
    checks      a Law                -> units, stiffness at rest
    source      a Law                -> the C++ of a shared library
    compiler    C++                  -> the library, by the compiler of this machine
    cache       the library          -> kept for the next time
    made        all of it            -> the core's LoadedLaw, and what a summary records
    of_scene    files a scene names  -> their laws
"""

from tissu.user_law.define import law, law_from_record, read_law

__all__ = ["law", "law_from_record", "read_law"]
