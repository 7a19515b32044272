"""Dataset 58 as it is written: double precision, SI, binary or text."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.recordings.uff.quantities import ACCELERATION, EXCITATION_FORCE, FREQUENCY, TIME

_REAL, _COMPLEX = 4, 6
_LITTLE_ENDIAN, _IEEE_754, _HEADER_LINES = 1, 2, 11
_EVEN = 1e-6
# type of the axis, its label and unit
FREQUENCY_AXIS = (FREQUENCY, "Frequency", "Hz")
TIME_AXIS = (TIME, "Time", "s")
ACCELERATION_AXIS = (ACCELERATION, "Acceleration", "m/s^2")
FORCE_AXIS = (EXCITATION_FORCE, "Force", "N")
NO_AXIS = (0, "NONE", "NONE")

Axis = tuple[int, str, str]


@dataclass(frozen=True)
class DofCode:
    """Node and direction as the file names them."""

    node: int
    direction: int


@dataclass(frozen=True)
class WrittenFunction:
    """What a dataset 58 says.

    Attributes
    ----------
    kind : int
        Function type.
    load_case : int
    response, reference : DofCode
    abscissa, values : arrays, shape (points,)
    axes : tuple of Axis
        Abscissa, ordinate and the ordinate's denominator.
    """

    kind: int
    load_case: int
    response: DofCode
    reference: DofCode
    abscissa: np.ndarray
    values: np.ndarray
    axes: tuple[Axis, Axis, Axis]

    def encoded(self, binary: bool) -> bytes:
        """The dataset with its delimiters.

        Even abscissae are written as start and increment with the format's six digits.
        """
        is_even = self._is_even()
        columns = [] if is_even else [self.abscissa]
        columns += [self.values.real, self.values.imag] if np.iscomplexobj(self.values) else [self.values]
        numbers = np.column_stack(columns).astype("<f8")
        if binary:
            body = numbers.tobytes()
            form = (
                f"b{_LITTLE_ENDIAN:6d}{_IEEE_754:6d}{_HEADER_LINES:12d}{len(body):12d}"
                + f"{0:6d}{0:6d}{0:12d}{0:12d}"
            )
        else:
            body = _text(numbers, is_even).encode("ascii")
            form = ""
        head = [f"{-1:6d}", f"{58:6d}{form}", *self._header(is_even)]
        return "\n".join([*head, ""]).encode("ascii") + body + f"{-1:6d}\n".encode("ascii")

    def _is_even(self) -> bool:
        steps = np.diff(self.abscissa)
        return len(steps) > 0 and bool(np.allclose(steps, np.mean(steps), rtol=_EVEN, atol=0.0))

    def _header(self, is_even: bool) -> list[str]:
        form = _COMPLEX if np.iscomplexobj(self.values) else _REAL
        count = len(self.values)
        start = self.abscissa[0] if is_even else 0.0
        step = (self.abscissa[-1] - self.abscissa[0]) / (count - 1) if is_even else 0.0
        return [
            *["NONE"] * 5,
            f"{self.kind:5d}{0:10d}{0:5d}{self.load_case:10d}"
            f" {'NONE':10s}{self.response.node:10d}{self.response.direction:4d}"
            f" {'NONE':10s}{self.reference.node:10d}{self.reference.direction:4d}",
            f"{form:10d}{count:10d}{int(is_even):10d}{start:13.5e}{step:13.5e}{0.0:13.5e}",
            *(
                f"{quantity:10d}{0:5d}{0:5d}{0:5d} {label:20s} {unit:20s}"
                for quantity, label, unit in (*self.axes, NO_AXIS)
            ),
        ]


def _text(numbers: np.ndarray, is_even: bool) -> str:
    if is_even:
        return _lines(numbers.ravel(), ("%20.12e",) * 4)
    is_complex = numbers.shape[1] == 3
    return _lines(
        numbers.ravel(), ("%13.5e", "%20.12e", "%20.12e") if is_complex else ("%13.5e", "%20.12e") * 2
    )


def _lines(numbers: np.ndarray, columns: tuple[str, ...]) -> str:
    full, rest = divmod(len(numbers), len(columns))
    template = ("".join(columns) + "\n") * full + ("".join(columns[:rest]) + "\n" if rest else "")
    return template % tuple(numbers)
