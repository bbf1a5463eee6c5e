"""Carries out in a simulated world what somebody does to a scene while the robot acts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from etot_cli.control.robot import Guards
from etot_cli.control.simulated_robot import SimulatedRobot
from etot_cli.errors import WorldError
from etot_cli.execution.acting import duration
from etot_cli.execution.protocols import RobotDevice
from etot_cli.execution.simulated_device import SimulatedDevice
from etot_cli.execution.world import ExecutionWorld
from etot_cli.skills.action import Action, Verb
from etot_cli.skills.motion.motion import Motion
from etot_cli.skills.motion.timing import JointLimits
from etot_cli.specs.disturbance import Disturbance, Role
from etot_cli.specs.objects import ObjectBase
from etot_cli.world.placing import place_object, raise_clear
from etot_cli.world.state import owner_of

SETTLE_S = 1.5
"""Time for what was disturbed to come to rest, at most [s]."""
DROP_HEIGHT = 0.08
"""A hand's breadth [m]."""
PART_SPEED = (0.3, 2.0)
"""A drawer [m/s] and a door [rad/s] moved by hand."""
PART_TOLERANCE = 0.004
"""A part this near to its goal is there [m or rad]: what a door turns by in a step of 2 ms."""
TIP_S = 3.0
"""Something that does not fall over in this time is left alone [s]."""
TIPPED_COSINE = 0.5
"""What leans this far (60°) falls by itself, or lies against something."""
UNMOVED = 0.01
"""What a person's deed displaced further than this is not the robot's doing [m]."""
TIP_GROWTH = 1.25
"""The push grows by this every tenth of a second: 800 times in ``TIP_S`` ..."""
TIP_START = 0.3
"""... from this share of what the weight resists with on an arm as long as it is wide."""


@dataclass(frozen=True)
class Roles:
    """Who the roles of a disturbance are at one moment; None where nobody is yet."""

    chosen: str | None = None
    target: str | None = None

    def name(self, given: str, known: ExecutionWorld) -> str | None:
        """The object that a name or a role means; an object of that name comes first."""
        if given in known.world.entries:
            return given
        return {Role.CHOSEN: self.chosen, Role.TARGET: self.target}.get(Role(given))


def roles_of(plan: tuple[Action, ...], chosen: str | None) -> Roles:
    """The roles that a plan gives: what it picks first, and where that is to go."""
    for index, action in enumerate(plan):
        if action.verb is Verb.PICK_UP:
            put = plan[index + 1] if index + 1 < len(plan) else None
            target = None if put is None else owner_of(put.target)
            return Roles(chosen or action.target, target)
    about = owner_of(plan[0].target) if plan else None
    return Roles(chosen, about)


class Somebody:
    """Does at their time what a task's disturbances say; with a real robot, a person does it.

    Args:
        pending: what is to happen.
        world: where; None with a real robot.
        happened: told of every deed: in words, and which objects it displaced.
    """

    def __init__(
        self,
        pending: Sequence[Disturbance],
        world: ExecutionWorld | None,
        happened: Callable[[str, frozenset[str]], None],
    ) -> None:
        self._pending, self._world, self._happened = list(pending), world, happened
        self._chosen: str | None = None

    def before(self, plan: tuple[Action, ...], done: int) -> None:
        """Does what is due before a plan's next action, or at the end, with an empty plan.

        Args:
            plan: the actions that are left.
            done: number of actions carried out so far.
        """
        for given in list(self._pending):
            due = {
                "planned": True,
                "committed": bool(plan) and plan[0].verb is Verb.PICK_UP,
                "after_action": done >= given.after_action,
                "during_action": False,
            }[given.when]
            if due:
                self._do(given, plan)

    def acting(self, action: Action) -> None:
        """Takes note of what is picked first."""
        if action.verb is Verb.PICK_UP and self._chosen is None:
            self._chosen = action.target

    def during(
        self,
        motion: Motion,
        plan: tuple[Action, ...],
        index: int,
        device: RobotDevice,
        limits: JointLimits,
    ) -> None:
        """Has what is due during an action happen while the robot moves.

        Args:
            motion: about to be run.
            plan: the actions that are left, this one first.
            index: the action's place in the trial, from 0.
            device: who moves; nothing happens unless it is simulated.
            limits: of its joint targets.
        """
        if not isinstance(device, SimulatedDevice):
            return
        for given in list(self._pending):
            if given.when == "during_action" and given.during_action == index + 1:
                seconds = duration(motion, device.state().targets, limits)
                at_s = device.world.time_s + given.share * seconds
                device.at(at_s, lambda given=given: self._do(given, plan))  # type: ignore[misc]
                return

    def _do(self, given: Disturbance, plan: tuple[Action, ...]) -> None:
        self._pending.remove(given)
        if self._world is None:
            return
        before = self._world.read()
        text = disturb(self._world, given, roles_of(plan, self._chosen))
        after = self._world.read()
        displaced = {
            name
            for name, was in before.states.items()
            if name not in after.states
            or math.dist(after.states[name].position, was.position) > UNMOVED
        }
        self._happened(text, frozenset(displaced))


