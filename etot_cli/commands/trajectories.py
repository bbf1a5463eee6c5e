"""The motions of a plan beside its report: one trajectory file for every action."""

from __future__ import annotations

import hashlib
from pathlib import Path

from etot_cli.commands.plan import Planning
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.motion_report import motion_model, trajectory_model
from etot_cli.skills.motion.motion import Trace
from etot_cli.world.robot import load_robot

FOLDER = "trajectories"


def write_trajectories(planning: Planning, folder: Path, *, keep_all: bool = False) -> None:
    """Writes the trajectory files and puts the plan's motions into the report.

    Args:
        planning: what was planned.
        folder: of the report.
        keep_all: also write what was tried and is no part of the plan.

    Raises:
        EtotError: a file cannot be written.
    """
    report, scene = planning.report, planning.scene
    if scene is None:
        return
    robot = load_robot(scene.robot, scene.directory)
    numbers = sorted(planning.result.rollouts) if keep_all else report.plan_nodes
    actions = {node.id: node.action for node in report.tree.nodes}
    for number in numbers:
        outcome = planning.result.rollouts.get(number)
        if outcome is None or not isinstance(outcome.trace, Trace):
            continue
        file = f"{FOLDER}/{number:03d}.json"
        model = trajectory_model(
            actions[number], robot.name, list(robot.joints), outcome.model_digest, outcome.trace
        )
        text = model.model_dump_json() + "\n"
        (folder / FOLDER).mkdir(exist_ok=True)
        write_atomically(folder / file, text)
        digest = hashlib.sha256(text.encode()).hexdigest()
        motion = motion_model(actions[number], number, file, digest, outcome)
        if motion is not None and number in report.plan_nodes:
            report.motions.append(motion)
            report.robot, report.model = robot.name, outcome.model_digest
    order = {number: place for place, number in enumerate(report.plan_nodes)}
    report.motions.sort(key=lambda motion: order[motion.node])
