"""Shapes of a stage's simulated modes, `shapes/<stage>.npz`: what the report's pictures are drawn from.

A mode of a free stator is stored on half a slot pitch with its harmonic; a mode of a supported one is a sum
of harmonics and stored on the nodes of the whole surface (`full_surface`). A block's is stored on the part that its
planes of symmetry leave.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.errors import ResultsError
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.results.full_surface import FullSurface, expand_cyclic, expand_mirrored, full_surface
from statorhom.study.atomic import write_bytes
from statorhom.study.message import one_line

FORMAT = 1
_UNKNOWN = -1  # stands for None in arrays of integers
_DAMAGED = (OSError, ValueError, KeyError, IndexError, TypeError, EOFError, zipfile.BadZipFile, zlib.error)


@dataclass(frozen=True)
class ModeShape:
    """One simulated mode.

    Parameters
    ----------
    frequency_hz : float
    displacement : ndarray
        (n, 3) complex cylindrical components of the half pitch's nodes where `harmonic` is given, else
        (f, 3) real ones of the nodes of `full_surface(mesh)`. Any scale.
    harmonic : int or None
        Circumferential harmonic h of a free stator's mode; None for a sum of harmonics. Parities of a block's mode.
    parity : str
        "pair", "even" or "odd" ("" for a sum of harmonics); "mirror" for a block's mode.
    order, axial : int or None
        Name (r, n).
    kind : str
    share : float
        Part of the radial mean square that is of order r.
    spectrum : ndarray, shape (planes, orders)
        Signed (real) or complex amplitudes of the radial motion's orders 0, 1, … in every plane.
    """

    frequency_hz: float
    displacement: np.ndarray
    harmonic: int | None
    parity: str
    order: int | None
    axial: int | None
    kind: str
    share: float
    spectrum: np.ndarray

    def __post_init__(self) -> None:
        self.displacement.setflags(write=False)
        self.spectrum.setflags(write=False)


@dataclass(frozen=True)
class ShapeFile:
    """A stage's mesh and mode shapes.

    Parameters
    ----------
    mesh : HalfPitchMesh or MirrorMesh
    planes_m : ndarray, shape (planes,)
        Axial positions of the planes of every mode's order spectrum; none of a block.
    modes : tuple of ModeShape
        `ModeResult.shape` counts them from 0.
    """

    mesh: HalfPitchMesh | MirrorMesh
    planes_m: np.ndarray
    modes: tuple[ModeShape, ...]

    def __post_init__(self) -> None:
        self.planes_m.setflags(write=False)

    def displacement(self, surface: FullSurface, mode: ModeShape) -> np.ndarray:
        """Real displacement (f, 3) of a mode on the nodes of `full_surface(self.mesh)`, in the mesh's axes."""
        if mode.harmonic is None:
            return mode.displacement
        if isinstance(self.mesh, MirrorMesh):
            return expand_mirrored(surface, self.mesh, mode.harmonic, mode.displacement)
        return expand_cyclic(surface, self.mesh.slots, mode.harmonic, mode.displacement)


def write_shape_file(path: Path, shapes: ShapeFile) -> Path:
    """Write a shape file atomically.

    Raises
    ------
    ResultsError
        Where it cannot be written; an existing file is then untouched.
    """
    buffer = io.BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **_mesh_arrays(shapes.mesh), **_mode_arrays(shapes))
    write_bytes(path, buffer.getvalue())
    return path


def read_shape_file(path: Path) -> ShapeFile:
    """Read a shape file.

    Raises
    ------
    ResultsError
        If it is missing or damaged.
    """
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            shapes = _shape_file(arrays)
    except FileNotFoundError:
        raise ResultsError(one_line(f"{path}: there is no such file; run the study again")) from None
    except _DAMAGED as error:
        reason = str(error) or type(error).__name__
        raise ResultsError(
            one_line(f"{path}: the file is damaged ({reason}); delete it and run the study again")
        ) from None
    return shapes


def _mesh_arrays(mesh: HalfPitchMesh | MirrorMesh) -> dict[str, Any]:
    common = {
        "format": FORMAT,
        "nodes": mesh.nodes,
        "elements": mesh.elements.astype(np.int32),
        "region": mesh.region.astype(np.int16),
        "regions": np.array(mesh.regions, dtype=np.str_),
    }
    if isinstance(mesh, MirrorMesh):
        axes, positions = zip(*mesh.mirrors, strict=True) if mesh.mirrors else ((), ())
        return {
            **common,
            "mirror_axes": np.array(axes, dtype=np.int32),
            "mirror_positions": np.array(positions, dtype=float),
        }
    return {
        **common,
        "slots": mesh.slots,
        "length": mesh.length,
        "outer_radius": mesh.outer_radius,
        "tooth_plane": mesh.tooth_plane.astype(np.int32),
        "slot_plane": mesh.slot_plane.astype(np.int32),
    }


def _mode_arrays(shapes: ShapeFile) -> dict[str, Any]:
    modes = shapes.modes
    cyclic = [m.displacement for m in modes if m.harmonic is not None]
    summed = [m.displacement for m in modes if m.harmonic is None]
    planes = len(shapes.planes_m)
    return {
        "planes_m": np.asarray(shapes.planes_m, dtype=float),
        "frequency_hz": np.array([m.frequency_hz for m in modes], dtype=float),
        "harmonic": _integers([m.harmonic for m in modes]),
        "order": _integers([m.order for m in modes]),
        "axial": _integers([m.axial for m in modes]),
        "parity": np.array([m.parity for m in modes], dtype=np.str_),
        "kind": np.array([m.kind for m in modes], dtype=np.str_),
        "share": np.array([m.share for m in modes], dtype=float),
        "displacement": _stacked(cyclic, np.complex64, (0, 3)),
        "full_displacement": _stacked(summed, np.float32, (0, 3)),
        "spectrum": _stacked([m.spectrum for m in modes], np.complex64, (planes, 0)),
    }


