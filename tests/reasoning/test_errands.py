"""What goes through drawers and doors is done with as few openings as the goal allows."""

from __future__ import annotations

import random
from collections import Counter
from itertools import permutations
from typing import Any

import pytest

from etot_cli.reasoning.builtin import BuiltinReasoner, branching
from etot_cli.reasoning.protocol import Assignment
from etot_cli.skills.action import Action, Verb, format_plan
from etot_cli.specs.task import Condition
from etot_cli.world.state import SceneState
from tests.reasoning import scenes
from tests.reasoning.intended import intended

Goals = list[dict[str, Any]]


def room(openness: dict[str, float], **inside: str | None) -> SceneState:
    """A chest, a cabinet, and small blocks: each in a part of one of them, or on the desk."""
    blocks = (
        scenes.item(
            name, at=(0.3, 0.1 * index), size=(0.03,) * 3, inside=part,
            on=part.partition(".")[0] if part else "desk",
        )
        for index, (name, part) in enumerate(inside.items())
    )  # fmt: skip
    chest = scenes.drawers("chest", (0.6, 0.0), openness)
    return scenes.scene(chest, scenes.cabinet("cabinet", (0.5, 0.5), 0.0), *blocks)


def drafted(state: SceneState, goal: Goals) -> tuple[Action, ...]:
    conditions = tuple(Condition.model_validate(item) for item in goal)
    return next(iter(BuiltinReasoner().propose(Assignment("", conditions), state))).actions


def openings(actions: tuple[Action, ...]) -> dict[str, int]:
    return dict(Counter(action.target for action in actions if action.verb is Verb.OPEN))


SHUT = {"a": 0.0, "b": 0.0, "c": 0.0}
CLOSED = [{"closed": f"chest.{name}"} for name in SHUT]


@pytest.mark.parametrize(
    ("goal", "inside", "actions"),
    [
        # Out of a drawer, and into it.
        ({"nut": "chest.b", "key": "chest.a"}, {"nut": "chest.a"}, 10),
        ({"nut": "chest.b", "key": "chest.a", "cap": "chest.b"}, {"nut": "chest.a"}, 12),
        # Down the whole chest.
        (
            {"nut": "chest.c", "key": "chest.b", "cap": "chest.a"},
            {"nut": "chest.b", "key": "chest.a"},
            16,
        ),
        # Two that go the same way.
        ({"nut": "chest.b", "key": "chest.b"}, {"nut": "chest.a", "key": "chest.a"}, 12),
        ({"nut": "chest.b", "key": "chest.b"}, {"nut": "chest.a", "key": "chest.c"}, 14),
        # Two that have nothing to do with each other.
        ({"nut": "cabinet", "key": "chest.a", "cap": "cabinet"}, {}, 10),
    ],
    ids=["through", "twice into", "three drawers", "together", "from two", "cabinet"],
)
def test_each_part_is_opened_once_whatever_the_order(
    goal: dict[str, str], inside: dict[str, str], actions: int
) -> None:
    state = room(SHUT, **{name: inside.get(name) for name in goal})
    for order in permutations(goal):
        wanted: Goals = [{"inside": [name, goal[name]]} for name in order]
        found = drafted(state, [*wanted, *CLOSED])
        assert {*openings(found).values()} == {1}, order
        assert len(found) == actions, order


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_what_stands_open_is_visited_first(order: tuple[int, ...]) -> None:
    """It may cover the others, and needs no opening."""
    state = room({"a": 0.0, "b": 1.0, "c": 0.0}, nut="chest.c", key="chest.b", cap=None)
    wanted = [("nut", "chest.a"), ("key", "chest.a"), ("cap", "chest.b")]
    found = drafted(state, [*({"inside": [*wanted[place]]} for place in order), *CLOSED])
    assert openings(found) == {"chest.a": 1, "chest.c": 1}
    closed = found.index(Action(Verb.CLOSE, "chest.b"))
    assert all(action.verb is not Verb.OPEN for action in found[:closed])


