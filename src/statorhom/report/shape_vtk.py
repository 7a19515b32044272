"""A measured mode shape in motion as a series of VTK files, for ParaView and its like."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.errors import MissingDependencyError
from statorhom.modes.measured_shape import MeasuredShape
from statorhom.report.figures.ring_motion import RingMotion, at_phase

_FRAMES = 24
_LONGEST_NAME = 60


def write_vtk_series(shape: MeasuredShape, directory: Path, name: str) -> Path:
    """Write one period of a shape's motion: `NAME-00.vtp` …, and `NAME.pvd` that lists them.

    Parameters
    ----------
    shape : MeasuredShape
        Complex motion; its missing points are left out.
    directory : Path
        Folder to write into; it is made where it is missing.
    name : str
        Name of the mode; letters that file names should not have become dashes.

    Returns
    -------
    Path
        The .pvd file.

    Raises
    ------
    MissingDependencyError
        Without pyvista.
    IdentificationError
        When the points do not show circumferential orders.
    """
    try:
        import pyvista
    except ImportError as error:
        raise MissingDependencyError(
            "VTK files need pyvista, which is not installed: pip install 'statorhom[vtk]'"
        ) from error
    motion, stem = RingMotion.of(shape), file_stem(name)
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for step in range(_FRAMES):
        files.append(f"{stem}-{step:02d}.vtp")
        _frame(pyvista, motion, motion.phase + 2 * np.pi * step / _FRAMES).save(directory / files[-1])
    series = directory / f"{stem}.pvd"
    rows = "".join(
        f'<DataSet timestep="{step / _FRAMES:.6f}" file="{file}"/>' for step, file in enumerate(files)
    )
    series.write_text(
        f'<?xml version="1.0"?><VTKFile type="Collection"><Collection>{rows}</Collection></VTKFile>\n',
        encoding="utf-8",
    )
    return series


def file_stem(name: str) -> str:
    """A name as a file may bear it: letters, digits, dashes and dots inside, nothing else."""
    stem = re.sub(r"[^A-Za-z0-9.]+", "-", name)[:_LONGEST_NAME].strip("-.")
    return stem or "shape"


def _frame(pyvista: Any, motion: RingMotion, phase: float) -> Any:
    """Deformed points with the faces between them; `radial` is the drawn radial motion over the radius."""
    places = motion.places(phase)
    present = np.isfinite(places).all(axis=-1)
    number = np.where(present, np.cumsum(present).reshape(present.shape) - 1, -1)
    corners = np.stack([number, np.roll(number, -1, axis=1)], axis=-1)
    quads = np.concatenate([corners[:-1], corners[1:, :, ::-1]], axis=-1).reshape(-1, 4)
    quads = quads[(quads >= 0).all(axis=1)]
    points = motion.radius_m * places[present]
    if len(quads):
        faces = np.column_stack([np.full(len(quads), 4), quads]).ravel()
        body = pyvista.PolyData(points, faces=faces)
    else:
        edges = corners.reshape(-1, 2)
        edges = edges[(edges >= 0).all(axis=1)]
        body = pyvista.PolyData(points, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())
    body.point_data["radial"] = at_phase(motion.points[0], phase)[present]
    return body
