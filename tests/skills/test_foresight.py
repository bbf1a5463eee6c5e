"""What is grasped for a place goes there; a rod does however it had been lying."""

from __future__ import annotations

from typing import Any

import pytest

from etot_cli.skills.action import Verb, parse_plan
from etot_cli.world.state import CauseKind
from tests.skills.helpers import episode

UNIT = {
    "kind": "drawer_unit", "at": [0.64, 0.0], "yaw_deg": 180, "size": [0.24, 0.28, 0.22], "mass": 5,
    "drawers": [{"name": "top", "travel": 0.19, "open": 0.19}, {"name": "bottom", "travel": 0.19}],
}  # fmt: skip
BOWL = {"kind": "bowl", "at": [0.36, -0.25], "diameter": 0.14, "height": 0.05, "mass": 0.2}
BOX = {"kind": "box", "at": [0.38, 0.12], "size": [0.05, 0.06, 0.05], "mass": 0.1}


def shelf(height: float, x: float = 0.60) -> dict[str, Any]:
    return {"kind": "shelf", "at": [x, 0.05], "yaw_deg": 180, "size": [0.20, 0.36, height],
            "boards": ["bottom", "top"]}  # fmt: skip


@pytest.mark.parametrize("yaw", [0, 50, 70, 110, 160, 250])
@pytest.mark.parametrize(
    ("kind", "length"), [("pen", 0.11), ("pen", 0.14), ("pen", 0.16), ("capsule", 0.14)]
)
def test_a_rod_goes_into_a_drawer_however_it_lay(yaw: float, length: float, kind: str) -> None:
    """The hand that took it may have its wrist at an end: the arm is bent otherwise over there."""
    rod = {"kind": kind, "at": [0.32, 0.28], "yaw_deg": yaw, "diameter": 0.012, "length": length,
           "mass": 0.02}  # fmt: skip
    state = episode(unit=UNIT, rod=rod).must("[PICK UP, rod]", "[PUT INTO, unit.top]")
    assert state.states["rod"].inside == "unit.top"


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("height", "x"), [(0.25, 0.60), (0.28, 0.60), (0.34, 0.54)])
def test_a_bowl_is_grasped_so_that_it_goes_high_up(height: float, x: float, seed: int) -> None:
    run = episode(seed, bowl=BOWL, shelf=shelf(height, x))
    run.must("[PICK UP, bowl] (to put on shelf.top)", "[PUT ON, shelf.top]")
    assert run.state.states["bowl"].on == ("shelf.top",)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("drawer", "lid"),
    [
        ("bottom", {"kind": "box", "size": [0.09, 0.05, 0.012]}),
        ("top", {"kind": "box", "size": [0.09, 0.05, 0.012]}),
        ("bottom", {"kind": "box", "size": [0.09, 0.05, 0.025]}),
    ],
)
def test_a_lid_goes_back_on_a_tin_before_a_carcass(
    drawer: str, lid: dict[str, Any], seed: int
) -> None:
    """By one end and off its middle; five centimetres are free behind the tin."""
    parts = [{"name": name, "travel": 0.17, "open": 0.17 * (name == drawer)}
             for name in ("top", "bottom")]  # fmt: skip
    chest = UNIT | {"at": [0.60, 0.02], "size": [0.24, 0.28, 0.26], "drawers": parts}
    tin = {"kind": "cup", "inside": f"chest.{drawer}", "diameter": 0.08, "height": 0.05,
           "mass": 0.2}  # fmt: skip
    run = episode(seed, chest=chest, tin=tin, lid=lid | {"on": "tin", "mass": 0.05})
    run.must("[PICK UP, lid]", "[PUT ON, desk]", "[PICK UP, lid] (to put on tin)")
    assert run.must("[PUT ON, tin]").states["lid"].on == ("tin",)


@pytest.mark.slow
@pytest.mark.parametrize("at", [[0.40, -0.22], [0.38, 0.15], [0.42, 0.0], [0.36, 0.0]])
def test_what_is_set_down_for_a_level_hand_is_where_one_gets_at_it(at: list[float]) -> None:
    book = {"kind": "box", "at": at, "size": [0.18, 0.075, 0.02], "mass": 0.2}
    run = episode(shelf=shelf(0.22, 0.62), book=book)
    run.must("[PICK UP, book] (vertical)", "[PUT ON, desk] (to be taken horizontal)")
    assert run.must("[PICK UP, book] (horizontal)").holding == "book"


def test_what_goes_there_anyhow_is_grasped_as_ever() -> None:
    plain, ahead = episode(box=BOX, shelf=shelf(0.2)), episode(box=BOX, shelf=shelf(0.2))
    plain.must("[PICK UP, box]")
    ahead.must("[PICK UP, box] (to put on shelf.top)")
    one, other = (run.done[-1].motion for run in (plain, ahead))
    assert one is not None and other is not None
    assert one.tool_at is not None and other.tool_at is not None
    assert one.tool_at.pose.position == pytest.approx(other.tool_at.pose.position)


def test_the_refusal_says_that_no_grasp_serves() -> None:
    full = {"kind": "box", "at": [0.60, 0.05], "size": [0.20, 0.36, 0.3], "mass": 5, "fixed": True}
    record = (
        episode(box=BOX, full=full, far={**BOX, "at": [0.84, 0.0]})
        .do("[PICK UP, box] (to put on far)")
        .record
    )
    cause = record.cause
    assert cause is not None
    assert (cause.kind, cause.objects) == (CauseKind.NO_ROOM, ("box",))
    assert "held so that it goes on far" in cause.text


def test_it_is_for_all_that_is_said_of_the_put_that_follows() -> None:
    pick, put = parse_plan("[PICK UP, pen] (to put on tray) [PUT ON, tray] (left of cup)")
    assert pick.onward == put
    assert str(pick) == "[PICK UP, pen] (to put on tray)"
    (alone,) = parse_plan("[PICK UP, pen] (vertical, to put into holder.top)")
    assert alone.onward is not None
    assert (alone.onward.verb, alone.onward.target) == (Verb.PUT_INTO, "holder.top")
    assert parse_plan(str(alone)) == (alone,)
