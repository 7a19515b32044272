"""A report as data: sections of text, tables and pictures, which the HTML page and the PDF both render.

Whatever comes from a file stays plain text up to the renderers, which escape it; no markup passes here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from statorhom.study.message import one_line

Style = Literal["plain", "strong", "symbol", "sub", "muted", "good", "warning"]
Align = Literal["left", "right", "center"]


@dataclass(frozen=True)
class Span:
    """Text in one style, on one line: names from files may hold line breaks or marks that turn text round."""

    text: str
    style: Style = "plain"

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", one_line(self.text))


Text = tuple[Span, ...]


@dataclass(frozen=True)
class Paragraph:
    """Running text; `lead` explains what a section shows, `note` is small print, headings name a part."""

    content: Text
    role: Literal["plain", "lead", "note", "heading", "subheading"] = "plain"


@dataclass(frozen=True)
class Notice:
    """Points that must be seen: warnings, or what was found."""

    title: str
    items: tuple[Text, ...]
    level: Literal["warning", "info"] = "info"


@dataclass(frozen=True)
class Picture:
    """SVG or PNG with what it shows in words; `width_mm` is its width on paper."""

    content: bytes
    format: Literal["svg", "png"]
    width_mm: float
    alt: str
    caption: Text = ()


@dataclass(frozen=True)
class Column:
    """Head of a table's column."""

    title: Text
    align: Align = "left"


Cell = Text | Picture


@dataclass(frozen=True)
class Row:
    """Cells of a table; a row with `group` is a heading over all columns."""

    cells: tuple[Cell, ...]
    group: bool = False


@dataclass(frozen=True)
class Table:
    """Columns and rows."""

    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    caption: Text = ()


@dataclass(frozen=True)
class Gallery:
    """Pictures side by side."""

    pictures: tuple[Picture, ...]
    columns: int = 2


@dataclass(frozen=True)
class Points:
    """A list of points."""

    items: tuple[Text, ...]


@dataclass(frozen=True)
class Definitions:
    """Terms and their meaning."""

    items: tuple[tuple[Text, Text], ...]


@dataclass(frozen=True)
class Fold:
    """Detail that the page hides until asked; the PDF prints it."""

    title: Text
    blocks: tuple[Paragraph | Table | Points, ...]


Block = Paragraph | Notice | Picture | Table | Gallery | Points | Definitions | Fold


@dataclass(frozen=True)
class Section:
    """A numbered section."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Document:
    """The whole report."""

    title: str
    study: str
    facts: tuple[tuple[str, str], ...]
    sections: tuple[Section, ...]


def text(*parts: str | Span | Text) -> Text:
    """Join strings, spans and texts into one text."""
    spans: list[Span] = []
    for part in parts:
        if isinstance(part, str):
            spans.append(Span(part))
        elif isinstance(part, Span):
            spans.append(part)
        else:
            spans.extend(part)
    return tuple(spans)


def strong(content: str) -> Span:
    """Emphasized text."""
    return Span(content, "strong")


def muted(content: str) -> Span:
    """Text of lesser weight."""
    return Span(content, "muted")


def warning(content: str) -> Span:
    """Text that calls for attention."""
    return Span(content, "warning")


def joined(items: list[Text], separator: str = ", ") -> Text:
    """Texts with a separator between them."""
    return text(*(part for i, item in enumerate(items) for part in ((separator,) if i else ()) + (item,)))


def plain(content: Text) -> str:
    """A text's letters without its styles."""
    return "".join(span.text for span in content)
