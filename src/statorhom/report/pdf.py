"""The report as a PDF, typeset by typst.

The template is fixed and reads the document as JSON: text from files never becomes markup.
"""

from __future__ import annotations

import json
import re
import tempfile
from importlib.resources import files
from pathlib import Path
from typing import Any

from statorhom.errors import MissingDependencyError, ResultsError
from statorhom.report.document import (
    Block,
    Definitions,
    Document,
    Fold,
    Gallery,
    Notice,
    Paragraph,
    Picture,
    Points,
    Row,
    Table,
    Text,
)
from statorhom.study.message import one_line

_TEMPLATE = "report.typ"
_LONG_WORD = re.compile(r"\S{31,}")
_PIECES = re.compile(r"\S{1,20}")
_ZERO_WIDTH_SPACE = "\u200b"


def render_pdf(document: Document) -> bytes:
    """Typeset a document.

    Raises
    ------
    MissingDependencyError
        If typst is not installed.
    ResultsError
        If typst refuses the document.
    """
    try:
        import typst
    except ImportError as error:
        raise MissingDependencyError(
            one_line(f"the PDF report needs typst ({error}); install it with `pip install typst`")
        ) from None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = folder / _TEMPLATE
        source.write_bytes(files("statorhom.report").joinpath("templates", _TEMPLATE).read_bytes())
        content = _Export(folder).document(document)
        (folder / "document.json").write_text(json.dumps(content, ensure_ascii=False), encoding="utf-8")
        try:
            # only the fonts inside typst: the same page on every machine
            return bytes(typst.compile(str(source), root=str(folder), ignore_system_fonts=True))
        except RuntimeError as error:
            raise ResultsError(one_line(f"report.pdf: typst cannot set it ({error})")) from None


class _Export:
    """A document as JSON values; pictures become files beside it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.pictures = 0

    def document(self, document: Document) -> dict[str, Any]:
        return {
            "title": document.title,
            "study": _breakable(document.study),
            "facts": [[name, _breakable(value)] for name, value in document.facts],
            "sections": [
                {"title": section.title, "blocks": [self.block(block) for block in section.blocks]}
                for section in document.sections
            ],
        }

    def block(self, block: Block) -> dict[str, Any]:
        content: dict[str, Any] = {"type": type(block).__name__}
        match block:
            case Paragraph():
                content |= {"content": _text(block.content), "role": block.role}
            case Notice():
                content |= {
                    "title": block.title,
                    "items": [_text(i) for i in block.items],
                    "level": block.level,
                }
            case Picture():
                content |= self.picture(block)
            case Table():
                content |= self.table(block)
            case Gallery():
                content |= {"pictures": [self.picture(p) for p in block.pictures], "columns": block.columns}
            case Points():
                content |= {"items": [_text(item) for item in block.items]}
            case Definitions():
                content |= {"items": [[_text(term), _text(meaning)] for term, meaning in block.items]}
            case Fold():
                content |= {"title": _text(block.title), "blocks": [self.block(b) for b in block.blocks]}
        return content

    def picture(self, picture: Picture) -> dict[str, Any]:
        self.pictures += 1
        name = f"picture-{self.pictures}.{picture.format}"
        (self.folder / name).write_bytes(picture.content)
        return {
            "file": name,
            "width": picture.width_mm,
            "alt": picture.alt,
            "caption": _text(picture.caption),
        }

    def table(self, table: Table) -> dict[str, Any]:
        return {
            "columns": [{"title": _text(c.title), "align": c.align} for c in table.columns],
            "rows": [self.row(row) for row in table.rows],
            "caption": _text(table.caption),
        }

    def row(self, row: Row) -> dict[str, Any]:
        cells = [self.picture(c) if isinstance(c, Picture) else {"text": _text(c)} for c in row.cells]
        return {"group": row.group, "cells": cells}


def _text(content: Text) -> list[dict[str, str]]:
    return [{"text": _breakable(span.text), "style": span.style} for span in content]


def _breakable(text: str) -> str:
    """Let words that are longer than a line be broken: typst would set them beyond the margin."""
    return _LONG_WORD.sub(lambda word: _ZERO_WIDTH_SPACE.join(_PIECES.findall(word[0])), text)
