"""Dataset 164, units, and the unit labels of functions."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from statorhom.recordings.uff.records import Place, number

# units per metre and per newton, by the format's code of the unit system; 9 is the user's own
_FACTORS = {
    1: (1.0, 1.0),
    2: (1 / 0.3048, 1 / 4.4482216152605),
    3: (1.0, 1 / 9.80665),
    4: (1 / 0.3048, 1 / 0.138254954376),
    5: (1e3, 1e3),
    6: (1e2, 1e2),
    7: (1 / 0.0254, 1 / 4.4482216152605),
    8: (1e3, 1 / 9.80665),
    10: (1e3, 1.0),
}
# the description that follows may touch it
_CODE = re.compile(r"^\s*(\d{1,9})")
_SI_NOW = "export the file in SI units (m, N, s)"


@dataclass(frozen=True)
class Units:
    """Units of a file: `length` units are a metre, `force` units a newton."""

    length: float = 1.0
    force: float = 1.0

    @property
    def are_si(self) -> bool:
        """Whether nothing has to be converted."""
        return self.length == 1.0 and self.force == 1.0


def read_units(place: Place, lines: list[str]) -> Units:
    """Read dataset 164.

    Parameters
    ----------
    place : Place
    lines : list of str
        Its records.

    Raises
    ------
    RecordingError
        Also where the factors are not those of the named unit system: one of the two is wrong.
    """
    try:
        code = int(_CODE.findall(lines[0])[0])
        length, force = (number(word) for word in " ".join(lines[1:]).split()[:2])
    except (ValueError, IndexError):
        raise place.error(None, "does not hold a unit system and its factors", _SI_NOW) from None
    if not all(math.isfinite(factor) and factor > 0.0 for factor in (length, force)):
        raise place.error(3, "factors must be greater than 0", _SI_NOW)
    expected = _FACTORS.get(code, (length, force))
    for name, factor, wanted in zip(("length", "force"), (length, force), expected, strict=True):
        if not math.isclose(factor, wanted, rel_tol=1e-3):
            raise place.error(
                3,
                f"unit system {code} has {wanted:.6g} units of {name} per SI unit, "
                f"but the file says {factor:.6g}",
                _SI_NOW,
            )
    # factors of 1 that were printed with a few digits too few
    return Units(*(1.0 if math.isclose(f, 1.0, rel_tol=1e-6) else f for f in (length, force)))
