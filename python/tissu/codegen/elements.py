"""The table of elements: nodes, shape functions and quadrature, from which their C++ is made.

Nodes: corners, middles of edges, middles of faces, centre. Adding an element is one entry of
`elements()`. `python -m tissu.codegen --check | --update` compares or writes the C++.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy

from tissu.codegen import quadrature
from tissu.codegen.quadrature import Rule
from tissu.codegen.reference_cells import AXES, CORNERS, EDGES, FACES, Nodes, middles
from tissu.codegen.shape_functions import (
    lagrange,
    pyramid_1,
    pyramid_2,
    serendipity,
    simplex_1,
    simplex_2,
    wedge_1,
    wedge_2,
)


@dataclass(frozen=True)
class Element:
    """An element: what the code generator has to know of it.

    Attributes:
        name: as in meshio.
        struct: name of the C++ struct.
        cell: name of the straight element of the same shape.
        order: the largest degree whose polynomials it holds, all of them.
        nodes: reference coordinates of each node.
        formula: of the shape functions, in words.
        shapes: shape function of each node, in the first `dimension` of AXES.
        reduced: fewer points than `full`; may have zero-energy modes.
        full: exact for the stiffness of Hooke's law on an affine cell.
        over: exact for St-Venant-Kirchhoff's law on an affine cell, or the nearest affordable rule.
    """

    name: str
    struct: str
    cell: str
    order: int
    nodes: Nodes
    formula: str
    shapes: tuple[Any, ...]
    reduced: Rule
    full: Rule
    over: Rule

    @property
    def dimension(self) -> int:
        """Of the reference cell: 1 line, 2 surface, 3 volume."""
        return len(self.nodes[0])

    @property
    def affine(self) -> bool:
        """Whether one Jacobian serves the whole cell, whatever its nodes."""
        return len(self.nodes) == self.dimension + 1

    @property
    def rational(self) -> bool:
        """Whether the shape functions have the denominator 1 - z."""
        return self.cell == "pyramid"

    @property
    def rules(self) -> dict[str, Rule]:
        """Its rules by name."""
        return {"reduced": self.reduced, "full": self.full, "over": self.over}

    @property
    def gradients(self) -> tuple[tuple[Any, ...], ...]:
        """dN_a/dxi_i, [node][axis]."""
        return tuple(tuple(sympy.diff(N, s) for s in AXES[: self.dimension]) for N in self.shapes)


def _element(
    name: str,
    cell: str,
    shapes: Callable[[str, Nodes], tuple[Any, ...]],
    rules: Sequence[Rule],
    *,
    middle: Sequence[tuple[int, ...]] = (),
) -> Element:
    """An element whose nodes are the corners of a cell and the middles of groups of them."""
    nodes = CORNERS[cell] + middles(cell, middle)
    struct = f"{cell.capitalize()}{len(nodes)}"
    order = 2 if middle else 1
    formula = inspect.getdoc(shapes) or ""
    return Element(name, struct, cell, order, nodes, formula, shapes(cell, nodes), *rules)


@cache
def elements() -> tuple[Element, ...]:
    """Every element, with its reduced, full and over rule.

    Over is exact for St-Venant-Kirchhoff's law on affine cells except on hexahedron20 and
    hexahedron27 (which would take 125 points instead of 64), wedge15 and pyramid13.
    """
    gauss, simplex = quadrature.tensor, quadrature.simplex
    wedge, cone = quadrature.wedge, quadrature.pyramid
    triangle6 = [simplex(2, degree) for degree in (1, 2, 4)]
    tetra10 = [simplex(3, degree) for degree in (1, 2, 5)]
    quad8 = [gauss(count, 2) for count in (2, 3, 5)]
    hexahedron20 = [gauss(count, 3) for count in (2, 3, 4)]
    wedge15 = [wedge(2, 2), wedge(4, 3), wedge(6, 4)]
    pyramid13 = [cone(2, 2), cone(3, 2), cone(4, 3)]
    square, cube = [*EDGES["quad"], *FACES["quad"]], [*EDGES["hexahedron"], *FACES["hexahedron"]]
    return (
        _element("line", "line", lagrange, [gauss(1, 1)] * 3),
        _element("line3", "line", lagrange, [gauss(n, 1) for n in (1, 2, 3)], middle=EDGES["line"]),
        _element("triangle", "triangle", simplex_1, [simplex(2, 1)] * 3),
        _element("triangle6", "triangle", simplex_2, triangle6, middle=EDGES["triangle"]),
        _element("quad", "quad", lagrange, [gauss(n, 2) for n in (1, 2, 3)]),
        _element("quad8", "quad", serendipity, quad8, middle=EDGES["quad"]),
        _element("quad9", "quad", lagrange, quad8, middle=square),
        _element("tetra", "tetra", simplex_1, [simplex(3, 1)] * 3),
        _element("tetra10", "tetra", simplex_2, tetra10, middle=EDGES["tetra"]),
        _element("hexahedron", "hexahedron", lagrange, [gauss(n, 3) for n in (1, 2, 3)]),
        _element(
            "hexahedron20", "hexahedron", serendipity, hexahedron20, middle=EDGES["hexahedron"]
        ),
        _element("hexahedron27", "hexahedron", lagrange, hexahedron20, middle=cube),
        _element("wedge", "wedge", wedge_1, [wedge(1, 1), wedge(2, 2), wedge(4, 3)]),
        _element("wedge15", "wedge", wedge_2, wedge15, middle=EDGES["wedge"]),
        _element("pyramid", "pyramid", pyramid_1, [cone(1, 1), cone(2, 1), cone(3, 1)]),
        _element("pyramid13", "pyramid", pyramid_2, pyramid13, middle=EDGES["pyramid"]),
    )


def element_texts() -> dict[str, str]:
    """The C++ of the elements: path from the root of the repository -> text."""
    from tissu.codegen.element_text import element_header, list_header

    folder = "cpp/include/tissu/element/generated"
    texts = {f"{folder}/{e.name}.h": element_header(e) for e in elements()}
    return {**texts, f"{folder}/all.h": list_header(elements())}
