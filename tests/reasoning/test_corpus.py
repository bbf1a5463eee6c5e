"""Many sentences about many scenes: read as they are meant, or refused by the word."""

from __future__ import annotations

import re
import statistics
import time
from contextlib import suppress
from pathlib import Path
from typing import Any
from zlib import crc32

import pytest
import yaml

from etot_cli.errors import InstructionError
from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.builtin.goal import Goal
from etot_cli.reasoning.builtin.wording import formal
from etot_cli.reasoning.language.instructions import goal_of
from etot_cli.skills.action import Verb
from etot_cli.world.state import SceneState, owner_of
from tests.reasoning import corpus_scenes
from tests.reasoning.reading_time import is_in_time

CORPUS: dict[str, dict[str, dict[str, str]]] = yaml.load(
    (Path(__file__).parent / "corpus.yaml").read_text(encoding="utf-8"), yaml.CSafeLoader
)
SCENES = {name: getattr(corpus_scenes, name)() for name in CORPUS}


ONE_IN = 8
"""Of so many sentences one is read in a run of all tests, of each scene and kind; `make
check-reading` reads them all."""


def sampled(text: str, one_in: int, at: int = 0) -> bool:
    """Whether a sentence belongs to a sample, whatever else is in the corpus."""
    return crc32(text.encode()) % one_in == at