def disturb(world: ExecutionWorld, given: Disturbance, roles: Roles) -> str:
    """Does it, and lets the scene come to rest while the robot holds still.

    Returns:
        What was done, in words.
    """
    text, name = str(given), given.name
    if given.part is not None and given.to is not None:
        _move_part(world, given.part, given.to)
    else:
        resolved = roles.name(given.name, world) if given.add is None else given.name
        if resolved is None or resolved not in world.world.entries:
            return f"{text}: nothing has that role"
        name = resolved
        text = text.replace(f" {given.name}", f" {name}", 1)
        if not world.world.entries[name].free:
            return f"{text}: it is fastened"
        if given.remove is not None:
            world.take_away(name)
        elif given.knock_over is not None:
            _knock_over(world, name)
        elif given.object is not None:
            text = f"{text} ({given.object.kind})"
            if not _put(world, name, given.object, 0.0):
                return f"{text}: there is no room for it"
            world.absent.discard(name)
        elif not _put(
            world, name, _destination(world, given, name), DROP_HEIGHT * bool(given.drop)
        ):
            return f"{text}: there is no room for it"
    SimulatedRobot(world.world, world.data, world.recorder).wait(
        SETTLE_S, Guards(), until_rest=True
    )
    return text


def _destination(world: ExecutionWorld, given: Disturbance, name: str) -> ObjectBase:
    """The object's own description, standing where it is to go."""
    at = given.at
    if given.by is not None:
        x, y = world.data.joint(name).qpos[:2]
        at = (float(x + given.by[0]), float(y + given.by[1]))
    spec: ObjectBase = world.world.scene.objects[name]
    return spec.model_copy(update={"at": at, "on": given.on, "inside": given.inside})


def _put(world: ExecutionWorld, name: str, spec: ObjectBase, height: float) -> bool:
    """Puts an object somewhere, lifted clear of what is there; whether it fits."""
    joint = world.data.joint(name)
    before = joint.qpos.copy()
    try:
        place_object(world.world, world.data, name, spec)
        fits = raise_clear(world.world, world.data, name)
    except WorldError:
        fits = False
    if not fits:
        joint.qpos[:] = before
        return False
    joint.qpos[2] += height
    joint.qvel[:] = 0.0
    mujoco.mj_forward(world.world.model, world.data)
    return True


def _move_part(world: ExecutionWorld, address: str, share: float) -> None:
    """Moves a part as a hand would, slowly enough for what is in it to come along."""
    part = world.world.parts[address]
    joint, model = world.data.joint(part.joint), world.world.model
    goal = part.lower + share * (part.upper - part.lower)
    speed = PART_SPEED[part.info.joint_type != "slide"]
    periods = 2 * abs(part.upper - part.lower) / speed / model.opt.timestep
    for _ in range(int(periods)):
        left = goal - float(joint.qpos[0])
        if abs(left) < PART_TOLERANCE:
            break
        joint.qvel[0] = np.sign(left) * speed
        mujoco.mj_step(model, world.data)
    joint.qvel[0] = 0.0


def _knock_over(world: ExecutionWorld, name: str) -> None:
    """Pushes an object at its top, harder and harder, until it falls."""
    model, data = world.world.model, world.data
    body = model.body(world.world.entries[name].body).id
    up = data.xmat[body].reshape(3, 3)[:, 2].copy()
    angle = float(world.random("knock", name).uniform(0.0, 2.0 * np.pi))
    axis = np.array([np.cos(angle), np.sin(angle), 0.0])
    width = max(world.world.entries[name].info.size[:2])
    weight = -float(model.opt.gravity[2] * model.body_subtreemass[body])
    torque = TIP_START * weight * width
    growth = TIP_GROWTH ** (model.opt.timestep / 0.1)
    for _ in range(int(TIP_S / model.opt.timestep)):
        if float(data.xmat[body].reshape(3, 3)[:, 2] @ up) < TIPPED_COSINE:
            break
        data.xfrc_applied[body, 3:] = torque * axis
        mujoco.mj_step(model, data)
        torque *= growth
    data.xfrc_applied[body] = 0.0
