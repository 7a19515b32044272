"""The list of blind cases: what is concealed, in which machine, how strongly, seen how."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from blind_machines import machine

MACHINES = 24
SERIES = 1000  # between the numbers of one series and the next
STRENGTHS = (0.15, 0.4, 0.65, 0.9)
STEEL = ("attached_mass", "local_stiffness", "ovality", "suspension_stiffness")
WINDING = ("end_winding_stiffness", "loose_winding_mass", "viscoelastic_winding")
# effect, template, tables (None: both kinds of data)
SINGLES: tuple[tuple[str, str, bool | None], ...] = (
    *((effect, "stack", None) for effect in STEEL),
    ("interlaminar_shear", "stack", None),
    ("stack_pressure_gradient", "stack", None),
    ("support_compliance", "clamped", None),
    ("sensor_mass", "stack", False),
    ("wrong_input", "wound", None),
    ("wrong_dimension", "wound", None),
    ("mislabelled_mode", "stack", True),
    ("temperature_shift", "chain", None),
    *((effect, "wound", None) for effect in WINDING),
    ("interface_debond", "wound", None),
    ("press_fit_contact", "framed", None),
    ("dry_friction", "levels", False),
)
OUTSIDE = ("outside_tether", "outside_absorber", "outside_helix", "outside_patchwork", "outside_lumps")
DOUBLES = (
    (("attached_mass", "interlaminar_shear"), "stack"),
    (("local_stiffness", "stack_pressure_gradient"), "stack"),
    (("attached_mass", "support_compliance"), "clamped"),
    (("ovality", "interlaminar_shear"), "stack"),
    (("attached_mass", "end_winding_stiffness"), "wound"),
)
# one doublet is split alike by a lump, a strip and an oval yoke; more of order 2 already tell them apart at times
ALIKE = ("attached_mass", "local_stiffness", "ovality")
ORDER_TWO = (("half_harmonic", 2.0),)  # an oval yoke of four waves splits order 2
NOTHING = ("stack", "wound", "clamped", "chain")
COUNTS = {"nothing": 80, "outside": 60, "double": 40, "ambiguous": 30}


@dataclass(frozen=True)
class BlindCase:
    """One case.

    Parameters
    ----------
    number : of the case; its seed as well.
    group : single, nothing, outside, double or ambiguous.
    effects : to conceal.
    template, machine : of the study.
    tables : modal tables instead of FRFs.
    strength : 0 … 1, of all effects.
    wide : the true constants are far from where a fit starts.
    only : the one mode (r, n) that a table lists.
    given : parameters that are not drawn.
    """

    number: int
    group: str
    effects: tuple[str, ...]
    template: str
    machine: int
    tables: bool
    strength: float
    wide: bool = False
    only: tuple[int, int] | None = None
    given: tuple[tuple[str, float], ...] = ()

    @property
    def name(self) -> str:
        """Name of its folder; tells nothing."""
        return f"case-{self.number:04d}"


def blind_cases(count: int | None = None, series: int = 0) -> tuple[BlindCase, ...]:
    """The first `count` cases, all by default; any beginning of the list holds all groups in about equal shares.

    Parameters
    ----------
    count : how many.
    series : 0 is the benchmark; others have the same effects in other machines with other draws, to develop on.
    """
    groups = [_singles(), _nothing(), _outside(), _doubles(), _ambiguous()]
    placed = [
        ((i + 0.5) / len(group), g, row) for g, group in enumerate(groups) for i, row in enumerate(group)
    ]
    rows = [row for _, _, row in sorted(placed, key=lambda p: p[:2])]
    cases = []
    for number, row in enumerate(rows[:count], start=1 + SERIES * series):
        rng = np.random.default_rng([5, number])
        choice = list(range(MACHINES * series, MACHINES * (series + 1)))
        if "interface_debond" in row["effects"]:  # type: ignore[operator]
            # what rattles in an arc takes minutes with more
            slots = {n: machine(n)["slots"]["count"] for n in choice}
            choice = [n for n in choice if slots[n] == min(slots.values())]
        cases.append(BlindCase(number=number, machine=int(rng.choice(choice)), **row))  # type: ignore[arg-type]
    return tuple(cases)


def _row(
    group: str, effects: tuple[str, ...], template: str, tables: bool, strength: float
) -> dict[str, object]:
    return {"group": group, "effects": effects, "template": template, "tables": tables, "strength": strength}


def _mixed(rows: list[dict[str, object]], seed: int) -> list[dict[str, object]]:
    order = np.random.default_rng([9, seed]).permutation(len(rows))
    return [rows[i] for i in order]


def _singles() -> list[dict[str, object]]:
    rows = []
    for (effect, template, kind), strength, tables in product(SINGLES, STRENGTHS, (True, False)):
        if kind in (None, tables):
            rows.append(_row("single", (effect,), template, tables, strength))
    # the most usual ones once more, on other machines
    rows += [_row("single", (e,), "stack", t, s) for e, s, t in product(STEEL, STRENGTHS, (True, False))]
    return _mixed(rows, 1)


def _nothing() -> list[dict[str, object]]:
    rows = [
        _row("nothing", ("none",), NOTHING[i % len(NOTHING)], i // len(NOTHING) % 2 == 0, 0.5)
        | {"wide": True}
        for i in range(COUNTS["nothing"])
    ]
    return _mixed(rows, 2)


def _outside() -> list[dict[str, object]]:
    rows = [
        _row(
            "outside", (OUTSIDE[i % len(OUTSIDE)],), "stack", i // len(OUTSIDE) % 2 == 0, STRENGTHS[i % 3 + 1]
        )
        for i in range(COUNTS["outside"])
    ]
    return _mixed(rows, 3)


def _doubles() -> list[dict[str, object]]:
    rows = []
    for i in range(COUNTS["double"]):
        effects, template = DOUBLES[i % len(DOUBLES)]
        rows.append(_row("double", effects, template, i // len(DOUBLES) % 2 == 0, STRENGTHS[i % 3 + 1]))
    return _mixed(rows, 4)


def _ambiguous() -> list[dict[str, object]]:
    rows = [
        _row("ambiguous", (ALIKE[i % len(ALIKE)],), "stack", True, STRENGTHS[i % 3 + 1])
        | {"only": (2, 0), "given": ORDER_TWO if ALIKE[i % len(ALIKE)] == "ovality" else ()}
        for i in range(COUNTS["ambiguous"])
    ]
    return _mixed(rows, 5)
