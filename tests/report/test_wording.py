"""Figures carry the digits that their uncertainty leaves them, symbols are those of the field."""

import pytest

from statorhom.report.diagnosis.words import place_words
from statorhom.report.document import plain
from statorhom.report.wording import (
    constant_formula,
    constant_interval,
    constant_symbol,
    constant_value,
    mode_name,
    percent,
    plural,
    rounded,
)
from statorhom.results.diagnosis import EffectResult, PlanLocation


@pytest.mark.parametrize(
    ("value", "interval", "shown"),
    [
        (191.53, (187.7, 195.3), "191.5"),
        (191.53, (100.0, 300.0), "190"),
        (0.346, (0.19, 0.54), "0.35"),
        (0.00001, (0.00001, 0.00001), "0.0000100"),
        (7810.5, None, "7810"),
        (25.0, (24.9999, 25.0001), "25.000"),
        (0.0, None, "0.00"),
        (float("nan"), None, "–"),
    ],
)
def test_rounded(value: float, interval: tuple[float, float] | None, shown: str) -> None:
    assert rounded(value, interval) == shown


def test_moduli_carry_their_unit() -> None:
    assert constant_value("E_p_pa", 1.915e11) == "192 GPa"
    assert constant_value("G_rz_pa", 8.02e7) == "80.2 MPa"
    assert constant_value("nu_p", 0.29) == "0.290"


def test_an_interval_has_one_unit() -> None:
    assert constant_interval("E_pa", 3.5e8, (6e7, 9e8)) == "0.060 … 0.90 GPa"


@pytest.mark.parametrize(
    ("name", "letters"),
    [
        ("E_p_pa", "Ep"),
        ("nu_pz", "νpz"),
        ("G_rz_pa", "Grz"),
        ("E_pa", "E"),
        ("nu_tz", "νθz"),
        ("E_t_pa", "Eθ"),
    ],
)
def test_symbols(name: str, letters: str) -> None:
    assert plain(constant_symbol(name)) == letters


def test_only_known_constants_become_formulas() -> None:
    assert constant_formula("nu_pz") == "$ν_{pz}$"
    assert constant_formula("E_\\input{x}_pa") is None


@pytest.mark.parametrize(
    ("order", "axial", "kind", "name"),
    [
        (2, 0, "radial", "(2, 0)"),
        (4, None, None, "(4, ?)"),
        (None, None, "torsion", "torsion of the core"),
        (None, None, "radial", "radial, order unknown"),
        (None, None, None, "unnamed"),
    ],
)
def test_mode_names(order: int | None, axial: int | None, kind: str | None, name: str) -> None:
    assert mode_name(order, axial, kind) == name


def test_percent_has_a_sign() -> None:
    assert [percent(x) for x in (0.5, -0.5, None)] == ["+0.50", "−0.50", "–"]


def test_plural() -> None:
    assert [plural(n, "mode") for n in (0, 1, 2, 11)] == ["no modes", "one mode", "two modes", "11 modes"]


def test_a_place_on_a_plan_is_never_known_to_no_millimetre() -> None:
    location = PlanLocation(
        x_mm=638.03, x_sd_mm=1.78, y_mm=947.1, y_sd_mm=0.16, place_ambiguity_mm=((638.03, 947.1),)
    )
    effect = EffectResult(
        effect="attached_mass",
        stage="wing",
        region=None,
        test=None,
        location=location,
        parameters={},
        probability=1.0,
        note=None,
    )
    assert place_words(effect) == "at x = 638 ± 3 mm, y = 947 ± 1 mm"
