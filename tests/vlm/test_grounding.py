"""Names, rules of a well-formed plan, and what a revision may change: decided by code."""

from __future__ import annotations

from dataclasses import replace

import pytest

from etot_cli.reasoning.vlm import describe
from etot_cli.reasoning.vlm.grounding import ground, purpose_reasons, relocated
from etot_cli.reasoning.vlm.reading.names import Names, Unresolved
from etot_cli.reasoning.vlm.reading.plans import read_plans
from etot_cli.skills.action import GraspPose, parse_plan
from tests.vlm.scenes import kitchen

SCENE = kitchen()
NAMES = Names.of_scene(SCENE, {1: "ball", 2: "red_cup"})


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("ball", "ball"),
        ("the rubber ball", "ball"),
        ("Ball", "ball"),
        ("balls", None),
        ("green ball on the left", "ball"),
        ("purple ball", None),
        ("red cup", "red_cup"),
        ("RED_CUP", "red_cup"),
        ("`red_cup`", "red_cup"),
        ("red", "red_cup"),
        ("cup", None),
        ("yellow cup", None),
        ("the red cup near the blue cup", "red_cup"),
        ("chest", "chest"),
        ("chest.top", "chest"),
        ("top drawer of the chest", "chest"),
        ("table", "desk"),
        ("a different part of the desk", "desk"),
        ("label 1", "ball"),
        ("mark 2", "red_cup"),
        ("2", "red_cup"),
        ("label 9", None),
        ("knife", None),
        ("", None),
        ("...", None),
    ],
)
def test_names(written: str, meant: str | None) -> None:
    found = NAMES.resolve(written)
    assert found == meant if meant else isinstance(found, Unresolved)


def test_unclear_names_say_what_they_may_mean() -> None:
    found = NAMES.resolve("the cup")
    assert isinstance(found, Unresolved) and "blue_cup or red_cup" in found.text


def reasons(text: str) -> str:
    (plan,) = read_plans(text).plans
    return " | ".join(ground(plan, SCENE, NAMES).reasons)


@pytest.mark.parametrize(
    ("plan", "reason"),
    [
        ("[PICK UP, knife]", "the scene has no 'knife'"),
        ("[OPEN, red_cup]", "nothing to open or close"),
        ("[PICK UP, chest]", "cannot be picked up"),
        ("[PUT ON, desk]", "needs something in the hand"),
        ("[PICK UP, ball] [PICK UP, spoon]", "holds ball"),
        ("[PICK UP, ball] [OPEN, chest]", "OPEN needs an empty hand"),
        ("[PICK UP, ball] [PUT INTO, chest]", "must be opened"),
        ("[OPEN, chest] [PICK UP, ball] [PUT INTO, chest]", "left open"),
        ("[PICK UP, ball] [PUT INTO, spoon, red_cup]", "the hand holds ball then"),
        ("[PICK UP, ball] [PUT ON, spoon]", "no flat top"),
        ("[PICK UP, ball] [PUT INTO, ball]", "itself"),
    ],
)
def test_broken_rules_are_told_exactly(plan: str, reason: str) -> None:
    assert reason in reasons(plan)


def test_poses_notes_and_three_part_steps() -> None:
    (plan,) = read_plans(
        "1. [PICK UP, red cup, horizontal]\n2. [PUT ON, red cup, desk] (somewhere out of the way)\n"
        "3. [PICK UP, ball] (from above)\n4. [PUT ON, a safe place]"
    ).plans
    pick, put, ball, aside = ground(plan, SCENE, NAMES).actions
    assert pick.pose is GraspPose.HORIZONTAL and ball.pose is GraspPose.VERTICAL
    assert put.safe and put.target == "desk" and aside.safe and aside.target == "desk"


ORIGINAL = "[PICK UP, spoon] [PUT INTO, red_cup]"


@pytest.mark.parametrize(
    ("original", "revised", "reason"),
    [
        (ORIGINAL, "[PICK UP, ball] [PUT ON, desk] (safe place) " + ORIGINAL, None),
        (ORIGINAL, ORIGINAL, "this is the plan that failed"),
        (ORIGINAL, "[PICK UP, spoon] [PUT INTO, blue_cup]", "may not choose another place"),
        (ORIGINAL, "[PICK UP, ball] [PUT INTO, red_cup]", "leaves out that spoon"),
        (ORIGINAL, "[PICK UP, spoon] [PUT ON, desk] " + ORIGINAL, None),
        (ORIGINAL, "[PICK UP, ball] [PUT INTO, blue_cup] " + ORIGINAL, "only be put on a surface"),
        (ORIGINAL, "[PICK UP, ball] [PUT ON, spoon] " + ORIGINAL, "which the task needs"),
        ("[OPEN, chest]", "[PICK UP, ball] [PUT ON, desk] (safe place) [OPEN, chest]", None),
        ("[OPEN, chest]", "[PICK UP, ball] [PUT ON, desk]", "ends with [OPEN, chest]"),
        ("[OPEN, chest]", "[OPEN, chest] [CLOSE, chest]", "ends with [OPEN, chest]"),
        ("[PICK UP, ball]", "[PICK UP, spoon]", "ball in the hand"),
        ("[OPEN, chest]", "[OPEN, chest] [PICK UP, ball]", "still in the hand"),
        ("[PICK UP, red_cup] [PUT ON, chest] [PICK UP, ball] [PUT INTO, red_cup]",
         "[PICK UP, ball] [PUT INTO, red_cup] [PICK UP, red_cup] [PUT ON, chest]", None),
    ],
)  # fmt: skip
def test_a_revision_keeps_the_purpose(original: str, revised: str, reason: str | None) -> None:
    found = purpose_reasons(parse_plan(original), parse_plan(revised))
    assert (reason in " ".join(found)) if reason else not found


def test_what_a_revision_moves_besides() -> None:
    revised = parse_plan("[PICK UP, ball] [PUT ON, desk] " + ORIGINAL)
    assert relocated(parse_plan(ORIGINAL), revised) == {"ball"}


def test_scenes_in_words() -> None:
    words = describe.relations(SCENE)
    assert "- chest: on desk, closed" in words and "the hand: empty" in words
    assert "has a drawer (chest)" in describe.catalogue(SCENE)
    held = replace(SCENE, holding="ball")
    assert "holds ball" in describe.relations(held)
