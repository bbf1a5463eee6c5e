"""``etot plan --export``: the plan, or its scene, in formats of other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from etot_cli.commands.plan import Planning
from etot_cli.errors import EtotError
from etot_cli.reporting.exports import behavior_tree, ground_plan
from etot_cli.reporting.files import write_atomically


def write_exports(planning: Planning, files: Sequence[Path]) -> list[str]:
    """Writes every file that can be written, by its ending; returns what could not, and why."""
    warnings = []
    for file in files:
        try:
            _write(planning, file)
        except EtotError as error:
            warnings.append(str(error))
    return warnings


def _write(planning: Planning, file: Path) -> None:
    report = planning.report
    if file.suffix == ".zip":
        if planning.scene is None:
            raise EtotError(f"{file} is not written: the scene was not read")
        from etot_cli.world.export import scene_archive

        write_atomically(file, scene_archive(planning.scene))
        return
    if not report.plan:
        raise EtotError(f"{file} is not written: there is no plan")
    text = behavior_tree(report) if file.suffix == ".xml" else ground_plan(report)
    write_atomically(file, text)
