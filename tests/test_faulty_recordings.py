"""`statorhom modes` with faulty recordings: a clear line, or the right modes all the same."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from command import Outcome, statorhom
from ring_recording import MODES, write_recording
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.read import read_recording
from statorhom.recordings.recording import Recording
from statorhom.recordings.uff.writer import write_uff


@pytest.fixture(scope="module")
def ring(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = write_recording(tmp_path_factory.mktemp("ring") / "ring.uff")
    write_uff(path, read_recording([path]), binary=False)
    return path


def modes(path: Path) -> Outcome:
    return statorhom("modes", path, "--out", path.parent / "out", "--json")


def check(path: Path) -> str:
    """The modes are right; returns the remarks that the table keeps."""
    outcome = modes(path)
    assert outcome.code == 0, outcome.stderr
    rows = json.loads(outcome.stdout)
    assert [(row["order"], row["axial"]) for row in rows] == [(r, n) for r, n, *_ in MODES]
    for row, (_, _, frequency, loss, _) in zip(rows, MODES, strict=True):
        assert row["frequency_hz"] == pytest.approx(frequency, rel=2e-4)
        assert row["loss_factor"] == pytest.approx(loss, rel=0.05)
    table = (path.parent / "out" / "modes.csv").read_text(encoding="utf-8")
    return "\n".join(line for line in table.splitlines() if line.startswith("#"))


def refused(path: Path, *fragments: str) -> None:
    outcome = modes(path)
    assert outcome.code == 2 and outcome.stdout == ""
    assert len(outcome.stderr.splitlines()) == 1
    for fragment in (path.name, *fragments):
        assert fragment in outcome.stderr
    assert not (path.parent / "out").exists()


def rewritten(ring: Path, path: Path, **changes: object) -> Path:
    """The ring's recording with other FRFs."""
    recording = read_recording([ring])
    (frfs,) = recording.frf_sets
    write_uff(path, Recording("ring", frf_sets=(replace(frfs, **changes),), nodes=recording.nodes))
    return path


def text_of(ring: Path) -> str:
    return ring.read_text(encoding="ascii")


def blocks(text: str) -> list[str]:
    """Datasets with their delimiters."""
    return re.findall(r"    -1\n.*?\n    -1\n", text, flags=re.DOTALL)


def test_coherence_or_none_gives_the_same_modes(ring: Path, tmp_path: Path) -> None:
    (frfs,) = read_recording([ring]).frf_sets
    assert frfs.coherence is None
    check(ring)
    coherence = np.full(frfs.accelerance.shape, 0.999)
    check(rewritten(ring, tmp_path / "with.uff", coherence=coherence))


def test_lines_that_are_not_numbers_are_left_out(ring: Path, tmp_path: Path) -> None:
    text = text_of(ring)
    number = re.compile(r"(?m)^( [ -]\d\.\d+[eE][+-]\d+)")
    found = 0

    def spoiled(match: re.Match[str]) -> str:
        nonlocal found
        found += 1
        return "nan".rjust(len(match[1])) if found % 3001 == 0 else match[1]

    (tmp_path / "nan.uff").write_text(number.sub(spoiled, text), encoding="ascii")
    assert found > 3001 * 3
    outcome = modes(tmp_path / "nan.uff")
    assert outcome.code == 0, outcome.stderr
    rows = json.loads(outcome.stdout)
    assert [(row["order"], row["axial"]) for row in rows] == [(r, n) for r, n, *_ in MODES]
    said = (tmp_path / "out" / "modes.csv").read_text(encoding="utf-8")
    assert re.search(
        r"# FRF of response \d+ and reference \d+ is not a number at 1 lines and is left out", said
    )


def test_a_file_without_units_is_refused(ring: Path, tmp_path: Path) -> None:
    every = blocks(text_of(ring))
    without = [block for block in every if block.splitlines()[1].strip() != "164"]
    assert len(without) == len(every) - 1
    path = tmp_path / "bare.uff"
    path.write_text("".join(without), encoding="ascii")
    refused(path, "has no units", "164")


def test_accelerations_in_g_without_a_factor_are_refused(ring: Path, tmp_path: Path) -> None:
    text = text_of(ring)
    assert "m/s^2" in text
    path = tmp_path / "g.uff"
    path.write_text(text.replace("m/s^2", "g    "), encoding="ascii")
    refused(path, 'unit "g"', "line")


def test_frequency_axes_that_differ(ring: Path, tmp_path: Path) -> None:
    recording = read_recording([ring])
    (frfs,) = recording.frf_sets
    half = len(frfs.responses) // 2
    first = FrfSet(frfs.frequency_hz, frfs.responses[:half], frfs.references[:half], frfs.accelerance[:half])
    second = FrfSet(
        frfs.frequency_hz[:-300],
        frfs.responses[half:],
        frfs.references[half:],
        frfs.accelerance[half:, :-300],
    )
    path = tmp_path / "axes.uff"
    write_uff(path, Recording("ring", frf_sets=(first, second), nodes=recording.nodes))
    refused(path, "frequency ax")


def test_a_node_in_two_places_is_refused(ring: Path, tmp_path: Path) -> None:
    text = text_of(ring)
    (nodes,) = [block for block in blocks(text) if block.splitlines()[1].strip() == "2411"]
    moved = nodes.replace("5.99", "6.99", 1)
    assert moved != nodes
    path = tmp_path / "twice.uff"
    path.write_text(text.replace(nodes, nodes + moved), encoding="ascii")
    refused(path, "is defined twice")


def test_a_point_measured_twice_counts_as_two_repeats(ring: Path, tmp_path: Path) -> None:
    (frfs,) = read_recording([ring]).frf_sets
    again = (*range(len(frfs.responses)), 0, 1, 2)
    path = rewritten(
        ring,
        tmp_path / "repeats.uff",
        responses=tuple(frfs.responses[i] for i in again),
        references=tuple(frfs.references[i] for i in again),
        accelerance=frfs.accelerance[list(again)],
    )
    check(path)


@pytest.mark.parametrize("part", [0.1, 0.5, 0.97])
def test_a_truncated_file_is_refused(ring: Path, tmp_path: Path, part: float) -> None:
    path = tmp_path / "short.uff"
    content = text_of(ring)
    path.write_text(content[: int(part * len(content))], encoding="ascii")
    refused(path)
