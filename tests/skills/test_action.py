"""Actions as they are written."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.errors import PlanSyntaxError
from etot_cli.skills.action import (
    MAX_PLAN_ACTIONS,
    Action,
    Coming,
    GraspPose,
    Verb,
    format_plan,
    parse_plan,
)
from etot_cli.world.spatial import Nearby, Whereabouts

names = st.from_regex(r"[A-Za-z][A-Za-z0-9_]{0,12}(\.[A-Za-z][A-Za-z0-9_]{0,8})?", fullmatch=True)
plain = st.builds(
    Action, st.sampled_from(Verb), names, st.one_of(st.none(), st.sampled_from(GraspPose))
)
millimetres = st.integers(-900, 900).map(lambda value: value / 1000)


@st.composite
def whereabouts(draw: st.DrawFn) -> Whereabouts:
    relation = draw(st.sampled_from(Nearby))
    if relation is Nearby.AT_POINT:
        return Whereabouts(relation, point=(draw(millimetres), draw(millimetres)))
    return Whereabouts(relation, tuple(draw(names) for _ in range(relation.landmarks)))


coming = st.builds(
    lambda name, where: Coming(name, tuple(where)),
    names,
    st.lists(whereabouts(), min_size=1, max_size=2),
)
placed = st.builds(
    lambda name, where, later: Action(Verb.PUT_ON, name, where=tuple(where), coming=tuple(later)),
    names,
    st.lists(whereabouts(), max_size=3),
    st.lists(coming, max_size=2, unique_by=lambda one: one.name),
)
partly = st.builds(lambda name: Action(Verb.OPEN, name, partly=True), names)
actions = st.one_of(plain, placed, partly)


@given(st.lists(actions, min_size=1, max_size=8))
@settings(deadline=None, max_examples=50)
@pytest.mark.slow
def test_reading_what_was_written_gives_the_same_plan(plan: list[Action]) -> None:
    assert parse_plan(format_plan(plan)) == tuple(plan)


@given(st.lists(actions, min_size=1, max_size=5), st.sampled_from([", ", "\n", ";", " ", ""]))
@settings(deadline=None, max_examples=50)
@pytest.mark.slow
def test_separators_and_numbers_do_not_matter(plan: list[Action], separator: str) -> None:
    written = separator.join(f"{i}. {action}" for i, action in enumerate(plan, 1))
    assert parse_plan(written) == tuple(plan)


@given(st.text(max_size=60))
@settings(deadline=None, max_examples=50)
def test_any_text_is_read_or_refused_with_a_sentence(text: str) -> None:
    try:
        plan = parse_plan(text)
    except PlanSyntaxError as error:
        assert len(str(error)) > 20
    else:
        assert parse_plan(format_plan(plan)) == tuple(
            Action(a.verb, a.target, a.pose, where=a.where, coming=a.coming) for a in plan
        )


@pytest.mark.parametrize(
    "text",
    [
        "[PUT INTO, cup] (at left)",
        "[PICK UP, cup] (left of plate)",
        "[PUT ON, desk] (left of)",
        "[PUT ON, desk] (between a)",
        "[PUT ON, desk] (at 3)",
        "[PUT ON, desk] (leftish)",
        "[PUT ON, desk] (beyond a and b)",
        "[PUT INTO, cup] (room for ball next to key)",
    ],
)
def test_places_that_make_no_sense_are_refused(text: str) -> None:
    with pytest.raises(PlanSyntaxError, match="unknown note"):
        parse_plan(text)


def test_room_is_kept_for_what_exists_at_a_place_that_makes_sense() -> None:
    with pytest.raises(PlanSyntaxError, match="unknown place"):
        parse_plan("[PUT ON, desk] (room for cup leftish)")
    with pytest.raises(PlanSyntaxError, match="no 'ball'"):
        parse_plan("[PUT ON, desk] (room for ball left of cup)", ["desk", "cup"])


def test_landmarks_must_exist() -> None:
    with pytest.raises(PlanSyntaxError, match="no 'plate'; it has cup, desk"):
        parse_plan("[PUT ON, desk] (left of plate)", ["desk", "cup"])


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ("[pick up, pen]", Action(Verb.PICK_UP, "pen")),
        ("[PICK_UP,pen]", Action(Verb.PICK_UP, "pen")),
        ("  [ Put  Into , unit.top ] ", Action(Verb.PUT_INTO, "unit.top")),
        ("[PICK UP, cup] (Horizontally)", Action(Verb.PICK_UP, "cup", GraspPose.HORIZONTAL)),
        ("[PICK UP, cup](vertical)", Action(Verb.PICK_UP, "cup", GraspPose.VERTICAL)),
        ("[PUT ON, desk] (safe place)", Action(Verb.PUT_ON, "desk", safe=True)),
        (
            "[PUT ON, desk] (not near cup)",
            Action(Verb.PUT_ON, "desk", where=(Whereabouts(Nearby.NEAR, ("cup",), denied=True),)),
        ),
        (
            "[PUT ON, desk] (room for cup left of box, room for cup near pen)",
            Action(
                Verb.PUT_ON,
                "desk",
                coming=(
                    Coming(
                        "cup",
                        (
                            Whereabouts(Nearby.LEFT, ("box",)),
                            Whereabouts(Nearby.NEAR, ("pen",)),
                        ),
                    ),
                ),
            ),
        ),
        (
            "[PUT INTO, bin] (next to cup)",
            Action(Verb.PUT_INTO, "bin", where=(Whereabouts(Nearby.NEXT_TO, ("cup",)),)),
        ),
        (
            "[PUT INTO, bin] (lying)",
            Action(Verb.PUT_INTO, "bin", where=(Whereabouts(Nearby.LYING),)),
        ),
        (
            "[PUT INTO, bin] (Upright)",
            Action(Verb.PUT_INTO, "bin", where=(Whereabouts(Nearby.UPRIGHT),)),
        ),
    ],
)
def test_spellings(text: str, action: Action) -> None:
    assert parse_plan(text) == (action,)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the plan is empty; expected e.g."),
        ("   \n", "the plan is empty"),
        ("pick up the pen", "cannot read 'pick up the pen' as an action; expected e.g."),
        ("[PICK UP, pen] and then", "cannot read 'and then'"),
        ("[PICK UP pen]", "cannot read"),
        ("[PICK UP, ]", "cannot read"),
        ("[PICK UP, 7up]", "cannot read"),
        ("[PICK UP, pen; rm -rf]", "cannot read"),
        ("[THROW, pen]", "unknown action 'THROW'; expected one of PICK UP, PUT ON, PUT INTO, "),
        ("[PICK UP, pen] (sideways)", r"unknown note \(sideways\) after \[PICK UP, pen\]"),
        ("[PICK UP, pen] (vertical", "cannot read"),
        ("[OPEN, chest.top] (horizontal)", r"unknown note \(horizontal\) after \[OPEN"),
        ("[PICK UP, pen] (safe place)", r"unknown note \(safe place\) after \[PICK UP"),
    ],
)
def test_nonsense_is_refused(text: str, message: str) -> None:
    with pytest.raises(PlanSyntaxError, match=message):
        parse_plan(text)


def test_unknown_target_lists_what_the_scene_has() -> None:
    assert parse_plan("[PICK UP, pen]", ["pen", "cup"])
    with pytest.raises(PlanSyntaxError, match="the scene has no 'pan'; it has cup, pen"):
        parse_plan("[PICK UP, pan]", ["pen", "cup"])


def test_length_is_bounded() -> None:
    assert len(parse_plan("[OPEN, a]" * MAX_PLAN_ACTIONS)) == MAX_PLAN_ACTIONS
    with pytest.raises(PlanSyntaxError, match=f"at most {MAX_PLAN_ACTIONS} actions"):
        parse_plan("[OPEN, a]" * (MAX_PLAN_ACTIONS + 1))


def test_what_is_set_down_for_another_grasp_says_so() -> None:
    (down,) = parse_plan("[PUT ON, desk] (to be taken horizontal)")
    assert down == Action(Verb.PUT_ON, "desk", GraspPose.HORIZONTAL)
    assert str(down) == "[PUT ON, desk] (to be taken horizontal)"
