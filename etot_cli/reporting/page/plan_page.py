"""The page of a plan report: the plan, the tree behind it, and why the rest did not work."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from typing import Any

from etot_cli.reporting.failures import distinct_failures
from etot_cli.reporting.page.assemble import assemble
from etot_cli.reporting.page.pictures import Frame, Frames, Store
from etot_cli.reporting.page.timeline import time_parts
from etot_cli.reporting.plan_report import PlanReport
from etot_cli.reporting.tree_report import NodeModel

NO_FRAMES: Sequence[Frame] = ()
TOLD = {
    "id", "parent", "action", "safe", "origin", "status", "changes", "moved", "contacts",
    "worlds_alive", "simulated_s", "wall_s",
}  # fmt: skip
"""Of a node, by its names in the report."""


def plan_page(report: PlanReport, frames: Frames, pictures: Store, notice: str = "") -> str:
    """The page as text.

    Args:
        report: what was found.
        frames: what each evaluated node's pictures show.
        pictures: by the keys that ``frames`` uses.
        notice: shown at the top, such as why nothing is rendered.
    """
    nodes = report.tree.nodes
    by_id = {node.id: node for node in nodes}
    return assemble(
        "plan.html.j2",
        scripts=("tree.js",),
        data={
            "nodes": [_node(node, frames.get(node.id, NO_FRAMES), report) for node in nodes],
            "plan": report.plan_nodes,
            "worlds": report.options.worlds,
        },
        pictures=pictures,
        command="plan",
        title=f"{report.task.name}: {report.status}",
        subject=report.task.file,
        heading=report.task.instruction or report.task.name,
        head=report,
        lead=_lead(report),
        notice=notice,
        report=report,
        survival=report.survival if report.options.worlds > 1 else None,
        conditions=getattr(getattr(report, "success", None), "conditions", None),
        understood_lines=_understood(report),
        strip=[_card(by_id[number], frames) for number in report.plan_nodes if number in by_id],
        removed=sum(node.status == "removed" for node in nodes),
        failures=[
            {
                "node": failure.node.id,
                "path": [item.action for item in failure.path],
                "action": failure.node.action,
                "status": failure.node.status,
                "kind": failure.kind,
                "text": failure.text,
                "times": failure.times,
            }
            for failure in distinct_failures(nodes)
        ],
        repeat=_command(report),
        **time_parts(report.timing, report.statistics),
    )


def _lead(report: PlanReport) -> str:
    if report.plan:
        return " ".join(report.plan)
    failed = sum(node.status in ("failure", "unsafe") for node in report.tree.nodes)
    return f"{failed} of {len(report.tree.nodes)} nodes failed" if failed else ""


def _card(node: NodeModel, frames: Frames) -> dict[str, Any]:
    shown = frames.get(node.id, NO_FRAMES)
    said = next((f"{item.object}: now {item.after}" for item in node.moved), "")
    return {
        "node": node.id,
        "action": node.action,
        "safe": node.safe,
        "picture": shown[-1].key if shown else "",
        "say": said,
    }


def _node(node: NodeModel, frames: Sequence[Frame], report: PlanReport) -> dict[str, Any]:
    notes = report.vlm.notes if report.vlm is not None else []
    return {
        **node.model_dump(include=TOLD),
        "kind": node.cause.kind.value if node.cause else "",
        "cause": node.cause.text if node.cause else "",
        "time": node.cause.time_s if node.cause else None,
        "frames": [{"key": frame.key, "caption": frame.caption} for frame in frames],
        "words": [
            f"{note.kind.value}: {note.text}" for note in notes if note.action == node.action
        ],
        "losses": [
            {"world": loss.world, "text": loss.cause.text if loss.cause else loss.status}
            for loss in node.losses
        ],
    }


def _understood(report: PlanReport) -> list[str]:
    """What else the reader of the instruction has on record, in words."""
    known = {"goal_holds", "branches"}
    lines = []
    for name, value in report.understood.model_dump().items():
        if name in known or not value:
            continue
        words = name.replace("_", " ")
        if isinstance(value, str | int | float):
            lines.append(f"{words}: {value}")
        elif isinstance(value, list):
            lines += [f"{words}: {item}" for item in value if isinstance(item, str)]
    return lines


def _command(report: PlanReport) -> str:
    options = report.options
    words = ["etot", "plan", report.task.file, "--seed", str(report.seed)]
    words += ["--reasoner", options.reasoner] if options.reasoner != "builtin" else []
    words += ["--vary"] if options.vary else []
    words += ["--worlds", str(options.worlds)] if options.worlds > 1 else []
    for mechanism in options.without:
        words += ["--without", mechanism]
    return shlex.join(words)
