"""The report as one HTML page that needs no other file."""

from __future__ import annotations

import base64

from jinja2 import Environment, PackageLoader, StrictUndefined

from statorhom.report.document import Document, Picture

_MEDIA = {"svg": "image/svg+xml", "png": "image/png"}


def render_html(document: Document) -> str:
    """Render a document; everything in it is escaped."""
    environment = Environment(
        loader=PackageLoader("statorhom.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals["data_uri"] = _data_uri
    environment.tests["of_kind"] = _of_kind
    return environment.get_template("report.html.j2").render(document=document)


def _data_uri(picture: Picture) -> str:
    content = base64.b64encode(picture.content).decode("ascii")
    return f"data:{_MEDIA[picture.format]};base64,{content}"


def _of_kind(block: object, name: str) -> bool:
    return type(block).__name__ == name
