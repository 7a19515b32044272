"""A small recording that holds everything, and universal files written word by word."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hit import Hit
from statorhom.recordings.mode_shape import ModeShape
from statorhom.recordings.named_direction import direction_vector
from statorhom.recordings.recording import Node, Recording

FREQUENCY = np.arange(100.0, 112.0, 2.0)


def ring_dof(node: int, angle_deg: float, z: float, direction: str = "r", radius: float = 0.06) -> Dof:
    angle = np.radians(angle_deg)
    position = (radius * float(np.cos(angle)), radius * float(np.sin(angle)), z)
    return Dof(node, position, direction_vector(direction, position))


def ring_recording(seed: int = 0) -> Recording:
    """Four radial responses on two planes, a hammer that pushes inwards, one hit, one shape."""
    rng = np.random.default_rng(seed)
    responses = tuple(
        ring_dof(100 * plane + i, angle, 0.02 * plane)
        for plane in (1, 2)
        for i, angle in enumerate((0.0, 75.0), start=1)
    )
    hammer = ring_dof(901, 40.0, 0.03, "-r")
    shape = (len(responses), len(FREQUENCY))
    accelerance = rng.standard_normal(shape) + 1j * rng.standard_normal(shape)
    frf_set = FrfSet(FREQUENCY, responses, (hammer,) * 4, accelerance, coherence=rng.uniform(0.5, 1.0, shape))
    hit = Hit(3, 48000.0, rng.standard_normal(9), rng.standard_normal((2, 9)), hammer, responses[:2])
    motion = rng.standard_normal((4, 3)) + 1j * rng.standard_normal((4, 3))
    dofs = (*responses, hammer)
    return Recording(
        name="ring",
        frf_sets=(frf_set,),
        hits=(hit,),
        shapes=(ModeShape(1432.5, 0.003, tuple(dof.node for dof in responses), motion),),
        nodes=tuple(Node(dof.node, dof.position) for dof in dofs if dof.position is not None),
        trace_lines=((101, 102, 202, 201, 101),),
    )


def units(code: int = 1, length: float = 1.0, force: float = 1.0) -> str:
    numbers = f"{length:25.16e}{force:25.16e}{1.0:25.16e}\n{273.15:25.16e}".replace("e", "D")
    return f"    -1\n   164\n{code:10d}{'units':20s}{2:10d}\n{numbers}\n    -1\n"


def function(
    values: str,
    *,
    kind: int = 4,
    form: int = 5,
    count: int = 3,
    even: int = 1,
    start: float = 10.0,
    step: float = 2.0,
    load_case: int = 0,
    response: tuple[int, int] = (1, 3),
    reference: tuple[int, int] = (2, 3),
    abscissa: tuple[int, str] = (18, "Hz"),
    ordinate: tuple[int, str] = (12, "m/s^2"),
    denominator: tuple[int, str] = (13, "N"),
) -> str:
    """A dataset 58 in text with its delimiters; `values` as they shall stand in the file."""
    return "\n".join(
        [
            "    -1",
            "    58",
            *["NONE"] * 5,
            f"{kind:5d}{0:10d}{0:5d}{load_case:10d}"
            f" {'NONE':10s}{response[0]:10d}{response[1]:4d} {'NONE':10s}{reference[0]:10d}{reference[1]:4d}",
            f"{form:10d}{count:10d}{even:10d}{start:13.5e}{step:13.5e}{0.0:13.5e}",
            *(
                f"{quantity:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {unit:20s}"
                for quantity, unit in (abscissa, ordinate, denominator, (0, "NONE"))
            ),
            values,
            "    -1",
            "",
        ]
    )


# three complex values in single precision: 1+2i, 3+4i, 5+6i
THREE = "".join(f"{x:13.5e}" for x in (1, 2, 3, 4, 5, 6))


def write(path: Path, *parts: str) -> Path:
    path.write_text("".join(parts), encoding="utf-8", newline="")
    return path
