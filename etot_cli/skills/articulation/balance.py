"""Where a part stays when the hand lets go of it: a lid falls shut under its own weight, unless it
leans beyond the vertical or its hinge holds it by friction or by a spring.
"""

from __future__ import annotations

import mujoco
import numpy as np

from etot_cli.skills.belief import Belief
from etot_cli.world.index import Part
from etot_cli.world.snapshot import copy_configuration

SHARES = 101
"""Places along a part's travel that are looked at: a percent apart, as outcomes are told."""
OPEN_SPARE = 0.04
"""Share of the travel by which an opening move goes beyond what counts as open, and beyond where
the part falls shut. Friction that holds a lid gives way in MuJoCo all the same: at 60 % of what it
can bear by 4 mrad/s, which takes a quarter of a minute for this much of 90°."""


class Balance:
    """Weight, springs and friction of a part along its travel, everything else at rest.

    Args:
        belief: where everything stands.
        part: door, drawer or lid.
    """

    def __init__(self, belief: Belief, part: Part) -> None:
        model, data = belief.world.model, belief.scratch
        copy_configuration(belief.data, data)
        data.qvel[:] = 0.0
        joint = model.joint(part.joint)
        dof = int(joint.dofadr[0])
        friction = float(model.dof_frictionloss[dof])
        direction = np.sign(part.upper - part.lower)
        forces = np.zeros(model.nv)
        opening = []
        for share in np.linspace(0.0, 1.0, SHARES):
            data.joint(part.joint).qpos[0] = part.lower + share * (part.upper - part.lower)
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_tendon(model, data)
            mujoco.mj_comVel(model, data)
            mujoco.mj_passive(model, data)
            mujoco.mj_rne(model, data, 0, forces)
            opening.append(direction * (data.qfrc_passive[dof] - forces[dof]))
        self._falls = np.array(opening) < -friction

    @property
    def stays_open_from(self) -> float | None:
        """Share of the travel from which on it does not fall shut; None where it does even from its
        end, or from close to it.
        """
        falling = np.flatnonzero(self._falls)
        if not len(falling):
            return 0.0
        share = (int(falling[-1]) + 1) / (SHARES - 1)
        return share if share <= 1.0 - OPEN_SPARE else None

    def stays_at(self, share: float) -> bool:
        """Whether it does not fall shut from a share of its travel."""
        return not self._falls[round(min(max(share, 0.0), 1.0) * (SHARES - 1))]
