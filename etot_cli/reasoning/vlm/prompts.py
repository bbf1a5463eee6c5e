"""Prompt templates: data files with a version, which a user may replace one by one."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from etot_cli.errors import SpecError
from etot_cli.specs.reading import read_utf8

BUILTIN = Path(__file__).parent / "prompts"
NAMES = (
    "system", "scene", "branches", "compare", "reflect", "screen", "repair", "probe", "oneshot",
    "cot_scene", "cot_attention", "cot_plan",
)  # fmt: skip
MAX_TEMPLATE = 50_000
"""Longest template [bytes]."""
_HEAD = re.compile(r"\A---\n(?P<head>.*?)\n---\n", re.DOTALL)
_VERSION = re.compile(r"(?m)^version:\s*(?P<version>[\w.-]{1,40})\s*$")
_FIELD = re.compile(r"\{\{\s*(\w+)\s*\}\}")


@dataclass(frozen=True, slots=True)
class Template:
    """A prompt with ``{{fields}}``. ``label``: name and version, part of every question's key."""

    name: str
    version: str
    text: str
    file: Path

    @property
    def label(self) -> str:
        """For records: ``branches/1``."""
        return f"{self.name}/{self.version}"

    @property
    def fields(self) -> frozenset[str]:
        """The fields that the template uses."""
        return frozenset(_FIELD.findall(self.text))

    def fill(self, values: Mapping[str, str]) -> str:
        """The prompt. Values are put in as they are; fields inside them mean nothing."""
        text = _FIELD.sub(lambda match: values.get(match[1], match[0]), self.text)
        return re.sub(r"\n{3,}", "\n\n", text).strip()


class Prompts:
    """All templates, the user's in place of the built-in ones.

    Args:
        folder: holds ``<name>.md`` for those to replace; None for none.

    Raises:
        SpecError: the folder is missing, or a template in it cannot be used.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._templates = {name: _load(BUILTIN / f"{name}.md", name) for name in NAMES}
        if folder is None:
            return
        if not folder.is_dir():
            raise SpecError("there is no such folder of prompts", file=str(folder))
        for path in sorted(folder.glob("*.md")):
            if path.stem not in NAMES:
                raise SpecError(
                    f"no prompt is called {path.stem!r}; expected one of {', '.join(NAMES)}",
                    file=str(path),
                )
            template = _load(path, path.stem)
            unknown = sorted(template.fields - self._templates[path.stem].fields)
            if unknown:
                known = ", ".join(sorted(self._templates[path.stem].fields)) or "none"
                raise SpecError(
                    f"unknown field {{{{{unknown[0]}}}}}; this prompt has {known}", file=str(path)
                )
            self._templates[path.stem] = template

    def __getitem__(self, name: str) -> Template:
        return self._templates[name]

    @property
    def versions(self) -> dict[str, str]:
        """Version of each prompt by name."""
        return {name: template.version for name, template in self._templates.items()}


def _load(path: Path, name: str) -> Template:
    text = read_utf8(path, MAX_TEMPLATE, "a prompt template")
    head = _HEAD.match(text)
    version = _VERSION.search(head["head"]) if head else None
    if head is None or version is None:
        raise SpecError(
            "expected a head with the version, three lines: ---, version: 1, ---",
            file=str(path), line=1,
        )  # fmt: skip
    return Template(name, version["version"], text[head.end() :], path)
