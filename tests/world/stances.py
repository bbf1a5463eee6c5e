"""How far from level things lie."""

from __future__ import annotations

import numpy as np

from etot_cli.world.pose import Pose
from etot_cli.world.state import SceneState


def flat_by(scene: SceneState, name: str) -> float:
    """How far from level an object's own z axis is [deg]."""
    state = scene.states[name]
    rise = Pose.of(state.position, state.quaternion).rotation[2, 2]
    return float(np.degrees(np.arcsin(min(abs(rise), 1.0))))
