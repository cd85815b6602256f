"""Matrices of the equation of motion, as SciPy's sparse arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Blocks = tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]


def sparse(blocks: Blocks, rows: int) -> Any:
    """A matrix (rows, rows) in compressed rows from its 3 x 3 blocks; those of one place add up."""
    from scipy.sparse import coo_array

    block_row, block_column, values = blocks
    three = np.arange(3, dtype=np.int32)
    row = np.broadcast_to(3 * block_row[:, None, None] + three[:, None], values.shape)
    column = np.broadcast_to(3 * block_column[:, None, None] + three, values.shape)
    made = coo_array((values.ravel(), (row.ravel(), column.ravel())), shape=(rows, rows)).tocsr()
    made.eliminate_zeros()
    return made
