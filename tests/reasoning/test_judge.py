"""The judge on records made by hand."""

from __future__ import annotations

from dataclasses import replace

import pytest

from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.builtin.constraints import cause_of_breach
from etot_cli.reasoning.builtin.goal import Constraint, Keep
from etot_cli.reasoning.protocol import Outcome, Verdict
from etot_cli.skills.action import parse_plan
from etot_cli.world.state import CauseKind, RolloutRecord
from tests.reasoning import scenes
from tests.reasoning.records import cause, changed, contact, held, record, released


def judge(action: str, rollout: RolloutRecord) -> Verdict:
    return BuiltinReasoner().judge(parse_plan(action)[0], rollout)


APPLE_UP = (0.4, 0.3, 0.4)


def test_pick_up() -> None:
    before = scenes.apple_and_holder()
    after = changed(before, apple={"in_hand": True, "on": (), "position": APPLE_UP})
    verdict = judge("[PICK UP, apple]", record(before, after))
    assert verdict == Verdict(Outcome.SUCCESS, None, ("apple",))


@pytest.mark.parametrize(("away", "outcome"), [(0.0, Outcome.SUCCESS), (0.05, Outcome.FAILURE)])
def test_what_is_back_in_its_place_is_unharmed(away: float, outcome: Outcome) -> None:
    """A cup that a wedged ball lifts for a moment, and one that it leaves elsewhere."""
    before = scenes.pens_and_apple()
    x, y, z = before.states["white_holder"].position
    after = changed(
        before, apple={"in_hand": True, "on": (), "position": APPLE_UP},
        white_holder={"position": (x + away, y, z)},
    )  # fmt: skip
    lifted = record(before, after, displacement={"apple": 0.1, "white_holder": 0.06})
    verdict = judge("[PICK UP, apple]", lifted)
    assert verdict.outcome is outcome
    assert "white_holder" in verdict.changes


def test_the_skill_s_own_cause_comes_first() -> None:
    before = scenes.apple_and_holder()
    own = cause(CauseKind.NO_GRASP, "holder", "apple")
    verdict = judge("[PICK UP, apple]", record(before, effect=False, cause=own))
    assert verdict.outcome is Outcome.FAILURE
    assert verdict.cause == own


def test_put_on_and_into() -> None:
    before = held(scenes.apple_and_holder(), "apple")
    on = released(before, apple={"on": ("drawer",)})
    assert judge("[PUT ON, drawer]", record(before, on)).outcome is Outcome.SUCCESS
    into = released(before, apple={"on": ("holder",), "inside": "holder"})
    assert judge("[PUT INTO, holder]", record(before, into)).outcome is Outcome.SUCCESS
    # In the drawer is not on the unit's top, although the unit bears it.
    drawer = released(before, apple={"on": ("drawer",), "inside": "drawer"})
    assert judge("[PUT ON, drawer]", record(before, drawer)).outcome is Outcome.FAILURE
    assert judge("[PUT INTO, drawer]", record(before, drawer)).outcome is Outcome.SUCCESS


def test_a_vessel_that_topples_is_to_blame() -> None:
    before = held(scenes.pens(), "pen")
    after = released(before, pen={"position": (0.4, -0.3, 0.14)}, black_holder={"toppled": True})
    verdict = judge("[PUT INTO, black_holder]", record(before, after))
    assert verdict.outcome is Outcome.FAILURE
    assert verdict.cause is not None
    assert verdict.cause.kind is CauseKind.TOPPLED
    assert verdict.cause.objects[0] == "black_holder"
    inside = released(
        before, pen={"inside": "black_holder", "on": ("black_holder",)},
        black_holder={"toppled": True},
    )  # fmt: skip
    assert judge("[PUT INTO, black_holder]", record(before, inside)).outcome is Outcome.FAILURE


