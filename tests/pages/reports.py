"""Reports for pages: a real search in the toy world, and a large made-up one."""

from __future__ import annotations

import random
from pathlib import Path

from etot_cli.commands.plan import Planning, PlanOptions, plan_task
from etot_cli.reporting.page.pictures import Frame, Picture
from etot_cli.reporting.plan_report import PlanReport
from etot_cli.reporting.tree_report import NodeModel
from etot_cli.world.state import CauseKind
from tests.planning.fakes import ToyReasoner, ToySimulator, fails
from tests.reporting.toy_rooms import ToyRooms


def toy_planning(*, worlds: int = 1) -> Planning:
    """Two failures, a reflection, removed nodes and a plan."""
    simulator = ToySimulator(fails("a", "c", kind=CauseKind.LOST), worlds=worlds)
    reasoner = ToyReasoner(["a b", "c"], {"a b @ 0": "x a b"})
    rooms = ToyRooms(simulator, reasoner).rooms()
    return plan_task(PlanOptions(task=Path("toy.yaml"), worlds=worlds), rooms=rooms)


def large_report(nodes: int) -> PlanReport:
    """A tree of many nodes, of which some failed and some were removed."""
    report = toy_planning().report.model_copy(deep=True)
    draw = random.Random(0)
    pattern = report.tree.nodes
    made: list[NodeModel] = []
    for number in range(1, nodes + 1):
        parent = None if number <= 3 else draw.randrange(max(1, number // 3), number)
        status = draw.choice(["success", "success", "failure", "removed", "pending"])
        failed = next(node for node in pattern if node.cause is not None)
        update = {
            "id": number, "parent": parent, "action": f"[PICK UP, thing_{number}]",
            "status": status, "cause": failed.cause if status == "failure" else None,
        }  # fmt: skip
        made.append(pattern[0].model_copy(update=update))
    report.tree.nodes = made
    report.plan_nodes = [1]
    report.plan = [made[0].action]
    return report


def chain_report(depth: int) -> PlanReport:
    """A tree that is one plan of so many actions."""
    report = large_report(depth)
    names = ("[PICK UP, white_holder] (horizontal)", "[PUT ON, desk]")
    report.tree.nodes = [
        node.model_copy(
            update={
                "parent": node.id - 1 if node.id > 1 else None, "status": "success",
                "cause": None, "action": names[node.id % 2],
            }
        )
        for node in report.tree.nodes
    ]  # fmt: skip
    report.plan_nodes = [node.id for node in report.tree.nodes]
    report.plan = [node.action for node in report.tree.nodes]
    return report


def heavy_pictures(
    report: PlanReport, size: int
) -> tuple[dict[int, list[Frame]], dict[str, Picture]]:
    """Two pictures per node, together ``size`` bytes, as incompressible as real ones."""
    import cv2
    import numpy as np

    noise = np.random.default_rng(0)
    count = 2 * len(report.tree.nodes)
    frames: dict[int, list[Frame]] = {}
    pictures: dict[str, Picture] = {}
    side = 16
    content = b""
    while len(content) < size / count:
        side += 16
        pixels = noise.integers(0, 255, (side, side, 3), dtype=np.uint8)
        content = cv2.imencode(".webp", pixels, [cv2.IMWRITE_WEBP_QUALITY, 60])[1].tobytes()
    for node in report.tree.nodes:
        keys = [f"n{node.id}-key", f"n{node.id}-after"]
        pictures |= {key: Picture("webp", content) for key in keys}
        frames[node.id] = [Frame(key, "A moment") for key in keys]
    return frames, pictures
