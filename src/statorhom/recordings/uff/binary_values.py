"""Values of a binary function dataset (58b)."""

from __future__ import annotations

import numpy as np

from statorhom.recordings.uff.function_header import FunctionHeader
from statorhom.recordings.uff.records import Place

_IEEE_754 = 2
_BYTE_ORDERS = {1: "<", 2: ">"}


def read_byte_order(place: Place, text: str) -> str:
    """``<`` or ``>`` from what follows the type: byte order, floating point format, header lines, bytes, …

    The number of bytes is not relied on, because programs count complex values differently.

    Raises
    ------
    RecordingError
    """
    words = text.split()
    try:
        order, floating_point = int(words[0]), int(words[1])
    except (ValueError, IndexError):
        raise place.error(1, "does not say how its binary numbers are stored") from None
    if order not in _BYTE_ORDERS:
        raise place.error(1, f"{order} is no byte order", "it is 1 (little endian) or 2 (big endian)")
    if floating_point != _IEEE_754:
        raise place.error(1, "its binary numbers are not IEEE 754", "export it as IEEE 754 or as text")
    return _BYTE_ORDERS[order]


def point_types(header: FunctionHeader, byte_order: str) -> list[np.dtype]:
    """How one point may be stored, the most frequent way first.

    With double precision and uneven spacing most programs store all numbers in eight bytes, while the format
    asks for abscissae in four.
    """
    ordinate = f"{byte_order}f{8 if header.is_double else 4}"
    ordinates = [("y", ordinate, (1 + header.is_complex,))]
    if header.is_even:
        return [np.dtype(ordinates)]
    abscissae = [ordinate, f"{byte_order}f4"] if header.is_double else [ordinate]
    return [np.dtype([("x", abscissa), *ordinates]) for abscissa in abscissae]
