"""What another dimension does to the frequencies.

The modes of the declared machine are good trial vectors on the mesh of a slightly changed one: their Ritz values give
the slopes. How a frequency goes on beyond a small change is solved on the changed mesh, when that is first asked for.
The weights stay as typed: densities follow the volumes. What lies far from the declared machine is seen from a nearer
one (`StageModel.machines`), to which modes are followed step by step.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeVar

import numpy as np

from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.stages.changed_machine import (
    SolvedMachine,
    changed_model,
    followed,
    ritz_logs,
    ritz_shifts,
    scaled,
    solved_machine,
    typed,
)
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import GeometryError, MassError
from statorhom.model.convergence import ModeKey, mode_keys

_T = TypeVar("_T")

# of ln(dimension), to each side, for the slopes; of a tube's wall where a diameter bounds it. A thin wall that is drawn
# thinner with its nodes shears, and Ritz values are off by the square of that.
STEP = 0.001
FAR = 0.03  # the same for changed machines that are solved, with a cubic through them
JUMP = 0.01  # of ln f: farther from its slope a mode is another one


class Cubic(NamedTuple):
    """Change of ln f of a mode at a machine, and its coefficients of ln(dimension) about it."""

    begin: float
    slope: float
    square: float
    cube: float

    def at(self, away: float, *, proportional: bool) -> float:
        """Away from the machine, or its slope's part alone."""
        near = self.begin + self.slope * away
        return near if proportional else near + self.square * away**2 + self.cube * away**3


def dimension_shift(
    study: StudyModel,
    stage: StageModel,
    dimensions: Mapping[str, float],
    key: ModeKey,
    *,
    proportional: bool = False,
) -> float:
    """Change of ln f of a mode by true dimensions ("section.key" → value), or its slope's part alone."""
    total = 0.0
    for name, value in dimensions.items():
        t = float(np.log(value / typed(study, name)))
        machine = stage.machines.get(name, 0.0)
        near = _about(study, stage, name, machine).get(key) if machine else None
        if near is not None:
            total += near.at(t - machine, proportional=proportional)
            continue
        slope = _slopes(study, stage, name).get(key, 0.0)
        square, cube = (0.0, 0.0) if proportional else _bends(study, stage, name).get(key, (0.0, 0.0))
        total += Cubic(0.0, slope, square, cube).at(t, proportional=proportional)
    return total


def _about(study: StudyModel, stage: StageModel, name: str, machine: float) -> Mapping[ModeKey, Cubic]:
    """Cubics about another machine, a change of ln(dimension) away; without modes that cannot be followed there."""
    return stage.memory.once(("about", name, machine), lambda: _made_about(study, stage, name, machine))


def _slopes(study: StudyModel, stage: StageModel, name: str) -> Mapping[ModeKey, float]:
    """Coefficients of ln(dimension) in ln f."""
    return stage.memory.once(("slopes", name), lambda: _made_slopes(study, stage, name))


def _bends(study: StudyModel, stage: StageModel, name: str) -> Mapping[ModeKey, tuple[float, float]]:
    """Coefficients of its square and its cube."""
    return stage.memory.once(("bends", name), lambda: _made_bends(study, stage, name))


def _made_about(study: StudyModel, stage: StageModel, name: str, machine: float) -> dict[ModeKey, Cubic]:
    step, far = STEP * scaled(study, name), FAR * scaled(study, name)
    try:
        there, places, begins = _path(study, stage, name, machine)

        def shifts(sign: int) -> tuple[dict[ModeKey, float], dict[ModeKey, float]]:
            near = ritz_shifts(there, places, *changed_model(study, stage, name, machine + sign * step))
            other = solved_machine(study, stage, name, machine + sign * far)
            same = followed(there, places, other)
            return near, {key: other.logs[place] - there.logs[places[key]] for key, place in same.items()}

        (low, low_far), (high, high_far) = _on_both_sides(stage, shifts)
    except (GeometryError, MassError):
        return {}
    found = {}
    for key in low.keys() & high.keys():
        slope = (high[key] - low[key]) / (2 * step)
        bend = (0.0, 0.0)
        if key in low_far and key in high_far:
            bend = _bend(low_far[key] + slope * far, high_far[key] - slope * far, far)
        found[key] = Cubic(begins[key], slope, *bend)
    return found


