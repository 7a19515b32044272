import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.errors import MassError
from statorhom.materials.density import Weighing, densities, shared_densities

VOLUMES = {"lamination": 4.0e-4, "winding": 3.0e-4, "overhang": 1.0e-4, "frame": 2.0e-4, "machine": 5.0e-4}
CHAIN = (
    Weighing("core", "stack", 3.0, 0.002),
    Weighing("coils", "wound", 4.2, 0.003),
    Weighing("potted", "impregnated", 4.3, 0.004),
    Weighing("housed", "framed", 4.8, 0.005),
    Weighing("done", "machine", 8.6, 0.012),
)


def test_a_chain_step_by_step():
    found = densities(CHAIN, VOLUMES)
    assert [density.stage for density in found] == ["core", "coils", "potted", "housed", "done"]
    assert [density.region for density in found] == ["lamination", "winding", "winding", "frame", "machine"]
    assert [density.mass_kg for density in found] == pytest.approx([3.0, 1.2, 1.3, 0.5, 3.8])
    assert [density.density_kg_m3 for density in found] == pytest.approx(
        [7500.0, 3000.0, 3250.0, 2500.0, 7600.0]
    )


def test_the_seed_papers_densities():
    # 394.3 and 420.0 cm³ (computed from the drawing's dimensions)
    chain = (Weighing("a", "stack", 3.08, 0.002), Weighing("b", "impregnated", 4.41, 0.002))
    core, winding = densities(chain, {"lamination": 3.9434e-4, "winding": 4.2004e-4})
    assert core.density_kg_m3 == pytest.approx(7810.5, rel=1e-3)
    assert winding.density_kg_m3 == pytest.approx(3166.4, rel=1e-3)


def test_both_weighings_make_the_uncertainty():
    core, coils, potted, housed, _ = densities(CHAIN, VOLUMES)
    assert core.density_sd_kg_m3 == pytest.approx(0.002 / 4.0e-4)
    assert coils.density_sd_kg_m3 == pytest.approx(math.hypot(0.002, 0.003) / 4.0e-4)
    assert potted.density_sd_kg_m3 == pytest.approx(math.hypot(0.002, 0.004) / 4.0e-4)
    assert housed.density_sd_kg_m3 == pytest.approx(math.hypot(0.004, 0.005) / 2.0e-4)


def test_the_uncertainty_is_the_scatter_of_repeated_weighings():
    rng = np.random.default_rng(5)
    stack, potted = 3.0 + 0.002 * rng.standard_normal(4000), 4.3 + 0.004 * rng.standard_normal(4000)
    repeated = [
        densities((Weighing("a", "stack", m, 0.002), Weighing("b", "impregnated", n, 0.004)), VOLUMES)[1]
        for m, n in zip(stack, potted, strict=True)
    ]
    scatter = np.std([density.density_kg_m3 for density in repeated])
    assert repeated[0].density_sd_kg_m3 == pytest.approx(scatter, rel=0.05)


@settings(deadline=None)
@given(st.lists(st.floats(0.01, 10.0), min_size=5, max_size=5))
def test_the_regions_masses_add_up_to_the_last_weight(added):
    totals = np.cumsum(added)
    chain = [Weighing(w.stage, w.kind, float(m), 0.0) for w, m in zip(CHAIN, totals, strict=True)]
    core, _, winding, frame, machine = densities(chain, VOLUMES)
    parts = (core, winding, frame, machine)
    assert sum(part.density_kg_m3 * part.volume_m3 for part in parts) == pytest.approx(totals[-1])


def test_steps_may_be_skipped():
    chain = (CHAIN[0], CHAIN[3])
    assert densities(chain, VOLUMES)[1].mass_kg == pytest.approx(1.8)


def test_resin_may_be_too_light_for_the_scale():
    chain = (CHAIN[0], CHAIN[1], Weighing("potted", "impregnated", 4.2, 0.003))
    _, dry, potted = densities(chain, VOLUMES)
    assert potted.density_kg_m3 == dry.density_kg_m3


@pytest.mark.parametrize(
    ("chain", "reason"),
    [
        (
            (CHAIN[0], CHAIN[2], Weighing("housed", "framed", 4.1, 0.005)),
            r"4\.1 kg after 'housed' is less than 4\.3 kg after 'potted', a loss of 0\.2 kg.*correct one",
        ),
        (
            (CHAIN[0], CHAIN[1], Weighing("potted", "impregnated", 4.15, 0.005)),
            r"4\.15 kg after 'potted' is less than 4\.2 kg after 'coils'",
        ),
        (
            (CHAIN[0], Weighing("coils", "wound", 3.0, 0.005)),
            r"3 kg after 'coils' leaves 0 kg for the region winding: correct",
        ),
        ((CHAIN[1],), r"4\.2 kg after 'coils' holds more than the winding: add the stage before it"),
        ((CHAIN[1], CHAIN[2]), "holds more than the winding"),
        ((CHAIN[3],), "holds more than the frame"),
    ],
)
def test_contradicting_weights_are_refused_with_the_numbers(chain, reason):
    with pytest.raises(MassError, match=reason):
        densities(chain, VOLUMES)


def test_a_region_without_volume_names_the_missing_table():
    with pytest.raises(MassError, match=r"stage 'housed'.*region frame.*add \[frame\]"):
        densities((CHAIN[0], CHAIN[3]), {"lamination": 4.0e-4})


WING_VOLUMES = {"cloth": 4e-4, "foam": 3e-3}


def test_the_weight_gives_the_one_density_that_is_not_known() -> None:
    weighing = Weighing("wing", "coupon", 1.0, 0.004)
    found = {d.region: d for d in shared_densities(weighing, WING_VOLUMES, {"foam": 80.0}, 0.1)}
    assert found["foam"].density_kg_m3 == pytest.approx(80.0) and found["foam"].density_sd_kg_m3 == 0.0
    assert found["cloth"].density_kg_m3 == pytest.approx((1.0 - 0.1 - 0.24) / 4e-4)
    assert found["cloth"].density_sd_kg_m3 == pytest.approx(0.004 / 4e-4)


def test_the_weight_scales_densities_that_are_all_known() -> None:
    weighing = Weighing("wing", "coupon", 1.0, 0.004)
    found = shared_densities(weighing, WING_VOLUMES, {"cloth": 1500.0, "foam": 80.0}, 0.1)
    assert sum(d.mass_kg for d in found) == pytest.approx(0.9)
    assert found[0].density_kg_m3 / found[1].density_kg_m3 == pytest.approx(1500.0 / 80.0)
    # all of them together are as uncertain as the weight
    assert sum(d.density_sd_kg_m3 * d.volume_m3 for d in found) == pytest.approx(0.004)


@pytest.mark.parametrize(
    ("known", "lumps_kg"), [({"foam": 400.0}, 0.0), ({"foam": 80.0, "cloth": 1500.0}, 1.1)]
)
def test_a_weight_below_its_parts_is_refused(known: dict[str, float], lumps_kg: float) -> None:
    with pytest.raises(MassError, match="no more than the parts of known mass together") as caught:
        shared_densities(Weighing("wing", "coupon", 1.0, 0.004), WING_VOLUMES, known, lumps_kg)
    assert "\n" not in str(caught.value)
