"""Pydantic's findings in the words of this program: key, problem, remedy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from statorhom.study.message import quoted
from statorhom.study.nearest import hint


def first_fault(error: ValidationError, table: Mapping[str, Any]) -> tuple[str, str, str]:
    """The fault to show first.

    Parameters
    ----------
    error : ValidationError
        What pydantic found.
    table : mapping
        The table it looked at.

    Returns
    -------
    where, problem, remedy : str
        The dotted key (list elements by their name, ``stages[wound].mass_kg``) and two half sentences.

    Notes
    -----
    An unknown key comes first: a missing one is most often its consequence.
    """
    faults = error.errors(include_url=False)
    fault = min(faults, key=lambda found: found["type"] != "unknown_key")
    problem, remedy = _words(fault)
    if len(faults) > 1:
        remedy += f" (the file has {len(faults)} faults; this is the first)"
    return dotted_key(fault, table), problem, remedy


def dotted_key(fault: ErrorDetails, table: Mapping[str, Any]) -> str:
    """Where the fault is; the branches of unions that pydantic adds to its location are left out."""
    parts: list[str] = []
    current: Any = table
    location = fault["loc"]
    for position, part in enumerate(location):
        if isinstance(current, Mapping) and part in current:
            current = current[part]
            parts.append(f".{part}")
        elif isinstance(current, list) and isinstance(part, int) and part < len(current):
            current = current[part]
            parts.append(f"[{_element(current, part)}]")
        elif fault["type"] == "missing" and isinstance(part, str) and position == len(location) - 1:
            parts.append(f".{part}")
    return "".join(parts).lstrip(".")


def _element(value: Any, index: int) -> str:
    name = value.get("name") if isinstance(value, Mapping) else None
    return name if isinstance(name, str) and name else f"#{index + 1}"


def _words(fault: ErrorDetails) -> tuple[str, str]:
    kind, context, value = fault["type"], fault.get("ctx", {}), fault["input"]
    if kind in ("unknown_key", "value_error"):
        return _own_words(fault)
    if kind == "missing" and isinstance(fault["loc"][-1], int):
        return f"has only {fault['loc'][-1]} element(s)", "add what is missing"
    if kind in _PHRASES:
        return _PHRASES[kind](context, value)
    return f"{fault['msg']} (it is {quoted(value)})", "correct it"


def _own_words(fault: ErrorDetails) -> tuple[str, str]:
    """Checks of ours say ``problem; remedy``."""
    context = fault.get("ctx", {})
    text = str(context["text"] if fault["type"] == "unknown_key" else context["error"])
    problem, _, remedy = text.partition("; ")
    return problem, remedy or "correct it"


def _choice(context: Mapping[str, Any], value: Any) -> tuple[str, str]:
    choices = str(context["expected"]).replace(" or ", ", ").replace("'", "").split(", ")
    remedy = hint(value, choices) if isinstance(value, str) else f"use {' or '.join(choices)}"
    return f"{quoted(value)} is not one of {', '.join(choices)}", remedy


def _tag(context: Mapping[str, Any], _value: Any) -> tuple[str, str]:
    key = str(context["discriminator"]).strip("'")
    choices = str(context["expected_tags"]).replace("'", "").split(", ")
    return f"{key} = {quoted(context['tag'])} is not one of {', '.join(choices)}", hint(
        str(context["tag"]), choices
    )


def _bound(words: str, key: str) -> Callable[[Mapping[str, Any], Any], tuple[str, str]]:
    return lambda context, value: (
        f"must be {words} {context[key]:g}, but is {quoted(value)}",
        "correct the number",
    )


def _type(expected: str, remedy: str) -> Callable[[Mapping[str, Any], Any], tuple[str, str]]:
    return lambda _context, value: (f"must be {expected}, but is {quoted(value)}", remedy)


def _list(_context: Mapping[str, Any], value: Any) -> tuple[str, str]:
    if isinstance(value, Mapping):
        return "must be a list of tables, but is a single table", "put its header in double square brackets"
    return f"must be a list, but is {quoted(value)}", "put the values in square brackets"


_PHRASES: dict[str, Callable[[Mapping[str, Any], Any], tuple[str, str]]] = {
    "missing": lambda _context, _value: ("is missing", "add this key"),
    "literal_error": _choice,
    "union_tag_invalid": _tag,
    "union_tag_not_found": lambda context, _value: (
        f"{str(context['discriminator']).strip(chr(39))} is missing",
        "add this key",
    ),
    "greater_than": _bound("greater than", "gt"),
    "greater_than_equal": _bound("at least", "ge"),
    "less_than": _bound("less than", "lt"),
    "less_than_equal": _bound("at most", "le"),
    "finite_number": _type("a finite number", "type the number, without nan or inf"),
    "float_type": _type("a number", "type it without quotes, with a decimal point"),
    "int_type": _type("a whole number", "type it without quotes and without a decimal point"),
    "string_type": _type("text", "put it in quotes"),
    "bool_type": _type("true or false", "type one of these without quotes"),
    "tuple_type": _list,
    "model_type": _type("a table", "write the keys below its [header]"),
    "model_attributes_type": _type("a table", "write the keys below its [header]"),
    "dict_type": _type("a table", "write the keys below its [header]"),
    "too_short": lambda context, _value: (
        f"needs at least {context['min_length']} element(s), but has {context['actual_length']}",
        "add what is missing",
    ),
    "too_long": lambda context, _value: (
        f"must have at most {context['max_length']} element(s), but has {context['actual_length']}",
        "remove some",
    ),
}
