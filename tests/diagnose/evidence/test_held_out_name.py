"""A renamed mode is judged by itself: how far it lies from its old and from its new name."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence import held_out_name
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.identify.residuals.model_error import ModelError
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.study.modal_table import MeasuredMode


@dataclass(frozen=True)
class FakeHypothesis:
    """As much of a hypothesis as a prediction needs."""

    study: Any
    held: dict[str, tuple[tuple[int, int, int] | None, ...]]
    left_out: frozenset[tuple[str, tuple[int, int, int] | None]] = frozenset()
    constants: int = 0

    def actions(self, _: np.ndarray) -> tuple[Action, ...]:
        return ()


@pytest.mark.parametrize(("old", "before"), [(1900.0, 100 * np.log(2000 / 1900)), (None, 100 * np.log(1.12))])
def test_wrong_name_before_right_name_after(
    old: float | None, before: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A mode of the old name lies elsewhere, or beyond the band's end."""
    row = MeasuredMode(1, "a", 2000.0, 0.2, order=2, axial=1)
    test = MeasuredTest(0, "t", "free", (row,))
    stage = SimpleNamespace(tests=(test,), error=ModelError())
    constants = SimpleNamespace(values=lambda _: {})
    study = SimpleNamespace(stages=(stage,), constants=constants, files=None)

    def refit(key: tuple[int, int, int] | None) -> SimpleNamespace:
        hypothesis = FakeHypothesis(study, {"t": (key,)})
        return SimpleNamespace(hypothesis=hypothesis, z=np.zeros(0))

    modes = {(3, 0, 0): SimpleNamespace(log_f=np.log(2001.0))}
    if old is not None:
        modes[2, 1, 0] = SimpleNamespace(log_f=np.log(old))
    left_out = []
    monkeypatch.setattr(held_out_name, "predicted", lambda *_: modes)
    monkeypatch.setattr(
        held_out_name, "refit_held", lambda h, z: left_out.append(h.left_out) or SimpleNamespace(z=z)
    )
    effect = SimpleNamespace(action=lambda *_: Action(names={("t", "a"): (3, 0)}))
    monkeypatch.setattr(held_out_name, "library", lambda: {"mislabelled_mode": effect})
    explanation = SimpleNamespace(
        candidates=(Candidate("mislabelled_mode", "s", ()),), refit=refit((3, 0, 0))
    )
    found = held_out_name.held_out_names(refit((2, 1, 0)), explanation)  # type: ignore[arg-type]
    assert found.before == pytest.approx((before,))
    assert found.after == pytest.approx((100 * np.log(2001 / 2000),))
    # neither prediction saw the mode
    assert left_out == [frozenset({("t", (2, 1, 0))}), frozenset({("t", (3, 0, 0))})]
    assert found.falls and not found.worsens
