"""A stack of isotropic sheets as one transversely isotropic material, stacking axis z (Backus 1962)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic


@dataclass(frozen=True)
class Layer:
    """One layer of the repeating pack.

    Parameters
    ----------
    material : Isotropic
    thickness_m : float
        Must be positive; only ratios count, except against a contact.

    Raises
    ------
    MaterialError
        The thickness is not positive.
    """

    material: Isotropic
    thickness_m: float

    def __post_init__(self) -> None:
        if not 0.0 < self.thickness_m < np.inf:
            raise MaterialError(f"layer: thickness_m must be positive and finite, is {self.thickness_m:.6g}")


@dataclass(frozen=True)
class Contact:
    """One imperfect contact per pack, as springs spread over the area.

    Parameters
    ----------
    normal_n_per_m3, tangential_n_per_m3 : float
        Stiffness per area against opening and sliding, in N/m³; infinite where nothing gives way.

    Raises
    ------
    MaterialError
        A stiffness is not positive.
    """

    normal_n_per_m3: float
    tangential_n_per_m3: float

    def __post_init__(self) -> None:
        for name in ("normal_n_per_m3", "tangential_n_per_m3"):
            if not getattr(self, name) > 0.0:
                raise MaterialError(f"contact: {name} must be positive, is {getattr(self, name):.6g}")


WELDED = Contact(normal_n_per_m3=np.inf, tangential_n_per_m3=np.inf)


def homogenize_layers(layers: Sequence[Layer], contact: Contact = WELDED) -> TransverselyIsotropic:
    """Homogenize a periodic pack of isotropic layers.

    With ⟨·⟩ the mean over the thickness and c = λ + 2μ: C33 = ⟨1/c⟩⁻¹, C13 = C33 ⟨λ/c⟩,
    C44 = ⟨1/μ⟩⁻¹, C66 = ⟨μ⟩, C11 = ⟨4μ(λ+μ)/c⟩ + C33 ⟨λ/c⟩² (G. E. Backus, J. Geophys. Res. 67,
    1962, 4427–4440). A contact is a layer without thickness: it adds 1/(t k) to 1/C33 and 1/C44,
    t being the thickness of the pack. Exact for fields that vary little over one pack.

    Parameters
    ----------
    layers : sequence of Layer
        One period, e.g. a sheet and its coating.
    contact : Contact
        The contact within the period; `WELDED` where all layers stick together.

    Raises
    ------
    MaterialError
        There is no layer.
    """
    if not layers:
        raise MaterialError("layers: at least one is needed")
    thickness = np.array([layer.thickness_m for layer in layers])
    lame = np.array([layer.material.lame_pa for layer in layers])
    shear = np.array([layer.material.shear_modulus_pa for layer in layers])
    pitch = thickness.sum()
    share = thickness / pitch
    pressure = lame + 2.0 * shear

    c33 = 1.0 / (share @ (1.0 / pressure) + 1.0 / (pitch * contact.normal_n_per_m3))
    c44 = 1.0 / (share @ (1.0 / shear) + 1.0 / (pitch * contact.tangential_n_per_m3))
    c66 = share @ shear
    squeeze = share @ (lame / pressure)
    c11 = share @ (4.0 * shear * (lame + shear) / pressure) + c33 * squeeze**2

    matrix = np.diag([c11, c11, c33, c44, c44, c66])
    matrix[0, 1] = matrix[1, 0] = c11 - 2.0 * c66
    matrix[:2, 2] = matrix[2, :2] = c33 * squeeze
    return TransverselyIsotropic.from_hooke(Hooke(matrix))
