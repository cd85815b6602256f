"""From an energy density to C++: stress, tangent and their cost, for every law.

    python -m tissu.codegen --list      # the laws, their parameters and operation counts
    python -m tissu.codegen --update    # writes the C++ again
    python -m tissu.codegen --check     # refuses C++ that is not what the formulae give

A law is one file in `laws/`: its parameters, the constants computed from them, and one energy.
The stages, each in its own module:

    definition  a file              -> a Law
    derive      an energy           -> its derivatives by the invariants (Weights)
    kernels     Weights             -> four lists of assignments (Program)
    program     lists               -> common parts named once, what is never read left out, counted
    cpp         Programs            -> the text of a header
    listing     all laws            -> the list of types, and the table of parameters
    checks      a Law               -> refused, with the reason, or accepted
"""
