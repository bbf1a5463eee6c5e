"""Viewers: which one, what they show, and the one in the browser as a real server."""

from __future__ import annotations

import json
import re
import signal
import subprocess
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

import mujoco
import numpy as np
import pytest

from etot_cli.errors import ServiceError
from etot_cli.specs.load import load_task
from etot_cli.world.model import build_world
from etot_cli.world.recorder import Trajectory
from etot_cli.world.viewing import choice
from etot_cli.world.viewing.reel import RATE_HZ, Reel, reel_of
from etot_cli.world.viewing.shapes import shapes_of
from tests.cli.test_process import REAL, ROOT, environment

TASK = ROOT / "tasks" / "task3.yaml"


# -- which one ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("variables", "platform", "viewer", "why"),
    [
        ({"DISPLAY": ":0"}, "linux", "window", "there is a display"),
        ({"WAYLAND_DISPLAY": "wayland-0"}, "linux", "window", "there is a display"),
        ({"DISPLAY": ""}, "linux", "browser", "DISPLAY and WAYLAND_DISPLAY are not set"),
        ({}, "linux", "browser", "there is no display"),
        ({}, "win32", "window", "there is a display"),
        ({}, "darwin", "browser", "on a Mac"),
    ],
)
def test_the_viewer_that_the_machine_has(
    monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], platform: str, viewer: str, why: str
) -> None:
    monkeypatch.setattr(choice, "find_spec", lambda name: object())
    chosen = choice.choose(variables, platform)
    assert chosen.viewer == viewer and why in chosen.why


def test_without_any_viewer_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choice, "find_spec", lambda name: None)
    with pytest.raises(ServiceError, match=r"no display.*pip install 'etot\[view\]'"):
        choice.choose({}, "linux")
    assert choice.choose({"DISPLAY": ":0"}, "linux").viewer == "window"


# -- what is shown -----------------------------------------------------------------------------

ALL_KINDS = """
<mujoco>
  <asset><mesh name="tip" vertex="0 0 0  .1 0 0  0 .2 0  0 0 .3"/></asset>
  <worldbody>
    <geom type="plane" size="1 2 .1"/>
    <body pos="0 0 1"><freejoint/>
      <geom type="box" size=".1 .2 .3" pos=".5 0 0" quat=".9 .1 .2 .3" rgba="1 0 0 .5"/>
      <geom type="sphere" size=".1" pos="0 .5 0"/>
      <geom type="ellipsoid" size=".1 .2 .3"/>
      <geom type="cylinder" size=".1 .4" quat=".7 .7 0 0"/>
      <geom type="capsule" size=".1 .4" pos=".1 .1 .1"/>
      <geom type="mesh" mesh="tip" pos="0 0 .7"/>
      <geom type="box" size="9 9 9" group="3"/>
      <geom type="box" size="9 9 9" rgba="1 1 1 0"/>
    </body>
  </worldbody>
</mujoco>
"""


def test_every_kind_of_geom_is_where_and_as_large_as_in_the_model() -> None:
    model = mujoco.MjModel.from_xml_string(ALL_KINDS)
    shapes = list(shapes_of(model))
    assert len(shapes) == 7  # neither the collision geom nor the invisible one
    assert shapes[1].color == (255, 0, 0) and shapes[1].opacity == 0.5
    for geom, shape in enumerate(shapes):
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        inside = (shape.vertices - model.geom_pos[geom]) @ turn.reshape(3, 3)
        if geom:  # a plane has no bounds of its own
            center, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
            assert np.allclose(inside.min(axis=0), center - half, atol=0.01), geom
            assert np.allclose(inside.max(axis=0), center + half, atol=0.01), geom
        assert shape.body == model.geom_bodyid[geom]
        assert shape.faces.min() >= 0 and shape.faces.max() < len(shape.vertices)


PAINTED = """
<mujoco>
  <asset>
    <texture name="half" type="cube" builtin="flat" rgb1=".5 .5 .5" width="8" height="8"/>
    <material name="plain"/>
    <material name="green" rgba="0 1 0 1"/>
    <material name="wood" texture="half"/>
  </asset>
  <worldbody>
    <geom size=".1" material="plain" rgba="1 0 0 1"/>
    <geom size=".1" material="green"/>
    <geom size=".1" material="wood" rgba="1 0 .5 1"/>
  </worldbody>
</mujoco>
"""


