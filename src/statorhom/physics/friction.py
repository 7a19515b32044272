"""Contacts that slip, by harmonic balance: equivalent stiffness and damping of one mode at a steady amplitude.

Jenkins' element (Jenkins 1962, Br. J. Appl. Phys. 13; Gaul and Nitsche 2001, Appl. Mech. Rev. 54) is a spring behind a
slider; Iwan's (1966, J. Appl. Mech. 33) many of them, which here slip little: dissipation ∝ X^(χ+3) (Segalman 2005,
J. Appl. Mech. 72).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

ROUNDS = 60


@dataclass(frozen=True)
class Slipping:
    """A mode whose contact slips.

    Parameters
    ----------
    fall : part of its stiffness that is lost.
    loss : added to its loss factor, which counts against the stiffness that is left.
    """

    fall: float
    loss: float


def jenkins(ratio: float) -> tuple[float, float]:
    """Equivalent stiffness, real and imaginary part, over that of the sticking element.

    Parameters
    ----------
    ratio : amplitude over the one at which it begins to slip, X/x_c.
    """
    if ratio <= 1.0:
        return 1.0, 0.0
    angle = math.acos(1.0 - 2.0 / ratio)
    # ΔE = 4 μN (X - x_c) and c_eq ω = ΔE/(π X²)
    return (angle - 0.5 * math.sin(2 * angle)) / math.pi, 4.0 / math.pi * (ratio - 1.0) / ratio**2


def jenkins_resonance(share: float, loss: float, force_over_slip: float) -> Slipping:
    """A mode at its own resonance under a harmonic force.

    Parameters
    ----------
    share : of the modal stiffness that the sticking element carries.
    loss : loss factor of the mode while it sticks.
    force_over_slip : modal force over the modal force at which the element slips.
    """
    # the force meets the dissipation: X λη + 4/π μN (1 - x_c/X) = F, with y = X/x_c and x_c = μN/(share λ)
    a, constant = loss / share, 4.0 / math.pi
    b = constant - force_over_slip
    if force_over_slip <= a:
        return Slipping(0.0, 0.0)
    y = (-b + math.sqrt(b * b + 4 * a * constant)) / (2 * a)
    real, imaginary = jenkins(y)
    fall = share * (1.0 - real)
    return Slipping(fall, share * imaginary / (1.0 - fall))


def iwan_resonance(drop: float, exponent: float, loss: float, force: float) -> Slipping:
    """The same of a contact in micro-slip.

    Parameters
    ----------
    drop : fall of the stiffness at amplitude 1.
    exponent : χ, -1 < χ < 0.
    loss : loss factor at no amplitude.
    force : over the stiffness; the amplitude at resonance is force/loss.
    """
    # Masing's rule for the backbone k x (1 - drop x^(χ+1))
    dissipated = 4.0 / math.pi * (exponent + 1.0) / (exponent + 3.0)

    def excess(amplitude: float) -> float:
        return amplitude * (loss + dissipated * drop * amplitude ** (exponent + 1.0)) - force

    low, high = 0.0, force / loss
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    fall = min(drop * high ** (exponent + 1.0), 0.9)
    return Slipping(fall, dissipated * fall / (1.0 - fall))
