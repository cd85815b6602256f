"""The state of a simulation as arrays: fields, forces, matrices, reactions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu import units
from tissu.errors import ParameterError
from tissu.field_names import FIELD_NAMES, PLACES, FieldName, Place
from tissu.reading import names_of
from tissu.simulation.compliance import WAYS, Compliance, Way
from tissu.simulation.fields import BodyFields, IntegrationPoints
from tissu.simulation.matrices import sparse

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.mesh import Mesh
    from tissu.reading import Number
    from tissu.simulation.meshes import Meshes
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


_OF_EVERY_MODEL = ("energy_density", "volume_ratio")  # at cells; of springs too


class Inspected:
    """The part of a simulation that reads its state; a step pays for none of it."""

    _core: core.Simulation
    _world: core.World
    _meshes: Meshes
    _tissue: dict[str, Mesh]
    _positions: Mapping[str, Floats]

    def field(self, name: FieldName, at: Place = "cells", body: str | None = None) -> Floats:
        """Strain, stress or energy of a body at the present state.

        Fields are computed on request, at no cost to a step. F of sheets and lines is that of a
        volume: across the sheet or line it has the stretch for which the stress there vanishes, and
        in plane strain 1. If a law has no such stretch (StVK, far in tension), values are nan.
        Stresses are those of the law, without viscosity. For mean dilatation, F is that of the cell
        itself, and the stress is the one in the balance of forces. Corotational cells and shells
        are linear in axes that turn with them.

        Args:
            name: deformation_gradient F, green_strain E, cauchy_stress [Pa],
                first_piola_kirchhoff_stress P = dW/dF [Pa], second_piola_kirchhoff_stress F^-1 P
                [Pa]: (m, 3, 3) in axes of space; von_mises of the Cauchy stress [Pa],
                energy_density per rest volume [J/m^3], volume_ratio det F: (m,);
                principal_stresses of the Cauchy stress [Pa] and principal_strains of E: (m, 3),
                the largest first.
            at: "points": the integration points, cell after cell (see `integration_points`; those
                of shells are their top, middle and bottom); "cells": means over the cells of the
                mesh, weighted by rest volume; von Mises and principal values are those of the mean
                tensor, but von Mises of a shell, or of a sheet or line of frames, is the largest
                through its thickness; "nodes": an affine function fitted to the points of each
                cell, and at a node the mean of those around it, weighted by rest volume (Hinton
                and Campbell 1974).
            body: its name; absent: the only one there is.

        Raises:
            ParameterError: no such field, place or body; a body with a model that has no stress;
                nodes of a tissue, which has no cells. Springs have energy_density and
                volume_ratio at cells.
        """
        return self.fields([name], at, body)[name]

    def fields(
        self, names: Sequence[str], at: Place = "cells", body: str | None = None
    ) -> dict[str, Floats]:
        """Several fields at once: see `field`. Common intermediate results are computed once.

        Raises:
            ParameterError: see `field`.
        """
        body, names = self._the_body(body), names_of(names, "fields")
        for what, given, words in (
            *(("field", name, FIELD_NAMES) for name in names),
            ("place", at, PLACES),
        ):
            if given not in words:
                raise ParameterError(f"found the {what} '{given}'; accepted: {', '.join(words)}")
        if at == "cells" and set(names) <= set(_OF_EVERY_MODEL):
            known = self.cell_fields(body)
            return {name: known[name] for name in names}
        fields = self._fields(body)
        if at == "points":
            return {name: fields.at_points(name) for name in names}
        if at == "cells":
            return {name: fields.at_cells(name) for name in names}
        if body in self._tissue:
            raise ParameterError(
                f"found nodes of tissue '{body}', which has points and no cells; points and cells "
                "are accepted"
            )
        rest = self._meshes[body].points
        return {name: fields.at_nodes(name, rest) for name in names}

    def integration_points(self, body: str | None = None) -> IntegrationPoints:
        """Cells, rest positions and rest volumes of the points of `field(..., at="points")`.

        Raises:
            ParameterError: no such body, or a model that has no stress.
        """
        return self._fields(self._the_body(body)).points()

    def cell_fields(self, body: str) -> dict[str, Floats]:
        """Mean values over each cell of a body, in the order of its mesh's cells.

        Returns:
            von_mises: of the Cauchy stress (e,) [Pa], absent where the model of some of its cells
            has none; energy_density: per rest volume (e,) [J/m^3];
            volume_ratio: det F (e,). The same numbers as those of `field`.

        Raises:
            ParameterError: no body of that name.
        """
        self._require_body(body)
        self._core.settle()
        blocks = self._core.point_fields(body)
        if all("F" in block for block in blocks):
            fields = BodyFields(body, blocks)
            names = ("von_mises", "energy_density", "volume_ratio")
            return {name: fields.at_cells(name) for name in names}
        found = self._core.cell_fields(body)
        order = np.argsort(self._core.remaining_cells(body), kind="stable")
        return {name: values[order] for name, values in found.items()}

    def inverted_cells(self, body: str) -> Ints:
        """Numbers (k,) of the cells of a body that are inside out: somewhere, det F is not above 0.

        det F is computed at the quadrature points of volume cells, and as a mean in thin cells and
        frames. This happens only on request, and after a static step that converged, whose report
        names such cells.

        Raises:
            ParameterError: no body of that name.
        """
        self._require_body(body)
        self._core.settle()
        left = np.sort(self._core.remaining_cells(body))
        return np.searchsorted(left, self._core.inverted_cells(body)).astype(np.int32)

    def reactions(self, body: str, *, moments: bool = False) -> Floats:
        """Forces (n, 3) of supports and prescribed nodes on a body [N]; zero at free nodes.

        They are M dv/dt - f, with the change of velocity of the latest step. In equilibrium this is
        minus the sum of the elastic and external forces.

        Args:
            body: its name.
            moments: return, instead of the forces, the moments (n, 3) on nodes whose rotation is
                fixed or prescribed, about axes of space [N m]. Forces on other nodes do not
                contribute.

        Raises:
            ParameterError: no body of that name, or moments of one whose nodes have no rotation.
        """
        return self._core.reactions()[self.rows(body, rotations=moments)]

    def rows(self, body: str, *, rotations: bool = False) -> slice:
        """The rows of `forces` that belong to the nodes of a body.

        Row i has the three numbers 3 i to 3 i + 2 of the matrices.

        Args:
            body: its name.
            rotations: the rows of the rotations of its nodes instead of their positions, for frames
                and shells.

        Raises:
            ParameterError: no body of that name, or rotations of nodes that have none.
        """
        self._require_body(body)
        first, count = self._core.body_range(body)
        if rotations:
            first = self._core.first_rotation(body)
        if first < 0:
            text = f"found body '{body}', whose nodes have no rotation; those of frames have one"
            raise ParameterError(text)
        return slice(first, first + count)

    def forces(self) -> Floats:
        """Forces (r, 3) on all rows at the present state, elastic, viscous and external [N].

        Rows of rotations have moments [N m]. In equilibrium, forces on free rows are zero, and
        those on held rows are minus the reactions. See `rows`.
        """
        self._core.settle()
        return self._core.forces()

    def stiffness(self) -> Any:
        """-df/dx at the present state as a sparse array (3 r, 3 r) of SciPy [N/m].

        The matrix has all rows, held ones too. It is the tangent of Newton's method: the derivative
        of `forces`, except where a model has an approximate tangent (corotational) or a symmetric
        one (a follower pressure on an open surface, shells and frames out of balance). Rows of
        nodes that a condensed region eliminates are empty.
        """
        self._core.settle()
        return sparse(self._core.stiffness(), 3 * self._world.blocks)

    def free_axes(self) -> NDArray[np.bool_]:
        """Which axes of all rows are unknowns (r, 3): not fixed, not prescribed and not eliminated.

        `simulation.stiffness()[free][:, free]` with `free = simulation.free_axes().ravel()` is the
        matrix for a solver.
        """
        return self._core.free_axes()

    def damping(self) -> Any:
        """-df/dv at the present state as a sparse array (3 r, 3 r) of SciPy [N s/m]."""
        self._core.settle()
        return sparse(self._core.damping(), 3 * self._world.blocks)

    def mass_matrix(self) -> Any:
        """The lumped mass as a sparse array (3 r, 3 r) of SciPy [kg]; of rotations [kg m^2]."""
        return sparse(self._core.mass_matrix(), 3 * self._world.blocks)

    def compliance(  # type: ignore[misc]
        self: Simulation,
        by: Way = "factor",
        *,
        tolerance: Number = 0.01,
        bodies: Sequence[str] | None = None,
    ) -> Compliance:
        """An object that computes the compliance of points of the bodies, step after step.

        Args:
            by: "factor": with a factor of the step's matrix, which is kept, corrected, and renewed
                where corrections are not enough; "cg": with conjugate gradients, without a factor;
                "condensed": with a table of the surface's nodes, made once, for stiffness that does
                not change with the shape; "warped": with the table of the rest shape, rotated with
                its nodes.
            tolerance: largest relative error of a direction's own compliance, for factor and cg.
            bodies: those whose surfaces are in the table of condensed and warped; absent: all.

        Raises:
            ParameterError: another way; a tolerance that is not above 0; more than 1,000 nodes on
                the surfaces for condensed and warped; no body of that name.
        """
        if by not in WAYS:
            raise ParameterError(f"found the way {by!r}; accepted: {', '.join(WAYS)}")
        share = units.NUMBER(tolerance)
        if not share > 0.0:
            raise ParameterError(f"found a tolerance of {share:g}; one above 0 is accepted")
        names = None if bodies is None else names_of(bodies, "bodies")
        for body in names or ():
            self._require_body(body)
        return Compliance(simulation=self, by=by, tolerance=share, bodies=names)

    def _require_body(self, name: str) -> None:
        if name not in list(self._positions):  # of a list, which cannot be a key, too
            raise ParameterError(f"found body {name!r}; accepted: {', '.join(self._positions)}")

    def _the_body(self, name: str | None) -> str:
        """A body or tissue by its name, or the only one."""
        if name is None:
            if len(self._positions) != 1:
                found = f"found no body's name where there are {len(self._positions)} bodies"
                raise ParameterError(f"{found}; accepted: {', '.join(self._positions)}")
            return next(iter(self._positions))
        self._require_body(name)
        return name

    def _fields(self, body: str) -> BodyFields:
        self._core.settle()
        return BodyFields(body, self._core.point_fields(body))
