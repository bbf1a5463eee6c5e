"""Options that several commands share, in one place. Imports nothing heavy: ``--help`` is quick."""

from __future__ import annotations

from collections.abc import Container
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from etot_cli.specs.look import Look

MAX_JOBS = 256
"""Processes at most; more of them than any machine has cores for only use its memory up."""


class ReasonerName(StrEnum):
    """Who proposes, judges and reflects."""

    BUILTIN = "builtin"
    VLM = "vlm"


class JudgeName(StrEnum):
    """Who decides whether an action succeeded."""

    STATE = "state"
    VLM = "vlm"
    BOTH = "both"


def folder_name(text: str) -> Path:
    """A folder's name. An empty one, of a variable that is not set, would be the current folder."""
    if not text:
        raise typer.BadParameter("found '', expected a folder")
    return Path(text)


TaskFile = Annotated[Path, typer.Argument(metavar="TASK.yaml", help="The task file.")]
Out = Annotated[
    Path | None,
    typer.Option(
        "--out",
        parser=folder_name,
        metavar="DIR",
        help="Folder for the report and its files. [default: results/<command>/<name>-<time>]",
    ),
]
Force = Annotated[
    bool,
    typer.Option("--force", help="Replace a report that is in the folder already."),
]
Seed = Annotated[
    int,
    typer.Option(
        "--seed", min=0, max=2**32 - 1, metavar="N", help="Same inputs and seed, same result."
    ),
]
TrialJobs = Annotated[
    int,
    typer.Option(
        "--jobs",
        min=1,
        max=MAX_JOBS,
        metavar="N",
        help="Trials carried out at the same time; changes no result.",
    ),
]
Json = Annotated[
    bool,
    typer.Option("--json", help="Print the report, and nothing else, on standard output."),
]
Html = Annotated[
    bool,
    typer.Option(
        "--html/--no-html",
        envvar="ETOT_HTML",
        help="Write report.html beside the report, with pictures of what was tried.",
    ),
]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Print the answer only.")]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="Print more detail.")]
Vary = Annotated[
    bool,
    typer.Option(
        "--vary", help="Draw poses and parameters from the scene's variation by the seed."
    ),
]
WhenToLook = Annotated[
    Look,
    typer.Option(
        "--look",
        help="When the robot looks at a varied world: before each action, or once at the start, "
        "running the twin's motions as they are.",
    ),
]
Reasoner = Annotated[
    ReasonerName, typer.Option("--reasoner", help="Who proposes, judges and reflects.")
]
VlmJudge = Annotated[
    JudgeName | None,
    typer.Option(
        "--judge",
        help="With --reasoner vlm: who decides whether an action succeeded. [default: both]",
    ),
]
VlmUrl = Annotated[
    str | None,
    typer.Option(
        "--vlm-url",
        metavar="URL",
        help="API base of an OpenAI-compatible server. [env: ETOT_VLM_URL, OPENAI_BASE_URL]",
    ),
]
VlmModelName = Annotated[
    str | None,
    typer.Option("--model", metavar="NAME", help="The server's model. [env: ETOT_VLM_MODEL]"),
]
VlmHints = Annotated[
    bool | None,
    typer.Option(
        "--hints/--no-hints",
        help="With --reasoner vlm: tell the model what the simulator knows of a failure's cause. "
        "[default: hints in simulation, none where a camera sees a real robot]",
    ),
]
VlmRecord = Annotated[
    Path | None,
    typer.Option(
        "--record",
        parser=folder_name,
        metavar="DIR",
        help="Write every exchange with the model there.",
    ),
]
VlmReplay = Annotated[
    Path | None,
    typer.Option(
        "--replay",
        parser=folder_name,
        metavar="DIR",
        help="Take the model's answers from such a folder.",
    ),
]
VlmMaxCalls = Annotated[
    int | None,
    typer.Option("--max-calls", min=0, metavar="N", help="Requests to the model at most."),
]
VlmMaxCost = Annotated[
    float | None,
    typer.Option("--max-cost", min=0.0, metavar="X", help="US dollars for the model at most."),
]


def model_settings(
    reasoner: ReasonerName,
    *,
    vlm_url: str | None,
    model: str | None,
    judge: JudgeName | None,
    record: Path | None,
    replay: Path | None,
    max_calls: int | None,
    max_cost: float | None,
    hints: bool | None = None,
) -> dict[str, Any]:
    """What the flags say of the model, by the names of its settings; None: they say nothing.

    Raises:
        typer.BadParameter: something is said of a model that nobody asks.
    """
    given: dict[str, Any] = {
        "vlm_url": vlm_url, "model": model, "judge": judge.value if judge else None,
        "hints": hints, "record": record, "replay": replay, "max_calls": max_calls,
        "max_cost": max_cost,
    }  # fmt: skip
    if reasoner is not ReasonerName.VLM:
        idle = [f"--{name.replace('_', '-')}" for name, value in given.items() if value is not None]
        if idle:
            raise typer.BadParameter(
                f"{', '.join(idle)}: the builtin reasoner asks no model; expected --reasoner vlm"
            )
    return {"url": given.pop("vlm_url"), **given}


def refuse_beside(context: typer.Context, flag: str, fitting: Container[str]) -> None:
    """Refuses what the command line says beside a flag that leaves no room for it.

    Args:
        context: of the command.
        flag: does something else than the command usually does.
        fitting: names of the parameters that mean something beside it.

    Raises:
        typer.BadParameter: there is something else.
    """
    for parameter in context.command.params:
        name = parameter.name or ""
        source = context.get_parameter_source(name)
        if source is None or source.name != "COMMANDLINE" or name in fitting:
            continue
        negated = context.params.get(name) is False
        flags = parameter.secondary_opts if negated and parameter.secondary_opts else parameter.opts
        told = flags[0] if flags[0].startswith("-") else name.upper()
        raise typer.BadParameter(f"{told} has no place beside {flag}")
