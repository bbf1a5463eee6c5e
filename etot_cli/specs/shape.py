"""Walks the models by the location of a validation error and says what was expected there."""

from __future__ import annotations

import types
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel, Tag
from pydantic.fields import FieldInfo

from etot_cli.specs.document import DataPath, Step
from etot_cli.specs.quantity import Meaning

LOADER_KEYS = {
    "Scene": ("actuation", "directory"), "Task": ("file", "inputs"), "RobotSpec": ("directory",),
}  # fmt: skip
"""Fields that the loader fills in and a document may not give, by model name."""
DOCUMENT_KEYS = {"Scene": ("include",), "Task": ("variation",)}
"""Keys that a document may give although the model has no such field: the loader resolves them."""
KEY = "[key]"
"""How pydantic marks that a mapping's key, not its value, is wrong."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A type and what rides along with it in ``Annotated``."""

    type: Any
    metadata: tuple[Any, ...] = ()

    @property
    def meaning(self) -> Meaning | None:
        """The words for the value, if its type has some."""
        return next((item for item in self.metadata if isinstance(item, Meaning)), None)

    def bound(self, kind: type) -> float | None:
        """The bound of kind Gt, Ge, Lt or Le, if there is one."""
        names = {Gt: "gt", Ge: "ge", Lt: "lt", Le: "le"}
        for item in self._constraints():
            if isinstance(item, kind):
                return float(getattr(item, names[kind]))
        return None

    def _constraints(self) -> Iterable[Any]:
        for item in self.metadata:
            yield from item.metadata if isinstance(item, FieldInfo) else (item,)


@dataclass(frozen=True, slots=True)
class Located:
    """Where a validation error points: the path into the data, and the shape expected there."""

    path: DataPath
    shape: Shape | None
    parent: Shape | None


def locate(model: type[BaseModel], location: Iterable[Step]) -> Located:
    """Follows a pydantic location, leaving out the union tags that are not in the data."""
    path: list[Step] = []
    parent: Shape | None = None
    shape: Shape | None = Shape(model)
    for step in location:
        if step == KEY:
            shape = None if parent is None else Shape(get_args(options(parent)[0].type)[0])
            continue
        tagged = None if shape is None else _tagged(shape, step)
        if tagged is not None:
            shape = tagged
            continue
        path.append(step)
        shape, parent = (None if shape is None else _child(shape, step)), shape
    return Located(tuple(path), _simple(shape), _simple(parent))


def allowed_keys(model: type[BaseModel]) -> list[str]:
    """The keys that a document may give for a model, in the order of its definition."""
    hidden = LOADER_KEYS.get(model.__name__, ())
    fields = model.model_fields.items()
    keys = [field.alias or name for name, field in fields if name not in hidden]
    keys.sort(key=lambda key: key != "kind")  # what decides about the others comes first
    return [*keys, *DOCUMENT_KEYS.get(model.__name__, ())]


def model_of(shape: Shape | None) -> type[BaseModel] | None:
    """The model class of a shape, when it is one."""
    if shape is not None:
        for option in options(shape):
            if isinstance(option.type, type) and issubclass(option.type, BaseModel):
                return option.type
    return None


def has_fixed_length(shape: Shape) -> bool:
    """Whether a shape is a list with a given number of entries."""
    return get_origin(shape.type) is tuple and Ellipsis not in get_args(shape.type)


def describe(shape: Shape) -> str:
    """What is expected, as a noun phrase with units and bounds: "a length in metres of at most
    0.6".
    """
    choices = options(shape)
    if len(choices) > 1:
        kinds = [option for option in choices if model_of(option) is not None]
        if kinds:
            return "a mapping of keys and values"
        return " or ".join(dict.fromkeys(describe(option) for option in choices))
    return _describe_one(choices[0])


def _describe_one(shape: Shape) -> str:
    origin = get_origin(shape.type)
    if shape.meaning is not None:
        return f"{shape.meaning.text}{_bounds(shape)}"
    if origin is Literal:
        return " or ".join(str(value) for value in get_args(shape.type))
    if origin is tuple:
        return _describe_tuple(get_args(shape.type))
    if origin is dict or model_of(shape) is not None:
        return "a mapping of keys and values"
    words = {str: "text", bool: "true or false", int: "a whole number", float: "a number"}
    return f"{words.get(shape.type, 'another value')}{_bounds(shape)}"


def _describe_tuple(items: tuple[Any, ...]) -> str:
    if len(items) == 2 and items[1] is Ellipsis:
        return f"a list, each entry {describe(Shape(items[0]))}"
    same = len(set(map(str, items))) == 1
    inner = (
        f"each {describe(Shape(items[0]))}"
        if same
        else ", ".join(describe(Shape(item)) for item in items)
    )
    return f"a list of {len(items)}, {inner}"


def _bounds(shape: Shape) -> str:
    low, over = shape.bound(Ge), shape.bound(Gt)
    high, below = shape.bound(Le), shape.bound(Lt)
    words = []
    if low is not None:
        words.append(f"at least {low:.10g}")
    if over is not None:
        words.append(f"more than {over:.10g}")
    if high is not None:
        words.append(f"at most {high:.10g}")
    if below is not None:
        words.append(f"less than {below:.10g}")
    return f" of {' and '.join(words)}" if words else ""


def options(shape: Shape) -> list[Shape]:
    """The alternatives of a shape without None; unions of unions are flattened."""
    origin = get_origin(shape.type)
    if origin is Annotated:
        inner, *metadata = get_args(shape.type)
        return options(Shape(inner, (*metadata, *shape.metadata)))
    if origin in (Union, types.UnionType):
        arguments = [item for item in get_args(shape.type) if item is not type(None)]
        if len(arguments) == 1:
            return options(Shape(arguments[0], shape.metadata))
        return [option for item in arguments for option in options(Shape(item))]
    return [shape]


def _simple(shape: Shape | None) -> Shape | None:
    """The shape without wrapping, where there is no choice."""
    choices = [] if shape is None else options(shape)
    return choices[0] if len(choices) == 1 else shape


def _tagged(shape: Shape, step: Step) -> Shape | None:
    """The alternative that a union's tag selects, when ``step`` is such a tag."""
    choices = options(shape)
    if len(choices) < 2 or not isinstance(step, str):
        return None
    for option in choices:
        if any(isinstance(item, Tag) and item.tag == step for item in option.metadata):
            return option
        model = model_of(option)
        kind = None if model is None else model.model_fields.get("kind")
        if kind is not None and step in get_args(kind.annotation):
            return option
    return None


def _child(shape: Shape, step: Step) -> Shape | None:
    """The shape one step below."""
    for option in options(shape):
        model = model_of(option)
        if model is not None:
            for name, field in model.model_fields.items():
                if step in (name, field.alias):
                    return Shape(field.annotation, tuple(field.metadata))
            continue
        origin, arguments = get_origin(option.type), get_args(option.type)
        if origin is dict:
            return Shape(arguments[1])
        if origin is tuple and isinstance(step, int):
            index = 0 if arguments[-1] is Ellipsis else min(step, len(arguments) - 1)
            return Shape(arguments[index])
    return None
