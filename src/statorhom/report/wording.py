"""How quantities are written: symbols of constants, names of modes, regions and steps, rounded figures."""

from __future__ import annotations

import math

from statorhom.report.document import Span, Text
from statorhom.results import ModeResult

NOTHING = "–"

_MEANING = {
    "E_pa": "Young’s modulus",
    "nu": "Poisson’s ratio",
    "E_p_pa": "Young’s modulus in the plane",
    "E_z_pa": "Young’s modulus along z",
    "nu_p": "Poisson’s ratio within the plane",
    "nu_pz": "Poisson’s ratio, along z under load in the plane",
    "G_rz_pa": "Shear modulus between the plane and z",
    "E_r_pa": "Young’s modulus, radial",
    "E_t_pa": "Young’s modulus, tangential",
    "nu_rt": "Poisson’s ratio, along θ under load along r",
    "nu_rz": "Poisson’s ratio, along z under load along r",
    "nu_tz": "Poisson’s ratio, along z under load along θ",
    "G_rt_pa": "Shear modulus in the r–θ plane",
    "G_tz_pa": "Shear modulus between θ and z",
    "E_1_pa": "Young’s modulus along 1",
    "E_2_pa": "Young’s modulus along 2",
    "E_3_pa": "Young’s modulus along 3",
    "nu_12": "Poisson’s ratio, along 2 under load along 1",
    "nu_13": "Poisson’s ratio, along 3 under load along 1",
    "nu_23": "Poisson’s ratio, along 3 under load along 2",
    "G_12_pa": "Shear modulus between 1 and 2",
    "G_13_pa": "Shear modulus between 1 and 3",
    "G_23_pa": "Shear modulus between 2 and 3",
}
AXES_OF_ROUND = ("r", "θ", "z")
AXES_OF_BLOCKS = ("x", "y", "z")
AXES_OF_PLIES = ("1", "2", "3")
WING = "wing"  # of coupons the one that has several materials
_SYMMETRY = {
    "isotropic": "isotropic (the same in all directions)",
    "transversely_isotropic": "transversely isotropic (the same in all {0}–{1} directions, different along {2})",
    "orthotropic": "orthotropic (different along {0}, {1} and {2})",
}
_KIND = {
    "stack": "lamination stack",
    "wound": "wound, without resin",
    "impregnated": "wound and impregnated",
    "framed": "in its frame",
    "machine": "complete machine",
    "coupon": "coupon",
}
_MODE_KIND = {
    "torsion": "torsion of the core",
    "axial": "axial motion",
    "winding": "motion of the winding",
    "radial": "radial motion",
    "in plane": "in-plane motion",
}
_NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
_SUBSCRIPT = {"t": "θ"}
_LETTER = {"nu": "ν"}


def constant_symbol(name: str) -> Text:
    """Symbol of an engineering constant: E_p_pa → E with subscript p."""
    parts = name.removesuffix("_pa").split("_")
    index = "".join(_SUBSCRIPT.get(c, c) for c in "".join(parts[1:]))
    letter = Span(_LETTER.get(parts[0], parts[0]), "symbol")
    return (letter, Span(index, "sub")) if index else (letter,)


def constant_formula(name: str) -> str | None:
    """A known constant's symbol as matplotlib sets it: E_p_pa → $E_{p}$; None for any other name."""
    if name not in _MEANING:
        return None
    letter, *index = (span.text for span in constant_symbol(name))
    return f"${letter}_{{{index[0]}}}$" if index else f"${letter}$"


def constant_meaning(name: str) -> str:
    """What a constant is, in words."""
    return _MEANING.get(name, "")


def symmetry_words(symmetry: str, axes: tuple[str, str, str] = AXES_OF_ROUND) -> str:
    """A symmetry in words."""
    return _SYMMETRY[symmetry].format(*axes) if symmetry in _SYMMETRY else symmetry


def step_words(kind: str) -> str:
    """A fabrication step in words."""
    return _KIND.get(kind, kind)


def mode_name(order: int | None, axial: int | None, kind: str | None = None) -> str:
    """(r, n), or the kind of a mode without radial motion."""
    if order is None:
        # what a plate, a beam or a wing does is said in full
        return _MODE_KIND.get(kind or "", kind or "unnamed") if kind != "radial" else "radial, order unknown"
    return f"({order}, {'?' if axial is None else axial})"


def short_name(mode: ModeResult) -> str:
    """A mode's name where there is little space."""
    if mode.order is None:
        return mode.kind if mode.kind and mode.kind != "radial" else "(?)"
    return mode_name(mode.order, mode.axial)


def constant_value(name: str, value: float, interval: tuple[float, float] | None = None) -> str:
    """Value of a constant with its unit."""
    scaled, unit = _scaled(name, value)
    ends = None if interval is None else (interval[0] / scaled, interval[1] / scaled)
    return f"{rounded(value / scaled, ends)}{unit}"


def constant_interval(name: str, value: float, interval: tuple[float, float]) -> str:
    """Interval of a constant with its unit."""
    scaled, unit = _scaled(name, value)
    low, high = (end / scaled for end in interval)
    return f"{rounded(low, (low, high))} … {rounded(high, (low, high))}{unit}"


def rounded(value: float, interval: tuple[float, float] | None = None, digits: int = 3) -> str:
    """A figure with the digits that its interval leaves it: two of the interval's half-width."""
    if not math.isfinite(value):
        return NOTHING
    magnitude = math.floor(math.log10(abs(value))) if value else 0
    half = 0.0 if interval is None else abs(interval[1] - interval[0]) / 2
    decimals = 1 - math.floor(math.log10(half)) if half > 0 else digits - 1 - magnitude
    # two digits of the value itself at least, five at most
    decimals = min(max(decimals, 1 - magnitude), 4 - magnitude)
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def frequency(value: float | None) -> str:
    """A frequency in Hz, to a tenth below 10 kHz."""
    if value is None:
        return NOTHING
    return f"{value:.1f}" if abs(value) < 9999.95 else f"{value:.0f}"


def percent(value: float | None, digits: int = 2, sign: bool = True) -> str:
    """A percentage with its sign, without the unit."""
    if value is None:
        return NOTHING
    shown = f"{value:{'+' if sign else ''}.{digits}f}"
    return shown.replace("-", "−")


def number(count: int) -> str:
    """A count in running text: up to ten in words."""
    return _NUMBERS[count] if 0 <= count < len(_NUMBERS) else str(count)


def plural(count: int, noun: str) -> str:
    """Count and noun."""
    return f"{number(count)} {noun}" if count == 1 else f"{number(count)} {noun}s"


def _scaled(name: str, value: float) -> tuple[float, str]:
    if not name.endswith("_pa"):
        return 1.0, ""
    return (1e9, " GPa") if abs(value) >= 0.1e9 else (1e6, " MPa")
