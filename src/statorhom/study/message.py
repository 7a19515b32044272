"""One-line messages about input files.

Whatever a file contains (keys and names are untrusted) ends up on a terminal and in a report, so line breaks,
control characters and bidirectional marks are shown escaped and long values are cut.
"""

from __future__ import annotations

from os import PathLike

from statorhom.errors import InputFileError

_LONGEST_VALUE = 60


def one_line(text: str) -> str:
    """`text` with every character that is not printable replaced by its escape."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


def quoted(value: object) -> str:
    """A value from a file as it may be shown: on one line, in quotes if it is text, cut if it is long.

    Parameters
    ----------
    value : object
        Anything that TOML or CSV can hold.

    Returns
    -------
    str
    """
    if isinstance(value, str):
        text = one_line(value)
        return f'"{_cut(text)}"'
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and value.bit_length() > 200:
        return "a number of more than 60 digits"
    return _cut(one_line(repr(value)))


def input_error(path: str | PathLike[str], where: str, problem: str, remedy: str) -> InputFileError:
    """The error to raise for one fault of an input file.

    Parameters
    ----------
    path : path
        The file, as the user named it.
    where : str
        The key, row or column; empty where the whole file is meant.
    problem, remedy : str
        What is wrong, and what to do about it.

    Returns
    -------
    InputFileError
        Its message is one line: ``file: where: problem; remedy``.
    """
    head = f"{path}: {where}: " if where else f"{path}: "
    return InputFileError(one_line(f"{head}{problem}; {remedy}"))


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 1] + "…"