@pytest.mark.parametrize("lost", [False, True])
def test_what_it_rebounded_off_is_to_blame(lost: bool) -> None:
    before = held(scenes.pens_and_apple(), "pen")
    after = released(before, pen={"position": (0.5, 0.2, 0.14), "lost": lost})
    contacts = (contact("apple", "pen", 0.3, 2.5), contact("drawer", "pen", 0.5, 2.9))
    verdict = judge("[PUT INTO, white_holder]", record(before, after, contacts=contacts))
    assert verdict.outcome is (Outcome.UNSAFE if lost else Outcome.FAILURE)
    assert verdict.cause is not None
    assert verdict.cause.kind is CauseKind.REBOUND
    assert verdict.cause.objects[0] == "apple"
    assert verdict.cause.time_s == 2.5
    assert "pen rebounded off apple" in verdict.cause.text


def test_a_lost_bystander_is_unsafe() -> None:
    before = scenes.microwave()
    after = changed(
        before,
        microwave={"openness": {"door": 1.0}, "opened": {"door": True}},
        tennis_ball={"lost": True, "on": (), "position": (0.0, 0.3, -0.5)},
    )
    hit = contact("microwave", "tennis_ball", time_s=0.7)
    verdict = judge("[OPEN, microwave]", record(before, after, contacts=(hit,)))
    assert verdict.outcome is Outcome.UNSAFE
    assert verdict.cause is not None
    assert (verdict.cause.kind, verdict.cause.objects) == (CauseKind.LOST, ("tennis_ball",))
    assert verdict.cause.time_s == 0.7
    assert verdict.changes == ("microwave", "tennis_ball")


def test_out_of_reach_is_unsafe() -> None:
    before = scenes.microwave()
    after = changed(
        before,
        microwave={"openness": {"door": 1.0}, "opened": {"door": True}},
        tennis_ball={"reachable": False, "position": (0.9, 0.5, 0.17)},
    )
    verdict = judge("[OPEN, microwave]", record(before, after))
    assert verdict.outcome is Outcome.UNSAFE
    assert verdict.cause is not None
    assert verdict.cause.kind is CauseKind.STRANDED


@pytest.mark.parametrize(
    ("put", "outcome"),
    [
        ("[PUT ON, tray]", Outcome.SUCCESS),
        ("[PUT ON, desk] (at 0.740 -0.460)", Outcome.SUCCESS),
        ("[PUT ON, desk]", Outcome.UNSAFE),
        ("[PUT ON, desk] (upright)", Outcome.UNSAFE),
    ],
)
def test_out_of_reach_is_no_harm_where_just_that_was_asked_for(put: str, outcome: Outcome) -> None:
    """It is on the desk anywhere, and might have been put where the arm gets it again."""
    where = (0.74, -0.46)
    start = scenes.scene(scenes.item("tray", at=where), scenes.item("can", at=(0.4, 0.0)))
    on = "tray" if "tray" in put else "desk"
    after = changed(
        start, can={"reachable": False, "position": (*where, scenes.TOP), "on": (on,)}
    )  # fmt: skip
    touches = (contact("gripper", "can", time_s=0.0), contact("can", "tray", time_s=2.1))
    verdict = judge(put, record(held(start, "can"), after, contacts=touches))
    assert verdict.outcome is outcome
    if verdict.cause is not None:
        assert verdict.cause.time_s == 2.1, "the hand had it from the start"


@pytest.mark.parametrize(("shift", "outcome"), [(0.02, Outcome.SUCCESS), (0.05, Outcome.FAILURE)])
def test_a_small_shove_is_a_change_and_no_failure(shift: float, outcome: Outcome) -> None:
    before = scenes.microwave()
    x, y, z = before.states["tennis_ball"].position
    after = changed(
        before,
        microwave={"openness": {"door": 1.0}, "opened": {"door": True}},
        tennis_ball={"position": (x + shift, y, z)},
    )
    verdict = judge("[OPEN, microwave]", record(before, after))
    assert verdict.outcome is outcome
    assert "tennis_ball" in verdict.changes
    if verdict.cause is not None:
        assert (verdict.cause.kind, verdict.cause.objects) == (
            CauseKind.COLLISION,
            ("tennis_ball",),
        )


