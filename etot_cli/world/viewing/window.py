"""MuJoCo's own viewer."""

from __future__ import annotations

import time
from collections.abc import Callable

import mujoco

from etot_cli.errors import ServiceError
from etot_cli.world.model import World
from etot_cli.world.viewing.reel import RATE_HZ, Reel

PAUSE_S = 1.5
"""Between the end and the next beginning [s]."""


def show_in_window(world: World, reel: Reel, told: Callable[[str], None]) -> None:
    """Plays a reel over and over, until the window is closed.

    Args:
        world: the scene.
        reel: what happened.
        told: gets the caption of each action that begins.

    Raises:
        ServiceError: no window can be opened.
    """
    try:
        from mujoco import viewer

        data = mujoco.MjData(world.model)
        handle = viewer.launch_passive(world.model, data, show_left_ui=False, show_right_ui=False)
    except Exception as error:  # whatever window systems and drivers throw
        raise ServiceError(f"MuJoCo's viewer cannot be opened ({error})") from None
    with handle:
        moment = 0
        while handle.is_running():
            if moment == 0 or reel.action[moment] != reel.action[moment - 1]:
                told(reel.caption(moment))
            data.qpos[:] = reel.qpos[moment]
            mujoco.mj_forward(world.model, data)
            handle.sync()
            last = moment == len(reel) - 1
            time.sleep(PAUSE_S if last else 1.0 / RATE_HZ)
            moment = 0 if last else moment + 1
