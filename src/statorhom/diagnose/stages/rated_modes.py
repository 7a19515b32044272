"""Modes of a stator whose moduli follow the frequency, each followed by its shape from rate to rate.

Over the band such moduli change threefold: modes of one harmonic problem change places, and of one family ranks, in
between. Their shapes do not, from one table of moduli to the next.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from statorhom.diagnose.bases.ring_basis import RingModes
from statorhom.diagnose.stages.same_shapes import same_shapes
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import Materials
from statorhom.model.stator_mode import StatorMode
from statorhom.physics.rated import Laws, at_rate, self_consistent

RATE_HZ = (
    400.0,
    1000.0,
    2000.0,
    4000.0,
    8000.0,
    15000.0,
)  # between which a modulus that follows the frequency is interpolated
AS_DECLARED = 1  # of these: where such a modulus has its declared value

Table = Mapping[tuple[int, int], StatorMode]  # place at declared moduli → the mode of a solution


def rated_modes(
    stage: StageModel, materials: Materials, laws: Laws, problems: frozenset[int] | None = None
) -> tuple[StatorMode, ...]:
    """Modes whose frequency is that of the moduli at it, sorted by it.

    Each has the name that it shows at the moduli next to its own, and the place that it has at the declared ones.

    Parameters
    ----------
    stage, materials : with the moduli as declared.
    laws : region → factor of its stiffness at a frequency (Hz).
    problems : the harmonic ones whose modes are wanted; all by default.

    Raises
    ------
    SolverError
        If a mass or stiffness is not definite.
    """
    solved = [stage.solve(at_rate(materials, laws, rate), problems) for rate in RATE_HZ]
    # what was solved before may hold further problems
    declared = [m for m in solved[AS_DECLARED].modes if problems is None or m.problem in problems]
    tables: list[Table] = [{mode.place: mode for mode in declared}] * len(solved)
    for outward in (range(AS_DECLARED, len(solved)), range(AS_DECLARED, -1, -1)):
        for here, there in pairwise(outward):
            tables[there] = continued(tables[here], solved[here], solved[there], materials)
    logs = self_consistent(np.log(RATE_HZ), tables)
    found = [_at(log_f, place, tables) for place, log_f in logs.items()]
    return tuple(sorted(found, key=lambda mode: mode.frequency_hz))


def _at(log_f: float, place: tuple[int, int], tables: Sequence[Table]) -> StatorMode:
    """A mode as the table next to its frequency shows it."""
    known = [i for i, table in enumerate(tables) if place in table]
    nearest = min(known, key=lambda i: abs(np.log(RATE_HZ[i]) - log_f))
    mode = tables[nearest][place]
    return mode._replace(frequency_hz=float(np.exp(log_f)), column=place[1])


def continued(table: Table, here: RingModes, there: RingModes, materials: Materials) -> Table:
    """The modes of another solution whose shapes are most like those of a table.

    Parameters
    ----------
    table : of modes of the solution `here`.
    here, there : in one basis; their densities are the same, and so is what shapes are compared by.
    materials : with these densities.
    """
    found: dict[tuple[int, int], StatorMode] = {}
    for number in {mode.problem for mode in table.values()}:
        places = [place for place in table if place[0] == number]
        modes = [mode for mode in there.modes if mode.problem == number]
        mass = here.problems[number].mass_matrix(materials)
        own = here.vectors[number][:, [table[place].column for place in places]].T @ mass
        others = there.vectors[number][:, [mode.column for mode in modes]]
        found |= {places[i]: modes[j] for i, j in same_shapes(own, others)}
    return found