def cases(kind: str, one_in: int = 1) -> list[Any]:
    return [
        pytest.param(name, text, wanted, id=f"{name}-{text[:60]}")
        for name, found in CORPUS.items()
        for text, wanted in found.get(kind, {}).items()
        if sampled(text, one_in)
    ]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Rows of the corpus for the tests of one."""
    kind = metafunc.function.__name__.removeprefix("test_")
    if kind in ("read", "refused"):
        one_in = 1 if metafunc.config.getoption("--whole-corpus") else ONE_IN
        metafunc.parametrize(("name", "text", "wanted"), cases(kind, one_in))


def told(text: str, scene: SceneState) -> Goal | InstructionError:
    """What a sentence is read as, or why not; fails where that takes too long."""
    found: list[Goal | InstructionError] = []
    assert is_in_time(lambda: found.append(goal_or_refusal(text, scene))), "it takes too long"
    return found[-1]


def goal_or_refusal(text: str, scene: SceneState) -> Goal | InstructionError:
    try:
        return goal_of(text, scene)
    except InstructionError as error:
        return error


def test_read(name: str, text: str, wanted: str) -> None:
    goal = told(text, SCENES[name])
    assert isinstance(goal, Goal), goal
    assert " | ".join([formal(goal), *goal.notes]) == wanted


def test_every_fourth_refusal_says_what_would_be_read() -> None:
    """0.256 of 2,224 did, and for the others there is nothing near that asks for the same; a
    twentieth of them differs from that by 0.04 (one deviation).
    """
    refused = [(name, text) for name, found in CORPUS.items() for text in found.get("refused", {})]
    refused = refused[::20]
    told = 0
    for name, text in refused:
        with pytest.raises(InstructionError) as raised:
            goal_of(text, SCENES[name])
        told += "what would be read: " in str(raised.value)
    assert told > (0.256 - 3 * 0.04) * len(refused)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("scullery", "Put the cups on the plate on the tray."),  # the tray was spoken of, too
        ("scullery", "Put only the tin on the tray."),
        ("numbered", "Put cubes 1 to 3 in bin 1."),
        ("breakfast", "Wash the plate."),  # picking it up is something else
        ("breakfast", "Put the spoon and the apple on the plate."),
        ("cupboard", "Put the can into the glass if it fits."),
    ],
)
def test_no_rewording_asks_for_something_else(name: str, text: str) -> None:
    with pytest.raises(InstructionError) as raised:
        goal_of(text, SCENES[name])
    assert "what would be read: " not in str(raised.value)


def test_refused(name: str, text: str, wanted: str) -> None:
    refusal = told(text, SCENES[name])
    assert isinstance(refusal, InstructionError), refusal
    first, _, reworded, *_ = str(refusal).splitlines()
    for part in wanted.split(" | "):
        assert part in first
    head, _, instead = reworded.partition("read: ")
    if not instead:
        assert reworded.startswith("  or write the goal")
        return
    assert head == "  what would be "
    assert goal_of(instead, SCENES[name]) is not None
    assert "_" not in instead, "things are called what people call them"
    sentence = text.split(".")[0]
    denied = re.search(r"\b(not|never|neither|without|except)\b|n't", sentence)
    assert not (denied and instead.startswith("Put ")) or re.search(r"not|n't|without|exc", instead)


@pytest.mark.parametrize(
    ("name", "text", "instead"),
    [
        ("breakfast", "Quickly put the apple on the plate.", "Put the apple on the plate."),
        ("breakfast", "Kick the apple into the bowl.", "Put the apple into the bowl."),
        ("breakfast", "Put the banana where the apple is.", "Put the banana next to the apple."),
        ("breakfast", "Put the apple in the fridge.", ""),
        (
            "breakfast",
            "Put the apple on the plate and the banana next to it.",
            "Put the apple on the plate and the banana next to the apple.",
        ),
        ("breakfast", "Do not touch the cup.", ""),
        ("black_bowls", "Put the red bowl on the plate.", "Put bowl 1 on the plate."),
        ("drawers_and_desk", "Close the blue drawer.", "Close the chest."),
        ("numbered", "Put cube 5 in bin 1.", "Put cube 1 in bin 1."),
        ("kitchen", "Fry the egg in the pan.", "Put the egg in the pan."),
    ],
)
def test_a_rewording_keeps_what_was_understood(name: str, text: str, instead: str) -> None:
    with pytest.raises(InstructionError) as raised:
        goal_of(text, SCENES[name])
    assert re.findall("read: (.*)", str(raised.value)) == ([instead] if instead else [])


def test_the_corpus_is_large_and_has_many_traps() -> None:
    assert len(CORPUS) >= 24
    assert len(cases("read")) + len(cases("refused")) >= 1400
    assert len(cases("refused")) >= 350


@pytest.mark.slow
def test_most_is_read_in_a_tenth_of_a_second() -> None:
    """The bound is ten times what an idle machine takes, so that a busy one passes, too."""
    taken = []
    for name, found in CORPUS.items():
        for text in [*found.get("read", {}), *found.get("refused", {})][::64]:
            start = time.process_time()
            with suppress(InstructionError):
                goal_of(text, SCENES[name])
            taken.append(time.process_time() - start)
    assert statistics.median(taken) < 0.1


@pytest.mark.parametrize(
    "text",
    [
        "Put the duck in one dresser and the train in the other one.",
        "Put the duck and the train in different dressers.",
        "Distribute the duck and the train among the dressers.",
        "Put the duck in a drawer and the train in another drawer.",
    ],
)
def test_several_pieces_of_furniture_are_told_apart_as_wholes(text: str) -> None:
    scene = SCENES["nursery"]
    branches = list(branches_of((goal_of(text, scene),), scene))
    places = [
        [
            owner_of(action.target)
            for action in branch.actions
            if action.verb in (Verb.PUT_INTO, Verb.PUT_ON)
        ]
        for branch in branches
    ]
    apart = [owners for owners in places if len(set(owners)) == 2]
    assert apart
    assert (len(places) > len(apart)) == ("drawer" in text)


@pytest.mark.parametrize(
    "text",
    [
        "Pick up the first block in the middle.",
        "Put the thing farthest from you into the bowl.",
        "Clear the hand in front of the gripper.",
        "Stack the cup on top of the robot.",
        "Empty the desk onto the robot farthest from you.",
        "Keep the desk in the gripper.",
        "Clear the robot in the desk.",
    ],
)
def test_desk_robot_and_sides_are_no_objects(text: str) -> None:
    for scene in [*SCENES.values()][len(text) % 8 :: 8]:
        with suppress(InstructionError):
            goal_of(text, scene)


BEHIND = [
    "Then put it on the tray.",
    "Open the oven and put it back on.",
    "Put the rest where it was.",
    "Whenever it frobnicates, put the other one next to it.",
]


@pytest.mark.slow
@pytest.mark.parametrize("behind", BEHIND)
def test_sentences_one_after_the_other_are_read_or_refused_in_time(behind: str) -> None:
    """Words that refer back to all kinds of clauses, some of which put nothing."""
    for name, found in [*CORPUS.items()][BEHIND.index(behind) :: len(BEHIND)]:
        for text in [*found.get("read", {})][::144]:
            told(f"{text.rstrip('.')}. {behind}", SCENES[name])


@pytest.mark.slow
@pytest.mark.parametrize("end", [", that should not stay here.", " because this is.", ", so the."])
def test_clauses_that_are_broken_off_are_read_or_refused(end: str) -> None:
    """What is looked for beside a request may be less than a clause."""
    for name, found in [*CORPUS.items()][::3]:
        for text in [*found.get("read", {})][::144]:
            goal_or_refusal(f"{text.rstrip('.')}{end}", SCENES[name])
