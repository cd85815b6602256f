"""Strains and stresses of F and P = dW/dF, and what is taken of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def transposed(A: Floats) -> Floats:
    """A^T of tensors (..., 3, 3)."""
    return np.swapaxes(A, -1, -2)


def symmetric(A: Floats) -> Floats:
    """(A + A^T) / 2 of tensors (..., 3, 3)."""
    return 0.5 * (A + transposed(A))


def determinant(F: Floats) -> Floats:
    """Det F of tensors (..., 3, 3)."""
    return np.asarray(np.einsum("...i,...i", F[..., 0], np.cross(F[..., 1], F[..., 2])))


def cofactors(F: Floats) -> Floats:
    """Det F F^-T of tensors (..., 3, 3)."""
    a, b, c = F[..., 0], F[..., 1], F[..., 2]
    return np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-1)


def green_strain(F: Floats) -> Floats:
    """E = (F^T F - I) / 2."""
    return 0.5 * (transposed(F) @ F - np.eye(3))


def cauchy_stress(F: Floats, P: Floats) -> Floats:
    """Sigma = P F^T / det F [Pa]; its symmetric part, of laws that see rotations."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return symmetric(P @ transposed(F)) / determinant(F)[..., None, None]


def second_stress(F: Floats, P: Floats) -> Floats:
    """S = F^-1 P [Pa]; its symmetric part, of laws that see rotations."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return symmetric(transposed(cofactors(F)) @ P) / determinant(F)[..., None, None]


def von_mises(sigma: Floats) -> Floats:
    """sqrt(3/2 s : s) with s the deviator of sigma [Pa]; nan of a stress that is not finite."""
    finite = np.isfinite(sigma).all(axis=(-1, -2), keepdims=True)
    known = np.where(finite, sigma, np.nan)  # a cell without volume has an infinite stress
    mean = np.einsum("...ii", known)[..., None, None] / 3.0
    deviator = known - mean * np.eye(3)
    return np.asarray(np.sqrt(1.5 * np.einsum("...ij,...ij", deviator, deviator)))


def principal_values(A: Floats) -> Floats:
    """Eigenvalues (..., 3) of symmetric tensors, the largest first."""
    known = np.isfinite(A).all(axis=(-1, -2))
    values = np.full(A.shape[:-1], np.nan)
    values[known] = np.linalg.eigvalsh(A[known])[..., ::-1]
    return values
