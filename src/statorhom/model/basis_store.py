"""Reduced bases kept in a folder, by the content of all that decides them: runs and processes share them.

A file is written whole under its final name, and two processes that build the same basis write the same content, so
that the last one may win. A file that is damaged or of another shape is as good as none.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
import zlib
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.local_basis import LocalBasis
from statorhom.model.reduced import MaterialBox, ReducedHarmonic
from statorhom.model.residual_norm import ResidualNorm
from statorhom.model.space import Space
from statorhom.study.atomic import write_bytes

FORMAT = 2  # raised when the same inputs shall give another basis
_DAMAGED = (
    OSError,
    ValueError,
    KeyError,
    EOFError,
    TypeError,
    AttributeError,
    zipfile.BadZipFile,
    zlib.error,
)
_ARRAYS = ("basis", "stiffness", "mass", "factor", "scales", "numbers")


def basis_key(mesh: PartMesh, harmonic: Space, box: MaterialBox, highest_hz: float, tolerance: float) -> str:
    """SHA-256 of everything that a reduced harmonic depends on, in hexadecimal."""
    digest = hashlib.sha256()
    parts = {field.name: getattr(mesh, field.name) for field in fields(mesh)}
    of_mesh = {name: part for name, part in parts.items() if not isinstance(part, np.ndarray)}
    words = (FORMAT, mesh.axes, sorted(of_mesh.items()), harmonic.order, harmonic.parity, harmonic.axial)
    entries = {region: found.tolist() for region, found in box.span.entries.items()}
    digest.update(
        repr(
            (*words, box.span.regions, box.span.groups, entries, float(highest_hz), float(tolerance))
        ).encode()
    )
    arrays = [part for _, part in sorted(parts.items()) if isinstance(part, np.ndarray)]
    for cell in box.training:
        arrays += [array for point in cell for array in (point.hooke, point.density)]
    for array in arrays:
        digest.update(repr((array.dtype.str, array.shape)).encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


@dataclass(frozen=True)
class BasisStore:
    """Reduced harmonics in a folder.

    Parameters
    ----------
    folder : made with the first basis.
    """

    folder: Path

    def path(self, key: str) -> Path:
        """File of a key."""
        return self.folder / f"{key}.npz"

    def write(self, key: str, reduced: ReducedHarmonic) -> None:
        """Keep a reduced harmonic.

        Raises
        ------
        ResultsError
            If the folder cannot be written.
        """
        content: dict[str, np.ndarray] = {}
        for i, cell in enumerate(reduced.cells):
            parts = (
                cell.basis,
                cell.stiffness,
                cell.mass,
                cell.residual.factor,
                cell.residual.scales,
                np.array([cell.residual.dropped, cell.error]),
            )
            content |= {f"{name}_{i}": part for name, part in zip(_ARRAYS, parts, strict=True)}
        file = io.BytesIO()
        np.savez(file, allow_pickle=False, **content)
        write_bytes(self.path(key), file.getvalue())

    def read(self, key: str, harmonic: Space, box: MaterialBox, highest_hz: float) -> ReducedHarmonic | None:
        """The reduced harmonic of a key; None where there is none that is sound."""
        try:
            with self.path(key).open("rb") as stream, np.load(stream, allow_pickle=False) as file:
                cells = tuple(
                    _cell([file[f"{name}_{i}"] for name in _ARRAYS], harmonic, box)
                    for i in range(len(box.training))
                )
        except _DAMAGED:
            return None
        return ReducedHarmonic(harmonic, cells, highest_hz)


def _cell(arrays: list[np.ndarray], harmonic: Space, box: MaterialBox) -> LocalBasis:
    """A basis from its arrays.

    Raises
    ------
    ValueError
        If they are not what such a basis consists of.
    """
    basis, stiffness, mass, factor, scales, numbers = arrays
    k, s, regions = basis.shape[-1], box.span.size, len(box.span.regions)
    shapes = ((harmonic.size, k), (s, k, k), (regions, k, k), (s + regions, *factor.shape[1:2], k))
    sound = (
        [a.shape for a in (basis, stiffness, mass, factor)] == list(shapes)
        and scales.shape == (s + regions,)
        and numbers.shape == (2,)
        and [a.dtype for a in arrays] == [np.float64] * 3 + [np.float32] + [np.float64] * 2
        and all(np.isfinite(a).all() for a in arrays)
    )
    if not sound:
        raise ValueError("not a reduced basis")
    for array in arrays:
        array.setflags(write=False)
    return LocalBasis(
        basis, stiffness, mass, ResidualNorm(factor, scales, float(numbers[0])), float(numbers[1])
    )
