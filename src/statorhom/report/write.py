"""Write report.html and report.pdf into a results folder, from all results that it holds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from statorhom.errors import ResultsError
from statorhom.report.check import check_results
from statorhom.report.compose import compose
from statorhom.report.diagnosis.page import diagnosis_document, diagnosis_facts, diagnosis_sections
from statorhom.report.document import Document
from statorhom.report.html import render_html
from statorhom.report.pdf import render_pdf
from statorhom.results import read_results
from statorhom.results.diagnosis import NAME as DIAGNOSIS_NAME
from statorhom.results.diagnosis import read_diagnosis
from statorhom.results.files import NAME as RESULTS_NAME
from statorhom.study.atomic import write_bytes, write_text
from statorhom.study.message import one_line, quoted

HTML_NAME = "report.html"
PDF_NAME = "report.pdf"


def write_report(folder: Path) -> tuple[Path, Path]:
    """Make the report of a results folder from its results.json, its diagnosis.json and its shape files.

    Either may be missing; with both, the two short answers come first. Both files are made before either is written;
    the same folder gives the same bytes.

    Returns
    -------
    tuple of Path
        The HTML page and the PDF.

    Raises
    ------
    ResultsError
        If both results are missing, belong to different studies, or a file is damaged or cannot be written.
    MissingDependencyError
        If the PDF's typesetter is not installed.
    """
    document = report_document(folder)
    page, pdf = render_html(document), render_pdf(document)
    write_text(folder / HTML_NAME, page)
    write_bytes(folder / PDF_NAME, pdf)
    return folder / HTML_NAME, folder / PDF_NAME


def report_document(folder: Path) -> Document:
    """The report of all results in a folder.

    Raises
    ------
    ResultsError
        As `write_report`.
    """
    diagnosed = (folder / DIAGNOSIS_NAME).exists()
    if diagnosed and not (folder / RESULTS_NAME).exists():
        return diagnosis_document(*read_diagnosis(folder))
    results = read_results(folder)
    check_results(results, folder / RESULTS_NAME)
    identified = compose(results, folder)
    if not diagnosed:
        return identified
    diagnosis, details = read_diagnosis(folder)
    if diagnosis.study != results.study:
        raise ResultsError(
            one_line(
                f"{folder}: results.json is of the study {quoted(results.study)}, diagnosis.json of "
                f"{quoted(diagnosis.study)}; move one of them to a folder of its own"
            )
        )
    summary, *rest = identified.sections
    verdict, *more = diagnosis_sections(diagnosis, details)
    return replace(
        identified,
        title=f"{identified.title.partition(',')[0]}, and what its model left out",
        facts=(*identified.facts, *diagnosis_facts(diagnosis, details)),
        sections=(summary, verdict, *rest[:-1], *more, rest[-1]),
    )