@pytest.mark.parametrize(
    ("openness", "closes", "opens"),
    [(0.0, True, False), (0.05, True, False), (0.4, False, False), (0.8, False, True)],
)
def test_openness(openness: float, closes: bool, opens: bool) -> None:
    before = scenes.toy_in_drawer()
    after = changed(before, drawer={"openness": {"top": openness}})
    for verb, wanted in (("CLOSE", closes), ("OPEN", opens)):
        verdict = judge(f"[{verb}, drawer]", record(before, after))
        assert (verdict.outcome is Outcome.SUCCESS) == wanted


@pytest.mark.parametrize(
    ("impulse", "kind"), [(5.0, CauseKind.BLOCKED), (0.1, CauseKind.NO_EFFECT)]
)
def test_what_held_a_drawer_until_the_fingers_slid_off(impulse: float, kind: CauseKind) -> None:
    """Nothing stopped the arm, so the skill itself saw nobody; what only bumped is not to blame."""
    before = scenes.toy_in_drawer()
    after = changed(before, drawer={"openness": {"top": 0.5}})
    seen = record(
        before, after, effect=False, cause=cause(CauseKind.NO_EFFECT, "drawer"),
        contacts=(contact("drawer.top", "toy", impulse), contact("gripper", "drawer.top", 9.0)),
    )  # fmt: skip
    verdict = judge("[CLOSE, drawer]", seen)
    assert verdict.cause is not None and verdict.cause.kind is kind
    assert verdict.cause.objects == (("toy", "drawer") if impulse > 1.0 else ("drawer",))


@pytest.mark.parametrize(
    ("first", "then", "harmed"), [(0.0, 0.18, True), (0.05, 0.1, False), (0.9, 0.72, False)]
)
def test_a_closed_part_that_is_left_ajar_was_opened_unasked(
    first: float, then: float, harmed: bool
) -> None:
    before = changed(scenes.toy_in_drawer(), drawer={"openness": {"top": first}})
    picked = held(before, "toy")
    after = changed(picked, drawer={"openness": {"top": then}})
    verdict = judge("[PICK UP, toy]", record(before, after))
    assert (verdict.outcome is not Outcome.SUCCESS) is harmed


def test_contents_ride_along() -> None:
    before = scenes.toy_in_drawer()
    after = changed(before, drawer={"openness": {"top": 0.0}}, toy={"position": (0.518, 0.10, 0.2)})
    verdict = judge("[CLOSE, drawer]", record(before, after))
    assert verdict.outcome is Outcome.SUCCESS
    assert verdict.changes == ("drawer", "toy")


def test_contents_must_stay_inside_what_is_carried() -> None:
    plain = scenes.apple_and_holder()
    before = changed(plain, apple={"inside": "holder", "on": ("holder",)})
    up = {"in_hand": True, "on": (), "position": (0.4, -0.34, 0.4)}
    kept = changed(before, holder=up, apple={"position": (0.4, -0.34, 0.42)})
    assert judge("[PICK UP, holder]", record(before, kept)).outcome is Outcome.SUCCESS
    spilled = changed(before, holder=up, apple={"inside": None, "on": ("desk",)})
    verdict = judge("[PICK UP, holder]", record(before, spilled))
    assert verdict.outcome is Outcome.FAILURE
    assert verdict.cause is not None
    assert verdict.cause.objects == ("apple",)


def test_what_is_put_in_may_push_what_was_there() -> None:
    plain = scenes.ball_before_drawer()
    inside = changed(
        plain, tennis_ball={"inside": "drawer", "on": ("drawer",)},
        drawer={"openness": {"top": 1.0}},
    )  # fmt: skip
    before = held(inside, "apple")
    after = released(
        before, apple={"inside": "drawer", "on": ("drawer",)},
        tennis_ball={"position": (0.45, 0.08, 0.2)},
    )  # fmt: skip
    assert judge("[PUT INTO, drawer]", record(before, after)).outcome is Outcome.SUCCESS


