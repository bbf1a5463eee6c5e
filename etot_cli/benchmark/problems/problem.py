"""A problem: a task, and a plan that a person would give."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

Document = dict[str, Any]
"""A task or a part of one, as it stands in a YAML file."""


@dataclass(frozen=True, slots=True)
class Problem:
    """One problem."""

    family: str
    seed: int
    task: Document
    plan: tuple[str, ...] = ()

    @property
    def id(self) -> str:
        """``family:seed``."""
        return f"{self.family}:{self.seed}"

    def write(self, folder: Path) -> Path:
        """Writes the task as ``family_seed.yaml`` and returns its path."""
        path = folder / f"{self.task['name']}.yaml"
        path.write_text(yaml.safe_dump(self.task, sort_keys=False), encoding="utf-8")
        return path


def move(name: str, verb: str, target: str, pose: str = "") -> list[str]:
    """The two actions that take an object somewhere; ``verb`` is PUT ON or PUT INTO."""
    return [f"[PICK UP, {name}]" + (f" ({pose})" if pose else ""), f"[{verb}, {target}]"]


def onto(name: str, target: str, pose: str = "") -> list[str]:
    """Takes an object onto a surface."""
    return move(name, "PUT ON", target, pose)


def into(name: str, target: str, pose: str = "") -> list[str]:
    """Takes an object into a container."""
    return move(name, "PUT INTO", target, pose)


def the(name: str) -> str:
    """``red_block`` as it is said: the red block."""
    return "the " + name.replace("_", " ")


def listed(names: Sequence[str]) -> str:
    """Several objects as they are said."""
    words = [the(name) for name in names]
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def sentence(text: str) -> str:
    """With a capital and a full stop."""
    return f"{text[0].upper()}{text[1:]}."
