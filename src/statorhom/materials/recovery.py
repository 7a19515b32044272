"""Check that a Hooke matrix really has the symmetry its constants were read with."""

from __future__ import annotations

import numpy as np

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke

_TOLERANCE = 1e-6


def check_recovered(symmetry: str, given: Hooke, rebuilt: Hooke) -> None:
    """Refuse a matrix that its own engineering constants do not give back.

    The deviation is measured in units of the geometric mean of the two diagonal entries, so that a
    stiff direction does not hide an error in a soft one.

    Raises
    ------
    MaterialError
        The matrix has not the symmetry.
    """
    diagonal = np.sqrt(np.diag(rebuilt.matrix))
    deviation = np.abs(given.matrix - rebuilt.matrix) / np.outer(diagonal, diagonal)
    if deviation.max() > _TOLERANCE:
        row, column = np.unravel_index(np.argmax(deviation), deviation.shape)
        raise MaterialError(
            f"Hooke matrix: is not {symmetry.replace('_', ' ')}, "
            f"C{row + 1}{column + 1} = {given.matrix[row, column]:.6g} Pa"
            f" should be {rebuilt.matrix[row, column]:.6g} Pa"
        )
