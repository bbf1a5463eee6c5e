"""Writes documents for tests and catches what loading them says."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.errors import SpecError
from etot_cli.specs.load import load_scene, load_task

BALL = "{kind: sphere, diameter: 0.07, at: [0.4, 0.0]}"


def write(folder: Path, name: str, text: str) -> Path:
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    return file


def scene_error(folder: Path, text: str, name: str = "scene.yaml") -> str:
    """What loading a scene says, the folder's name cut off."""
    return _error(folder, write(folder, name, text), load_scene)


def task_error(folder: Path, text: str) -> str:
    return _error(folder, write(folder, "task.yaml", text), load_task)


def _error(folder: Path, file: Path, load: object) -> str:
    with pytest.raises(SpecError) as caught:
        load(file)  # type: ignore[operator]
    message = str(caught.value)
    assert "\n" not in message
    return message.replace(f"{folder}/", "")


def objects(**items: str) -> str:
    """A scene document with one object a line; the first stands in line 2."""
    return "objects:\n" + "".join(f"  {name}: {text}\n" for name, text in items.items())
