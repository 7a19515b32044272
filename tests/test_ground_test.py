"""The commands of a ground vibration test: suspension, compare, and sweeps for `statorhom modes`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from command import statorhom
from statorhom.recordings.mode_shape import ModeShape
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff

CORDS = "x_mm,y_mm,z_mm,stiffness_n_per_m\n-400,-100,0,100\n-400,100,0,100\n400,-100,0,100\n400,100,0,100\n"
X, Y = (one.ravel() for one in np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 3)))
NODES = tuple(range(1, len(X) + 1))
FREE = {"bending": X**2 - 0.4, "second": X**3 - 0.65 * X, "torsion": X * Y}


def cords(tmp_path: Path, text: str = CORDS) -> Path:
    path = tmp_path / "cords.csv"
    path.write_text(text, encoding="utf-8")
    return path


def shapes(
    path: Path, modes: list[tuple[float, np.ndarray]], nodes: tuple[int, ...] = NODES, placed: bool = True
) -> Path:
    found = [ModeShape(f, 0.01, nodes, np.column_stack([0 * w, 0 * w, w]).astype(complex)) for f, w in modes]
    places = [Node(n, (0.9 * float(x), 0.2 * float(y), 0.0)) for n, x, y in zip(nodes, X, Y, strict=True)]
    write_uff(path, Recording("wing", shapes=tuple(found), nodes=tuple(places) if placed else ()))
    return path


def test_the_suspension_s_rigid_body_modes(tmp_path: Path) -> None:
    arguments = ("--mass-kg", 3, "--elastic-hz", 50.3, "--inertia-kg-m2", 0.05, 0.9, 0.95)
    outcome = statorhom("suspension", cords(tmp_path), *arguments)
    assert outcome.code == 0, outcome.stderr
    assert "as good as free" in outcome.stdout
    listed = json.loads(statorhom("suspension", cords(tmp_path), *arguments, "--json").stdout)
    heave = next(row for row in listed if row["motion"] == "along z")
    assert heave["frequency_hz"] == pytest.approx(1.8378, abs=1e-4)


@pytest.mark.parametrize(
    ("text", "mass", "words"),
    [
        (CORDS.replace("100,0,100", "100,0,-100", 1), 3, "line 2, column stiffness_n_per_m"),
        (CORDS.replace("-400,-100", ",-100", 1), 3, "line 2, column x_mm: is empty"),
        (CORDS.replace("stiffness_n_per_m", "stiffness"), 3, "stiffness"),
        (CORDS, -3, "positive mass"),
    ],
)
def test_what_is_no_suspension_is_one_line(tmp_path: Path, text: str, mass: float, words: str) -> None:
    outcome = statorhom("suspension", cords(tmp_path, text), "--mass-kg", mass, "--elastic-hz", 50.3)
    assert outcome.code == 2 and len(outcome.stderr.splitlines()) == 1
    assert words in outcome.stderr and "cords.csv" in outcome.stderr


def test_shapes_side_by_side(tmp_path: Path) -> None:
    first, second, twist = FREE.values()
    measured = shapes(tmp_path / "a.uff", [(50.3, first * 1j), (111.9, second), (125.0, twist)])
    simulated = shapes(
        tmp_path / "b.uff", [(60.4, first), (97.8, second), (138.0, -twist), (200.0, Y**2 - 0.6)]
    )
    rows = json.loads(statorhom("compare", measured, simulated, "--json").stdout)
    assert [row["name"] for row in rows[:3]] == ["1st bending", "2nd bending", "1st torsion"]
    assert [row["difference_percent"] for row in rows[:3]] == pytest.approx([20.08, -12.60, 10.4], abs=5e-3)
    assert [row["mac"] for row in rows[:3]] == pytest.approx([1.0] * 3)
    assert rows[3]["measured_hz"] is None and rows[3]["simulated_hz"] == pytest.approx(200.0, rel=1e-5)
    outcome = statorhom("compare", measured, simulated)
    assert outcome.code == 0 and "20.08" in outcome.stdout


def test_directions_that_were_not_measured_do_not_count(tmp_path: Path) -> None:
    """A simulated shape moves in the plane as well; the accelerometers were across it."""
    first = FREE["bending"]
    measured = shapes(tmp_path / "a.uff", [(50.3, first)])
    motion = np.column_stack([3 * Y, 0 * X, first]).astype(complex)
    places = tuple(
        Node(n, (0.9 * float(x), 0.2 * float(y), 0.0)) for n, x, y in zip(NODES, X, Y, strict=True)
    )
    simulated = tmp_path / "b.uff"
    write_uff(simulated, Recording("wing", shapes=(ModeShape(60.4, None, NODES, motion),), nodes=places))
    (row,) = json.loads(statorhom("compare", measured, simulated, "--json").stdout)
    assert row["mac"] == pytest.approx(1.0)


def test_shapes_that_cannot_be_compared_are_one_line(tmp_path: Path) -> None:
    first = FREE["bending"]
    measured = shapes(tmp_path / "a.uff", [(50.3, first)])
    other = shapes(tmp_path / "b.uff", [(50.3, first)], tuple(n + 100 for n in NODES))
    empty = tmp_path / "c.uff"
    write_uff(empty, Recording("wing", nodes=(Node(1, (0.0, 0.0, 0.0)),)))
    for second, words in ((other, "0 nodes in common"), (empty, "")):
        outcome = statorhom("compare", measured, second)
        assert outcome.code == 2 and len(outcome.stderr.splitlines()) == 1
        assert words in outcome.stderr and second.name in outcome.stderr


def test_shapes_without_places_are_compared_without_names(tmp_path: Path) -> None:
    measured = shapes(tmp_path / "a.uff", [(50.3, FREE["torsion"])], placed=False)
    (row,) = json.loads(statorhom("compare", measured, measured, "--json").stdout)
    assert row["name"] == "" and row["mac"] == pytest.approx(1.0)


def sweep_csv(path: Path) -> Path:
    """A sweep past one resonance at 90 Hz, as a logger writes it."""
    from scipy import signal

    from statorhom.recordings.estimation.sweep_plan import SweepStage, sweep_signal

    rate, natural, ratio = 1000.0, 2 * np.pi * 90.0, 0.01
    quiet = np.zeros(2000)
    force = np.concatenate([quiet, sweep_signal([SweepStage(60.0, 120.0, 2.0)], rate), quiet])
    system = ([1.0, 0.0, 0.0], [1.0, 2 * ratio * natural, natural**2])
    numerator, denominator, _ = signal.cont2discrete(system, 1 / rate, method="foh")
    response = signal.lfilter(np.ravel(numerator), denominator, force)
    noise = 1e-3 * np.random.default_rng(0).standard_normal((2, len(force)))
    table = np.column_stack([np.arange(len(force)) / rate, force + noise[0], response + noise[1]])
    np.savetxt(path, table, delimiter=",", header="time_s,force_n,acceleration_m_s2", comments="", fmt="%.9g")
    return path


def test_modes_of_a_sweep(tmp_path: Path) -> None:
    record = sweep_csv(tmp_path / "sweep.csv")
    out = ("--out", tmp_path / "o")
    outcome = statorhom("modes", record, *out, "--sweep-hz", 65, 115, "--segment-s", 8, "--json")
    assert outcome.code == 0, outcome.stderr
    (row,) = json.loads(outcome.stdout)
    assert row["frequency_hz"] == pytest.approx(90.0, rel=1e-3)
    assert row["loss_factor"] == pytest.approx(0.02, rel=0.05)
    remarks = (tmp_path / "o" / "modes.csv").read_text(encoding="utf-8")
    assert "# second stage: sweep 8" in remarks


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--segment-s", 4), "--sweep-hz"),
        (("--sweep-hz", 115, 65), "stop_hz"),
        (("--sweep-hz", 65, 115, "--segment-s", -1), "segment_s"),
        (("--sweep-hz", 65, 115, "--segment-s", 600), "shorter than a segment"),
    ],
)
def test_what_is_no_sweep_is_one_line(tmp_path: Path, arguments: tuple, words: str) -> None:
    outcome = statorhom("modes", sweep_csv(tmp_path / "sweep.csv"), "--out", tmp_path / "o", *arguments)
    assert outcome.code == 2 and len(outcome.stderr.splitlines()) == 1
    assert words in outcome.stderr and not (tmp_path / "o").exists()
