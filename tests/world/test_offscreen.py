"""Pixels: colours, depths and geoms, whatever ``MUJOCO_GL`` says that can be used."""

from __future__ import annotations

import sys

import mujoco
import numpy as np
import pytest

from etot_cli.errors import ServiceError
from etot_cli.world.offscreen import OffscreenRenderer
from etot_cli.world.opengl import open_context

WIDTH, HEIGHT, DISTANCE = 80, 60, 0.9
MODEL = f"""
<mujoco>
  <worldbody>
    <light pos="0 0 3"/>
    <camera name="above" pos="0 0 1" fovy="45"/>
    <geom name="floor" type="plane" size="0.3 0.3 0.1" rgba="0 0 1 1"/>
    <geom name="left" type="box" size="0.1 0.1 0.05" pos="-0.15 0.05 {0.95 - DISTANCE}"
          rgba="1 0 0 1"/>
  </worldbody>
</mujoco>
"""


def renderer() -> tuple[OffscreenRenderer, mujoco.MjModel]:
    """A box to the left and above the middle, seen from above; its top is ``DISTANCE`` away."""
    model = mujoco.MjModel.from_xml_string(MODEL)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    made = OffscreenRenderer(model, WIDTH, HEIGHT)
    camera = mujoco.MjvCamera()
    camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, 0
    made.look(data, camera)
    return made, model


@pytest.mark.render
@pytest.mark.slow
def test_colours_depths_and_geoms_agree_with_the_model() -> None:
    made, model = renderer()
    with made:
        color = made.color()
        depth, geoms = made.depth_and_geoms()
        assert np.array_equal(color, made.color())
    assert color.shape == (HEIGHT, WIDTH, 3) and depth.shape == geoms.shape == (HEIGHT, WIDTH)
    box, floor = (geoms == model.geom(name).id for name in ("left", "floor"))
    assert set(np.unique(geoms)) == {-1, 0, 1}
    assert np.allclose(depth[box].min(), DISTANCE, atol=1e-5)
    assert np.allclose(depth[floor], 1.0, atol=1e-5)
    rows, columns = np.nonzero(box)
    assert rows.mean() < HEIGHT / 2 and columns.mean() < WIDTH / 2
    assert (color[box].argmax(axis=1) == 0).mean() > 0.9  # edges are blended
    assert (color[floor].argmax(axis=1) == 2).mean() > 0.9


@pytest.mark.render
@pytest.mark.slow
def test_two_renderers_and_a_closed_one_do_not_mix() -> None:
    one, two = renderer()[0], renderer()[0]
    expected = one.color()
    assert np.array_equal(two.color(), expected)
    two.close()
    two.close()
    assert np.array_equal(one.color(), expected)
    one.close()
    with pytest.raises(Exception, match="has been closed"):
        one.color()


@pytest.mark.render
@pytest.mark.parametrize("choice", ["", " ", "on"])
def test_any_library_is_found(choice: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MUJOCO_GL", choice)
    with renderer()[0] as made:
        assert made.color().std() > 10


@pytest.mark.parametrize(
    ("choice", "message"),
    [("off", "MUJOCO_GL=off"), ("vulkan", "'vulkan'; expected one of egl, osmesa")],
)
def test_a_choice_that_cannot_be_used_is_named(
    choice: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MUJOCO_GL", choice)
    with pytest.raises(ServiceError, match=message):
        open_context(16, 16)


def test_missing_libraries_are_named_with_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("MUJOCO_GL", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    for name in ("mujoco.egl", "mujoco.osmesa"):
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setattr("etot_cli.world.opengl.find_library", lambda _: None)
    monkeypatch.setattr("etot_cli.world.opengl._forget_opengl", lambda: None)
    monkeypatch.setattr("sys.platform", "linux")
    with pytest.raises(ServiceError, match=r"no libEGL.*no libOSMesa.*install libegl1") as error:
        open_context(16, 16)
    assert error.value.exit_code == 3
