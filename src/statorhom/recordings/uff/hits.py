"""Time records of a universal file, brought together into hits."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

import numpy as np

from statorhom.recordings.dof import Dof
from statorhom.recordings.hit import Hit
from statorhom.recordings.uff.function import Function
from statorhom.recordings.uff.function_header import TIME_RESPONSE
from statorhom.recordings.uff.nodes import Geometry
from statorhom.recordings.uff.quantities import TIME, plain, quantity, scale_to_si
from statorhom.recordings.uff.units import Units

_ABSCISSA_LINE, _ORDINATE_LINE = 9, 10
_SECONDS = ("", "s")
_EVEN = 1e-3


def hits(functions: Sequence[Function], geometry: Geometry, units: Units) -> tuple[list[Hit], list[str]]:
    """The hits among functions: time records of the same load case.

    Parameters
    ----------
    functions : sequence of Function
    geometry : Geometry
    units : Units

    Returns
    -------
    hits : list of Hit
        By ascending number.
    remarks : list of str
        Records and hits that are left out.

    Raises
    ------
    RecordingError
        Where the records of one load case cannot belong to one hit.
    """
    cases: dict[int, dict[str, list[Function]]] = defaultdict(lambda: {"force": [], "acceleration": []})
    left_out: Counter[str] = Counter()
    for function in functions:
        if function.header.kind != TIME_RESPONSE:
            continue
        name = quantity(function.header.ordinate)
        if name in ("force", "acceleration"):
            cases[function.header.load_case][name].append(function)
        else:
            left_out["time records are of neither force nor acceleration and are left out"] += 1
    found = []
    for number, channels in sorted(cases.items()):
        if not channels["force"] or not channels["acceleration"]:
            left_out["load cases lack a force or an acceleration and are left out"] += 1
            continue
        hit = _hit(number, channels, geometry, units)
        if np.isfinite(hit.force_n).all() and np.isfinite(hit.acceleration_m_s2).all():
            found.append(hit)
        else:
            left_out["hits hold what is not a number and are left out"] += 1
    return found, [f"{count} {reason}" for reason, count in left_out.items()]


def _hit(number: int, channels: dict[str, list[Function]], geometry: Geometry, units: Units) -> Hit:
    force, *others = channels["force"]
    if others:
        raise others[0].place.error(
            None, f"is a second force of load case {number}", "give every hit a load case of its own"
        )
    responses = channels["acceleration"]
    rate = sample_rate(force)
    for function in responses:
        if len(function.values) != len(force.values) or abs(sample_rate(function) - rate) > _EVEN * rate:
            raise function.place.error(
                None,
                f"has another length or sample rate than the force of load case {number}",
                "export all channels of a hit with the same samples",
            )
    return Hit(
        number=number,
        sample_rate_hz=rate,
        force_n=_in_si(force, "force", units),
        acceleration_m_s2=np.array([_in_si(function, "acceleration", units) for function in responses]),
        reference=_hammer(force, geometry),
        responses=tuple(
            geometry.dof(function.header.response_node, function.header.response_direction)
            for function in responses
        ),
        source=str(force.place.path),
    )


def _hammer(force: Function, geometry: Geometry) -> Dof:
    """A force channel names its point as the response; some programs only name it as the reference."""
    header = force.header
    if header.response_node or not header.reference_node:
        return geometry.dof(header.response_node, header.response_direction)
    return geometry.dof(header.reference_node, header.reference_direction)


def _in_si(function: Function, name: str, units: Units) -> np.ndarray:
    scale, _ = scale_to_si(function.place, _ORDINATE_LINE, name, function.header.ordinate.unit, units)
    return np.asarray(function.values.real * scale, dtype=float)


def sample_rate(function: Function) -> float:
    """Samples per second of a time record.

    Files print the increment with six digits: a whole number of samples per second that prints the same is
    what was meant.

    Raises
    ------
    RecordingError
    """
    axis, times = function.header.abscissa, function.abscissa
    if axis.quantity not in (0, 1, TIME) or plain(axis.unit) not in _SECONDS:
        raise function.place.error(
            _ABSCISSA_LINE, "the abscissa is not a time in s", "export it over time in s"
        )
    if len(times) < 2:
        raise function.place.error(None, "has a single sample", "export the whole record")
    steps = np.diff(times)
    step = float(np.mean(steps))
    if not step > 0 or not np.isfinite(step) or np.max(np.abs(steps - step)) > _EVEN * step:
        raise function.place.error(
            None, "samples are not evenly spaced in time", "export evenly sampled records"
        )
    whole = round(1 / step)
    return float(whole) if whole and f"{1 / whole:.5e}" == f"{step:.5e}" else 1 / step
