"""TOML text of plain tables: what a study or geometry file holds, written again."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any


def toml_text(table: Mapping[str, Any]) -> str:
    """A table as TOML.

    Parameters
    ----------
    table : mapping of str
        Texts, numbers, truth values, lists of them, tables and lists of tables; keys without a value (None) are
        left out.

    Raises
    ------
    ValueError
        If a value has no form in TOML.
    """
    return "\n".join(_lines(table, ())).strip() + "\n"


def _lines(table: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    """Plain keys first: behind a table's header they would belong to it."""
    given = {key: value for key, value in table.items() if value is not None}
    nested = {key: value for key, value in given.items() if isinstance(value, Mapping)}
    listed = {key: value for key, value in given.items() if _is_list_of_tables(value)}
    for key, value in given.items():
        if key not in nested and key not in listed:
            yield f"{_key(key)} = {_value(value)}"
    for key, value in nested.items():
        yield from ("", f"[{_path((*path, key))}]", *_lines(value, (*path, key)))
    for key, values in listed.items():
        for value in values:
            yield from ("", f"[[{_path((*path, key))}]]", *_lines(value, (*path, key)))


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) > 0 and all(isinstance(v, Mapping) for v in value)


def _path(keys: tuple[str, ...]) -> str:
    return ".".join(_key(key) for key in keys)


def _key(key: str) -> str:
    is_bare = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if is_bare else _text(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    raise ValueError(f"{type(value).__name__} has no form in TOML")


def _text(text: str) -> str:
    # JSON escapes are TOML's as well, but for the one control character that JSON leaves as it is
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
