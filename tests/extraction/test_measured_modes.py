"""From the recordings of a test to its named modes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from ring_recording import MODES, write_recording
from statorhom.errors import RecordingError
from statorhom.extraction.measured_modes import MeasuredModes, measured_modes
from statorhom.extraction.modal_table_text import modal_table, table_text
from statorhom.study.modal_table import read_modal_table

DOUBLET = ((2, 0, 3090.0, 0.004, 0.3), (2, 0, 3120.0, 0.004, 0.3 + np.pi / 4))


@pytest.fixture(scope="module")
def ring(tmp_path_factory: pytest.TempPathFactory) -> MeasuredModes:
    return measured_modes([write_recording(tmp_path_factory.mktemp("ring") / "ring.uff")])


def test_modes_are_found_with_their_names(ring: MeasuredModes) -> None:
    assert [(one.order, one.axial) for one in ring.modes] == [(r, n) for r, n, *_ in MODES]
    for one, (_, _, frequency, loss, angle) in zip(ring.modes, MODES, strict=True):
        assert one.mode.frequency_hz == pytest.approx(frequency, rel=1e-4)
        assert one.mode.loss_factor == pytest.approx(loss, rel=0.03)
        assert one.features is not None and one.features.antinode is not None
        assert one.features.antinode.angle_rad % (np.pi / 2) == pytest.approx(angle, abs=0.01)


def test_linear_modes_raise_no_hint(ring: MeasuredModes) -> None:
    assert [one.hints.remarkable for one in ring.modes if one.hints] == [False, False]
    assert not [remark for remark in ring.remarks if "linear" in remark]


def test_a_split_doublet_is_a_pair(tmp_path: Path) -> None:
    found = measured_modes([write_recording(tmp_path / "ring.uff", DOUBLET)])
    assert [one.mode.frequency_hz for one in found.modes] == pytest.approx([3090.0, 3120.0], rel=1e-4)
    (pair,) = found.doublets
    assert (pair.order, pair.axial) == (2, 0)
    assert pair.rotation_rad == pytest.approx(pair.ideal_rotation_rad, rel=0.02)


def test_the_table_is_one_that_the_program_reads(ring: MeasuredModes, tmp_path: Path) -> None:
    path = tmp_path / "modes.csv"
    table = modal_table(ring, path)
    path.write_text(table_text(table, ["two\nlines"]), encoding="utf-8")
    assert path.read_text(encoding="utf-8").startswith("# two lines\n")
    again = read_modal_table(path)
    assert [(m.order, m.axial, m.label) for m in again.modes] == [(2, 0, "1"), (2, 1, "2")]
    for one, mode in zip(ring.modes, again.modes, strict=True):
        assert mode.frequency_hz == pytest.approx(one.mode.frequency_hz, rel=1e-8)
        assert mode.frequency_sd_hz == pytest.approx(one.mode.frequency_sd_hz, rel=1e-8)


def test_shapes_without_measurements_are_refused(tmp_path: Path) -> None:
    from statorhom.recordings.mode_shape import ModeShape
    from statorhom.recordings.recording import Recording
    from statorhom.recordings.uff.writer import write_uff

    shape = ModeShape(100.0, 0.01, (1,), np.ones((1, 3), dtype=complex))
    write_uff(tmp_path / "shapes.uff", Recording("shapes", shapes=(shape,)))
    with pytest.raises(RecordingError, match=r"shapes\.uff: holds neither FRFs nor hits"):
        measured_modes([tmp_path / "shapes.uff"])
