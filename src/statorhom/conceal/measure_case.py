"""Solve every test of a case on the fine mesh and make its recording."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom.conceal import frfs
from statorhom.conceal.breaks import all_changes, joined
from statorhom.conceal.ground import StageGround, stage_ground
from statorhom.conceal.listed import ListedMode, listed_modes
from statorhom.conceal.ritz import Losses, RitzModes, ritz_modes
from statorhom.conceal.sensors import Sensors, sensors
from statorhom.conceal.tables import relabelled, shortened, table_text
from statorhom.conceal.truth import Case, Finding, TrueStage, TrueTest
from statorhom.errors import SupportError
from statorhom.mesh import MeshDensity
from statorhom.model.broken.attachments import springs
from statorhom.model.broken.change import Change, PieceChange
from statorhom.model.supports import support_on
from statorhom.model.surface import surface_radius
from statorhom.recordings.frf_set import FrfSet
from statorhom.study.supports import LineSupport, SupportKeys

PRESS_N_PER_M2 = 1e13
TWO_HITS = 0.5  # how often the hammer hits at two places


@dataclass(frozen=True, eq=False)
class Measured:
    """One test.

    Parameters
    ----------
    stage, test : their numbers.
    ritz : the solution.
    modes : of the band.
    table : the modal table's text, None where FRFs were recorded.
    recording : the FRFs.
    listed, missing : names in the table, and visible ones that are not.
    """

    stage: int
    test: int
    ritz: RitzModes
    modes: tuple[ListedMode, ...]
    table: str | None = None
    recording: FrfSet | None = None
    listed: tuple[ListedMode, ...] = ()


def measure_case(
    case: Case, rng: np.random.Generator, density: MeshDensity | None = None
) -> tuple[Case, tuple[Measured, ...]]:
    """Measure all tests.

    Parameters
    ----------
    case : the truth.
    rng : of noise, positions and what is missing.
    density : of the true stator's mesh; None: what is usual of the step.

    Returns
    -------
    case, tests : what only the table decides is added to the findings.

    Raises
    ------
    StatorhomError
        If the true stator cannot be solved.
    """
    found = []
    with threadpool_limits(limits=1, user_api="blas"):
        for number, stage in enumerate(case.stages):
            for measured in _stage(case, number, stage, rng, density) if stage.tests else ():
                case = _with_label(case, measured)
                found.append(measured)
    return case, tuple(found)


def _stage(
    case: Case, number: int, stage: TrueStage, rng: np.random.Generator, density: MeshDensity | None
) -> Iterator[Measured]:
    ground = stage_ground(case.geometry, stage, density)
    d = case.geometry.dimensions
    hits = 2 if rng.random() < TWO_HITS else 1
    places = sensors(surface_radius(ground.mesh), d.length, hits, rng)
    for index, test in enumerate(stage.tests):
        own = ground.with_factors(test.stiffness_factor) if test.stiffness_factor else ground
        ritz = _solved(own, stage, test, None if test.is_table else places)
        measured = Measured(number, index, ritz, listed_modes(ritz, is_free=test.declared is None))
        if test.is_table:
            yield _table(measured, test, rng)
        else:
            how = frfs.Observation(test.sensor_mass_kg, test.slip, test.force_n)
            lines = frfs.frequency_lines(own.highest_hz)
            clean = frfs.accelerance(ritz, places, lines, how)
            yield replace(measured, recording=frfs.frf_set(clean, places, lines, rng))


def _solved(ground: StageGround, stage: TrueStage, test: TrueTest, places: Sensors | None) -> RitzModes:
    changes = all_changes((*stage.breaks, *test.breaks), ground)
    lossy: dict[int, float] = {}
    if test.elastic is not None:
        lossy[len(changes)] = test.elastic.loss_factor
        changes.append(_springs(ground, test.elastic.lines))
    elif test.declared is not None:
        changes.append(_as_declared(ground, test.declared))
    if places is not None:
        changes.append(places.faint_springs(ground.mesh))
    losses = Losses({region: stage.materials[region].loss_factor for region in ground.mesh.regions}, lossy)
    waves = joined([change for wave in stage.scatter for change in wave.changes(ground)])
    weak = [change for change in waves if isinstance(change, PieceChange)]
    return ritz_modes(ground, changes, weak, losses, stage.absorbers, stage.modulus_slope)


def _as_declared(ground: StageGround, keys: SupportKeys) -> Change:
    """A support that is what the study says; a rigid one is as stiff as a press."""
    if not isinstance(keys, LineSupport):
        raise SupportError(
            f"support {keys.name!r}: faces and arcs cannot be concealed yet; give the tests line supports"
        )
    return pressed(ground, keys) if keys.declared == "rigid" else _springs(ground, keys)


def pressed(ground: StageGround, keys: LineSupport) -> Change:
    """Lines as stiff as a press."""
    stiff = {"declared": "elastic", "normal_stiffness_n_per_m2": PRESS_N_PER_M2, "tangential_ratio": 1.0}
    return _springs(ground, keys.model_copy(update=stiff))


def _springs(ground: StageGround, keys: LineSupport) -> Change:
    return springs(ground.mesh, support_on(ground.mesh, keys).points)


def _table(measured: Measured, test: TrueTest, rng: np.random.Generator) -> Measured:
    listed = shortened(measured.modes, rng, test.only)
    typed = listed if test.relabelled is None else relabelled(listed, test.relabelled)[0]
    return replace(measured, table=table_text(typed, rng), listed=listed)


def _with_label(case: Case, measured: Measured) -> Case:
    """State which mode a table misnames."""
    test = case.stages[measured.stage].tests[measured.test]
    if test.relabelled is None:
        return case
    _, row, true = relabelled(measured.listed, test.relabelled)
    parameters = {"mode": row, "order": true.order, "axial": true.axial}

    def stated(finding: Finding) -> Finding:
        mine = finding.effect == "mislabelled_mode" and finding.test == test.name
        return replace(finding, parameters=parameters) if mine else finding

    return replace(case, findings=tuple(stated(finding) for finding in case.findings))