def test_a_pen_may_stand_or_lie() -> None:
    before = held(scenes.pens(), "pen")
    after = released(
        before, pen={"inside": "white_holder", "on": ("white_holder",), "toppled": True}
    )
    assert judge("[PUT INTO, white_holder]", record(before, after)).outcome is Outcome.SUCCESS


def test_a_toppled_bystander_is_a_failure() -> None:
    before = scenes.pens()
    after = changed(before, pen={"in_hand": True, "on": ()}, white_holder={"toppled": True})
    verdict = judge("[PICK UP, pen]", record(before, after))
    assert verdict.outcome is Outcome.FAILURE
    assert verdict.cause is not None
    assert (verdict.cause.kind, verdict.cause.objects) == (CauseKind.TOPPLED, ("white_holder",))


@pytest.mark.parametrize(
    ("before_deg", "after_deg", "inside", "outcome"),
    [
        (0.0, 10.0, None, Outcome.FAILURE),
        (0.5, 5.0, None, Outcome.FAILURE),
        (0.0, 2.5, None, Outcome.SUCCESS),
        (10.0, 15.0, None, Outcome.SUCCESS),
        (90.0, 80.0, None, Outcome.SUCCESS),
        (0.0, 10.0, "mug", Outcome.SUCCESS),
    ],
    ids=["leans", "leans a little", "stands", "leant before", "lay before", "in a vessel"],
)
@pytest.mark.parametrize("action", ["[OPEN, chest]", "[PICK UP, nut]", "[PUT ON, desk]"])
def test_what_stood_and_is_left_leaning_was_harmed(
    action: str, before_deg: float, after_deg: float, inside: str | None, outcome: Outcome
) -> None:
    before = scenes.scene(
        scenes.drawers("chest", (0.5, 0.0), {"top": 0.0}),
        scenes.cup("mug", (0.3, 0.0)),
        scenes.item("can", "cylinder", (0.3, 0.0), on=inside or "desk", inside=inside),
        scenes.item("nut", at=(0.3, 0.3)),
    )
    before = changed(before, can={"tilt_deg": before_deg})
    if action == "[OPEN, chest]":
        after = changed(before, chest={"openness": {"top": 1.0}}, can={"tilt_deg": after_deg})
    elif action == "[PICK UP, nut]":
        up = {"in_hand": True, "on": (), "position": (0.3, 0.3, 0.4)}
        after = changed(before, nut=up, can={"tilt_deg": after_deg})
    else:
        before = held(before, "nut")
        after = released(before, can={"tilt_deg": after_deg})
    verdict = judge(action, record(before, after))
    assert verdict.outcome is outcome
    if outcome is Outcome.FAILURE:
        assert verdict.cause is not None
        assert verdict.cause.objects == ("can",) and "can was tipped" in verdict.cause.text


def test_what_is_put_down_may_lean() -> None:
    """So may a pen anywhere, which does not stand by itself."""
    before = held(scenes.scene(scenes.item("book"), scenes.item("pen", "pen")), "book")
    leaning = released(before, book={"tilt_deg": 20.0}, pen={"tilt_deg": 20.0})
    assert judge("[PUT ON, desk]", record(before, leaning)).outcome is Outcome.SUCCESS


def test_falling_off_a_surface_is_a_failure() -> None:
    before = scenes.pens()
    after = changed(
        before,
        white_holder={"in_hand": True, "on": ()},
        pen={"on": ("desk",), "position": (0.49, 0.02, 0.14)},
    )
    verdict = judge("[PICK UP, white_holder]", record(before, after))
    assert verdict.outcome is Outcome.FAILURE
    assert verdict.cause is not None
    assert verdict.cause.objects == ("pen",)


