"""The geometry of whatever a study is of: a stator, a plate, a beam, a tube or a wing."""

from __future__ import annotations

from pathlib import Path

from statorhom.geometry.block import BlockGeometry
from statorhom.geometry.stator import StatorGeometry, StepGeometry, stator_geometry
from statorhom.geometry.tube import TubeGeometry, tube_geometry
from statorhom.geometry.wing import WingGeometry
from statorhom.geometry.wing_of_file import wing_of_file
from statorhom.study.coupon_file import BeamFile, PlateFile, TubeFile
from statorhom.study.message import one_line
from statorhom.study.object_file import ObjectFile
from statorhom.study.wing_file import WingFile

# whose modes have names (r, n)
RingGeometry = StatorGeometry | TubeGeometry
ObjectGeometry = RingGeometry | BlockGeometry | WingGeometry
# as it stands after some step
ObjectStep = StepGeometry | BlockGeometry | WingGeometry


def object_geometry(file: ObjectFile, path: Path) -> ObjectGeometry:
    """Build the geometry that a file describes.

    Raises
    ------
    GeometryError
        If it is impossible; the message names the two keys that contradict each other.
    """
    where = one_line(str(path))
    match file:
        case PlateFile(plate=p):
            return BlockGeometry("plate", (p.length_mm / 1e3, p.width_mm / 1e3, p.thickness_mm / 1e3), where)
        case BeamFile(beam=b):
            return BlockGeometry("beam", (b.length_mm / 1e3, b.width_mm / 1e3, b.height_mm / 1e3), where)
        case TubeFile(tube=t):
            return tube_geometry(t, where)
        case WingFile(wing=w):
            return wing_of_file(w, where)
        case _:
            return stator_geometry(file, path)
