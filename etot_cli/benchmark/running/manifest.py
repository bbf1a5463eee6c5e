"""What a run was asked for, beside its trials, so that it can be gone on with, or begun anew."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from etot_cli.benchmark.methods.catalogue import METHODS
from etot_cli.benchmark.running.journal import NAME as JOURNAL
from etot_cli.benchmark.suite import Seed, Trials
from etot_cli.errors import EtotError
from etot_cli.specs.bounds import MAX_TRIALS
from etot_cli.specs.problems import read_json
from etot_cli.specs.writing import replacing

NAME = "bench.json"
TRIALS = "trials"
"""Folder of the trials' own reports, in a folder for each method."""
RESULTS = ("report.json", "report.html", "rows.csv", "trials.csv")
"""What a run leaves at its end; of a run that is thrown away it would tell of other trials."""
MAX_BYTES = 8 * 1024 * 1024
"""A bound on what is read: a manifest names tasks, methods and options."""


class Manifest(BaseModel):
    """What fixes the results of a run: two runs that agree in it may share a folder.

    ``tasks``: digests by name; ``draws``: what draws each trial's world.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    inputs: Annotated[list[str], Field(min_length=1)]
    tasks: dict[str, str]
    methods: list[str]
    trials: Trials
    seed: Seed
    draws: Annotated[list[tuple[Seed, int]], Field(max_length=MAX_TRIALS)]
    reasoner: str
    model: str
    thinking: dict[str, str] = Field(default_factory=dict)
    """What the model's answers depend on besides; empty without a model."""
    video: bool
    etot: str
    mujoco: str


def read_manifest(folder: Path, *, resume: bool) -> Manifest | None:
    """What the folder's run was asked for; None where there is none yet.

    Raises:
        EtotError: there is one and it is not to be gone on with, or the other way round.
    """
    path = folder / NAME
    if not path.exists():
        if resume and (folder / JOURNAL).exists():
            raise EtotError(f"{folder} has trials, but no {NAME} that says of what run")
        if resume:
            raise EtotError(f"there is no run in {folder} to go on with")
        return None
    if not resume:
        raise EtotError(
            f"there is a run in {folder} already; go on with it by --resume {folder}, or give "
            "another --out"
        )
    return read_json(
        Manifest, path, MAX_BYTES, "benchmark's description", "what 'etot bench' wrote"
    )


def agree(wanted: Manifest, known: Manifest | None, folder: Path) -> None:
    """Writes down what the run is, or makes sure that it is still the same.

    Raises:
        EtotError: it is another one; the message says in what.
        OSError: the file system refuses.
    """
    if known is None:
        with replacing(folder / NAME) as stream:
            stream.write((wanted.model_dump_json(indent=2) + "\n").encode("utf-8", "replace"))
        return
    before, now = known.model_dump(), wanted.model_dump()
    # How the inputs are named may differ; what is in them may not.
    for key in [key for key in now if key != "inputs" and before[key] != now[key]]:
        raise EtotError(
            f"the run in {folder} has {key} {_short(before[key])}, this one has "
            f"{_short(now[key])}; give another --out"
        )


def throw_away(folder: Path) -> None:
    """Removes a run: what it was, its trials and its results, and nothing that it did not write.

    Raises:
        OSError: the file system refuses.
    """
    if not (folder / NAME).exists() and not (folder / JOURNAL).exists():
        return
    for method in METHODS:
        place = folder / TRIALS / method
        # A link may lead to somebody else's files.
        if place.is_dir() and not place.is_symlink() and not place.parent.is_symlink():
            for file in place.iterdir():
                if file.suffix in (".json", ".html"):
                    file.unlink()
    # The description goes last: what is left of a run is still known to be one.
    for name in (*RESULTS, JOURNAL, NAME):
        (folder / name).unlink(missing_ok=True)


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 120 else text[:117] + "..."