@pytest.mark.parametrize("action", ["[PUT ON, desk]", "[OPEN, pen]", "[PICK UP, pen]"])
def test_what_has_no_effect_fails_without_any_account_too(action: str) -> None:
    verdict = judge(action, record(scenes.pens()))
    assert verdict.outcome is Outcome.FAILURE
    assert verdict.cause is not None and verdict.cause.kind is CauseKind.NO_EFFECT


# -- true causes -----------------------------------------------------------------------------------


def test_what_stands_on_the_picked_object_must_not_come_along() -> None:
    start = scenes.scene(
        scenes.item("crate", at=(0.4, 0.0)), scenes.item("vase", at=(0.4, 0.0), on="crate", z=0.22)
    )
    lifted = changed(
        start,
        crate={"in_hand": True, "on": (), "position": (0.4, 0.0, 0.3)},
        vase={"position": (0.4, 0.0, 0.36)},
    )
    verdict = judge("[PICK UP, crate]", record(start, lifted))
    assert verdict.outcome is Outcome.FAILURE and verdict.cause is not None
    assert verdict.cause.objects == ("vase",)
    assert "vase, which stood on it, was moved with it" in verdict.cause.text
    alone = scenes.scene(scenes.item("crate", at=(0.4, 0.0)), scenes.item("vase", at=(0.6, 0.0)))
    lifted = changed(alone, crate={"in_hand": True, "on": (), "position": (0.4, 0.0, 0.3)})
    assert judge("[PICK UP, crate]", record(alone, lifted)).outcome is Outcome.SUCCESS


def test_what_lies_in_the_picked_vessel_may_come_along() -> None:
    start = scenes.scene(
        scenes.cup("mug", (0.4, 0.0)), scenes.ball("pea", (0.4, 0.0), on="mug", inside="mug")
    )
    lifted = changed(
        start,
        mug={"in_hand": True, "on": (), "position": (0.4, 0.0, 0.3)},
        pea={"position": (0.4, 0.0, 0.3)},
    )
    assert judge("[PICK UP, mug]", record(start, lifted)).outcome is Outcome.SUCCESS


@pytest.mark.parametrize(
    ("rider", "outcome"),
    [
        (scenes.ball("egg", (0.4, 0.0), on="mug", z=0.275), Outcome.SUCCESS),
        (scenes.ball("egg", (0.4, 0.0), on="mug", z=0.295), Outcome.FAILURE),
        (scenes.item("lid", at=(0.4, 0.0), on="mug", size=(0.1, 0.1, 0.01), z=0.265),
         Outcome.FAILURE),
        (scenes.item("pen", "pen", (0.4, 0.0), on="mug", size=(0.01, 0.01, 0.15), z=0.265),
         Outcome.FAILURE),
    ],
    ids=["in its mouth", "on its rim", "over its mouth", "across its mouth"],
)  # fmt: skip
def test_what_sits_in_the_mouth_of_the_picked_vessel_may_come_along(
    rider: scenes.Item, outcome: Outcome
) -> None:
    name, (x, y, z) = rider[0].name, rider[1].position
    start = scenes.scene(scenes.cup("mug", (0.4, 0.0), z=0.22), rider)
    lifted = changed(
        start,
        mug={"in_hand": True, "on": (), "position": (0.4, 0.0, 0.32)},
        **{name: {"position": (x, y, z + 0.1)}},
    )
    assert judge("[PICK UP, mug]", record(start, lifted)).outcome is outcome


