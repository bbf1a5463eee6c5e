"""The YAML formats as a page: ``python -m tests.docs.formats docs/formats.md``.

Every key, what it may be and its default are read from the models that check the files.
"""

from __future__ import annotations

import ast
import inspect
import json
import sys
import textwrap
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from etot_cli.reporting.files import write_atomically
from etot_cli.specs import objects
from etot_cli.specs import scene as scenes
from etot_cli.specs import task as tasks

HEAD = """# Keys of task and scene files

Generated from the models that check the files; `make docs` writes it anew. Lengths in metres,
masses in kilograms, angles in degrees, the base frame (x forward, y left, z up), quaternions
w x y z. How they go together is told in [task_format.md](task_format.md),
[scene_format.md](scene_format.md) and [objects.md](objects.md). `include: FILE` beside any of a
scene's keys takes the rest from another file; a task may have the scene's `variation`, too.
"""
SECTIONS: tuple[tuple[str, tuple[type[BaseModel], ...]], ...] = (
    ("Task file", (tasks.Task, tasks.Condition, tasks.Disturbance)),
    ("Scene", (scenes.Scene, scenes.Desk, scenes.Camera, scenes.Variation, scenes.Perception)),
    ("Every object", (objects.ObjectBase,)),
    (
        "Kinds of objects",
        (objects.Sphere, objects.Box, objects.Cylinder, objects.Capsule, objects.Pen, objects.Cup,
         objects.DrawerUnit, objects.Drawer, objects.Handle, objects.Cabinet, objects.Door,
         objects.Shelf, objects.Mesh, objects.Mjcf, objects.MjcfPart),
    ),
)  # fmt: skip
SET_BY_LOADER = {"actuation", "directory", "file", "inputs"}
"""Keys of models that no file may give, but for the file of a mesh or MJCF object."""


def formats_text() -> str:
    """The page."""
    parts = [HEAD]
    for title, models in SECTIONS:
        parts.append(f"## {title}\n")
        parts += [_section(model) for model in models]
    return "\n".join(parts).rstrip() + "\n"


def _section(model: type[BaseModel]) -> str:
    schema = model.model_json_schema(by_alias=True)
    if "$ref" in schema:  # a model that refers to itself
        schema = {**schema["$defs"][model.__name__], "$defs": schema["$defs"]}
    told = field_docstrings(model)
    common = set(objects.ObjectBase.model_fields) if _is_kind(model) else set()
    lines = [f"### {model.__name__}\n", _plain(inspect.getdoc(model) or ""), ""]
    lines += ["| key | value | default | |", "| --- | --- | --- | --- |"]
    required = set(schema.get("required", ()))
    for name, field in model.model_fields.items():
        loader = name in SET_BY_LOADER and not issubclass(model, objects.Mesh | objects.Mjcf)
        if name in common or loader:
            continue
        key = field.alias or name
        value = schema["properties"][key]
        default = "required" if key in required else _default(value.get("default"))
        if name == "name" and model in (tasks.Task, scenes.Scene):
            default = "the file's name"
        if name == "instruction" and model is tasks.Task:
            default = "required without a `goal`"  # which the loader sees to
        if key not in required and "$ref" in value and "](#" in _value(value, schema):
            default = ""  # told where the link leads
        cells = (f"`{key}`", _value(value, schema), default, _plain(told.get(name, "")))
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _is_kind(model: type[BaseModel]) -> bool:
    return issubclass(model, objects.ObjectBase) and model is not objects.ObjectBase


def field_docstrings(model: type[BaseModel]) -> dict[str, str]:
    """The strings that stand below the fields, those of base classes included."""
    found: dict[str, str] = {}
    for kind in reversed(model.__mro__):
        if not issubclass(kind, BaseModel) or kind is BaseModel:
            continue
        (node,) = ast.parse(textwrap.dedent(inspect.getsource(kind))).body
        assert isinstance(node, ast.ClassDef)
        for item, following in zip(node.body, node.body[1:], strict=False):
            if (
                isinstance(item, ast.AnnAssign)
                and isinstance(item.target, ast.Name)
                and isinstance(following, ast.Expr)
                and isinstance(following.value, ast.Constant)
            ):
                found[item.target.id] = inspect.cleandoc(str(following.value.value))
    return found


def _plain(text: str) -> str:
    return " ".join(text.replace("``", "`").split()).replace("<", "&lt;")


def _default(value: object) -> str:
    return "" if value is None else f"`{json.dumps(value, ensure_ascii=False)}`"


def _value(schema: dict[str, Any], root: dict[str, Any]) -> str:
    """What a key may hold, in words."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[-1]
        definition = root.get("$defs", {}).get(name, {})
        documented = {model.__name__ for _, models in SECTIONS for model in models}
        return f"[{name}](#{name.lower()})" if name in documented else _value(definition, root)
    if "const" in schema:
        return f"`{schema['const']}`"
    if "enum" in schema:
        return " or ".join(f"`{item}`" for item in schema["enum"])
    for key in ("anyOf", "oneOf"):
        if key in schema:
            found = [_value(item, root) for item in schema[key] if item.get("type") != "null"]
            return " or ".join(dict.fromkeys(found))
    kind = schema.get("type")
    if kind == "array":
        if "prefixItems" in schema:
            items = [_value(item, root) for item in schema["prefixItems"]]
            return f"{len(items)} × {items[0]}" if len(set(items)) == 1 else ", ".join(items)
        return f"list of {_value(schema.get('items', {}), root)}"
    if kind == "object":
        named = [*schema.get("patternProperties", {}).values(), schema.get("additionalProperties")]
        inner = named[0]
        return f"name: {_value(inner, root)}" if isinstance(inner, dict) else "mapping"
    words = {
        "number": "number",
        "integer": "whole number",
        "string": "text",
        "boolean": "yes or no",
    }
    return (words.get(str(kind), "anything") + _bounds(schema)).strip()


def _bounds(schema: dict[str, Any]) -> str:
    low = schema.get("minimum", schema.get("exclusiveMinimum"))
    high = schema.get("maximum", schema.get("exclusiveMaximum"))
    above = "over" if "exclusiveMinimum" in schema else "from"
    below = "below" if "exclusiveMaximum" in schema else "to"
    bounds = [f"{above} {low:g}" if low is not None else "", f"{below} {high:g}" if high else ""]
    return "".join(f" {bound}" for bound in bounds if bound)


def main(arguments: list[str]) -> int:
    """Writes the page into the file given as the only argument."""
    if len(arguments) != 1:
        print("usage: python -m tests.docs.formats FILE", file=sys.stderr)
        return 2
    write_atomically(Path(arguments[0]), formats_text())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
