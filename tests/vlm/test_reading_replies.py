"""Replies of real models and of our own making, each with the reading that is right."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from etot_cli.reasoning.vlm.baselines import label_poses
from etot_cli.reasoning.vlm.reading.names import Names
from etot_cli.reasoning.vlm.reading.plans import ReadPlan, read_plans, read_revision
from etot_cli.reasoning.vlm.reading.states import read_comparison, read_scene
from etot_cli.reasoning.vlm.reading.verdicts import read_verdict

HERE = Path(__file__).parent
OWN = HERE / "replies.jsonl"
SHARED = HERE.parents[2] / "shared" / "vlm_replies.jsonl"
POSES = {"horizontally": "horizontal", "vertically": "vertical"}


def load(path: Path) -> list[Any]:
    if not path.is_file():
        reason = f"{path.name} is not here"
        return [pytest.param(None, id=path.stem, marks=pytest.mark.skip(reason=reason))]
    lines = path.read_text(encoding="utf-8").splitlines()
    records = [json.loads(line) for line in lines if line.strip()]
    # No question of this program asks for the goal as a list of relations.
    return [
        pytest.param(record, id=record["id"])
        for record in records
        if record["expected"]["kind"] != "states"
    ]


def branches(plans: tuple[ReadPlan, ...]) -> list[list[list[str | None]]]:
    assert not any(plan.problems for plan in plans)
    return [
        [
            [
                step.verb.value,
                step.target,
                None if step.pose is None else step.pose.value,
                step.note,
            ]
            for step in plan.steps
        ]
        for plan in plans
    ]


def expected_branches(given: list[list[list[str | None]]]) -> list[list[list[str | None]]]:
    return [
        [[verb, name, POSES.get(pose or "", pose), note] for verb, name, pose, note in branch]
        for branch in given
    ]


@pytest.mark.parametrize("record", [*load(SHARED), *load(OWN)])
def test_reply(record: dict[str, Any]) -> None:
    expected, reply = record["expected"], record["reply"]
    names = Names([(name, name) for name in record["objects"]])
    kind = expected["kind"]
    if kind == "branches":
        read = read_revision if record["role"] == "reflective" else read_plans
        found = read(reply)
        assert branches(found.plans) == expected_branches(expected["branches"])
        poses = {label: pose.value for label, pose in label_poses(record["instruction"]).items()}
        for label, pose in expected.get("implied_pose", {}).items():
            asked = {s.target: s.pose.value for p in found.plans for s in p.steps if s.pose}
            assert asked.get(label, poses.get(label)) == POSES.get(pose, pose)
    elif kind == "none":
        found = read_revision(reply)
        assert found.none and not found.plans
    elif kind == "unusable":
        found = read_revision(reply)
        assert not found.none
        assert all(plan.problems for plan in found.plans)
    elif kind == "verdict":
        verdict = read_verdict(reply)
        assert verdict.verdict == expected["verdict"]
        assert verdict.ambiguous == expected["ambiguous"]
        assert verdict.first == expected["first_marker"]
        assert verdict.last == expected["last_marker"]
        corrected = expected.get("corrected_plan")
        assert branches(verdict.corrected) == expected_branches(corrected or [])
    elif kind == "state_compare":
        seen = read_comparison(reply, names)
        assert dict(seen.before) == expected["before"]
        assert dict(seen.after) == expected["after"]
    else:
        assert kind == "scene"
        scene = read_scene(reply, names)
        assert dict(scene.labels) == expected["labels"]
        for name, state in expected.items():
            if name not in ("kind", "labels"):
                assert state in scene.states[name].split(", ")
