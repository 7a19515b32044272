"""Modes that an arc of lost contact has and the even contact has not, named by what accelerometers see of them.

Within the arc the winding moves by itself, and takes the core along. Such a mode is many of the even contact's, of all
orders. Its name is that of the order that most of the motion of the core's back is of.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from math import log

import numpy as np

from statorhom.diagnose.contacts.joint_arc import Family, JoinedMode, Weakened
from statorhom.model.affine import Materials
from statorhom.model.eigen import frequency_hz
from statorhom.model.radial_profile import node_planes
from statorhom.model.stator_mode import RIGID_HZ, VISIBLE, StatorMode


@dataclass(frozen=True, eq=False)
class Surface:
    """What is seen of a family's modes in the band.

    Parameters
    ----------
    order : (m,) that moves the back of the core most.
    amplitudes : (p, m) of that order, over the height.
    """

    order: np.ndarray
    amplitudes: np.ndarray

    def shows(self, number: int, mode: StatorMode) -> bool:
        """Whether a mode looks like one of the even contact; above the band nobody looks."""
        return number >= len(self.order) or bool(mode.order == self.order[number])


def surface(family: Family, highest_hz: float) -> Surface:
    """Of the modes of the band."""
    count = int(np.count_nonzero(frequency_hz(family.values) <= highest_hz))
    orders, parts = [], []
    for problem, start in family.starts.items():
        vectors, own = family.even.vectors[problem], family.even.problems[problem]
        x = vectors @ family.coordinates[start : start + vectors.shape[1], :count]
        orders.append(own.space.order)
        parts.append(own.profile @ x)
    amplitudes = np.array(parts)
    largest = np.argmax(np.sum(amplitudes**2, axis=1), axis=0)
    return Surface(np.array(orders)[largest], amplitudes[largest, :, np.arange(count)].T)


def born_modes(
    weakened: Weakened,
    number: int,
    seen: Surface,
    named: Collection[int],
    place: int,
    mass: float,
    materials: Materials,
) -> list[JoinedMode]:
    """Visible modes of the band that bear no name of the even contact.

    They are named by their surface, and the place of each is its number among the modes of its family.

    Parameters
    ----------
    weakened, number : modes of one axial parity, and which of their families.
    seen : what is seen of that family's.
    named : the numbers of those that do.
    place : number of the family, in the place of a problem's.
    mass : of the stator (kg).
    materials : of all regions.
    """
    family = weakened.families[number]
    frequencies = frequency_hz(family.values[: len(seen.order)]).tolist()
    visibility = np.minimum(1.0, mass * np.mean(seen.amplitudes**2, axis=0)).tolist()
    axial = node_planes(seen.amplitudes).tolist()
    found = []
    for i, f in enumerate(frequencies):
        if i in named or f < RIGID_HZ or visibility[i] <= VISIBLE:
            continue
        mode = StatorMode(f, int(seen.order[i]), axial[i], "radial", visibility[i], 1, place, i)
        found.append(JoinedMode(mode, log(f), 0j, family.slope(i, materials)))
    return found
