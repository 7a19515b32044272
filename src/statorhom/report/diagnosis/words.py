"""How the diagnosis page says things: effects, their quantities, constants and features, in plain words and units."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.materials.typical_ranges import Z95
from statorhom.report.wording import constant_interval, constant_meaning, constant_value, rounded
from statorhom.results.diagnosis import ConstantRow, EffectResult, Estimated, FeatureRow, PlanLocation
from statorhom.study.message import one_line

VERDICTS = {
    "none": "Nothing is missing from the model, as far as these measurements can tell.",
    "named": "The model lacks something, and the measurements say what.",
    "ambiguous": "The model lacks something; several explanations fit, and these measurements cannot decide.",
    "unknown": "The model lacks something that none of the effects known to the program explains.",
}
# ending of a quantity's name → factor and unit to show; longer endings first
UNITS = (
    ("_n_per_m3", 1.0, "N/m³"),
    ("_n_per_m2", 1.0, "N/m²"),
    ("_n_per_m", 1.0, "N/m"),
    ("_kg", 1.0, "kg"),
    ("_pa", 1e-9, "GPa"),
    ("_deg", 1.0, "°"),
    ("_mm", 1.0, "mm"),
    ("_k", 1.0, "K"),
    ("_n", 1.0, "N"),
)
GRAMS = 0.5  # kg: below, masses are told in grams
KINDS = {
    "frequency": "frequency",
    "split": "distance and angle of its two lines",
    "shift": "shift from one measuring place to the next",
    "lean": "how far the shape leans to one end",
    "shape": "shape",
    "damping": "damping",
    "loss": "loss factor",
    "level": "frequency above that of the lowest force",
    "level_loss": "loss factor above that of the lowest force",
    "density": "density of the sheets",
}


def effect_words(effect: str) -> str:
    """An effect's name without its underscores."""
    if effect == "none":
        return "nothing is missing"
    return one_line(effect.replace("_", " ").replace("+", " and "))


def mode_words(mode: tuple[int, ...] | None) -> str:
    """(r, n), or ? where the order is not known; the row in its table of a mode that has no such name."""
    if mode is None:
        return ""
    if len(mode) == 1:
        return str(mode[0])
    return f"({mode[0] if mode[0] >= 0 else '?'}, {mode[1]})"


def sizes_words(parameters: Mapping[str, Estimated | float | str]) -> str:
    """All parameters of an effect; a wrong input is told as the key and what it should be."""
    key = _number(parameters.get("input", ""))
    if isinstance(key, str) and key and "value" in parameters:
        unit = unit_of(key, 1.0)[2]
        said = quantity("value", parameters["value"]).removeprefix("value ")
        head, _, tail = said.partition(" (")
        return f"{one_line(key)} should be {head}{_spaced(unit)}" + (f" ({tail}" if tail else "")
    return "; ".join(quantity(name, value) for name, value in parameters.items())


def _number(value: Estimated | float | str) -> float | str:
    return value.value if isinstance(value, Estimated) else value


def quantity(name: str, value: Estimated | float | str) -> str:
    """A parameter with its unit and 90 % interval: "mass 57 g (52 … 62)"."""
    number = _number(value)
    interval = value.ci90 if isinstance(value, Estimated) else None
    words, factor, unit = unit_of(name, number)
    if isinstance(number, str):
        return f"{words}: {one_line(number)}"
    if interval is None:
        # a number of waves is whole
        shown = f"{number:.0f}" if not unit and number == round(number) else figure(number * factor)
        return f"{words} {shown}{_spaced(unit)}"
    low, high = (end * factor for end in interval)
    ends = (low, high)
    shown = figure(number * factor, ends)
    return f"{words} {shown}{_spaced(unit)} (90 % interval {figure(low, ends)} … {figure(high, ends)})"


def unit_of(name: str, value: float | str) -> tuple[str, float, str]:
    """Words, factor and unit of a quantity by its name."""
    for ending, factor, unit in UNITS:
        if name.endswith(ending):
            words = name.removesuffix(ending).replace("_", " ")
            if unit == "kg" and not isinstance(value, str) and abs(value) < GRAMS:
                factor, unit = 1e3, "g"
            return words, factor, unit
    return name.replace("_", " "), 1.0, ""


def figure(value: float, interval: tuple[float, float] | None = None) -> str:
    """A number as people write it."""
    if value and not 1e-3 <= abs(value) < 1e5:
        mantissa, power = f"{value:.2e}".split("e")
        return f"{mantissa}·10{''.join('⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.index(c)] for c in str(int(power)))}"
    return rounded(value, interval)


def place_words(effect: EffectResult) -> str:
    """Where an effect sits; empty where it sits nowhere."""
    place = effect.location
    if isinstance(place, PlanLocation):
        return _on_plan(place)
    parts = []
    if place is not None and place.angle_deg is not None:
        sd = place.angle_sd_deg or 0.0
        also = [f"{a:.0f}°" for a in place.angle_ambiguity_deg[1:]]
        parts.append(f"at {place.angle_deg:.0f}° ± {max(Z95 * sd, 0.5):.1f}° around the axis")
        if also:
            parts[-1] += f" (or, equally possible: {', '.join(also)})"
    if place is not None and place.z_mm is not None and place.z_sd_mm is not None:
        parts.append(f"{place.z_mm:.0f} ± {_whole_mm(place.z_sd_mm)} mm above the lower end")
    return ", ".join(parts)


def _on_plan(place: PlanLocation) -> str:
    others = [f"({x:.0f}, {y:.0f})" for x, y in place.place_ambiguity_mm[1:]]
    also = f" (or, equally possible: {', '.join(others)} mm)" if others else ""
    x, y = f"{place.x_mm:.0f} ± {_whole_mm(place.x_sd_mm)}", f"{place.y_mm:.0f} ± {_whole_mm(place.y_sd_mm)}"
    return f"at x = {x} mm, y = {y} mm{also}"


def constant_words(name: str) -> tuple[str, str]:
    """Step and name of a constant: "stack:lamination.E_p_pa" → "stack", "lamination: Young's modulus …"."""
    step, _, rest = name.partition(":")
    region, _, constant = rest.partition(".")
    if not constant:
        return step, "weight" if rest == "mass_kg" else rest.replace("_", " ")
    meaning = constant_meaning(constant) or constant.replace("_", " ")
    return step, f"{region}: {meaning}"


def constant_figures(row: ConstantRow) -> tuple[str, str]:
    """Value and 90 % interval of a constant, before and after."""
    constant = row.name.rpartition(".")[2] if "." in row.name else row.name.rpartition(":")[2]
    found = []
    for value, sd in ((row.before, row.before_sd), (row.after, row.after_sd)):
        ends = (value - Z95 * sd, value + Z95 * sd)
        if constant == "mass_kg":
            found.append(f"{figure(value, ends)} kg ({figure(ends[0], ends)} … {figure(ends[1], ends)})")
        else:
            ends = (max(ends[0], 0.0), ends[1])
            found.append(
                f"{constant_value(constant, value, ends)} ({constant_interval(constant, value, ends)})"
            )
    return found[0], found[1]


def feature_words(row: FeatureRow) -> str:
    """What a feature is."""
    return KINDS.get(row.kind, row.kind.replace("_", " "))


def _spaced(unit: str) -> str:
    return unit if unit in ("", "°") else f" {unit}"


def _whole_mm(sd_mm: float) -> int:
    """Half of the 90 % interval of a place in whole millimetres, never none."""
    return max(1, round(Z95 * sd_mm))
