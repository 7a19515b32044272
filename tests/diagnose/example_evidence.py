"""Evidence that passes every rule, for tests that break one."""

from __future__ import annotations

from statorhom.diagnose.evidence.decision import Evidence
from statorhom.diagnose.evidence.held_out import HeldOut

GROUPS = tuple(("test", (r, 0, 0)) for r in range(2, 8))
FALLS = HeldOut(GROUPS, (2.0, 3.0, 1.5, 2.5, 2.0, 3.0), (0.2, 0.3, 0.1, 0.2, 0.3, 0.2), (0.1,) * 6)
GOOD = Evidence(
    p_value=1e-3,
    unpaired=False,
    over_nothing=40.0,
    over_others=12.0,
    over_discrepancy=30.0,
    held_out=FALLS,
    adequacy=0.4,
    chance_of_rows=0.9,
    nothing_adequacy=1e-9,
    nothing_but_one=1e-9,
    within=True,
    stability=1.0,
)
