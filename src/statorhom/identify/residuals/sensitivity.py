"""How much each constant moves each mode, and which constants no mode reaches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.identify.parameters.bounds import Array, read_only
from statorhom.identify.stages.stage_materials import DENSITY, StageMaterials
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.reduced_stator import ReducedModes

# A constant is out of reach where its whole 90 % range moves every mode by less than this part (the usual spread of a
# measured frequency) or, where no range is given, where doubling it would.
FELT = 2e-3


@dataclass(frozen=True, eq=False)
class SensitivityMatrix:
    """∂ ln f / ∂ ln p of modes and constants.

    Parameters
    ----------
    constants : names of the constants, `region.constant`, densities included.
    modes : names of the modes, "(r, n)", with an apostrophe for each lower mode of the same name.
    values : (modes, constants). Poisson's ratios count like moduli: relative change of the frequency over relative
        change of the ratio, the other engineering constants held.
    """

    constants: tuple[str, ...]
    modes: tuple[str, ...]
    values: Array

    def out_of_reach(self, log_ranges: Mapping[str, float] | None = None) -> tuple[str, ...]:
        """Constants that no mode reaches.

        Parameters
        ----------
        log_ranges : constant → ln(high / low) of its prior's 90 % range; ln 2 where missing.
        """
        ranges = {} if log_ranges is None else log_ranges
        largest = np.abs(self.values).max(axis=0, initial=0.0)
        return tuple(
            name
            for name, value in zip(self.constants, largest, strict=True)
            if value * ranges.get(name, np.log(2.0)) < FELT
        )

    def strongest(self, constant: str) -> str | None:
        """The mode that a constant moves most, None where it moves none."""
        column = np.abs(self.values[:, self.constants.index(constant)])
        return self.modes[int(column.argmax())] if column.size and column.max() > 0 else None


def sensitivity(
    solution: ReducedModes,
    materials: StageMaterials,
    values: Mapping[str, float],
    keys: Sequence[ModeKey] | None = None,
) -> SensitivityMatrix:
    """Sensitivities at a point.

    Parameters
    ----------
    solution : modes of the reduced model there.
    materials : how constants become materials.
    values : the constants.
    keys : modes wanted (default: all that have a name); those that the solution lacks are left out.
    """
    modes = mode_keys(solution.modes)
    wanted = [key for key in (modes if keys is None else keys) if key in modes]
    slopes = materials.hooke_slopes(values)
    constants = materials.names
    rows = np.zeros((len(wanted), len(constants)))
    for row, key in zip(rows, wanted, strict=True):
        gradient = materials.log_frequency_slopes(solution.log_frequency_gradient(modes[key]), slopes)
        row[:] = [gradient[name] * values[name] for name in constants]
    return SensitivityMatrix(constants, tuple(mode_name(key) for key in wanted), read_only(rows))


def mode_name(key: ModeKey) -> str:
    """Name of a mode: "(2, 0)", "(2, 0)'" for the second one of that name, and so on."""
    return f"({key[0]}, {key[1]})" + "'" * key[2]


def unreached_statement(names: Sequence[str]) -> str:
    """One sentence that names what the measured modes cannot tell; empty where they reach everything."""
    constants = [name for name in names if not name.endswith(DENSITY)]
    if not constants:
        return ""
    return (
        f"No measured mode depends on {_listed(constants)}: what is given there comes from the prior alone."
    )


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"