def _stacked(arrays: list[np.ndarray], kind: type, empty: tuple[int, int]) -> np.ndarray:
    return np.array(arrays, dtype=kind) if arrays else np.zeros((0, *empty), dtype=kind)


def _integers(values: list[int | None]) -> np.ndarray:
    return np.array([_UNKNOWN if value is None else value for value in values], dtype=np.int32)


def _shape_file(arrays: Mapping[str, np.ndarray]) -> ShapeFile:
    version = int(arrays["format"])
    if version != FORMAT:
        raise ValueError(f"format {version} instead of {FORMAT}")
    mesh = _mesh(arrays)
    return ShapeFile(mesh, np.array(arrays["planes_m"], dtype=float), _modes(arrays, mesh))


def _mesh(arrays: Mapping[str, np.ndarray]) -> HalfPitchMesh | MirrorMesh:
    mesh = _block(arrays) if "mirror_axes" in arrays else _half_pitch(arrays)
    _check_mesh(mesh)
    return mesh


def _block(arrays: Mapping[str, np.ndarray]) -> MirrorMesh:
    axes, positions = arrays["mirror_axes"], arrays["mirror_positions"]
    if len(set(axes.tolist())) < len(axes) or not _within(axes, 3) or not np.isfinite(positions).all():
        raise ValueError("its planes of symmetry contradict each other")
    mirrors = tuple((int(a), float(p)) for a, p in zip(axes, positions, strict=True))
    return MirrorMesh(*_elements(arrays), mirrors=mirrors)


def _elements(
    arrays: Mapping[str, np.ndarray],
) -> tuple[np.ndarray, np.ndarray, np.ndarray, tuple[str, ...]]:
    regions = tuple(str(name) for name in arrays["regions"])
    return arrays["nodes"], arrays["elements"].astype(np.int64), arrays["region"].astype(np.int64), regions


def _half_pitch(arrays: Mapping[str, np.ndarray]) -> HalfPitchMesh:
    return HalfPitchMesh(
        *_elements(arrays),
        slots=int(arrays["slots"]),
        length=float(arrays["length"]),
        outer_radius=float(arrays["outer_radius"]),
        tooth_plane=arrays["tooth_plane"].astype(np.int64),
        slot_plane=arrays["slot_plane"].astype(np.int64),
    )


def _check_mesh(mesh: HalfPitchMesh | MirrorMesh) -> None:
    n = len(mesh.nodes)
    round_ = isinstance(mesh, MirrorMesh) or (
        _within(mesh.tooth_plane, n)
        and _within(mesh.slot_plane, n)
        and mesh.slots > 0
        and np.isfinite([mesh.length, mesh.outer_radius]).all()
    )
    whole = (
        round_
        and mesh.nodes.shape == (n, 3)
        and np.isfinite(mesh.nodes).all()
        and mesh.elements.shape == (len(mesh.region), 20)
        and len(mesh.region) > 0
        and _within(mesh.elements, n)
        and _within(mesh.region, len(mesh.regions))
    )
    if not whole:
        raise ValueError("its mesh contradicts itself")


def _within(numbers: np.ndarray, count: int) -> bool:
    return bool(np.all((numbers >= 0) & (numbers < count)))


def _modes(arrays: Mapping[str, np.ndarray], mesh: HalfPitchMesh | MirrorMesh) -> tuple[ModeShape, ...]:
    cyclic, summed = arrays["displacement"], arrays["full_displacement"]
    spectrum, harmonic = arrays["spectrum"], arrays["harmonic"]
    _check_modes(cyclic, summed, spectrum, harmonic, arrays["planes_m"], mesh)
    # a mode's row among those of its own kind
    row = np.where(harmonic >= 0, np.cumsum(harmonic >= 0), np.cumsum(harmonic < 0)) - 1
    columns = [arrays[key] for key in ("frequency_hz", "order", "axial", "parity", "kind", "share")]
    modes = []
    for i, (frequency, order, axial, parity, kind, share) in enumerate(zip(*columns, strict=True)):
        h = _number(harmonic[i])
        shape = summed[row[i]] if h is None else cyclic[row[i]]
        modes.append(
            ModeShape(
                float(frequency), shape.copy(), h, str(parity), _number(order), _number(axial), str(kind),
                float(share), spectrum[i].copy(),
            )
        )  # fmt: skip
    return tuple(modes)


def _check_modes(
    cyclic: np.ndarray,
    summed: np.ndarray,
    spectrum: np.ndarray,
    harmonic: np.ndarray,
    planes: np.ndarray,
    mesh: HalfPitchMesh | MirrorMesh,
) -> None:
    count = int(np.count_nonzero(harmonic >= 0)), int(np.count_nonzero(harmonic < 0))
    whole = (
        (len(cyclic), len(summed)) == count
        and spectrum.shape[:2] == (len(harmonic), len(planes))
        and (not count[0] or cyclic.shape[1:] == mesh.nodes.shape)
        and (not count[1] or summed.shape[1:] == full_surface(mesh).nodes.shape)
        and all(np.isfinite(array).all() for array in (cyclic, summed, spectrum, planes))
    )
    if not whole:
        raise ValueError("its modes do not fit its mesh")


def _number(value: np.integer[Any]) -> int | None:
    return None if value == _UNKNOWN else int(value)
