"""Turns pydantic's validation errors into one message for the person who wrote the file."""

from __future__ import annotations

import difflib
import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar, get_args

from annotated_types import Ge, Gt, Le
from pydantic import BaseModel, ValidationError

from etot_cli.errors import SpecError
from etot_cli.specs.document import DataPath, Node, path_text
from etot_cli.specs.reading import printable, read_utf8
from etot_cli.specs.shape import (
    KEY,
    LOADER_KEYS,
    Located,
    Shape,
    allowed_keys,
    describe,
    has_fixed_length,
    locate,
    model_of,
    options,
)

Model = TypeVar("Model", bound=BaseModel)

LONGEST_VALUE = 60
"""Characters of a bad value that a message shows."""
SMALLEST_PLAUSIBLE = 0.001
"""A value of another unit must come out at least this large (in ours) to be suggested."""


@dataclass(frozen=True, slots=True)
class Problem:
    """One finding: where in the data, and what to say about it."""

    path: DataPath
    message: str
    missing: bool = False
    """A key is missing. Such findings come last, for a misspelt key is often the reason."""


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong first with data that no person wrote: ``path``, with dots, may be empty."""

    path: str
    text: str

    def __str__(self) -> str:
        return f"{self.path}: {self.text}" if self.path else self.text


def first_fault(error: ValidationError) -> Fault:
    """The first finding, in pydantic's words: never what was found, which may be a secret."""
    first = error.errors(include_url=False, include_input=False)[0]
    return Fault(".".join(str(step) for step in first["loc"]), first["msg"])


def read_json(model: type[Model], path: Path, limit: int, name: str, expected: str) -> Model:
    """What a program wrote as JSON, ``limit`` bytes at most; ``name``: what it is called.

    Raises:
        SpecError: it cannot be read, or is something else.
    """
    text = read_utf8(path, limit, f"a {name}")
    try:
        return model.model_validate_json(text)
    except ValidationError as error:
        fault = first_fault(error)
        raise SpecError(
            f"is no {name}: {fault.text}; expected {expected}",
            file=printable(path),
            path=fault.path,
        ) from None


def validate(model: type[Model], node: Node) -> Model:
    """Validates a document's node strictly against a model.

    Numbers must be numbers, not text or true/false.

    Raises:
        SpecError: the first problem by line, with file, line, path and the number of others.
    """
    data = node.plain()
    problems: list[Problem] = []
    _refuse_loader_keys(model, node, (), problems)
    try:
        # By way of JSON: there, strict mode still takes lists for tuples.
        result = model.model_validate_json(json.dumps(data), strict=True)
    except ValidationError as error:
        problems.extend(_translate(model, error))
        raise first_error(node, problems) from None
    if problems:
        raise first_error(node, problems)
    return result


def first_error(node: Node | None, problems: Iterable[Problem]) -> SpecError:
    """The error to raise: the first problem in reading order, and how many more there are.

    Args:
        node: the document that the problems' paths refer to; None when there is no document.
        problems: at least one.
    """
    ordered = list(problems)
    if node is not None:
        ordered.sort(key=lambda item: _reading_order(item, node))
    first, more = ordered[0], len(ordered) - 1
    message = first.message + (f" (and {more} more)" if more else "")
    if node is None:
        return SpecError(message, path=path_text(first.path))
    return node.error(first.path, message)


def _reading_order(problem: Problem, node: Node) -> tuple[bool, bool, int]:
    place = node.locate(problem.path)
    return (problem.missing, place.file != node.place.file, place.line)


def _refuse_loader_keys(
    model: type[BaseModel], node: Node, path: DataPath, problems: list[Problem]
) -> None:
    """Finds keys that the models have but documents may not give."""
    if not isinstance(node.value, dict):
        return
    problems.extend(
        Problem((*path, key), _unknown_key(key, model))
        for key in LOADER_KEYS.get(model.__name__, ())
        if key in node.value
    )
    for key, child in node.value.items():
        field = model.model_fields.get(key)
        inner = None if field is None else model_of(Shape(field.annotation))
        if inner is not None and inner.__name__ in LOADER_KEYS:
            _refuse_loader_keys(inner, child, (*path, key), problems)


def _translate(model: type[BaseModel], error: ValidationError) -> list[Problem]:
    """All findings of a validation, those dropped that only follow from another one."""
    entries = [(item, locate(model, item["loc"])) for item in error.errors(include_url=False)]
    paths = [located.path for _, located in entries]
    problems = []
    for item, located in entries:
        below = any(
            len(p) > len(located.path) and p[: len(located.path)] == located.path for p in paths
        )
        if item["type"] == "too_short" and below:
            continue  # the list is only short because an entry of it is bad
        problems.append(_problem(dict(item), located))
    return problems


