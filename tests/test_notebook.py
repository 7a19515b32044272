"""The notebook runs, shows what it says, and is one that jupytext reads."""

import itertools
import runpy
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOK = ROOT / "notebooks" / "explore_550w.py"


@pytest.fixture
def without_windows() -> Iterator[None]:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    backend = mpl.get_backend()
    mpl.use("Agg")
    yield
    pyplot.close("all")
    mpl.use(backend)


@pytest.mark.usefixtures("without_windows")
def test_the_notebook_runs(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    import matplotlib.pyplot as plt

    monkeypatch.chdir(NOTEBOOK.parent)
    seen = runpy.run_path(str(NOTEBOOK))
    assert seen["densities"]["stack"] == pytest.approx(7810.5, rel=1e-3)
    assert seen["densities"]["impregnated"] == pytest.approx(3166.4, rel=1e-3)
    assert len(plt.get_fignums()) == 3
    # a coarse uniform mesh asks for a softer material than the graded, finer one
    moduli = [row[-1] for row in seen["rows"]]
    assert moduli[0] < moduli[1] < moduli[-1]
    # as the text says: the measured frequency is met on more than one branch
    assert crossings(seen["points"], 1170.0) > 1
    assert seen["modulus"].ci90[0] < 191e9 < seen["modulus"].ci90[1]
    assert seen["modulus"].status == "identified"
    assert "identified" in capsys.readouterr().out


def crossings(points: list[tuple[float, float, float]], level_hz: float) -> int:
    """How often one of the lowest branches (by rank) passes a frequency as the modulus rises."""
    moduli = sorted({modulus for modulus, *_ in points})
    spectra = [sorted(hz for modulus, hz, _ in points if modulus == at) for at in moduli]
    below = [sum(hz < level_hz for hz in spectrum) for spectrum in spectra]
    return sum(abs(a - b) for a, b in itertools.pairwise(below))


def test_jupytext_reads_it() -> None:
    jupytext = pytest.importorskip("jupytext")
    notebook = jupytext.read(NOTEBOOK)
    kinds = [cell.cell_type for cell in notebook.cells]
    assert kinds.count("markdown") >= 7
    assert kinds.count("code") >= 8
    written = jupytext.writes(notebook, fmt="ipynb")
    assert contents(jupytext.reads(written, fmt="ipynb")) == contents(notebook)


def contents(notebook: Any) -> list[tuple[str, str]]:
    return [(cell.cell_type, cell.source) for cell in notebook.cells]