def test_what_has_to_stay_closed_is_looked_at_after_every_action() -> None:
    start = scenes.scene(
        scenes.drawers("chest", (0.5, 0.0), {"top": 0.0, "low": 0.5}),
        scenes.item("vase", at=(0.3, 0.0)),
    )
    ajar = changed(start, chest={"openness": {"top": 0.2, "low": 0.0}})
    for name, broken in (("chest", True), ("chest.top", True), ("chest.low", False)):
        forbidden = [Constraint(Keep.CLOSED, (name,))]
        assert (cause_of_breach(record(start, ajar), forbidden) is not None) is broken, name
    x, y, z = start.states["vase"].position
    nudged = changed(start, vase={"position": (x + 0.012, y, z)})
    still = [Constraint(Keep.UNMOVED, ("vase",))]
    assert cause_of_breach(record(start, nudged), still) is not None
    assert cause_of_breach(record(start, nudged), still, blur=0.014) is None


def test_what_must_not_be_hit_may_be_carried() -> None:
    start = scenes.scene(scenes.item("vase", at=(0.3, 0.0)))
    not_hit = [Constraint(Keep.UNHIT, ("vase",))]
    up = changed(start, vase={"in_hand": True, "on": (), "position": (0.3, 0.0, 0.3)})
    down = changed(start, vase={"position": (0.5, 0.2, start.states["vase"].position[2])})
    assert cause_of_breach(record(start, up), not_hit) is None
    assert cause_of_breach(record(up, down), not_hit) is None
    breach = cause_of_breach(record(start, down), not_hit)
    assert breach is not None and breach.objects == ("vase",)


def test_a_part_that_moved_unasked_is_not_said_to_be_pushed() -> None:
    start = scenes.scene(
        scenes.drawers("chest", (0.5, 0.0), {"top": 0.0}), scenes.item("vase", at=(0.3, 0.0))
    )
    after = changed(
        start,
        chest={"openness": {"top": 0.6}},
        vase={"in_hand": True, "on": (), "position": (0.3, 0.0, 0.3)},
    )
    verdict = judge("[PICK UP, vase]", record(start, after))
    assert verdict.cause is not None and verdict.cause.objects == ("chest",)
    assert "chest was opened or closed unasked" in verdict.cause.text
    assert "0 cm" not in verdict.cause.text


def test_what_came_out_of_a_vessel_is_said_to() -> None:
    start = scenes.scene(
        scenes.cup("mug", (0.4, 0.0)), scenes.ball("pea", (0.4, 0.0), on="mug", inside="mug"),
        scenes.item("vase", at=(0.3, 0.0)),
    )  # fmt: skip
    after = changed(
        start, pea={"inside": None, "on": ("desk",)},
        vase={"in_hand": True, "on": (), "position": (0.3, 0.0, 0.3)},
    )  # fmt: skip
    verdict = judge("[PICK UP, vase]", record(start, after))
    assert verdict.cause is not None and "pea came out of mug" in verdict.cause.text


def test_what_comes_to_rest_on_what_was_there_has_no_room_and_did_not_rebound() -> None:
    start = held(
        scenes.scene(
            scenes.cup("mug", (0.4, 0.0)),
            scenes.ball("pea", (0.4, 0.0), on="mug", inside="mug"),
            scenes.ball("nut", (0.2, 0.0)),
        ),
        "nut",
    )
    touch = (contact("nut", "pea"),)
    lying = released(start, nut={"on": ("pea",)})
    verdict = judge("[PUT INTO, mug]", record(start, lying, contacts=touch))
    assert verdict.cause is not None and verdict.cause.kind is CauseKind.NO_ROOM
    assert verdict.cause.objects[0] == "pea"
    gone = released(start, nut={"position": (0.2, 0.3, 0.165)})
    verdict = judge("[PUT INTO, mug]", record(start, gone, contacts=touch))
    assert verdict.cause is not None and verdict.cause.kind is CauseKind.REBOUND


