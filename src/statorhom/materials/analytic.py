"""Analytic start values of the lamination and the winding from what the files tell of them."""

from __future__ import annotations

from statorhom.errors import MaterialError
from statorhom.materials.constituents import (
    COPPER,
    ELECTRICAL_STEEL,
    IMPREGNATING_RESIN,
    SHEET_COATING,
    WIRE_ENAMEL,
)
from statorhom.materials.homogenization.layers import Layer, homogenize_layers
from statorhom.materials.homogenization.wires import Fill, homogenize_wires
from statorhom.materials.transversely_isotropic import TransverselyIsotropic


def analytic_lamination(sheet_thickness_m: float, coating_thickness_m: float) -> TransverselyIsotropic:
    """Homogenize bonded sheets of electrical steel with their coating (h1 and h2 of the seed's Table 1).

    Parameters
    ----------
    sheet_thickness_m, coating_thickness_m : float
        Of the bare sheet, and of the coating per sheet.

    Raises
    ------
    MaterialError
        A thickness is not positive.
    """
    sheet = Layer(ELECTRICAL_STEEL.material, sheet_thickness_m)
    coating = Layer(SHEET_COATING.material, coating_thickness_m)
    return homogenize_layers((sheet, coating))


def analytic_winding(
    dry_density_kg_m3: float,
    impregnated_density_kg_m3: float,
    wire_radius_m: float,
    insulated_radius_m: float,
) -> TransverselyIsotropic:
    """Homogenize an impregnated winding, its fill taken from the weighings before and after the resin.

    Parameters
    ----------
    dry_density_kg_m3, impregnated_density_kg_m3 : float
        Mean densities of the winding's volume before and after impregnation.
    wire_radius_m, insulated_radius_m : float
        r1 of the bare and r2 of the insulated wire.

    Raises
    ------
    MaterialError
        The radii or the densities are impossible: the parts need more room than there is, or the
        weighings show no resin.
    """
    if not 0.0 < wire_radius_m <= insulated_radius_m:
        raise MaterialError(
            f"wire: wire_radius_mm must be positive and at most insulated_radius_mm, is "
            f"{1e3 * wire_radius_m:.6g} against {1e3 * insulated_radius_m:.6g}"
        )
    enamel_per_copper = (insulated_radius_m / wire_radius_m) ** 2 - 1.0
    conductor = dry_density_kg_m3 / (COPPER.density_kg_m3 + enamel_per_copper * WIRE_ENAMEL.density_kg_m3)
    fill = Fill(
        conductor=conductor,
        insulation=enamel_per_copper * conductor,
        resin=(impregnated_density_kg_m3 - dry_density_kg_m3) / IMPREGNATING_RESIN.density_kg_m3,
    )
    return homogenize_wires(COPPER.material, WIRE_ENAMEL.material, IMPREGNATING_RESIN.material, fill)
