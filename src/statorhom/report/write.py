"""Write report.html and report.pdf into a results folder."""

from __future__ import annotations

from pathlib import Path

from statorhom.report.check import check_results
from statorhom.report.compose import compose
from statorhom.report.html import render_html
from statorhom.report.pdf import render_pdf
from statorhom.results import read_results
from statorhom.results.files import NAME as RESULTS_NAME
from statorhom.study.atomic import write_bytes, write_text

HTML_NAME = "report.html"
PDF_NAME = "report.pdf"


def write_report(folder: Path) -> tuple[Path, Path]:
    """Make the report of a results folder from its results.json and shape files.

    Both files are made before either is written; the same folder gives the same bytes.

    Returns
    -------
    tuple of Path
        The HTML page and the PDF.

    Raises
    ------
    ResultsError
        If results.json is missing or a file is damaged or cannot be written.
    MissingDependencyError
        If the PDF's typesetter is not installed.
    """
    results = read_results(folder)
    check_results(results, folder / RESULTS_NAME)
    document = compose(results, folder)
    page, pdf = render_html(document), render_pdf(document)
    write_text(folder / HTML_NAME, page)
    write_bytes(folder / PDF_NAME, pdf)
    return folder / HTML_NAME, folder / PDF_NAME
