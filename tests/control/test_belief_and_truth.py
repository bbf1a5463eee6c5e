"""A robot acts on what it sees of a world that is not its twin."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np
import pytest

from etot_cli.control import true_world
from etot_cli.control.perception import perceive
from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.control.true_world import TrueWorld
from etot_cli.control.withdrawal import FAR_BACK, withdrawal
from etot_cli.skills.action import parse_plan
from etot_cli.skills.motion.motion import Move, PhaseEnd, PhaseTrace, Trace
from etot_cli.specs.scene import Perception
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import place_objects
from tests.skills.helpers import BALL, CUP, UNIT, drawers
from tests.world.helpers import make_scene

ERROR = Perception(position_m=0.005, yaw_deg=3.0)


def seen(truth: World, twin: World, draw: int) -> tuple[mujoco.MjData, mujoco.MjData]:
    """A true start state, and what a look at it shows."""
    data, believed = mujoco.MjData(truth.model), mujoco.MjData(twin.model)
    place_objects(truth, data)
    mujoco.mj_forward(truth.model, data)
    perceive(truth, data, twin, believed, ERROR, np.random.default_rng(draw))
    return data, believed


def unit(**changes: Any) -> dict[str, Any]:
    return {**UNIT, "drawers": drawers(open=0.04), "yaw_deg": -90.0, **changes}


@pytest.mark.parametrize("draw", range(5))
def test_furniture_is_believed_where_it_is_seen(draw: int) -> None:
    twin = build_world(make_scene(unit=unit()), loose_furniture=True)
    truth = build_world(make_scene(unit=unit(at=[0.46, 0.01], yaw_deg=-82.0)))
    data, believed = seen(truth, twin, draw)
    for body in ("unit", *(part.body for part in twin.parts.values())):
        off = believed.body(body).xpos - data.body(body).xpos
        lever = float(np.linalg.norm(data.body(body).xpos - data.body("unit").xpos))
        bound = math.hypot(0.005, 0.005) + lever * math.radians(3.0)
        assert 1e-4 < float(np.linalg.norm(off)) <= bound
    cosine = float(data.body("unit").xmat[:2] @ believed.body("unit").xmat[:2])
    assert 0.0 < math.degrees(math.acos(min(cosine, 1.0))) <= 3.0


@pytest.mark.parametrize("draw", range(8))
def test_what_is_seen_does_not_stand_in_each_other(draw: int) -> None:
    """A ball that fills its cup, and two boxes side by side."""
    box = {"kind": "box", "size": [0.05, 0.05, 0.05], "mass": 0.1}
    scene = make_scene(
        cup=CUP,
        ball={"kind": "sphere", "diameter": 0.086, "mass": 0.1, "inside": "cup"},
        one={**box, "at": [0.40, 0.10]},
        other={**box, "at": [0.40, 0.152]},
    )
    _, believed = seen(build_world(scene), build_world(scene, loose_furniture=True), draw)
    level = np.hypot(*believed.contact.frame[:, :2].T)
    assert (believed.contact.dist[level > 0.5] > -0.002).all()


@pytest.mark.slow
def test_a_displaced_drawer_is_opened_where_it_is_seen() -> None:
    scene = make_scene(unit=unit(), ball=BALL | {"at": [0.30, 0.30]})
    twin = SimulatedWorld(scene)
    (action,) = parse_plan("[OPEN, unit]")
    rehearsed = twin.perform(twin.start()[0], action).motion
    opened = 0
    for number, (yaw, shift) in enumerate([(-10.0, 0.01), (10.0, -0.01), (10.0, 0.01)]):
        moved = unit(at=[0.45 + shift, shift], yaw_deg=yaw - 90.0)
        truth = TrueWorld(make_scene(unit=moved, ball=scene.objects["ball"]), twin, number)
        opened += truth.perform(truth.start()[0], action, rehearsed).record.effect
    assert opened == 3


def test_a_robot_that_is_stopped_backs_off_looks_again_and_goes_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The first look takes the chest to be 3 cm behind where it stands."""
    looks = 0

    def see(*args: Any) -> None:
        nonlocal looks
        perceive(*args)
        looks += 1
        if looks == 1:
            twin, believed = args[2], args[3]
            believed.mocap_pos[0, 1] += 0.03
            mujoco.mj_forward(twin.model, believed)

    monkeypatch.setattr(true_world, "perceive", see)
    scene = make_scene(unit=unit(drawers=drawers(open=0.10)))
    twin = SimulatedWorld(scene)
    (action,) = parse_plan("[CLOSE, unit]")
    rehearsed = twin.perform(twin.start()[0], action).motion
    truth = TrueWorld(scene, twin, 1)
    performed = truth.perform(truth.start()[0], action, rehearsed)
    assert looks == 2
    assert performed.record.effect, performed.record.cause


def test_the_way_back_is_the_way_that_the_arm_came() -> None:
    sent = np.linspace([0.0, 0.0], [1.0, 0.5], 101)
    stopped = PhaseTrace(
        "approach", PhaseEnd.BLOCKED, 0.0, 1.0, 0.08, tuple(sent[60]), targets=sent
    )
    after = PhaseTrace("settle", PhaseEnd.DONE, 1.0, 1.2, 0.08, tuple(sent[60]))
    back = withdrawal(Trace((stopped, after)))
    assert back is not None
    (move,) = back.phases
    assert isinstance(move, Move)
    assert (np.diff(move.path[:, 0]) < 0).all()
    assert sent[60, 0] - FAR_BACK <= move.path[-1, 0] <= sent[60, 0] - FAR_BACK + 0.06
    np.testing.assert_allclose(move.path[:, 1], move.path[:, 0] / 2)


def test_who_was_not_stopped_has_nothing_to_back_off_from() -> None:
    sent = np.linspace([0.0, 0.0], [1.0, 0.5], 101)
    done = PhaseTrace("lift", PhaseEnd.SLIPPED, 0.0, 1.0, 0.0, tuple(sent[60]), targets=sent)
    assert withdrawal(Trace((done,))) is None
    along = PhaseTrace("along", PhaseEnd.BLOCKED, 0.0, 1.0, 0.0, tuple(sent[60]), targets=sent)
    retreat = PhaseTrace("retreat", PhaseEnd.DONE, 1.0, 2.0, 0.0, tuple(sent[0]), targets=sent)
    assert withdrawal(Trace((along, retreat))) is None
    assert withdrawal(Trace(())) is None
