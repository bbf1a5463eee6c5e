"""Success conditions against scenes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from etot_cli.errors import SpecError
from etot_cli.planning.conditions import holds
from etot_cli.specs.task import BESIDE_KEYS, Condition
from etot_cli.specs.wording import describe
from etot_cli.world.state import CLOSED_AT, STAYS_OPEN_AT, SceneState
from tests.planning.fakes import scene


def changed(**changes: Any) -> SceneState:
    """The toy scene with changes to the cup's state."""
    start = scene()
    cup = replace(start.states["cup"], **changes)
    return replace(start, states={**start.states, "cup": cup})


def lid(openness: float) -> SceneState:
    start = scene()
    box = replace(start.states["box"], openness={"lid": openness})
    return replace(start, states={**start.states, "box": box})


def check(document: dict[str, Any], state: SceneState) -> bool:
    return holds(Condition.model_validate(document), state)


def test_on() -> None:
    assert check({"on": ["cup", "desk"]}, scene())
    assert not check({"on": ["cup", "box"]}, scene())
    assert check({"on": ["cup", "box"]}, changed(on=("box",)))
    assert check({"on": ["cup", "box"]}, changed(on=("box.board",)))
    assert not check({"on": ["cup", "box"]}, changed(on=("box.lid",), inside="box"))


def test_inside() -> None:
    assert not check({"inside": ["cup", "box"]}, scene())
    assert check({"inside": ["cup", "box"]}, changed(on=(), inside="box"))
    assert check({"inside": ["cup", "box.lid"]}, changed(on=(), inside="box"))
    assert check({"inside": ["cup", "box"]}, changed(on=(), inside="box.lid"))


def test_inside_what_is_inside() -> None:
    state = changed(on=(), inside="box")
    ball = replace(state.states["cup"], inside="cup")
    info = replace(state.infos["cup"], name="ball")
    state = replace(
        state, states={**state.states, "ball": ball}, infos={**state.infos, "ball": info}
    )
    assert check({"inside": ["ball", "cup"]}, state)
    assert check({"inside": ["ball", "box"]}, state)


@pytest.mark.parametrize(
    ("openness", "is_open", "is_closed"),
    [
        (0.0, False, True),
        (CLOSED_AT, False, True),
        (0.3, False, False),
        (0.5, False, False),
        (STAYS_OPEN_AT, True, False),
    ],
)
def test_open_and_closed(openness: float, is_open: bool, is_closed: bool) -> None:
    state = lid(openness)
    assert check({"open": "box"}, state) is is_open
    assert check({"closed": "box.lid"}, state) is is_closed


def test_states_of_one_object() -> None:
    assert check({"in_hand": "cup"}, changed(in_hand=True))
    assert not check({"in_hand": "cup"}, scene())
    assert check({"upright": "cup"}, scene())
    assert not check({"upright": "cup"}, changed(toppled=True))
    on_its_side = changed(quaternion=(0.7071068, 0.7071068, 0.0, 0.0))
    assert check({"lying": "cup"}, on_its_side) and not check({"lying": "cup"}, scene())
    assert not check(
        {"lying": "cup"}, changed(quaternion=on_its_side.states["cup"].quaternion, in_hand=True)
    )
    assert check({"present": "cup"}, scene())
    assert not check({"present": "cup"}, changed(lost=True))


def test_logic() -> None:
    no = {"in_hand": "cup"}
    yes = {"present": "cup"}
    assert check({"any": [no, yes]}, scene())
    assert not check({"all": [no, yes]}, scene())
    assert check({"not": no}, scene())


def test_unknown_names_are_refused() -> None:
    with pytest.raises(SpecError, match=r"no object 'jar'; it has box, cup"):
        check({"present": "jar"}, scene())
    with pytest.raises(SpecError, match="no part 'cup'"):
        check({"open": "cup"}, scene())
    with pytest.raises(SpecError, match="no 'shelf'"):
        check({"on": ["cup", "shelf"]}, scene())


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ({"any": [{"on": ["cup", "desk"]}, {"not": {"in_hand": "cup"}}]},
         "(cup on desk) or (not (cup in hand))"),
        ({"between": ["cup", "box", "jar"]}, "cup between box and jar"),
        ({"at": ["cup", [0.4, -0.1]]}, "cup at 0.4 -0.1"),
        ({"at": ["cup", "left"]}, "cup at left"),
        *(({key: ["cup", "box"]}, f"cup {key.replace('_', ' ')} box")
          for key in BESIDE_KEYS if key != "between"),
    ],
)  # fmt: skip
def test_in_words(document: dict[str, Any], words: str) -> None:
    assert describe(Condition.model_validate(document)) == words
