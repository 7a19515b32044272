"""Any recording, whatever its format: the contents of a file decide, not its ending."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from statorhom.recordings.array_frf import NAMES, frfs_of_arrays
from statorhom.recordings.csv_frf import read_csv_frfs
from statorhom.recordings.csv_hit import FORCE, read_csv_hit
from statorhom.recordings.frf_groups import Frf, frf_sets, single_frfs
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hdf5_file import read_hdf5_arrays
from statorhom.recordings.mat_file import read_mat_arrays
from statorhom.recordings.message import recording_error
from statorhom.recordings.number_table import NumberTable
from statorhom.recordings.placement import Placement
from statorhom.recordings.recording import Recording
from statorhom.recordings.uff.reader import read_uff
from statorhom.recordings.wav_hit import read_wav_hit

# MAT files of version 7.3 are HDF5 with a head of their own
_HDF5_SIGNATURES = (b"\x89HDF\r\n\x1a\n", b"MATLAB 7.3 MAT-file")
_MAT_SIGNATURE = b"MATLAB 5.0 MAT-file"
_WAV_SIGNATURES = (b"RIFF", b"RIFX", b"RF64")
_UNIVERSAL_ENDINGS = (".uff", ".unv", ".uf", ".bunv")
_HEAD = 64


# what overflows in a damaged file is found by what is not finite afterwards
@np.errstate(over="ignore", invalid="ignore")
def read_recording(paths: Sequence[Path], placement: Placement | None = None) -> Recording:
    """Read the files of one test: universal files, CSV, HDF5, MAT, WAV.

    Parameters
    ----------
    paths : sequence of Path
        At least one. Hits of several files are numbered through.
    placement : Placement, optional
        Points, direction and scales of files that carry none.

    Returns
    -------
    Recording

    Raises
    ------
    RecordingError, InputFileError, MissingDependencyError
        One line with file, place and remedy; also where the files hold neither FRFs, hits nor shapes.
    """
    placement = placement or Placement()
    parts = [_read(Path(path), placement) for path in paths]
    hits = [hit for part in parts for hit in part.hits]
    if len(parts) > 1:
        hits = [replace(hit, number=number) for number, hit in enumerate(hits, start=1)]
    sets, regrouped = _one_set_per_axis(paths, parts)
    whole = Recording(
        name=parts[0].name,
        frf_sets=sets,
        hits=tuple(hits),
        shapes=tuple(shape for part in parts for shape in part.shapes),
        nodes=tuple(node for part in parts for node in part.nodes),
        trace_lines=tuple(line for part in parts for line in part.trace_lines),
        remarks=(*(remark for part in parts for remark in part.remarks), *regrouped),
    )
    if not (whole.frf_sets or whole.hits or whole.shapes):
        because = f" ({'; '.join(whole.remarks)})" if whole.remarks else ""
        raise recording_error(
            paths[0], "", f"holds no FRF, hit or mode shape{because}", "export FRFs or time records"
        )
    return whole


def _one_set_per_axis(
    paths: Sequence[Path], parts: Sequence[Recording]
) -> tuple[tuple[FrfSet, ...], tuple[str, ...]]:
    """FRFs of several files brought together where they share their frequencies."""
    if len(parts) == 1:
        return parts[0].frf_sets, ()
    frfs = [frf for part in parts for frf_set in part.frf_sets for frf in single_frfs(frf_set)]
    return frf_sets(frfs, f"{paths[0]} and {len(paths) - 1} more")


def _read(path: Path, placement: Placement) -> Recording:
    head = _head(path)
    if head.startswith(_HDF5_SIGNATURES):
        return _of_frfs(path, frfs_of_arrays(path, read_hdf5_arrays(path, NAMES)))
    if head.startswith(_MAT_SIGNATURE) or path.suffix.lower() == ".mat":
        return _of_frfs(path, frfs_of_arrays(path, read_mat_arrays(path, NAMES)))
    if head.startswith(_WAV_SIGNATURES):
        return Recording(path.stem, hits=(read_wav_hit(path, placement, number=1),))
    is_universal = head.removeprefix(b"\xef\xbb\xbf").split(maxsplit=1)[:1] == [b"-1"]
    if is_universal or path.suffix.lower() in _UNIVERSAL_ENDINGS:
        return read_uff(path)
    table = NumberTable(path)
    if FORCE in table.columns:
        return Recording(path.stem, hits=(read_csv_hit(table, placement, number=1),))
    return _of_frfs(path, read_csv_frfs(table, placement))


def _head(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(_HEAD)
    except OSError as error:
        reason = error.strerror or "unknown reason"
        raise recording_error(
            path, "", f"cannot be read ({reason})", "check the path and permissions"
        ) from None


def _of_frfs(path: Path, frfs: list[Frf]) -> Recording:
    sets, remarks = frf_sets(frfs, str(path))
    return Recording(path.stem, frf_sets=sets, remarks=remarks)
