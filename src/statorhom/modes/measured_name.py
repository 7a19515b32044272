"""The name (r, n) of a measured shape: how sure it is, and what else the points could have seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.amplitude_noise import amplitude_sd
from statorhom.modes.measured_shape import MeasuredShape
from statorhom.modes.naming import ModeName, measured_node_planes, name_shape, order_noise
from statorhom.modes.order_spectrum import OrderSpectrum, order_spectrum

FloatArray = npt.NDArray[np.float64]

_COPIES = 400  # of the shape, each with other noise: the confidence is good to about 0.02
_SEED = 0


@dataclass(frozen=True)
class MeasuredName:
    """Name of a measured shape.

    Attributes
    ----------
    name : ModeName or None
        None where the points cannot carry a name at all.
    spectrum : OrderSpectrum or None
        Circumferential orders of the radial motion; None where nothing moves radially or no plane has
        three angles.
    confidence : float or None
        Probability that the name is not the measurement's noise: the part of 400 copies of the order
        amplitudes, with further noise of the same size, that have the same (r, n). It does not count
        aliases, which noise has no part in. None without an order.
    statement : str
        What the points cannot tell, in one line.
    """

    name: ModeName | None
    spectrum: OrderSpectrum | None
    confidence: float | None
    statement: str


def name_measured(shape: MeasuredShape) -> MeasuredName:
    """Name a measured shape by its radial motion; where the points cannot tell, say so."""
    try:
        name = name_shape(
            shape.radial, shape.angles_rad, shape.z_m, tangential=shape.tangential, axial_motion=shape.axial
        )
    except IdentificationError as error:
        return MeasuredName(None, None, None, str(error))
    if name.kind != "radial":
        return MeasuredName(
            name, None, None, f"named by its kind: {100 * name.share:.0f} % is not radial motion"
        )
    spectrum = order_spectrum(shape.radial, shape.angles_rad)
    confidence = None if name.order is None else _confidence(shape, spectrum, name)
    return MeasuredName(name, spectrum, confidence, alias_statement(name, spectrum))


def alias_statement(name: ModeName, spectrum: OrderSpectrum) -> str:
    """What the angles and planes of the points cannot tell about a radial mode, in one line."""
    grid, order = spectrum.grid, spectrum.dominant_order
    if name.order is None:
        if spectrum.lookalikes:
            others = " or ".join(str(other) for other in spectrum.lookalikes)
            return f"the points present cannot tell order {order} from {others}: no order is given"
        return (
            f"{100 * spectrum.unexplained_share:.0f} % of the motion is no order up to {grid.highest_order}: "
            "no order is given"
        )
    kind = "equidistant angles" if grid.equidistant else "uneven angles"
    said = [f"{grid.count} {kind} show orders up to {grid.highest_order}"]
    if aliases := spectrum.aliases(order):
        said.append(f"{order} could also be {' or '.join(str(alias) for alias in aliases)}")
    if grid.halved(order):
        said.append("at half the number of angles only one phase is seen, and the share is a lower bound")
    if name.axial_limit is not None:
        said.append(_axial_statement(name.axial, name.axial_limit))
    return "; ".join(said)


def _axial_statement(axial: int | None, limit: int) -> str:
    if axial is None:
        return "one plane does not show n" if limit < 1 else "too few planes move for n"
    return f"{limit + 1} planes show up to {limit} node {'plane' if limit == 1 else 'planes'}"


def _confidence(shape: MeasuredShape, spectrum: OrderSpectrum, name: ModeName) -> float:
    order = spectrum.dominant_order
    amplitudes = np.nan_to_num(np.stack([spectrum.cosine, spectrum.sine], axis=-1))
    spread = np.nan_to_num(amplitude_sd(shape, spectrum)) / np.sqrt(2)
    rng = np.random.default_rng(_SEED)
    noise = rng.standard_normal((2, _COPIES, *amplitudes.shape))
    copies = amplitudes + spread * (noise[0] + 1j * noise[1])
    power = np.sum(np.abs(copies) ** 2, axis=(1, 3))
    single = [r for r in range(power.shape[1]) if r == 0 or spectrum.grid.halved(r)]
    power[:, single] *= 2.0  # mean square of 1 against that of cos rθ
    same_order = np.argmax(power, axis=1) == order
    along = spectrum.signed_amplitudes(order)
    used = np.isfinite(along)
    # the copies' amplitudes along the direction that all planes share
    common = along[used] @ amplitudes[used, order]
    signed = (copies[:, used, order] @ common.conj()).real
    noise_level = order_noise(spectrum, order) * float(np.linalg.norm(common))
    same_axial = [
        measured_node_planes(one, shape.z_m[used], noise=noise_level) == name.axial for one in signed
    ]
    return float(np.mean(same_order & np.array(same_axial)))
