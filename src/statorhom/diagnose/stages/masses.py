"""From the weights of all steps to the densities of a step's regions, and what is known of those.

A number that was typed wrongly may be met by other constants everywhere but here: no material has the density.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from statorhom.materials.density import Weighing, densities, whole_density
from statorhom.study.regions import COUPON
from statorhom.study.study import StudyFiles

# kind of step → mean and standard deviation of the density (kg/m³) of what it adds; coupons may be of anything
KNOWN: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        # sheets of electrical steel of 7600 … 7850 kg/m³ at usual stacking factors
        "stack": (7700.0, 90.0),
        # copper that fills 30 … 42 % of slots and overhangs, with its insulation
        "wound": (3150.0, 350.0),
    }
)


def stage_densities(
    files: StudyFiles, masses_kg: Mapping[str, float], index: int, volumes: Mapping[str, float]
) -> dict[str, float]:
    """Region → density (kg/m³) after a step.

    Parameters
    ----------
    files : the study.
    masses_kg : stage → weight.
    index : number of the step.
    volumes : region → volume (m³) at this step.

    Raises
    ------
    MassError
        If a step loses mass.
    """
    weighings: Sequence[Weighing] = [
        Weighing(s.name, s.kind, masses_kg[s.name], s.mass_sd_kg) for s in files.study.stages[: index + 1]
    ]
    if weighings[-1].kind == COUPON:
        return {r: whole_density(weighings[-1], r, v).density_kg_m3 for r, v in volumes.items()}
    return {d.region: d.density_kg_m3 for d in densities(weighings, volumes)}
