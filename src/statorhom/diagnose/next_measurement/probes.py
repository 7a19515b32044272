"""Motion where no test has looked: in the bore, on the overhang; and how far a known mass lowers the frequencies."""

from __future__ import annotations

import numpy as np

from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.next_measurement.option import Option, Predict, Told
from statorhom.diagnose.next_measurement.view import View
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.convergence import mode_keys

RATIO_SD = 0.05  # of the logarithm of a ratio of two sensors' motion
SHIFT_SD = 1e-4  # relative, of a frequency with a mass against without it
MASS_PART = 0.01  # of the stage: the mass to add
LEAST_VISIBLE = 0.1
Place = tuple[float, float]  # radius and height (m)


def options(refit: Refit) -> list[Option]:
    """For every tested step."""
    found = []
    for stage in refit.hypothesis.study.stages:
        mesh, name = stage.model.mesh, stage.name
        mass = MASS_PART * stage.setup.keys.mass_kg
        what = f"the free frequencies of step {name} with a known mass of {1e3 * mass:.2g} g on the back of the core"
        found.append(Option(what, 1.0, _added(stage, mass)))
        nodes = mesh.nodes
        top = float(nodes[:, 2].max())
        inner = float(np.hypot(nodes[:, 0], nodes[:, 1]).min())
        what = (
            f"the motion of the tooth tips in the bore, beside that of the back, for the modes of step {name}"
        )
        found.append(Option(what, 1.5, _ratio(stage, (inner, mesh.length))))
        if top > mesh.length + 1e-4:
            what = (
                f"the motion of the winding overhang, beside that of the core, for the modes of step {name}"
            )
            found.append(Option(what, 1.0, _ratio(stage, (inner, top))))
    return found


def _added(stage: StageModel, mass_kg: float) -> Predict:
    def predict(view: View) -> Told:
        solved = stage.solve(view.materials(stage))
        told: dict[str, tuple[float, float]] = {}
        for key, mode in mode_keys(solved.modes).items():
            if mode.visibility < LEAST_VISIBLE:
                continue
            problem = solved.problems[mode.problem]
            end = float((problem.profile @ solved.vectors[mode.problem][:, mode.column])[-1])
            # of a doublet one line alone feels a mass: its mean half as much
            told[str(key)] = -0.5 * mass_kg * end**2 / mode.multiplicity, SHIFT_SD
        return told

    return predict


def _ratio(stage: StageModel, place: Place) -> Predict:
    nodes = stage.model.mesh.nodes
    radius = np.hypot(nodes[:, 0], nodes[:, 1])

    def nearest(r: float, z: float) -> int:
        return int(np.argmin(np.hypot(radius - r, nodes[:, 2] - z)))

    probe, back = nearest(*place), nearest(float(radius.max()), stage.model.mesh.length)

    def predict(view: View) -> Told:
        solved = stage.solve(view.materials(stage))
        told: dict[str, tuple[float, float]] = {}
        for key, mode in mode_keys(solved.modes).items():
            if mode.visibility < LEAST_VISIBLE:
                continue
            problem = solved.problems[mode.problem]
            shape = problem.space.expand(problem.basis @ solved.vectors[mode.problem][:, mode.column])
            motion = np.linalg.norm(np.abs(shape).reshape(-1, 3), axis=1)
            told[str(key)] = float(np.log(motion[probe] / motion[back])), RATIO_SD
        return told

    return predict
