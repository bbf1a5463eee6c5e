"""One HTML file from a template, its style, its scripts and its data; nothing is fetched."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup

from etot_cli.reporting.page.pictures import Store
from etot_cli.reporting.style import LOOKS

WORDS = {
    "feasible": "feasible plan",
    "infeasible": "no feasible plan",
    "limit": "no plan within the limits",
}
"""Statuses in the heading; the others say what they mean."""


def assemble(
    template: str,
    *,
    scripts: Sequence[str],
    data: Mapping[str, Any],
    pictures: Store,
    **context: Any,
) -> str:
    """A page as text.

    Args:
        template: file in the ``templates`` folder.
        scripts: scripts of that folder, after the common one.
        data: what the scripts show; becomes JSON.
        pictures: by key; embedded once each.
        context: what the template shows. Whatever is in it is escaped.
    """
    script = "\n".join(_asset(name) for name in ("common.js", *scripts))
    return (
        _environment()
        .get_template(template)
        .render(
            css=Markup(_asset("page.css")),
            js=Markup(script),
            data_json=_embedded({"symbols": _symbols(), **data}),
            pictures_json=_embedded({key: picture.uri for key, picture in pictures.items()}),
            symbols=_symbols(),
            words=WORDS,
            **context,
        )
    )


def _symbols() -> dict[str, str]:
    return {status: look.symbol for status, look in LOOKS.items()}


def _embedded(value: object) -> Markup:
    """JSON that cannot end the script element it stands in, whatever names are in it."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)


@cache
def _environment() -> Environment:
    return Environment(
        autoescape=True,
        loader=FunctionLoader(_asset),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


@cache
def _asset(name: str) -> str:
    return (files("etot_cli.reporting.page") / "templates" / name).read_text(encoding="utf-8")
