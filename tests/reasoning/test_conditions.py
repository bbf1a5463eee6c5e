"""Formal goals."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from etot_cli.errors import InstructionError, UnsatisfiableError
from etot_cli.planning.conditions import holds
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.builtin.branching import MAX_ALTERNATIVES
from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.reasoning.builtin.ordering import Placement, supports_first
from etot_cli.reasoning.protocol import Assignment, ReasonerStopped
from etot_cli.skills.action import format_plan
from etot_cli.specs.task import Condition
from etot_cli.world.state import SceneState
from tests.reasoning import scenes


def plans(state: SceneState, *conditions: dict[str, Any]) -> list[str]:
    goal = tuple(Condition.model_validate(item) for item in conditions)
    branches = BuiltinReasoner().propose(Assignment("ignored, whatever it says", goal), state)
    return [format_plan(branch.actions) for branch in branches]


INTO_HOLDER = "[PICK UP, apple] [PUT INTO, holder]"
ON_DRAWER = "[PICK UP, apple] [PUT ON, drawer]"


@pytest.mark.parametrize(
    ("conditions", "wanted"),
    [
        ([{"inside": ["apple", "holder"]}], [INTO_HOLDER]),
        ([{"on": ["apple", "drawer"]}], [ON_DRAWER]),
        ([{"on": ["apple", "desk"]}], []),
        ([{"in_hand": "apple"}, {"open": "drawer"}], ["[OPEN, drawer] [PICK UP, apple]"]),
        ([{"open": "drawer.top"}], ["[OPEN, drawer]"]),
        ([{"closed": "drawer"}, {"present": "apple"}, {"upright": "holder"}], []),
        ([{"not": {"closed": "drawer"}}], ["[OPEN, drawer]"]),
        (
            [{"any": [{"inside": ["apple", "holder"]}, {"on": ["apple", "drawer"]}]}],
            [INTO_HOLDER, ON_DRAWER],
        ),
        (
            [{"all": [{"on": ["holder", "drawer"]}, {"inside": ["apple", "holder"]}]}],
            [f"[PICK UP, holder] [PUT ON, drawer] {INTO_HOLDER}"],
        ),
        (
            [{"not": {"all": [{"closed": "drawer"}, {"not": {"in_hand": "apple"}}]}}],
            ["[OPEN, drawer]", "[PICK UP, apple]"],
        ),
        (
            [{"inside": ["apple", "drawer"]}, {"closed": "drawer"}],
            ["[OPEN, drawer] [PICK UP, apple] [PUT INTO, drawer] [CLOSE, drawer]"],
        ),
        ([{"inside": ["apple", "holder"]}, {"on": ["apple", "holder"]}], [INTO_HOLDER]),
        (
            [
                {"inside": ["holder", "drawer"]},
                {"inside": ["apple", "holder"]},
                {"inside": ["apple", "drawer"]},
            ],
            [
                "[OPEN, drawer] [PICK UP, holder] [PUT INTO, drawer] "
                "[PICK UP, apple] [PUT INTO, holder] [CLOSE, drawer]"
            ],
        ),
    ],
)
def test_branches(conditions: list[dict[str, Any]], wanted: list[str]) -> None:
    assert plans(scenes.apple_and_holder(), *conditions) == wanted


def test_denied_place() -> None:
    state = scenes.toy_in_drawer()
    assert plans(state, {"not": {"inside": ["toy", "drawer"]}}) == ["[PICK UP, toy] [PUT ON, desk]"]


@pytest.mark.parametrize("on", ["plate", "desk"])
@pytest.mark.parametrize("told_last", [True, False])
def test_what_is_in_a_bowl_on_a_plate_is_not_on_the_plate(on: str, told_last: bool) -> None:
    state = scenes.scene(
        scenes.item("plate", "cylinder", (0.46, 0.0), size=(0.22, 0.22, 0.012)),
        scenes.ball("pear", (0.46, -0.05), on=on),
        scenes.cup("bowl", (0.45, 0.28)),
    )
    wanted = [{"inside": ["pear", "bowl"]}, {"on": ["bowl", "plate"]}]
    denied = {"not": {"on": ["pear", "plate"]}}
    conditions = [*wanted, denied] if told_last else [denied, *wanted]
    filled = "[PICK UP, pear] [PUT INTO, bowl]"
    assert plans(state, *conditions) == [f"{filled} [PICK UP, bowl] [PUT ON, plate]"]


def test_what_leaves_with_its_vessel_is_not_taken_out_of_it() -> None:
    state = scenes.scene(
        scenes.cabinet("cupboard", (0.5, 0.0), 1.0),
        scenes.cup("mug", (0.5, 0.0), inside="cupboard", on="cupboard"),
        scenes.ball("nut", (0.5, 0.0), inside="mug", on="mug"),
    )
    out, apart = {"on": ["mug", "desk"]}, {"not": {"inside": ["nut", "cupboard"]}}
    assert plans(state, out, apart) == ["[PICK UP, mug] [PUT ON, desk]"]
    assert plans(state, apart) == ["[PICK UP, nut] [PUT ON, desk]"]
    for names in (["bolt", "cupboard"], ["nut", "bolt"]):
        with pytest.raises(InstructionError, match="no such object"):
            plans(state, {"not": {"inside": names}})


@pytest.mark.parametrize("count", [3, 4, 6, 9])
def test_any_number_of_things_leaves_the_desk(count: int) -> None:
    names = [f"ball_{index}" for index in range(count)]
    balls = [scenes.ball(name, (0.3, 0.1 * index)) for index, name in enumerate(names)]
    state = scenes.scene(*balls, scenes.cup("bowl", (0.5, -0.2)), scenes.cup("mug", (0.5, -0.4)))
    conditions = [Condition.model_validate({"not": {"on": [name, "desk"]}}) for name in names]
    branches = BuiltinReasoner().propose(Assignment("", tuple(conditions)), state)
    first = " ".join(f"[PICK UP, {name}] [PUT INTO, bowl]" for name in names)
    assert format_plan(next(branches).actions) == first
    if 2**count <= MAX_ALTERNATIVES:
        assert len(list(branches)) == 2**count - 1
        return
    assert format_plan(next(branches).actions) == first.replace("bowl", "mug")
    with pytest.raises(ReasonerStopped):
        list(branches)


@pytest.mark.parametrize(
    ("condition", "wanted"),
    [
        ({"not": {"near": ["nut", "mug"]}}, ["[PICK UP, nut] [PUT ON, desk] (not near mug)"]),
        ({"behind": ["nut", "unit"]}, ["[PICK UP, nut] [PUT ON, desk] (behind unit)"]),
        ({"not": {"at": ["nut", "left"]}}, ["[PICK UP, nut] [PUT ON, desk] (not at left)"]),
        ({"left_of": ["unit", "nut"]}, ["[PICK UP, nut] [PUT ON, desk] (right of unit)"]),
        (
            {"not": {"on": ["nut", "desk"]}},
            ["[PICK UP, nut] [PUT INTO, mug]", "[PICK UP, nut] [PUT ON, unit]"],
        ),
    ],
)
def test_what_is_not_to_be_there_goes_elsewhere(
    condition: dict[str, Any], wanted: list[str]
) -> None:
    state = scenes.scene(
        scenes.drawers("unit", (0.4, 0.0), {}, on=""),
        scenes.cup("mug", (0.4, 0.3)),
        scenes.ball("nut", (0.4, 0.4)),
    )
    assert plans(state, condition) == wanted


def fastened() -> SceneState:
    return scenes.scene(
        scenes.item("scale", size=(0.2, 0.14, 0.04), fixed_on="desk"),
        scenes.item("clock", at=(0.6, 0.0), fixed_on="rack.top"),
        scenes.item("rack", "shelf", (0.6, 0.0), boards=("bottom", "top"), fixed_on="desk"),
        scenes.cup("jar", (0.4, 0.3)),
        scenes.ball("pill", (0.4, -0.3)),
    )


@pytest.mark.parametrize(
    "condition",
    [
        {"on": ["scale", "desk"]},
        {"on": ["rack", "desk"]},
        {"on": ["clock", "rack"]},
        {"on": ["clock", "rack.top"]},
        {"not": {"on": ["scale", "jar"]}},
        {"not": {"on": ["clock", "desk"]}},
        {"not": {"inside": ["scale", "jar"]}},
        {"not": {"in_hand": "rack"}},
        {"any": [{"inside": ["scale", "jar"]}, {"on": ["scale", "desk"]}]},
    ],
)
def test_what_holds_of_a_fastened_thing_needs_no_picking_up(condition: dict[str, Any]) -> None:
    state = fastened()
    assert plans(state, condition) == []
    assert holds(Condition.model_validate(condition), state)
    assert plans(state, condition, {"inside": ["pill", "jar"]}) == [
        "[PICK UP, pill] [PUT INTO, jar]"
    ]


@pytest.mark.parametrize(
    "condition",
    [
        {"on": ["scale", "rack"]},
        {"on": ["clock", "rack.bottom"]},
        {"inside": ["scale", "jar"]},
        {"not": {"on": ["scale", "desk"]}},
        {"in_hand": "rack"},
    ],
)
def test_what_does_not_hold_of_a_fastened_thing_is_refused(condition: dict[str, Any]) -> None:
    with pytest.raises(InstructionError, match="cannot be picked up"):
        plans(fastened(), condition)
    assert not holds(Condition.model_validate(condition), fastened())


@pytest.mark.parametrize(
    ("upper", "verb"),
    [
        ({"kind": "cylinder", "size": (0.05, 0.05, 0.1)}, "PUT INTO"),
        ({"kind": "bowl", "size": (0.17, 0.17, 0.05), "foot": 0.13}, "PUT INTO"),
        ({"kind": "bowl", "size": (0.17, 0.17, 0.05)}, "PUT ON"),
        ({"kind": "cylinder", "size": (0.18, 0.18, 0.01)}, "PUT ON"),
        ({"kind": "box", "size": (0.13, 0.13, 0.02)}, "PUT ON"),
    ],
)
def test_what_goes_through_a_mouth_is_put_in_where_it_is_to_be_on(
    upper: dict[str, Any], verb: str
) -> None:
    """A box by its diagonal, and a vessel by its foot, as it nests in another one."""
    dish = scenes.item("dish", "bowl", (0.4, 0.2), size=(0.17, 0.17, 0.05))
    state = scenes.scene(dish, scenes.item("it", at=(0.4, -0.2), **upper))
    wish = {"on": ["it", "dish"]}
    assert plans(state, wish) == [f"[PICK UP, it] [{verb}, dish]"]
    within = scenes.item("it", at=(0.4, 0.2), on="dish", inside="dish", **upper)
    there = scenes.scene(dish, within)
    if verb == "PUT INTO":
        assert plans(there, wish) == []
        assert plans(there, {"not": wish}) == ["[PICK UP, it] [PUT ON, desk]"]
    assert holds(Condition.model_validate(wish), there)


@pytest.mark.parametrize("keys", [("left_of", "right_of"), ("in_front_of", "behind")])
def test_an_order_that_is_a_circle_is_refused_as_one(keys: tuple[str, str]) -> None:
    key, turned = keys
    state = scenes.scene(*(scenes.ball(name, (0.4, 0.2 * i)) for i, name in enumerate("abcd")))
    ahead = [{key: ["a", "b"]}, {turned: ["c", "b"]}]
    for closing in ({key: ["c", "a"]}, {turned: ["a", "c"]}):
        with pytest.raises(UnsatisfiableError, match=r"circle: a .* b, b .* c, c .* a$"):
            plans(state, {key: ["d", "a"]}, *ahead, closing)
    # One that only meets again is none, nor is one that is denied.
    assert plans(state, *ahead, {key: ["a", "c"]})
    assert plans(state, *ahead, {"not": {key: ["c", "a"]}})


@pytest.mark.parametrize(
    ("key", "side", "other"), [("left_of", "left", "right"), ("right_of", "right", "left")]
)
def test_what_comes_beside_what_stands_there_comes_to_its_right_side(
    key: str, side: str, other: str
) -> None:
    state = scenes.scene(
        scenes.item("tray", at=(0.5, 0.0), size=(0.2, 0.4, 0.01)),
        scenes.cup("jar", (0.5, 0.0), on="tray"),
        scenes.cup("tin", (0.3, 0.3)), scenes.cup("pot", (0.3, -0.3)),
    )  # fmt: skip
    on = [{"on": [name, "tray"]} for name in ("tin", "jar", "pot")]
    stays, moved = plans(state, *on, {key: ["tin", "jar"]}, {key: ["jar", "pot"]})
    tin, pot = (f"[PICK UP, {name}] [PUT ON, tray]" for name in ("tin", "pot"))
    assert stays == f"{tin} ({side} of jar) {pot} ({other} of jar)"
    assert f"[PICK UP, jar] [PUT ON, tray] ({side} of pot)" in moved
    # At a very point there is no choice.
    at = {"at": ["pot", [0.5, -0.1]]}
    (first, *_) = plans(state, on[2], at, {key: ["jar", "pot"]})
    assert f"{other} of jar" not in first


@pytest.mark.parametrize("between", [None, "on", "inside"])
def test_a_part_is_closed_once_after_the_last_that_goes_into_it(between: str | None) -> None:
    state = scenes.scene(
        scenes.drawers("chest", (0.5, 0.0), {"upper": 0.0}),
        scenes.cabinet("shelf", (0.5, 0.4), 0.0),
        scenes.ball("nut", (0.3, -0.3)), scenes.ball("egg", (0.3, 0.3)),
        scenes.ball("pea", (0.3, 0.0)),
    )  # fmt: skip
    nut, egg = ({"inside": [name, "chest"]} for name in ("nut", "egg"))
    goals: list[dict[str, Any]] = [nut, *([{between: ["pea", "shelf"]}] if between else []), egg]
    (plan,) = plans(state, *goals, {"closed": "chest"})
    assert (plan,) == tuple(plans(state, *goals))
    assert plan.count("[OPEN, chest]") == plan.count("[CLOSE, chest]") == 1
    # Another part may be where that which stands open is, or be covered by it.
    assert plan.count("[CLOSE, chest] [OPEN, shelf]") == (between == "inside")
    assert plan.endswith("[CLOSE, shelf]" if between == "inside" else "[CLOSE, chest]")


def test_a_part_is_closed_after_the_last_that_is_taken_out_where_something_went_in() -> None:
    state = scenes.scene(
        scenes.cabinet("shelf", (0.5, 0.4), 0.0),
        scenes.ball("nut", (0.3, -0.3)), scenes.ball("egg", (0.5, 0.4), inside="shelf", on="shelf"),
    )  # fmt: skip
    goals = {"inside": ["nut", "shelf"]}, {"on": ["egg", "desk"]}
    (plan,) = plans(state, *goals)
    assert plan == (
        "[OPEN, shelf] [PICK UP, nut] [PUT INTO, shelf] [PICK UP, egg] [PUT ON, desk] "
        "[CLOSE, shelf]"
    )
    # What is to be in the hand is taken before, and a part that is to be open stays so.
    (held,) = plans(state, goals[0], {"in_hand": "egg"})
    assert held.endswith("[PICK UP, egg]") and held.count("[CLOSE, shelf]") == 1
    (left,) = plans(state, *goals, {"open": "shelf"})
    assert left == plan.removesuffix(" [CLOSE, shelf]")


def test_what_stands_is_laid_down_and_what_lies_is_left() -> None:
    name, mug = scenes.cup("mug", (0.4, 0.2))
    state = scenes.scene((name, mug), scenes.drawers("unit", (0.5, 0.0), {}, on=""))
    assert plans(state, {"lying": "mug"}) == ["[PICK UP, mug] [PUT ON, desk] (lying)"]
    assert plans(state, {"lying": "mug"}, {"on": ["mug", "unit"]}) == [
        "[PICK UP, mug] [PUT ON, unit] (lying)"
    ]
    on_its_side = replace(mug, toppled=True, quaternion=(0.7071068, 0.7071068, 0.0, 0.0))
    state = scenes.scene((name, on_its_side))
    assert plans(state, {"lying": "mug"}) == []
    with pytest.raises(InstructionError, match="no skill makes 'lying'"):
        plans(state, {"not": {"lying": "mug"}})


def test_what_lies_is_stood_up_before_it_takes_something_in() -> None:
    name, mug = scenes.cup("mug", (0.4, 0.2))
    state = scenes.scene((name, replace(mug, toppled=True)), scenes.ball("nut", (0.4, -0.2)))
    assert plans(state, {"upright": "mug"}) == ["[PICK UP, mug] [PUT ON, desk] (upright)"]
    assert plans(state, {"inside": ["nut", "mug"]}, {"upright": "mug"}) == [
        "[PICK UP, mug] [PUT ON, desk] (upright) [PICK UP, nut] [PUT INTO, mug]"
    ]
    assert plans(state, {"inside": ["nut", "mug"]}) == [
        "[PICK UP, mug] [PUT ON, desk] (upright) [PICK UP, nut] [PUT INTO, mug]"
    ]
    assert plans(state, {"upright": "mug"}, {"left_of": ["mug", "nut"]}) == [
        "[PICK UP, mug] [PUT ON, desk] (left of nut, upright)"
    ]


@pytest.mark.parametrize(
    ("condition", "named"),
    [
        ({"inside": ["pear", "holder"]}, "no such object; it has holder, drawer, apple, desk"),
        ({"inside": ["apple", "desk"]}, "cannot be used as a container"),
        ({"open": "drawer.bottom"}, "no such part; it has top"),
        ({"in_hand": "drawer"}, "cannot be picked up"),
        ({"not": {"upright": "holder"}}, "no skill"),
        ({"lying": "apple"}, "apple: no side of it is one to lie on"),
        ({"all": [{"lying": "holder"}, {"upright": "holder"}]}, "cannot both stand and lie"),
        ({"all": [{"lying": "holder"}, {"in_hand": "holder"}]}, "what is held does not lie"),
    ],
)
def test_refusals(condition: dict[str, Any], named: str) -> None:
    with pytest.raises(InstructionError, match=named):
        plans(scenes.apple_and_holder(), condition)


def test_an_object_cannot_be_at_two_places() -> None:
    conditions = {"on": ["apple", "drawer"]}, {"inside": ["apple", "holder"]}
    with pytest.raises(UnsatisfiableError, match="apple: it cannot be both at drawer"):
        plans(scenes.apple_and_holder(), *conditions)


def test_two_objects_cannot_be_in_the_hand() -> None:
    with pytest.raises(InstructionError, match="one object at a time"):
        plans(scenes.apple_and_holder(), {"in_hand": "apple"}, {"in_hand": "holder"})


def test_a_stack_may_be_turned_over() -> None:
    blue, red = scenes.item("blue"), scenes.item("red", on="blue")
    assert plans(scenes.scene(blue, red), {"on": ["blue", "red"]}) == [
        "[PICK UP, blue] [PUT ON, red]"
    ]
    with pytest.raises(InstructionError, match="on or in itself"):
        plans(scenes.scene(blue, red), {"on": ["blue", "red"]}, {"on": ["red", "blue"]})


def test_from_drawer_to_drawer_by_way_of_the_desk() -> None:
    """Of two drawers that stand open, the upper one covers the lower one."""
    state = scenes.scene(
        scenes.drawers("chest", (0.5, 0.0), {"upper": 0.0, "lower": 0.0}),
        scenes.ball("nut", (0.5, 0.0), on="chest", inside="chest.upper"),
    )
    assert plans(state, {"inside": ["nut", "chest.lower"]}) == [
        "[OPEN, chest.upper] [PICK UP, nut] [PUT ON, desk] [CLOSE, chest.upper] "
        "[OPEN, chest.lower] [PICK UP, nut] [PUT INTO, chest.lower] [CLOSE, chest.lower]"
    ]


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 0, 2), (2, 1, 0)])
def test_a_drawer_that_is_to_be_closed_is_not_opened_again(order: tuple[int, ...]) -> None:
    """The one that the nut comes from is closed on the way; where no word closes it, it is open
    again in the end.
    """
    state = scenes.scene(
        scenes.drawers("chest", (0.5, 0.0), {"upper": 0.9, "lower": 0.0}),
        scenes.ball("nut", (0.5, 0.0), on="chest", inside="chest.upper"),
    )
    moved = (
        "[PICK UP, nut] [PUT ON, desk] [CLOSE, chest.upper] "
        "[OPEN, chest.lower] [PICK UP, nut] [PUT INTO, chest.lower] [CLOSE, chest.lower]"
    )
    asked: list[dict[str, Any]] = [
        {"inside": ["nut", "chest.lower"]}, {"closed": "chest.upper"}, {"closed": "chest.lower"},
    ]  # fmt: skip
    assert plans(state, *(asked[place] for place in order)) == [moved]
    assert plans(state, asked[0]) == [f"{moved} [OPEN, chest.upper]"]


TOWER = [("red", "green"), ("green", "blue"), ("blue", "desk2")]


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_supports_come_first_whatever_the_order(order: tuple[int, ...]) -> None:
    names = ("red", "green", "blue", "desk2")
    state = scenes.scene(*(scenes.item(name, at=(0.3, 0.1 * i)) for i, name in enumerate(names)))
    conditions = [{"on": list(TOWER[place])} for place in order]
    assert plans(state, *conditions) == [
        "[PICK UP, blue] [PUT ON, desk2] [PICK UP, green] [PUT ON, blue] "
        "[PICK UP, red] [PUT ON, green]"
    ]


@pytest.mark.parametrize("turned", [False, True])
def test_contents_come_before_what_lies_on_top(turned: bool) -> None:
    state = scenes.scene(
        scenes.item("crate", "box", (0.4, 0.0)),
        scenes.item("lid", "box", (0.3, 0.3)),
        scenes.ball("nut", (0.3, -0.3)),
    )
    infos = {**state.infos, "crate": replace(state.infos["crate"], container=True)}
    conditions = [{"on": ["lid", "crate"]}, {"inside": ["nut", "crate"]}]
    found = plans(replace(state, infos=infos), *(conditions[::-1] if turned else conditions))
    assert found == ["[PICK UP, nut] [PUT INTO, crate] [PICK UP, lid] [PUT ON, crate]"]


def test_a_vessel_keeps_its_turn() -> None:
    """A filled cup can be carried, so the order given stays; reflection may change it."""
    state = scenes.apple_and_holder()
    conditions = [{"inside": ["apple", "holder"]}, {"on": ["holder", "drawer"]}]
    assert plans(state, *conditions)[0].startswith("[PICK UP, apple] [PUT INTO, holder]")


@pytest.mark.parametrize("turned", [False, True])
def test_a_vessel_leaves_another_before_that_is_filled(turned: bool) -> None:
    """What fell into the inner one would leave with it."""
    state = scenes.kitchen()
    inner = replace(state.states["mug_a"], inside="bowl_1", on=("bowl_1",))
    state = replace(state, states={**state.states, "mug_a": inner})
    conditions = [{"inside": ["bottle", "bowl_1"]}, {"on": ["mug_a", "desk"]}]
    assert plans(state, *(conditions[::-1] if turned else conditions))[0] == (
        "[PICK UP, mug_a] [PUT ON, desk] [PICK UP, bottle] [PUT INTO, bowl_1]"
    )


@given(st.permutations(range(5)))
def test_an_order_is_one_of_the_given_placements(order: list[int]) -> None:
    """Whatever waits for whom, in circles too: each placement comes exactly once."""
    ring = [Placement(f"n{i}", Relation.ON, f"n{(i + 1) % 5}") for i in order]
    assert sorted(supports_first(ring)) == list(range(5))
    free = [Placement(f"n{i}", Relation.ON, "desk") for i in order]
    assert supports_first(free) == list(range(5)), "the order given stays"


def test_places_beside_things_are_goals() -> None:
    state = scenes.kitchen()
    assert plans(state, {"left_of": ["bottle", "box"]}) == [
        "[PICK UP, bottle] [PUT ON, desk] (left of box)"
    ]
    assert plans(state, {"between": ["bottle", "box", "mug_a"]}, {"on": ["bottle", "desk"]}) == [
        "[PICK UP, bottle] [PUT ON, desk] (between box and mug_a)"
    ]
    assert plans(state, {"at": ["bottle", "edge"]}, {"near": ["bottle", "box"]}) == [
        "[PICK UP, bottle] [PUT ON, desk] (at edge, near box)"
    ]
    assert plans(state, {"not": {"left_of": ["bottle", "bowl_1"]}}, {"in_hand": "box"}) == [
        "[PICK UP, box]"
    ]
    assert plans(state, {"next_to": ["bowl_1", "plate"]}) == []


def test_what_leaves_its_place_with_what_it_lay_in_comes_back() -> None:
    state = scenes.scene(
        scenes.item("crate", "bowl", (0.4, 0.0), size=(0.3, 0.3, 0.1)),
        scenes.item("bowl", "bowl", (0.4, 0.0), inside="crate", on="crate"),
        scenes.ball("nut", (0.4, 0.0), inside="bowl", on="bowl"),
    )
    away = "[PICK UP, bowl] [PUT ON, desk]"
    goal = ({"inside": ["nut", "crate"]}, {"on": ["bowl", "desk"]})
    assert plans(state, *goal) == [f"{away} [PICK UP, nut] [PUT INTO, crate]"]
    assert plans(state, {"inside": ["nut", "bowl"]}, goal[1]) == [away], "it rides along"


def _table(**on: str) -> SceneState:
    """A mat and a bowl, of which things are taken on or in other things."""
    things = [
        scenes.item("mat", at=(0.42, -0.2), size=(0.2, 0.2, 0.01)),
        scenes.cup("bowl", (0.3, 0.3)),
        scenes.item("wine", at=(0.4, 0.22), on=on.get("wine", "desk")),
        scenes.item("vase", at=(0.42, 0.0), on=on.get("vase", "desk")),
    ]
    return scenes.scene(*things)


@pytest.mark.parametrize(
    "relation",
    [
        {"left_of": ["vase", "wine"]},
        {"near": ["vase", "wine"]},
        {"away_from": ["vase", "wine"]},
        {"between": ["vase", "wine", "bowl"]},
        {"not": {"near": ["vase", "wine"]}},
    ],
)
@pytest.mark.parametrize(("goal", "inner"), [("on", "mat"), ("inside", "bowl")])
def test_what_is_beside_a_moved_thing_is_left_where_it_stands_first(
    relation: dict[str, Any], goal: str, inner: str
) -> None:
    """Then it comes beside what the landmark is brought to, and onto or into that in the end."""
    verb = "PUT ON" if goal == "on" else "PUT INTO"
    moved, vase = f"[PICK UP, wine] [{verb}, {inner}]", "[PICK UP, vase]"
    first, second, *last = plans(_table(), {goal: ["wine", inner]}, relation)
    assert first == moved
    assert second.startswith(f"{moved} {vase} [PUT ON, desk] (")
    if (goal, "between") == ("inside", *relation):
        assert not last, "in the bowl it is not between that and another thing"
    else:
        assert last[0].startswith(f"{moved} {vase} [{verb}, {inner}] (")


def test_what_stands_on_the_surface_asked_for_is_left_there_too() -> None:
    goal = {"on": ["wine", "mat"]}, {"on": ["vase", "desk"]}, {"left_of": ["vase", "wine"]}
    moved = "[PICK UP, wine] [PUT ON, mat]"
    again = f"{moved} [PICK UP, vase] [PUT ON, desk] (left of wine)"
    assert plans(_table(), *goal) == [moved, again]
    assert plans(_table(vase="mat"), *goal) == [again]


def test_beside_what_stays_things_are_put_at_once() -> None:
    assert plans(_table(), {"left_of": ["wine", "vase"]}) == [], "it stands there"
    assert plans(_table(wine="mat"), {"right_of": ["vase", "wine"]}) == [], "on another surface"
    assert plans(_table(), {"right_of": ["wine", "vase"]}) == [
        "[PICK UP, wine] [PUT ON, desk] (right of vase)"
    ]


def test_of_two_that_are_to_be_beside_each_other_one_is_moved() -> None:
    goal = {"next_to": ["wine", "vase"]}, {"next_to": ["vase", "wine"]}
    first, second, *_ = sorted(plans(_table(), *goal), key=len)
    assert {first, second} == {
        "[PICK UP, vase] [PUT ON, desk] (next to wine)",
        "[PICK UP, wine] [PUT ON, desk] (next to vase)",
    }


def test_what_is_held_is_beside_nothing() -> None:
    state = _table()
    held = "[PICK UP, wine]"
    assert plans(state, {"in_hand": "wine"}, {"not": {"left_of": ["wine", "vase"]}}) == [held]
    with pytest.raises(UnsatisfiableError, match="what is held stands nowhere"):
        plans(state, {"in_hand": "wine"}, {"left_of": ["wine", "vase"]})


def _post(*extra: scenes.Item, other: float = -0.30) -> SceneState:
    """A shelf, which stays where it is, and two cones beside it."""
    shelf = scenes.item("shelf", "shelf", (0.42, 0.0), size=(0.08, 0.08, 0.16))
    cones = scenes.item("one", at=(0.42, -0.15)), scenes.item("other", at=(0.42, other))
    return scenes.scene(shelf, *cones, *extra)


BETWEEN = {"between": ["shelf", "one", "other"]}


def test_of_what_stays_between_others_either_of_these_goes_to_its_other_side() -> None:
    *first, last = plans(_post(), BETWEEN)
    assert first == ["[PICK UP, one] [PUT ON, desk] (beyond shelf from other)"]
    assert last == "[PICK UP, other] [PUT ON, desk] (beyond shelf from one)"


@pytest.mark.parametrize("condition", [BETWEEN, {"left_of": ["shelf", "one"]}])
def test_a_relation_that_holds_of_what_cannot_be_moved_is_no_error(
    condition: dict[str, Any],
) -> None:
    assert plans(_post(other=0.20), condition) == []


def test_a_relation_of_what_cannot_be_moved_may_come_about_by_another_condition() -> None:
    first, *_ = plans(_post(), BETWEEN, {"at": ["other", [0.42, 0.2]]})
    assert first == "[PICK UP, other] [PUT ON, desk] (at 0.420 0.200)"


def test_what_is_to_leave_the_desk_goes_where_a_person_would_put_it() -> None:
    """Into an open vessel, onto what stands fast, onto something large, and last onto small things;
    a vessel that it does not go through the mouth of, or that has a lid on, is no such vessel."""
    state = scenes.scene(
        scenes.item("die", at=(0.3, 0.0), size=(0.03, 0.03, 0.03)),
        scenes.item("nut", at=(0.3, 0.1), size=(0.03, 0.03, 0.03)),
        scenes.item("mat", at=(0.3, 0.3), size=(0.2, 0.2, 0.01)),
        scenes.item("scale", at=(0.5, 0.3), size=(0.15, 0.15, 0.04), fixed_on="desk"),
        scenes.cup("pot", (0.5, -0.1)),
        scenes.item("lid", at=(0.5, -0.1), size=(0.1, 0.1, 0.01), on="pot"),
        scenes.cup("bowl", (0.5, -0.3)),
    )
    places = [
        text.split()[-1].rstrip("]") for text in plans(state, {"not": {"on": ["die", "desk"]}})
    ]
    assert places == ["bowl", "scale", "mat", "lid", "nut", "pot"]
    wide = {"not": {"on": ["mat", "desk"]}}
    assert plans(state, wide)[0] == "[PICK UP, mat] [PUT ON, scale]"


def test_a_place_that_another_condition_denies_is_not_chosen() -> None:
    state = scenes.scene(
        scenes.item("die", at=(0.3, 0.0), size=(0.03, 0.03, 0.03)),
        scenes.cup("pot", (0.5, -0.1)),
        scenes.cup("bowl", (0.5, -0.3)),
    )
    either = {"any": [{"inside": ["die", "pot"]}, {"inside": ["die", "bowl"]}]}
    out = {"not": {"inside": ["die", "pot"]}}
    assert plans(state, either, out) == ["[PICK UP, die] [PUT INTO, bowl]"]
    assert plans(state, {"not": {"on": ["die", "desk"]}}, out) == [
        "[PICK UP, die] [PUT INTO, bowl]"
    ]
    with pytest.raises(UnsatisfiableError, match="it is to be at pot and not to be there"):
        plans(state, {"inside": ["die", "pot"]}, out)


def test_what_has_to_leave_its_place_does_not_keep_off_the_desk_by_staying() -> None:
    state = scenes.scene(
        scenes.cup("pot", (0.5, -0.1)),
        scenes.item("die", at=(0.5, -0.1), size=(0.03, 0.03, 0.03), on="pot", inside="pot"),
        scenes.cup("bowl", (0.5, -0.3)),
    )
    out = {"not": {"inside": ["die", "pot"]}}
    assert plans(state, out, {"not": {"on": ["die", "desk"]}}) == [
        "[PICK UP, die] [PUT INTO, bowl]"
    ]
