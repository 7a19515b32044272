"""Many machines of one geometry: fitted by several processes or computers, into one table."""

from statorhom.fleet.batch import FleetResults, fit_fleet

__all__ = ["FleetResults", "fit_fleet"]