def _problem(item: dict[str, Any], located: Located) -> Problem:
    kind, found, path = item["type"], item.get("input"), located.path
    context = item.get("ctx") or {}
    if kind == "extra_forbidden":
        return Problem(path, _unknown_key(str(path[-1]), model_of(located.parent)))
    if kind == "missing" and isinstance(path[-1], str):
        expected = f", {describe(located.shape)}" if located.shape else ""
        return Problem(path[:-1], f"missing key {path[-1]!r}{expected}", True)
    if kind == "missing":
        return Problem(path[:-1], _found_expected(found, located.parent))
    if kind == "union_tag_not_found":
        return Problem(path, f"missing key 'kind', one of {_kinds(located.shape)}", True)
    if kind == "union_tag_invalid":
        kinds = _kinds(located.shape)
        near = _closest(str(context.get("tag")), kinds.split(", "))
        tag = show(found.get("kind") if isinstance(found, dict) else context.get("tag"))
        return Problem((*path, "kind"), f"found {tag}, expected one of {kinds}{near}")
    if kind == "value_error":
        return Problem(path, str(context["error"]))
    if kind == "string_pattern_mismatch" or KEY in item["loc"]:
        expected = "another name" if located.shape is None else describe(located.shape)
        return Problem(path, f"found {show(found)}, expected {expected}")
    if kind in ("too_long", "string_too_long"):
        if located.shape is not None and has_fixed_length(located.shape):
            return Problem(path, _found_expected(found, located.shape))
        unit = "entries" if kind == "too_long" else "characters"
        size = len(found) if isinstance(found, str | list | dict) else "more"
        return Problem(path, f"found {size} {unit}, expected at most {context['max_length']}")
    if kind in ("too_short", "string_too_short"):
        one, several = ("entry", "entries") if kind == "too_short" else ("character", "characters")
        least = int(context["min_length"])
        size = (
            f"found {len(found)}" if isinstance(found, str | list | dict) and found else "is empty"
        )
        return Problem(path, f"{size}, expected at least {least} {one if least == 1 else several}")
    if found is None and kind in ("dict_type", "model_type") and len(path) == 2:
        return Problem(
            path, "found nothing, expected a mapping (null only removes what an included scene has)"
        )
    if kind in _BOUNDS and located.shape is not None:
        return Problem(path, _out_of_bounds(found, located.shape, kind))
    if located.shape is not None:
        return Problem(path, _found_expected(found, located.shape))
    return Problem(path, f"found {show(found)}: {item['msg']}")


def show(value: object) -> str:
    """A value as it may stand in a message: short and on one line."""
    if value is None:
        return "nothing"
    if isinstance(value, dict):
        return "a mapping"
    text = repr(value) if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= LONGEST_VALUE else text[: LONGEST_VALUE - 1] + "…"


def unknown(name: str, valid: Iterable[str]) -> str:
    """The end of a message about a name that is not among the valid ones."""
    names = list(valid)
    return f"; expected one of {', '.join(names)}{_closest(name, names)}"


def _found_expected(found: object, shape: Shape | None) -> str:
    expected = "another value" if shape is None else describe(shape)
    if isinstance(found, list):
        return f"found a list of {len(found)}, expected {expected}"
    return f"found {show(found)}, expected {expected}"


_BOUNDS: dict[str, tuple[type, str]] = {
    "greater_than": (Gt, "more than"),
    "greater_than_equal": (Ge, "at least"),
    "less_than_equal": (Le, "at most"),
}


def _out_of_bounds(found: object, shape: Shape, kind: str) -> str:
    """Names only the bound that was crossed, and the unit that was perhaps meant."""
    bound_type, words = _BOUNDS[kind]
    bound, meaning = shape.bound(bound_type), shape.meaning
    if bound is None or meaning is None or not isinstance(found, int | float):
        return _found_expected(found, shape)
    message = f"found {show(found)}, expected {meaning.text} of {words} {bound:.10g}"
    hints = [
        f"{found:g} {unit} is {found / factor:g}"
        for unit, factor in meaning.confusions
        if SMALLEST_PLAUSIBLE <= abs(found) / factor <= abs(bound)
    ]
    return message + (f" ({' and '.join(hints)})" if hints else "")


def _unknown_key(key: str, model: type[BaseModel] | None) -> str:
    keys = [] if model is None else allowed_keys(model)
    near = _closest(key, keys).removeprefix("; ")
    hint = f" ({near})" if near else ""
    return f"unknown key {show(key)}{hint}; allowed keys: {', '.join(keys)}"


def _closest(word: str, words: Iterable[str]) -> str:
    close = difflib.get_close_matches(word, list(words), n=1, cutoff=0.6)
    return f"; did you mean {close[0]!r}?" if close else ""


def _kinds(shape: Shape | None) -> str:
    if shape is None:
        return "the known kinds"
    names: list[str] = []
    for option in options(shape):
        model = model_of(option)
        if model is not None:
            names.extend(get_args(model.model_fields["kind"].annotation))
    return ", ".join(names)