@pytest.mark.parametrize("fixture", ["vessel", "thing", "in a vessel"])
@pytest.mark.parametrize(("source", "target"), [("a", "b"), ("b", "a"), ("a", "c")])
def test_what_goes_to_a_thing_in_another_drawer_waits_on_the_desk(
    source: str, target: str, fixture: str
) -> None:
    """Of two drawers that stand open the upper one covers what is in the lower one."""
    size = (0.09, 0.09, 0.05)
    place: dict[str, Any] = {"size": size, "on": "chest", "inside": f"chest.{target}"}
    nut: dict[str, Any] = {"size": (0.03,) * 3, "on": "chest", "inside": f"chest.{source}"}
    more = [scenes.item("nut", at=(0.6, 0.0), **nut)]
    if fixture == "in a vessel":
        around = {**place, "inside": f"chest.{source}"}
        more = [scenes.cup("jar", (0.6, 0.0), **around)]
        more.append(scenes.item("nut", at=(0.6, 0.0), **{**nut, "on": "jar", "inside": "jar"}))
    thing = scenes.item("mug", "box" if fixture == "thing" else "cup", (0.6, 0.1), **place)
    chest = scenes.drawers("chest", (0.6, 0.0), SHUT)
    state = scenes.scene(chest, thing, *more)
    relation, put = ("on", "PUT ON") if fixture == "thing" else ("inside", "PUT INTO")
    first = f"[OPEN, chest.{source}] [PICK UP, nut] [PUT ON, desk] [CLOSE, chest.{source}]"
    then = f"[OPEN, chest.{target}] [PICK UP, nut] [{put}, mug]"
    for goal, last in (
        ([], f" [CLOSE, chest.{target}]"),
        (CLOSED, f" [CLOSE, chest.{target}]"),
        ([{"open": f"chest.{target}"}], ""),
    ):
        actions = drafted(state, [{relation: ["nut", "mug"]}, *goal])
        assert format_plan(actions) == f"{first} {then}{last}"


@pytest.mark.parametrize("turned", [False, True])
def test_drawers_that_change_their_contents(turned: bool) -> None:
    """One of them has to be opened twice; of orders that are as long the given one stays."""
    state = room(SHUT, nut="chest.a", key="chest.b")
    goal: Goals = [{"inside": ["nut", "chest.b"]}, {"inside": ["key", "chest.a"]}]
    found = drafted(state, [*(goal[::-1] if turned else goal), *CLOSED])
    assert sorted(openings(found).values()) == [1, 2]
    assert found[1].target == ("key" if turned else "nut")


def test_supports_come_first_all_the_same() -> None:
    state = room(SHUT, nut="chest.a", key=None, cap=None, tray=None)
    goal: Goals = [
        {"on": ["key", "tray"]}, {"inside": ["nut", "chest.b"]}, {"inside": ["cap", "chest.a"]},
        {"on": ["tray", "cabinet"]},
    ]  # fmt: skip
    found = drafted(state, [*goal, *CLOSED])
    taken = [action.target for action in found if action.verb is Verb.PICK_UP]
    assert openings(found) == {"chest.a": 1, "chest.b": 1}
    assert taken.index("tray") < taken.index("key")


@pytest.mark.parametrize(
    ("told", "visits"),
    [
        ("Put the nut in the cabinet, the key in the chest and the cap in the cabinet.", 1),
        ("Put the nut in the cabinet. Put the key in the chest. Put the cap in the cabinet.", 2),
        ("Put the nut in the cabinet, then the key in the chest, then the cap in the cabinet.", 2),
    ],
    ids=["one sentence", "sentences", "then"],
)  # fmt: skip
def test_an_order_in_words_stays(told: str, visits: int) -> None:
    state = room({"drawer": 0.0}, nut=None, key=None, cap=None)
    found = next(iter(BuiltinReasoner().propose(Assignment(told), state))).actions
    taken = [action.target for action in found if action.verb is Verb.PICK_UP]
    assert taken == (["nut", "key", "cap"] if visits > 1 else ["nut", "cap", "key"])
    assert openings(found) == {"cabinet": visits, "chest": 1}


@pytest.mark.parametrize("seed", range(40))
def test_it_leads_to_the_goal_and_is_never_longer(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    rng = random.Random(seed)
    parts = ["chest.a", "chest.b", "chest.c", "cabinet"]
    inside = {f"block_{i}": rng.choice([None, *parts]) for i in range(rng.randint(2, 5))}
    wanted = {name: rng.choice(parts) for name in inside}
    if wanted == inside:
        return
    state = room(SHUT, **inside)
    goal: Goals = [*({"inside": [*item]} for item in wanted.items()), *CLOSED]
    rng.shuffle(goal)
    found = drafted(state, goal)
    final = intended(state, found)
    assert final is not None
    assert {name: final.states[name].inside for name in wanted} == wanted
    assert not any(final.states["chest"].opened.values())
    monkeypatch.setattr(branching, "visiting_orders", lambda *_: ())
    assert len(found) <= len(drafted(state, goal))
