"""How many modes are tried together before any is worth its price."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.extraction import mode_count


def added(monkeypatch: pytest.MonkeyPatch, misfits: Sequence[float]) -> tuple[int | None, int]:
    """Modes that one step adds, None for none, and how many were tried.

    Parameters
    ----------
    misfits : of fits with one mode more each, the first one with none.
    """
    fits = [SimpleNamespace(chi2=misfit, number=number) for number, misfit in enumerate(misfits)]
    waiting = iter(fits[1:])
    monkeypatch.setattr(mode_count, "_with_candidate", lambda *_, **__: next(waiting, None))
    monkeypatch.setattr(mode_count, "misfit", lambda _, fit: fit.chi2)
    # what the noise does not explain counts as noise, smooth along ten lines
    monkeypatch.setattr(mode_count, "dispersion", lambda _, fit: 10.0 * fit.chi2)
    monkeypatch.setattr(mode_count, "price", lambda _: 1.0)
    among: Any = SimpleNamespace(window=None)
    found: Any = mode_count._worth_their_price(among, fits[0])  # type: ignore[arg-type]
    return None if found is None else found.number, len(fits) - 1 - len(list(waiting))


def test_modes_that_overlap_are_judged_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of fourteen lines of a wound stator six were found; with four more at once the noise explains the rest."""
    assert added(monkeypatch, (480.0, 311.0, 187.0, 83.0, 2.9)) == (4, 4)


def test_nothing_is_added_where_modes_explain_little(monkeypatch: pytest.MonkeyPatch) -> None:
    assert added(monkeypatch, (480.0, 300.0, 250.0, 20.0)) == (None, 2)
    assert added(monkeypatch, (480.0, 300.0)) == (None, 1)


def test_one_that_is_worth_its_price_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    assert added(monkeypatch, (480.0, 10.0, 1.0)) == (1, 1)


def test_there_is_an_end_to_what_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    assert added(monkeypatch, [0.79**n for n in range(20)]) == (None, mode_count._AHEAD)


@pytest.mark.parametrize(
    ("misfits", "quiet", "number"),
    [
        ((300.0, 35.0, 1.2), False, 2),
        ((300.0, 35.0, 1.5, 1.38, 1.25), False, 4),
        ((300.0, 35.0, 1.5, 1.45), False, 0),
        ((300.0, 35.0, 3.0), False, 0),
        ((300.0, 35.0, 1.2), True, 0),
        ((1.4, 1.0), False, 0),
    ],
    ids=[
        "down to the noise",
        "bit by bit",
        "stuck",
        "not so far",
        "less noisy than models are exact",
        "there already",
    ],
)
def test_faint_modes_are_modes_where_they_explain_everything(
    monkeypatch: pytest.MonkeyPatch, misfits: Sequence[float], quiet: bool, number: int
) -> None:
    """Between broad peaks a mode makes up little of any FRF, and two of a wound stator's 39 were not taken."""
    fits = [SimpleNamespace(chi2=misfit, number=number, modes=(1,)) for number, misfit in enumerate(misfits)]

    def candidate(_: Any, fit: Any, *, faint: bool = False) -> Any:
        return fits[fit.number + 1] if faint and fit.number + 1 < len(fits) else None

    monkeypatch.setattr(mode_count, "_with_candidate", candidate)
    monkeypatch.setattr(mode_count, "misfit", lambda _, fit: fit.chi2)
    monkeypatch.setattr(mode_count, "dispersion", lambda _, fit: fit.chi2)
    monkeypatch.setattr(mode_count, "price", lambda _: 0.1)
    window: Any = SimpleNamespace(quiet=quiet)
    nothing: Any = None
    found: Any = mode_count.grown_to_noise(window, fits[0], nothing, nothing, nothing)  # type: ignore[arg-type]
    assert found.number == number
