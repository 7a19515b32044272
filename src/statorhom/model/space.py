"""What the solvers need of an eigenvalue problem that a body's symmetry leaves, whichever symmetry it is."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import scipy.sparse as sp

MIRROR = "mirror"  # the parity of the problems of a body with mirror planes


class Space(Protocol):
    """One problem: a circumferential harmonic of a stator, a parity of a body with mirror planes.

    `order` numbers the problems of a body (several may share a number), `multiplicity` is how often each eigenvalue
    occurs in the whole body, `copies` the modal mass of the whole body over yᵀ M y.
    """

    @property
    def order(self) -> int: ...
    @property
    def parity(self) -> str: ...
    @property
    def axial(self) -> str | None: ...
    @property
    def multiplicity(self) -> int: ...
    @property
    def copies(self) -> int: ...
    @property
    def size(self) -> int: ...
    def project(self, matrix: sp.csr_array) -> sp.csr_array: ...
    def expand(self, y: np.ndarray) -> np.ndarray: ...


class Profile(Protocol):
    """What accelerometers see of shapes: amplitudes (points, k) of shapes (3 n, k) of a problem."""

    def orders(self, space: Space, shapes: np.ndarray) -> np.ndarray: ...
