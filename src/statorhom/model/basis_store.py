"""Reduced bases kept in a folder, by the content of all that decides them: runs and processes share them.

A file is written whole under its final name, and two processes that build the same basis write the same content, so
that the last one may win. A file that is damaged or of another shape is as good as none.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.local_basis import LocalBasis, RoomBasis
from statorhom.model.reduced import MaterialBox, ReducedHarmonic
from statorhom.model.residual_norm import ResidualNorm
from statorhom.model.space import Space
from statorhom.study.atomic import write_bytes

FORMAT = 4  # raised when the same inputs shall give another basis
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
_ARRAYS = ("turn", "stiffness", "mass", "factor", "scales", "numbers")  # of every room


def basis_key(mesh: PartMesh, harmonic: Space, box: MaterialBox, highest_hz: float, tolerance: float) -> str:
    """SHA-256 of everything that a reduced harmonic depends on, in hexadecimal."""
    digest = hashlib.sha256()
    parts = {field.name: getattr(mesh, field.name) for field in fields(mesh)}
    of_mesh = {name: part for name, part in parts.items() if not isinstance(part, np.ndarray)}
    words = (FORMAT, mesh.axes, sorted(of_mesh.items()), harmonic.order, harmonic.parity, harmonic.axial)
    entries = {region: found.tolist() for region, found in box.span.entries.items()}
    digest.update(
        repr(
            (
                *words,
                box.span.regions,
                box.span.groups,
                entries,
                _rooms(box),
                float(highest_hz),
                float(tolerance),
            )
        ).encode()
    )
    arrays = [part for _, part in sorted(parts.items()) if isinstance(part, np.ndarray)]
    for cell in box.training:
        arrays += [array for point in cell for array in (point.hooke, point.density)]
    for array in arrays:
        digest.update(repr((array.dtype.str, array.shape)).encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def _rooms(box: MaterialBox) -> list[tuple[tuple[int, ...], ...]]:
    return [rooms.members for rooms in box.rooms]


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
            content[f"basis_{i}"] = cell.basis
            for j, room in enumerate(cell.rooms):
                parts = (*room.arrays, np.array([room.residual.dropped, room.error]))
                content |= {f"{name}_{i}_{j}": part for name, part in zip(_ARRAYS, parts, strict=True)}
        file = io.BytesIO()
        np.savez(file, allow_pickle=False, **content)
        write_bytes(self.path(key), file.getvalue())

    def read(self, key: str, harmonic: Space, box: MaterialBox, highest_hz: float) -> ReducedHarmonic | None:
        """The reduced harmonic of a key; None where there is none that is sound."""
        try:
            with self.path(key).open("rb") as stream, np.load(stream, allow_pickle=False) as file:
                cells = tuple(
                    _cell(file, i, len(rooms.members), harmonic, box) for i, rooms in enumerate(box.rooms)
                )
        except _DAMAGED:
            return None
        return ReducedHarmonic(harmonic, cells, highest_hz)


def _cell(
    file: Mapping[str, np.ndarray], number: int, rooms: int, harmonic: Space, box: MaterialBox
) -> LocalBasis:
    """The basis of a cell; ValueError if it is none."""
    basis = file[f"basis_{number}"]
    _check([basis], [(harmonic.size, basis.shape[-1])], [np.float64])
    found = []
    for room in range(rooms):
        arrays = [file[f"{name}_{number}_{room}"] for name in _ARRAYS]
        found.append(_room(arrays, basis.shape[1], box))
    return LocalBasis(basis, tuple(found))


def _room(arrays: list[np.ndarray], cell_size: int, box: MaterialBox) -> RoomBasis:
    """The basis of a room from its arrays; ValueError if they are not what such a basis consists of."""
    turn, stiffness, mass, factor, scales, numbers = arrays
    k, s, regions = turn.shape[-1], box.span.size, len(box.span.regions)
    terms = s + regions
    shapes = [(cell_size, k), (s, k, k), (regions, k, k), (terms, *factor.shape[1:2], k), (terms,), (2,)]
    _check(arrays, shapes, [np.float64] * 3 + [np.float32] + [np.float64] * 2)
    residual = ResidualNorm(factor, scales, float(numbers[0]))
    return RoomBasis(turn, stiffness, mass, residual, float(numbers[1]))


def _check(arrays: list[np.ndarray], shapes: list[tuple[int, ...]], kinds: Sequence[type]) -> None:
    """Raise a ValueError unless the arrays have these shapes and types and only numbers; nobody may write to them."""
    sound = (
        [a.shape for a in arrays] == shapes
        and [a.dtype for a in arrays] == kinds
        and all(np.isfinite(a).all() for a in arrays)
    )
    if not sound:
        raise ValueError("not a reduced basis")
    for array in arrays:
        array.setflags(write=False)