def test_colours_are_those_that_mujoco_draws() -> None:
    colors = [shape.color for shape in shapes_of(mujoco.MjModel.from_xml_string(PAINTED))]
    assert colors[:2] == [(255, 0, 0), (0, 255, 0)]
    assert np.allclose(colors[2], (127, 0, 64), atol=2), "a texture's mean, tinted"


def _reel(world_qpos: np.ndarray, count: int) -> Reel:
    rows = np.tile(world_qpos, (count, 1))
    rows[:, 0] += np.linspace(0.0, 0.5, count)
    times = np.arange(count) * 0.04 + 3.0
    trajectory = Trajectory(times.astype(np.float32), rows.astype(np.float32))
    return reel_of([("one", trajectory), ("two", trajectory)])


def test_actions_are_strung_together_at_even_distances() -> None:
    times = np.array([2.0, 2.04, 2.5, 2.54], np.float32)
    trajectory = Trajectory(times, np.arange(4, dtype=np.float32)[:, None])
    still = Trajectory(times[:1], np.full((1, 1), 9, np.float32))
    reel = reel_of([("a", trajectory), ("b", still)])
    assert len(reel) == round(0.52 * RATE_HZ) + 2 + 1  # its first and its last one, and b
    assert list(np.unique(reel.qpos)) == [0, 1, 2, 3, 9]
    assert (np.diff(reel.qpos[:-1, 0]) >= 0).all()
    assert reel.caption(0) == "a" and reel.caption(len(reel) - 1) == "b"


# -- in the browser ----------------------------------------------------------------------------


@pytest.mark.slow
def test_the_browser_gets_the_scene_as_it_is_at_each_moment() -> None:
    pytest.importorskip("viser", reason="the extra etot[view] is not installed")
    from etot_cli.world.viewing.browser import BrowserReplay

    world = build_world(load_task(TASK).scene, dressed=True)
    data = mujoco.MjData(world.model)
    reel = _reel(data.qpos.copy(), 10)
    with BrowserReplay(world, reel, port=18_080) as replay:
        with urlopen(replay.url, timeout=10) as answer:
            page = answer.read().decode()
        assert answer.status == 200 and "<html" in page.lower()
        shown = [body for body in range(world.model.nbody) if world.model.body(body).name]
        seen = 0
        for moment in (0, 5, 99):
            replay.show(moment)
            data.qpos[:] = reel.qpos[min(moment, len(reel) - 1)]
            mujoco.mj_kinematics(world.model, data)
            for body in shown:
                try:
                    position, turn = replay.pose(world.model.body(body).name)
                except KeyError:  # nothing of it is seen
                    continue
                seen += 1
                assert np.allclose(position, data.xpos[body], atol=1e-6)
                assert np.allclose(turn, data.xquat[body], atol=1e-6)
        assert seen >= 3 * 5
    with pytest.raises(URLError):
        urlopen(replay.url, timeout=2)


@pytest.mark.slow
def test_simulate_view_without_a_display(tmp_path: Path) -> None:
    pytest.importorskip("viser", reason="the extra etot[view] is not installed")
    process = subprocess.Popen(
        [*REAL, "simulate", str(TASK), "--plan", "[PICK UP, holder] (vertical)", "--view",
         "--no-html", "--json", "--out", "x"],
        cwd=tmp_path, env=environment(DISPLAY="", WAYLAND_DISPLAY=""), text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    try:
        assert process.stderr is not None
        said = next(line for line in process.stderr if line.startswith("viewing in a browser"))
        assert "since there is no display" in said and "Ctrl-C ends" in said
        found = re.search(r"http://127\.0\.0\.1:\d+", said)
        assert found is not None
        with urlopen(found[0], timeout=10) as answer:
            assert answer.status == 200
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=20)
    finally:
        process.kill()
    # Closing the viewer is no interruption: the answer stands.
    assert process.returncode == 0 and json.loads(out)["status"] == "success"
    assert "the viewer is closed" in err and "Traceback" not in err
