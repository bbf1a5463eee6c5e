"""Coming to rest: what is put somewhere settles there, and what merely balances falls.

A pen that stands in a cup on its point, exactly upright, stays so in the simulator for a while and
then falls against the rim, maybe under the hand that comes for it. Nobody leaves a thing so: it has
fallen before anybody looks. So everything is jogged, and what comes down by itself is let fall.
"""

from __future__ import annotations

import math

import mujoco

from etot_cli.world.model import World
from etot_cli.world.snapshot import Memory, restore, save

JOG_DEG = 2.0
"""Things are pushed as if the ground leaned so far [degrees]. Rods on their points or round ends
fall from at most 1.2 on (a pen of 100 mm stands on 2 mm), and what has a face to stand on that is a
tenth as wide as it is high from 5 on."""
JOG_S = 0.1
"""... for so long [s], in which rods of up to 200 mm get over their edge and balls roll 2 mm."""
FALL_S = 0.6
"""Time to come down in [s]; pens and capsules of 80 to 200 mm do it within 0.5."""
FALLEN = 2e-5
"""What came down further than this balanced [m]. Rods came down by 5e-5, in a tube of twice their
width, to 2e-2, in a wide cup, and things with a face to stand on by less than 1e-6."""


def settle_objects(world: World, data: mujoco.MjData, seconds: float) -> None:
    """Lets the objects come to rest for so long [s], while the arm stands still where it is."""
    _step(world, data, seconds)
    if let_fall(world, data):
        _step(world, data, seconds)


def let_fall(world: World, data: mujoco.MjData) -> bool:
    """Lets fall what balances in a state at rest; all else stays as it is. Whether anything does.

    What fell has come down, but may still move.
    """
    before = save(world, data, Memory())
    free = [name for name, entry in world.entries.items() if entry.free]
    heights = {name: _height(world, data, name) for name in free}
    _jog(world, data, free)
    fallen = [name for name in free if heights[name] - _height(world, data, name) > FALLEN]
    restore(world, data, before)
    if fallen:
        _jog(world, data, fallen)  # alone: other things may have rolled
    return bool(fallen)


def _height(world: World, data: mujoco.MjData, name: str) -> float:
    """Of an object's centre of mass [m]."""
    return float(data.body(world.entries[name].body).subtree_com[2])


def _jog(world: World, data: mujoco.MjData, names: list[str]) -> None:
    """Pushes things away from the robot, and lets them fall."""
    slope = -world.model.opt.gravity[2] * math.tan(math.radians(JOG_DEG))
    for name in names:
        entry = world.entries[name]
        data.body(entry.body).xfrc_applied[0] = slope * entry.info.mass
    _step(world, data, JOG_S)
    data.xfrc_applied[:] = 0.0
    _step(world, data, FALL_S)


def _step(world: World, data: mujoco.MjData, seconds: float) -> None:
    """Steps for so long [s], while the arm stands still where it is."""
    joints = world.robot.qpos
    standing = data.qpos[joints].copy()
    for _ in range(int(seconds / world.model.opt.timestep)):
        data.qpos[joints] = standing
        data.qvel[world.robot.dof] = 0.0
        mujoco.mj_step(world.model, data)
    data.qpos[joints] = standing
    mujoco.mj_forward(world.model, data)
