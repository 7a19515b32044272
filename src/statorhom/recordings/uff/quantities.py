"""What a function's axes show, and what makes SI of it."""

from __future__ import annotations

import math

from statorhom.recordings.uff.function_header import Axis
from statorhom.recordings.uff.records import Place
from statorhom.recordings.uff.units import Units
from statorhom.study.message import quoted

DISPLACEMENT, REACTION_FORCE, VELOCITY, ACCELERATION, EXCITATION_FORCE, TIME, FREQUENCY = (
    8,
    9,
    11,
    12,
    13,
    17,
    18,
)
_UNSPECIFIC = (0, 1)
_QUANTITIES = {
    DISPLACEMENT: "displacement",
    REACTION_FORCE: "force",
    VELOCITY: "velocity",
    ACCELERATION: "acceleration",
    EXCITATION_FORCE: "force",
}
# SI units per unit of a label, by quantity, as `plain` writes labels
_LABELS = {
    "acceleration": {
        "m/s2": 1.0, "m/s/s": 1.0, "ms-2": 1.0, "mm/s2": 1e-3, "cm/s2": 1e-2, "in/s2": 0.0254, "ft/s2": 0.3048,
        "g": 9.80665, "gn": 9.80665, "gs": 9.80665,
    },
    "velocity": {"m/s": 1.0, "ms-1": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "in/s": 0.0254, "ft/s": 0.3048},
    "displacement": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "in": 0.0254, "ft": 0.3048},
    "force": {"n": 1.0, "kn": 1e3, "mn": 1e-3, "lbf": 4.4482216152605, "kgf": 9.80665},
}  # fmt: skip
_NOT_CALIBRATED = ("v", "mv", "db", "%")
_PER_FORCE = "/n"
_SPELLINGS = (("²", "2"), ("µ", "u"), ("μ", "u"), ("newton", "n"), ("sec", "s"))
_NO_MEANING = str.maketrans("", "", " ^*()[]·'")


def quantity(axis: Axis) -> str | None:
    """acceleration, velocity, displacement or force, by the axis' code or else by its unit; None if neither."""
    if axis.quantity not in _UNSPECIFIC:
        return _QUANTITIES.get(axis.quantity)
    label = plain(axis.unit).removesuffix(_PER_FORCE)
    return next((name for name, labels in _LABELS.items() if label in labels), None)


def is_per_force(numerator: Axis, denominator: Axis) -> bool:
    """Whether a function is a response over a force."""
    if denominator.quantity in _UNSPECIFIC and not denominator.unit:
        return plain(numerator.unit).endswith(_PER_FORCE)
    return quantity(denominator) == "force"


def scale_to_si(place: Place, line: int, name: str, unit: str, units: Units) -> tuple[float, bool]:
    """What to multiply a function's values by.

    The unit on the axis must be that of the file's unit system: where they contradict each other nobody can
    know which one is right.

    Parameters
    ----------
    place : Place
    line : int
        Line of the axis, for messages.
    name : str
        acceleration, velocity, displacement or force.
    unit : str
        As the file prints it; may be empty.
    units : Units
        The file's unit system.

    Returns
    -------
    scale : float
    known : bool
        False where the unit is none that could be compared.

    Raises
    ------
    RecordingError
    """
    scale = 1.0 / (units.force if name == "force" else units.length)
    label = plain(unit) if name == "force" else plain(unit).removesuffix(_PER_FORCE)
    factor = _LABELS[name].get(label)
    of_others = factor is None and any(label in labels for labels in _LABELS.values())
    contradicts = factor is not None and not math.isclose(factor, scale, rel_tol=1e-3)
    if of_others or contradicts or label in _NOT_CALIBRATED:
        raise place.error(
            line,
            f"unit {quoted(unit)} of {name} is not that of the file's unit system (dataset 164)",
            "export the file in SI units, m/s² and N",
        )
    return scale, factor is not None or not label


def plain(unit: str) -> str:
    """A unit without what is written in many ways: case, blanks, brackets, signs of powers."""
    text = unit.lower()
    for spelling, short in _SPELLINGS:
        text = text.replace(spelling, short)
    return text.translate(_NO_MEANING)
