"""Fit one fabrication step: reduced basis, global search, mesh correction, polish, intervals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.bases.stage_basis import TOLERANCE
from statorhom.identify.fits.ranked_optima import ranked_optima
from statorhom.identify.inference.intervals import Posterior, posterior
from statorhom.identify.inference.optima import distinct_optima, find_optima
from statorhom.identify.inference.polish import Optimum, polish
from statorhom.identify.optimizers.annealing import SimulatedAnnealing
from statorhom.identify.optimizers.threshold import ThresholdAccepting
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace
from statorhom.identify.processes.announce import Progress
from statorhom.identify.processes.workers import Workers
from statorhom.identify.residuals.model_error import model_error
from statorhom.identify.residuals.stage_problem import MESH, StageProblem
from statorhom.identify.stages.stage_materials import DENSITY
from statorhom.model.affine import Materials
from statorhom.model.broken.named_response import Response
from statorhom.model.convergence import ModeConvergence, ModeKey, mode_keys
from statorhom.model.reduced_stator import ReducedStator
from statorhom.study.stages import IdentifyKeys

MOST_STARTS = 4  # optima of the coarse problem that are followed up
HOPELESS = (
    16.0  # squared distance of a coarse optimum to the best one, hundreds of times that in the fine one
)
ROUNDS = 4  # of mesh correction and discrepancy
MOVED = 30.0  # posterior standard deviations after which the mesh factors are computed again
NEGLIGIBLE = 50.0  # an optimum whose posterior density is e⁻²⁵ of the best one's plays no part
REBASED = 2  # rounds in which the reduced model may be made anew around the optima
SETTLED = 0.1  # the discrepancy is settled when it changes by less than this part
# convergence study of the modes at given materials
Refine = Callable[[Materials], tuple[ModeConvergence, ...]]
# what declared effects do to the modes at given materials
Effects = Callable[[Materials], Mapping[ModeKey, Response]]
# a reduced model that is exact around some optima of the problem
Rebase = Callable[[StageProblem, Sequence[np.ndarray]], ReducedStator]

OPTIMIZERS = {"annealing": SimulatedAnnealing, "threshold": ThresholdAccepting}


@dataclass(frozen=True)
class StageFit:
    """A fitted stage.

    Parameters
    ----------
    problem : with the final mesh factors and discrepancy.
    posterior : of all constants.
    convergence : of the modes at the optimum.
    evaluations : spent by the global search.
    """

    problem: StageProblem
    posterior: Posterior
    convergence: tuple[ModeConvergence, ...]
    evaluations: int


def search_space(space: ParameterSpace) -> ParameterSpace:
    """The space in which the global search moves: what earlier steps and the scale know stays where it is."""
    known = {name for block in space.blocks for name in block.names}
    values = space.values(space.start)
    led = {name for tie in space.ties if tie.names[0] in known for name in tie.names}

    def settled(parameter: Parameter) -> bool:
        return parameter.name in known | led or parameter.name.endswith(DENSITY) or parameter.name == MESH

    parameters = tuple(
        Parameter.constant(p.name, values[p.name]) if settled(p) or p.fixed else p for p in space.parameters
    )
    ties = tuple(tie for tie in space.ties if tie.names[0] not in known)
    return ParameterSpace(parameters, ties)


def fit_stage(
    problem: StageProblem,
    keys: IdentifyKeys,
    refine: Refine,
    rebase: Rebase | None = None,
    *,
    seed: int,
    workers: Workers,
    progress: Progress | None = None,
    effects: Effects | None = None,
) -> StageFit:
    """Find the constants of a stage.

    Parameters
    ----------
    problem : in the full space, without mesh factors.
    keys : method, evaluations and chains.
    refine : convergence study at given materials.
    rebase : makes the reduced model anew where it is not certified at all optima; None to keep it.
    seed : of the search.
    workers : processes.
    progress : called with the evaluations spent.
    effects : of the study's declared effects; None where it has none.

    Raises
    ------
    IdentificationError
        If there is nothing to fit.
    """
    if not problem.measured:
        raise IdentificationError(
            "the stage has no mode to fit: give a free test modes that are not held out"
        )
    starts = search(problem, keys, seed=seed, workers=workers, progress=progress)
    return fit_from(problem, starts, keys.evaluations, refine, rebase, seed=seed, effects=effects)


def search(
    problem: StageProblem,
    keys: IdentifyKeys,
    *,
    seed: int,
    workers: Workers,
    progress: Progress | None = None,
) -> list[np.ndarray]:
    """Coordinates (d,) that are worth a polish, by chains on the reduced model; see `fit_stage`."""
    coarse = replace(problem, space=search_space(problem.space)).coarse()
    found = find_optima(
        coarse,
        seed=seed,
        optimizer=OPTIMIZERS[keys.method](),
        chains=keys.chains,
        evaluations=keys.evaluations,
        workers=workers,
        progress=progress,
    )
    if not any(mode.order is not None for mode in problem.measured):
        found = distinct_optima([*found, *ranked_optima(coarse, seed=seed, workers=workers)])
    hopeful = [o for o in found[:MOST_STARTS] if o.value < found[0].value + HOPELESS]
    return [problem.space.internal(coarse.space.values(o.x)) for o in hopeful]


def fit_from(
    problem: StageProblem,
    starts: Sequence[np.ndarray],
    evaluations: int,
    refine: Refine,
    rebase: Rebase | None = None,
    *,
    seed: int,
    effects: Effects | None = None,
) -> StageFit:
    """Polish what a search has found, correct for the mesh, and draw intervals.

    Parameters
    ----------
    problem : in the full space, without mesh factors.
    starts : (d,) each, the most hopeful first.
    evaluations : that the search has spent.
    refine, rebase, seed, effects : see `fit_stage`.
    """
    problem, convergence, optima = _sharpen(problem, starts, refine, rebase, effects)
    return StageFit(problem, posterior(optima, problem.space, seed=seed), convergence, evaluations)


def _sharpen(
    problem: StageProblem,
    starts: Sequence[np.ndarray],
    refine: Refine,
    rebase: Rebase | None,
    effects: Effects | None,
) -> tuple[StageProblem, tuple[ModeConvergence, ...], tuple[Optimum, ...]]:
    """Alternate polish, mesh correction and discrepancy until they agree."""
    problem = problem.coarse()
    optima = _polish_all(problem, starts)
    convergence: tuple[ModeConvergence, ...] = ()
    refined_at: np.ndarray | None = None
    for round_ in range(ROUNDS):
        if rebase is not None and round_ < REBASED and not _certified(problem, optima):
            problem = replace(problem, solver=rebase(problem, [o.x for o in optima]))
            optima, refined_at = _polish_all(problem, [o.x for o in optima]), None
        x = optima[0].x
        if refined_at is None or np.linalg.norm(optima[0].jacobian @ (x - refined_at)) > MOVED:
            materials = problem.stage_materials(x)
            convergence, refined_at = refine(materials), x
            error = model_error(convergence, reduced_frequencies(problem, x))
            if effects is not None:
                error = replace(error, effects=effects(materials))
            problem = replace(problem, error=error)
        before = problem.discrepancy
        problem = replace(problem, discrepancy=unexplained(problem, x))
        optima = _polish_all(problem, [o.x for o in optima])
        if round_ > 0 and abs(problem.discrepancy - before) <= SETTLED * max(before, 1e-4):
            break
    return problem, convergence, optima


def _certified(problem: StageProblem, optima: Sequence[Optimum]) -> bool:
    """Whether the reduced model is exact enough at every optimum, not only at the best one."""
    return all(problem.solve(o.x).largest_certified_error <= TOLERANCE for o in optima)


def _polish_all(problem: StageProblem, starts: Sequence[np.ndarray]) -> tuple[Optimum, ...]:
    optima = distinct_optima([polish(problem, start) for start in starts])
    return tuple(o for o in optima if o.value < optima[0].value + NEGLIGIBLE)


def unexplained(problem: StageProblem, x: np.ndarray) -> float:
    """Relative standard deviation that the model leaves unexplained beyond measurement and mesh.

    The smallest common one for which the squared residuals do not exceed their expected number, the modes
    less what was fitted to them.
    """
    sharp = replace(problem, discrepancy=0.0).smooth_at(x)
    assert isinstance(sharp, StageProblem) and sharp.held is not None
    paired = np.array([key is not None for key in sharp.held])
    distance = sharp.data_residuals(x)[:-1][paired]  # the last one is no mode's
    base = np.array([sharp.relative_sd(m, k) for m, k in zip(sharp.measured, sharp.held, strict=True)])[
        paired
    ]
    residual = distance * base
    expected = max(1.0, paired.sum() - effective_constants(problem, x))
    if not paired.any() or float(np.sum((residual / base) ** 2)) <= expected:
        return 0.0
    low, high = 0.0, float(np.sqrt(np.sum(residual**2)))
    for _ in range(50):
        middle = (low + high) / 2
        if float(np.sum(residual**2 / (base**2 + middle**2))) > expected:
            low = middle
        else:
            high = middle
    return high


def reduced_frequencies(problem: StageProblem, x: np.ndarray) -> dict[ModeKey, float]:
    """Frequencies of the reduced model by mode."""
    return {key: mode.frequency_hz for key, mode in mode_keys(problem.solve(x).modes).items()}


def effective_constants(problem: StageProblem, x: np.ndarray) -> float:
    """Number of constants that the data determine: the trace of the resolution matrix JᵀJ (JᵀJ + Λ)⁻¹."""
    smooth = problem.smooth_at(x)
    J = smooth.data_jacobian(x)
    prior = problem.space.prior_jacobian
    data = J.T @ J
    return float(np.trace(np.linalg.solve(data + prior.T @ prior, data)))