@pytest.mark.parametrize(
    ("rim_s", "there"), [(1.0, True), (None, True), (1.0, False), (3.0, True)],
    ids=["fell out", "never got to it", "empty", "struck on the way"],
)  # fmt: skip
def test_what_falls_out_of_a_full_vessel_had_no_room_whatever_it_fell_on(
    rim_s: float | None, there: bool
) -> None:
    full = {"on": "mug", "inside": "mug"} if there else {}
    start = held(
        scenes.scene(
            scenes.cup("mug", (0.4, 0.0)), scenes.cup("jar", (0.4, 0.2)),
            scenes.item("pea", at=(0.4, 0.0), **full), scenes.item("nut", at=(0.2, 0.0)),
        ),
        "nut",
    )  # fmt: skip
    fallen = released(start, nut={"on": ("jar",)})
    touches = (contact("nut", "jar", time_s=2.0),)
    if rim_s is not None:
        touches = (*touches, contact("nut", "mug", time_s=rim_s))
    verdict = judge("[PUT INTO, mug]", record(start, fallen, contacts=touches))
    assert verdict.cause is not None
    if there and rim_s == 1.0:
        assert verdict.cause.kind is CauseKind.NO_ROOM
        assert verdict.cause.objects == ("pea", "nut")
    else:
        assert verdict.cause.kind is CauseKind.COLLISION
        assert verdict.cause.objects == ("jar", "nut")


def test_what_lies_on_the_rim_does_not_go_in_and_did_not_rebound() -> None:
    start = held(scenes.scene(scenes.cup("mug", (0.4, 0.0)), scenes.ball("nut", (0.2, 0.0))), "nut")
    lying = released(start, nut={"on": ("mug",)})
    verdict = judge("[PUT INTO, mug]", record(start, lying, contacts=(contact("nut", "mug"),)))
    assert verdict.cause is not None and verdict.cause.kind is CauseKind.NO_ROOM
    assert verdict.cause.objects == ("mug", "nut")
    assert "does not go into mug" in verdict.cause.text


def test_what_never_touched_its_target_did_not_rebound() -> None:
    start = held(scenes.scene(scenes.cup("mug", (0.4, 0.0)), scenes.ball("nut", (0.2, 0.0))), "nut")
    beside = released(start)
    verdict = judge("[PUT INTO, mug]", record(start, beside))
    assert verdict.cause is not None and verdict.cause.kind is CauseKind.NO_EFFECT
    assert "without touching it" in verdict.cause.text
    off = record(start, beside, contacts=(contact("nut", "mug"),))
    verdict = judge("[PUT INTO, mug]", off)
    assert verdict.cause is not None and verdict.cause.kind is CauseKind.REBOUND


@pytest.mark.parametrize(
    ("size", "too_wide"), [((0.09, 0.09, 0.09), True), ((0.09, 0.05, 0.05), False)]
)
def test_what_is_wider_than_the_mouth_is_refused_for_that(
    size: tuple[float, float, float], too_wide: bool
) -> None:
    mug = scenes.cup("mug", (0.4, 0.0))
    start = held(scenes.scene(mug, scenes.item("nut", at=(0.2, 0.0), size=size)), "nut")
    verdict = judge("[PUT INTO, mug]", record(start, released(start)))
    assert verdict.cause is not None
    assert ("the mouth" in verdict.cause.text) == too_wide
    assert (verdict.cause.kind is CauseKind.NO_ROOM) == too_wide


def test_two_looks_tell_no_story() -> None:
    """What was not watched has no account of how it came about, only what is seen afterwards."""
    start = scenes.apple_and_holder()
    gone = changed(start, holder={"lost": True, "on": ()}, apple={"in_hand": True, "on": ()})
    lifted = record(start, gone)
    for watched, words in ((True, "fell off the desk"), (False, "is gone from the desk")):
        verdict = judge("[PICK UP, apple]", replace(lifted, watched=watched))
        assert verdict.cause is not None
        assert verdict.cause.text.endswith(f"holder {words}")
    before = held(start, "apple")
    beside = record(before, released(before), effect=False)
    for watched, words in ((True, "without touching it"), (False, "did not stay in holder")):
        verdict = judge("[PUT INTO, holder]", replace(beside, watched=watched))
        assert verdict.cause is not None
        assert words in verdict.cause.text