def _path(
    study: StudyModel, stage: StageModel, name: str, machine: float
) -> tuple[SolvedMachine, dict[ModeKey, tuple[int, int]], dict[ModeKey, float]]:
    """A machine far from the declared one, the places there of the declared one's modes, and changes of their ln f."""
    before = declared = solved_machine(study, stage, name, 0.0)
    places = dict(declared.named)
    steps = int(np.ceil(abs(machine) / (FAR * scaled(study, name))))
    for number in range(1, steps + 1):
        after = solved_machine(study, stage, name, machine * number / steps)
        places, before = followed(before, places, after), after
    begins = {key: before.logs[place] - declared.logs[declared.named[key]] for key, place in places.items()}
    return before, places, begins


def _made_slopes(study: StudyModel, stage: StageModel, name: str) -> dict[ModeKey, float]:
    try:
        # the Ritz values' own errors, of second order, cancel
        step = STEP * scaled(study, name)
        low, high = _on_both_sides(stage, lambda sign: _shifts(study, stage, name, sign * step))
    except (GeometryError, MassError):
        return {}
    return {key: (high[key] - low[key]) / (2 * step) for key in low.keys() & high.keys()}


def _made_bends(study: StudyModel, stage: StageModel, name: str) -> dict[ModeKey, tuple[float, float]]:
    slopes = _slopes(study, stage, name)
    try:
        far = FAR * scaled(study, name)
        low, high = _on_both_sides(stage, lambda sign: _solved(study, stage, name, sign * far))
    except (GeometryError, MassError):
        return {}
    found = {}
    for key in slopes.keys() & low.keys() & high.keys():
        rest = low[key] + slopes[key] * far, high[key] - slopes[key] * far
        if max(map(abs, rest)) < JUMP:
            found[key] = _bend(*rest, far)
    return found


def _bend(below: float, above: float, far: float) -> tuple[float, float]:
    """Coefficients of the square and the cube, of what slopes leave to both sides."""
    return (below + above) / (2 * far**2), (above - below) / (2 * far**3)


def _on_both_sides(stage: StageModel, changes: Callable[[int], _T]) -> list[_T]:
    """Changes of ln f by less and by more of a dimension."""
    return side_by_side(changes, (-1, 1), list(stage.reference_keys))


def _solved(study: StudyModel, stage: StageModel, name: str, log_change: float) -> dict[ModeKey, float]:
    """Change of ln f on the changed mesh."""
    after = mode_keys(solved_machine(study, stage, name, log_change).modes.modes)
    before = stage.reference_keys
    return {k: float(np.log(after[k].frequency_hz / before[k].frequency_hz)) for k in before.keys() & after}


def _shifts(study: StudyModel, stage: StageModel, name: str, log_change: float) -> dict[ModeKey, float]:
    """Change of the Ritz values' ln f; none where the changed mesh has other cells."""
    model, materials = changed_model(study, stage, name, log_change)
    if model.mesh.nodes.shape != stage.model.mesh.nodes.shape:
        return {}
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    found = {}
    solved = stage.solve(stage.reference)
    for number, problem in enumerate(stage.ring.problems):
        own = {k: m.column for k, m in stage.reference_keys.items() if m.problem == number}
        shapes = problem.space.expand(problem.basis @ solved.vectors[number])
        for key, log_f in ritz_logs(shapes, own, K, M).items():
            found[key] = log_f - float(np.log(stage.reference_keys[key].frequency_hz))
    return found
