import pytest

from statorhom.materials.constituents import (
    COPPER,
    ELECTRICAL_STEEL,
    IMPREGNATING_RESIN,
    SHEET_COATING,
    WIRE_ENAMEL,
)


@pytest.mark.parametrize(
    ("constituent", "wave_m_s"),
    # speed of sound in a thin rod, √(E/ρ), from tables of acoustics
    [(ELECTRICAL_STEEL, 5170.0), (COPPER, 3700.0), (IMPREGNATING_RESIN, 1600.0)],
)
def test_stiffness_and_density_make_the_tabulated_speed_of_sound(constituent, wave_m_s):
    speed = (constituent.material.E_pa / constituent.density_kg_m3) ** 0.5
    assert speed == pytest.approx(wave_m_s, rel=0.02)


def test_polymers_are_lighter_and_softer_than_metals():
    for polymer in (SHEET_COATING, WIRE_ENAMEL, IMPREGNATING_RESIN):
        assert polymer.density_kg_m3 < 2000.0
        assert polymer.material.E_pa < 0.1 * COPPER.material.E_pa
