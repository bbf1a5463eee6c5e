"""Reading a plan back from a report, exactly as it was found."""

from __future__ import annotations

from dataclasses import replace
from itertools import zip_longest
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from etot_cli.errors import PlanSyntaxError, SpecError
from etot_cli.skills.action import MAX_PLAN_ACTIONS, Action, Keepout, parse_plan
from etot_cli.specs.problems import first_fault
from etot_cli.specs.reading import read_bytes

MAX_REPORT_BYTES = 64 * 1024 * 1024
"""A report is a few hundred kilobytes; what is far larger is something else."""
READABLE = "etot.plan/1"


class Lenient(BaseModel):
    """Reads only what a replay needs, so that reports with further fields stay readable."""

    model_config = ConfigDict(extra="ignore", allow_inf_nan=False)


M = TypeVar("M", bound=Lenient)


class _Disc(Lenient):
    x: float
    y: float
    radius: float
    soft: bool = False


class _Node(Lenient):
    id: int
    action: str
    safe: bool = False
    keepout: list[_Disc] = Field(default_factory=list)


class _Tree(Lenient):
    nodes: list[_Node] = Field(default_factory=list)


class _Head(Lenient):
    schema_: str = Field(default="", alias="schema")
    status: str = ""
    plan: list[str] = Field(default_factory=list)
    plan_nodes: list[int] = Field(default_factory=list)
    tree: _Tree = _Tree()


def plan_from_report(path: Path) -> tuple[Action, ...]:
    """The plan of a report written by ``etot plan``.

    Actions come back with the details that their written form leaves out (safe places and the
    discs they avoid), so that they lead to the same motions. Where the list ``plan`` has been
    edited by hand, the written form counts.

    Raises:
        PlanSyntaxError: the file cannot be read, is no such report, or holds no plan.
    """
    report = read_report(path, _Head)
    if report.schema_ != READABLE:
        found = f"schema {report.schema_!r}" if report.schema_ else "no schema"
        raise PlanSyntaxError(f"{path}: not a plan report ({found}); expected schema {READABLE!r}")
    if not report.plan:
        raise PlanSyntaxError(f"{path}: the report holds no plan (status {report.status!r})")
    if len(report.plan) > MAX_PLAN_ACTIONS:
        raise PlanSyntaxError(
            f"{path}: a plan of {len(report.plan)} actions; it may have at most {MAX_PLAN_ACTIONS}"
        )
    nodes = {node.id: node for node in report.tree.nodes}
    detailed = [nodes.get(number) for number in report.plan_nodes]
    return tuple(
        _restore(_parse_one(path, written), node)
        for written, node in zip_longest(report.plan, detailed[: len(report.plan)])
    )


def _restore(action: Action, node: _Node | None) -> Action:
    """Adds the details that the tree node of an action has on record."""
    if node is None or node.action != str(action):
        return action
    discs = tuple(Keepout(disc.x, disc.y, disc.radius, disc.soft) for disc in node.keepout)
    return replace(action, safe=node.safe, keepout=discs)


def _parse_one(path: Path, written: str) -> Action:
    try:
        actions = parse_plan(written)
    except PlanSyntaxError as error:
        raise PlanSyntaxError(f"{path}: {error}") from None
    if len(actions) != 1:
        raise PlanSyntaxError(f"{path}: {written!r} in the plan is not one action")
    return actions[0]


def read_report(path: Path, model: type[M]) -> M:
    """Reads what ``model`` has of a report, and ignores the rest.

    Raises:
        PlanSyntaxError: the file cannot be read, or holds something else there.
    """
    try:
        text = read_bytes(path, MAX_REPORT_BYTES, "a plan report")
    except SpecError as error:
        said = error.message.removeprefix("cannot be read: ")
        raise PlanSyntaxError(f"{path}: cannot be read: {said}") from None
    try:
        return model.model_validate_json(text)
    except ValidationError as error:
        raise PlanSyntaxError(f"{path}: not a readable report: {first_fault(error)}") from None
