"""What cells keep, beside the counts of Faure's thesis (2014) and what the core measures."""

import pytest
from typer.testing import CliRunner

from tissu import _core
from tissu.cli.app import app
from tissu.cli.constants import PAPER, rows

ROWS = list(rows())
OF_PAPER = ("hooke", "stvk")  # the laws that the thesis expands
BY_NAME = [f"{row.element}-{row.law}" for row in ROWS]


def test_every_element_with_every_law_has_a_row():
    laws = [(law, dimensions) for law, _, _, addition, dimensions in _core.laws() if not addition]
    wanted = {(e, law) for e, _, m, _ in _core.elements() for law, of in laws if m in of}
    assert {(row.element, row.law) for row in ROWS} == wanted
    assert len(ROWS) == len(wanted)


@pytest.mark.parametrize("row", ROWS, ids=BY_NAME)
def test_affine_cells_keep_one_jacobian(row):
    """J^-1 (m m), the size, of a line of Hooke's law its axes: 9 + 1 + 2 at most."""
    assert row.affine.reals <= 12
    assert row.affine.reals <= row.own.reals <= row.affine.reals + row.law_constants


@pytest.mark.parametrize(
    "row", [r for r in ROWS if r.element in PAPER and r.law in OF_PAPER], ids=str
)
def test_counts_are_at_most_those_of_the_paper(row):
    """The thesis has flat triangles, tetrahedra, any pyramid, any prism, and boxes."""
    any_shape = row.element in ("pyramid", "wedge", "tetra")
    ours = row.general if any_shape else row.affine
    assert ours.reals <= PAPER[row.element]


@pytest.mark.parametrize("row", ROWS, ids=BY_NAME)
@pytest.mark.parametrize("kind", ["affine", "general", "own"])
def test_what_is_counted_is_what_is_measured(row, kind):
    """Beside the numbers, 8 bytes each: 2 for each node's place, 4 for each pair's block, and for a
    node of a chunk 4, of which a cell has its own at most; lanes that pad and constants that all
    cells share are a tenth at most, of several hundred cells."""
    storage = getattr(row, kind)
    assert storage.cells >= 216
    least = 8 * storage.reals + 2 * row.nodes + 4 * row.nodes**2
    assert least <= storage.per_cell <= 1.1 * (least + 4 * row.nodes)


def test_the_command_prints_the_table():
    result = CliRunner().invoke(app, ["info", "--constants"])
    assert result.exit_code == 0
    lines = result.output.splitlines()
    tetra = next(line.split() for line in lines if line.startswith("tetra "))
    row = next(row for row in ROWS if row.element == "tetra")
    assert tetra[1:3] == [str(row.affine.reals), str(row.general.reals)]
    assert tetra[4] == str(PAPER["tetra"])
