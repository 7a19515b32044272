"""The files that users write: study, geometry and modal tables."""

from statorhom.study.geometry_file import GeometryFile, read_geometry
from statorhom.study.modal_table import MeasuredMode, ModalTable, read_modal_table
from statorhom.study.study import StudyFiles, load_study
from statorhom.study.study_file import StudyFile

__all__ = [
    "GeometryFile",
    "MeasuredMode",
    "ModalTable",
    "StudyFile",
    "StudyFiles",
    "load_study",
    "read_geometry",
    "read_modal_table",
]
