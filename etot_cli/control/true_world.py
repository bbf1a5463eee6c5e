"""A world that differs from the planner's twin: the robot acts in it on what it sees.

Nothing is tried in it and taken back: what has moved has moved.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace

import mujoco

from etot_cli.control.perception import perceive
from etot_cli.control.physics_world import Performed, PhysicsWorld
from etot_cli.control.simulated_world import ATTEMPTS, SimulatedWorld
from etot_cli.control.withdrawal import withdrawal
from etot_cli.skills.action import Action
from etot_cli.skills.belief import Belief
from etot_cli.skills.motion.motion import Motion
from etot_cli.skills.motions import plan_motions
from etot_cli.skills.outcome import SkillOutcome, failed
from etot_cli.specs.look import Look
from etot_cli.specs.scene import Scene
from etot_cli.world.snapshot import Snapshot
from etot_cli.world.state import CauseKind


class TrueWorld(PhysicsWorld):
    """A varied world in which a robot acts that believes in another one.

    Args:
        scene: the true scene.
        twin: what the robot believes in: masses, frictions and sizes of its own. Only read.
        number: tells this world's random numbers from those of others.
        look: when it looks.
        keep_frames: keep trajectories for rendering.
    """

    def __init__(
        self,
        scene: Scene,
        twin: SimulatedWorld,
        number: int,
        *,
        look: Look = Look.EACH,
        keep_frames: bool = False,
    ) -> None:
        super().__init__(scene, twin.seed, keep_frames=keep_frames, arm=twin.arm)
        self._twin, self._number, self._when = twin.seen_twin, number, look
        # Planning for this world ends when planning in the twin does.
        self.deadline = twin.deadline
        self._perception = twin.world.scene.perception
        self._believed = mujoco.MjData(self._twin.world.model)

    def believe(self, start: Snapshot, salt: str) -> Belief:
        """What the robot takes a stored state of this world for, after a look at it."""
        scene = self.look(start)
        rng = self.random(self._number, salt, hashlib.sha256(start.physics).hexdigest())
        perceive(self.world, self.data, self._twin.world, self._believed, self._perception, rng)
        return Belief(self._twin, self._believed, rng, scene)

    def perform(self, start: Snapshot, action: Action, rehearsed: Motion | None) -> Performed:
        """Carries an action out.

        After a failure that lies in how it was done the robot looks again and tries once more, from
        where things then are; where it was stopped it backs off first.

        Args:
            start: the state of this world.
            action: what is to be done.
            rehearsed: the motion that worked in the twin.
        """
        if self._when is Look.ONCE:
            return self._replay(start, action, rehearsed)
        performed: Performed | None = None
        for attempt in range(ATTEMPTS):
            here = start if performed is None else performed.end
            belief = self.believe(here, f"{action}/{attempt}")
            # What fails twice where it is seen anew does not fail by how it was seen.
            like = rehearsed if attempt < ATTEMPTS - 1 else None
            motion = next(plan_motions(belief, action, like))
            if isinstance(motion, SkillOutcome):
                # Once tried, what went wrong is what happened, not that nothing is left to try.
                performed = performed or self.not_tried(here, motion)
                break
            latest, again = self.run(here, belief, action, motion)
            performed = latest if performed is None else _joined(performed, latest)
            if not again or latest.record.after.holding != performed.record.before.holding:
                break
            performed = self._withdrawn(performed)
        assert performed is not None  # ATTEMPTS is not zero
        return performed

    def _withdrawn(self, performed: Performed) -> Performed:
        """A robot that was stopped goes back a little the way it came; else it stays."""
        back = None if performed.trace is None else withdrawal(performed.trace)
        if back is None:
            return performed
        gone = _joined(performed, self.drive(performed.end, back)[0])
        record = replace(gone.record, cause=performed.record.cause)
        return replace(gone, record=record, motion=performed.motion, trace=performed.trace)

    def _replay(self, start: Snapshot, action: Action, rehearsed: Motion | None) -> Performed:
        if rehearsed is None:
            reason = failed(CauseKind.PRECONDITION, [], "there is no motion to replay")
            return self.not_tried(start, reason)
        return self.run(start, self.believe(start, str(action)), action, rehearsed)[0]


def _joined(first: Performed, second: Performed) -> Performed:
    """Two attempts, one after the other, as one action."""
    one, two = first.record, second.record
    later = [replace(event, time_s=event.time_s + one.simulated_s) for event in two.contacts]
    moved = {
        name: max(one.displacement.get(name, 0.0), far) for name, far in two.displacement.items()
    }
    record = replace(
        two,
        before=one.before,
        contacts=(*one.contacts, *later),
        displacement=moved,
        swept=(*one.swept, *two.swept),
        simulated_s=round(one.simulated_s + two.simulated_s, 4),
        steps=one.steps + two.steps,
    )
    trajectory = second.trajectory
    if first.trajectory is not None and trajectory is not None:
        trajectory = first.trajectory.followed_by(trajectory, one.simulated_s)
    return replace(second, record=record, trajectory=trajectory)
