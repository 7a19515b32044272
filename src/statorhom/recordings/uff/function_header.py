"""Dataset 58, function at nodal degree of freedom: its eleven header records."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.recordings.uff.records import Place, fields

HEADER_RECORDS = 11
TIME_RESPONSE, FRF, COHERENCE = 1, 4, 6
_REAL_SINGLE, _REAL_DOUBLE, _COMPLEX_SINGLE, _COMPLEX_DOUBLE = 2, 4, 5, 6

_DOF = (
    (5, int), (10, int), (5, int), (10, int),
    (11, str), (10, int), (4, int), (11, str), (10, int), (4, int),
)  # fmt: skip
_FORM = ((10, int), (10, int), (10, int), (13, float), (13, float), (13, float))
_AXIS = ((10, int), (5, int), (5, int), (5, int), (21, str), (21, str))


@dataclass(frozen=True)
class Axis:
    """What an axis or an ordinate shows: the format's code of the quantity, and its unit as text."""

    quantity: int
    unit: str


@dataclass(frozen=True)
class FunctionHeader:
    """What a function is and how its values are stored.

    Attributes
    ----------
    kind : int
        Function type: 1 time response, 4 frequency response function, 6 coherence.
    load_case : int
        Of raw records: the number of the hit.
    response_node, response_direction, reference_node, reference_direction : int
        Directions ±1, ±2, ±3 in the node's displacement coordinate system; 0 is none.
    is_complex, is_double : bool
    count : int
        Values, or pairs of abscissa and value.
    is_even : bool
        Whether only the first abscissa and the increment are stored.
    start, increment : float
    abscissa, ordinate, denominator : Axis
    """

    kind: int
    load_case: int
    response_node: int
    response_direction: int
    reference_node: int
    reference_direction: int
    is_complex: bool
    is_double: bool
    count: int
    is_even: bool
    start: float
    increment: float
    abscissa: Axis
    ordinate: Axis
    denominator: Axis

    @property
    def values_per_point(self) -> int:
        """Numbers that are stored for each point."""
        return 1 + self.is_complex + (not self.is_even)


def read_header(place: Place, records: list[str]) -> FunctionHeader:
    """Read the header.

    Parameters
    ----------
    place : Place
    records : list of str
        The eleven lines that follow the line with the dataset's type.

    Raises
    ------
    RecordingError
    """
    # line 1 holds the dataset's type, lines 2 to 6 are free text
    dof = fields(place, 7, records[5], _DOF)
    form, count, spacing, start, increment, _ = fields(place, 8, records[6], _FORM)
    if form not in (_REAL_SINGLE, _REAL_DOUBLE, _COMPLEX_SINGLE, _COMPLEX_DOUBLE):
        raise place.error(8, f"{form} is no type of data", "export it as real or complex (2, 4, 5 or 6)")
    if count < 1:
        raise place.error(8, f"promises {count} values", "export it again")
    if spacing not in (0, 1):
        raise place.error(8, f"{spacing} is no spacing of the abscissa", "it is 0 (uneven) or 1 (even)")
    return FunctionHeader(
        kind=dof[0],
        load_case=dof[3],
        response_node=dof[5],
        response_direction=dof[6],
        reference_node=dof[8],
        reference_direction=dof[9],
        is_complex=form in (_COMPLEX_SINGLE, _COMPLEX_DOUBLE),
        is_double=form in (_REAL_DOUBLE, _COMPLEX_DOUBLE),
        count=count,
        is_even=spacing == 1,
        start=start,
        increment=increment,
        abscissa=_axis(place, 9, records[7]),
        ordinate=_axis(place, 10, records[8]),
        denominator=_axis(place, 11, records[9]),
    )


def _axis(place: Place, line: int, text: str) -> Axis:
    quantity, _, _, _, _, unit = fields(place, line, text, _AXIS)
    return Axis(quantity, "" if unit.upper() == "NONE" else unit)
