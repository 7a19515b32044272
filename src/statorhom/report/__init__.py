"""The report of a study: one HTML page and one PDF, made from a results folder alone."""

from statorhom.report.write import write_report

__all__ = ["write_report"]
