"""Boxes with a hinged lid: it falls shut unless it leans back or its hinge holds it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import mujoco
import pytest

from etot_cli.skills.articulation.balance import Balance
from etot_cli.world.snapshot import restore
from etot_cli.world.state import CLOSED_AT, OPEN_AT, CauseKind
from tests.skills.helpers import Episode
from tests.world.helpers import make_scene

BOX = """<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default><geom type="box" friction="0.6 0.005 0.0001"/></default>
  <worldbody>
    <body name="case">
      <geom size="{hx} {hy} 0.0025" pos="0 0 0.0025" mass="0.3"/>
      <geom size="0.0025 {hy} 0.0425" pos="{hx} 0 0.0425" mass="0.1"/>
      <geom size="0.0025 {hy} 0.0425" pos="-{hx} 0 0.0425" mass="0.1"/>
      <geom size="{hx} 0.0025 0.0425" pos="0 {hy} 0.0425" mass="0.1"/>
      <geom size="{hx} 0.0025 0.0425" pos="0 -{hy} 0.0425" mass="0.1"/>
      <site name="room" type="box" size="{ix} {iy} 0.04" pos="0 0 0.045"/>
      <body name="lid" pos="-{hx} 0 0.086">
        <joint name="hinge" type="hinge" axis="0 -1 0" range="0 {range}" frictionloss="{friction}"
               damping="0.05" armature="0.002"/>
        <geom size="{hx} {hy} 0.003" pos="{hx} 0 0.003" mass="{mass}"/>
        {handle}
      </body>
    </body>
  </worldbody>
</mujoco>"""
BAR = """<geom size="0.006 0.006 0.012" pos="{x} 0.03 0.018" mass="0.01"/>
<geom size="0.006 0.006 0.012" pos="{x} -0.03 0.018" mass="0.01"/>
<geom size="0.006 0.04 0.006" pos="{x} 0 0.036" mass="0.02"/>
<site name="hold" type="box" size="0.006 0.036 0.006" pos="{x} 0 0.036"/>"""
KNOB = """<geom size="0.008 0.008 0.016" pos="{x} 0 0.022" mass="0.02"/>
<site name="hold" type="box" size="0.008 0.008 0.012" pos="{x} 0 0.026"/>"""
UPRIGHT = math.atan2(0.0888, 0.0090)
"""Where the centre of mass of the lid with a bar is above the hinge [rad]."""
DIE = {"kind": "box", "size": [0.036, 0.036, 0.036], "mass": 0.05, "inside": "kit"}


def box(
    folder: Path,
    seed: int = 0,
    *,
    depth: float = 0.15,
    width: float = 0.22,
    mass: float = 0.12,
    friction: float = 0.1,
    end: float = 1.8,
    handle: str = BAR,
    front: bool = True,
    **more: Any,
) -> Episode:
    """A box with a closed lid, a die in it; ``end`` of the lid's range [rad]."""
    hx, hy = depth / 2, width / 2
    text = BOX.format(
        hx=hx, hy=hy, ix=hx - 0.005, iy=hy - 0.005, mass=mass, friction=friction, range=end,
        handle=handle.format(x=depth - 0.02),
    )  # fmt: skip
    (folder / "kit.xml").write_text(text)
    part = {"joint": "hinge", "container_site": "room"} | ({"front_site": "hold"} if front else {})
    kit = {"kind": "mjcf", "file": "kit.xml", "fixed": True, "yaw_deg": 180, "parts": {"lid": part}}
    return Episode(make_scene(folder, kit={**kit, "at": [0.43, -0.08], **more}, die=DIE), seed)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    "given",
    [
        {},  # the hinge holds it from 44° on: it is taken there before the hand changes
        {"friction": 0.0},  # only beyond the vertical
        {"end": 2.3},  # the hand pushes it from behind, below its edge
        {"depth": 0.20, "width": 0.16, "end": 2.0, "at": [0.45, -0.05]},
    ],
)
def test_lid_that_opens_away_from_the_robot(
    given: dict[str, Any], seed: int, tmp_path: Path
) -> None:
    run = box(tmp_path, seed, **given)
    opened = run.must("[OPEN, kit]").states["kit"]
    assert opened.openness["lid"] >= OPEN_AT
    closed = run.must("[PICK UP, die]", "[PUT ON, desk]", "[CLOSE, kit]").states["kit"]
    assert closed.openness["lid"] <= CLOSED_AT


@pytest.mark.parametrize(("yaw", "mass"), [(180, 0.12), (-90, 0.12), (90, 0.3)])
def test_lid_that_does_not_stay_open(yaw: float, mass: float, tmp_path: Path) -> None:
    """It is said so; with a hinge that holds it, the same lid opens."""
    same = {"yaw_deg": yaw, "mass": mass, "end": 1.4}
    record = box(tmp_path, friction=0.0, **same).do("[OPEN, kit]").record
    assert not record.effect and record.cause is not None
    assert record.cause.kind is CauseKind.NO_EFFECT and record.cause.objects == ("kit",)
    assert (
        record.cause.text == "kit does not stay open: let go of at 96% of its travel, it falls shut"
    )
    run = box(tmp_path, friction=0.3, **same)
    run.must("[OPEN, kit]")
    world = run.simulated.world
    restore(world, run.simulated.data, run.snapshot)
    for _ in range(2500):
        mujoco.mj_step(world.model, run.simulated.data)
    assert run.simulated.data.joint("kit/hinge").qpos[0] >= OPEN_AT * same["end"]


def test_lid_that_cannot_be_brought_to_where_it_stays(tmp_path: Path) -> None:
    """The hand on its knob does not come with it as far as that, and it falls back from there."""
    same = {"handle": KNOB, "end": 1.9, "at": [0.42, 0.1]}
    record = box(tmp_path, friction=0.02, **same).do("[OPEN, kit]").record
    assert record.cause is not None and record.cause.kind is CauseKind.UNREACHABLE
    assert record.cause.text.endswith("let go of below 70% of its travel, it falls shut")
    box(tmp_path, friction=0.3, **same).must("[OPEN, kit]")


def test_lid_without_a_handle_offers_nothing_to_hold(tmp_path: Path) -> None:
    """What the file does not mark is not known, and nothing that is shut is pushed open."""
    record = box(tmp_path, front=False).do("[OPEN, kit]").record
    assert record.cause is not None and record.cause.kind is CauseKind.NO_GRASP
    assert record.cause.objects == ("kit",)


@pytest.mark.parametrize(
    ("friction", "end", "share"),
    [(0.0, 1.8, UPRIGHT / 1.8), (0.0, 1.5, None), (0.05, 1.8, 0.65), (0.3, 1.8, 0.0)],
)
def test_where_a_lid_stays_open(
    friction: float, end: float, share: float | None, tmp_path: Path
) -> None:
    run = box(tmp_path, friction=friction, end=end)
    belief = run.simulated.believe(run.snapshot)
    found = Balance(belief, belief.world.parts["kit"]).stays_open_from
    assert found == (None if share is None else pytest.approx(share, abs=0.05))
