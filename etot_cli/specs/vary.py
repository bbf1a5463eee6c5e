"""Draws a varied scene: poses, sizes, friction and mass within the scene's ``variation``.

Every object has a random stream of its own, made from the seed, the attempt and its name, so
adding or reordering objects leaves the draws of the others as they are.
"""

from __future__ import annotations

import math
import zlib
from dataclasses import dataclass, field

from etot_cli.specs.checks import placement_problems
from etot_cli.specs.footprint import turned
from etot_cli.specs.objects import FURNITURE, ROLLING_DEFAULT, Cup, Mjcf
from etot_cli.specs.placement import Placed, place_all
from etot_cli.specs.quantity import MAX_ROLLING
from etot_cli.specs.references import DESK, support_of
from etot_cli.specs.resize import resize, uniform
from etot_cli.specs.scene import Actuation, Scene

TRIES = 50
"""Draws at full amplitude before it is reduced."""
SHRINKS = 5
"""How often the amplitude is halved before poses stay: down to a thirtieth."""
TRIES_SHRUNK = TRIES // SHRINKS
"""Draws at each of these, altogether as many as at full amplitude."""
OWN_SHARE = 0.3
"""Part of the bounds by which an object moves relative to the object that carries it."""
FRICTION_BOUNDS = (0.01, 3.0)
MASS_BOUNDS = (0.0002, 100.0)
MAX_JOINTS = 12
"""Of a robot."""


@dataclass(frozen=True, slots=True)
class _Draw:
    """One object's random numbers, each uniform in −1…1."""

    x: float
    y: float
    yaw: float
    friction: float
    mass: float


@dataclass(frozen=True, slots=True)
class _Motion:
    """A rigid motion in the plane: turn by ``yaw_deg`` about ``x y``, then shift by ``dx dy``."""

    x: float = 0.0
    y: float = 0.0
    dx: float = 0.0
    dy: float = 0.0
    yaw_deg: float = 0.0

    def apply(self, x: float, y: float) -> tuple[float, float]:
        """Where the point x y goes."""
        u, v = turned((x - self.x, y - self.y), self.yaw_deg)
        return (self.x + u + self.dx, self.y + v + self.dy)


def vary(scene: Scene, seed: int) -> Scene:
    """Draws a scene within the bounds of ``scene.variation``.

    Objects that stand on or in others move with them. A draw in which objects overlap, leave the
    desk or their support, or get out of reach is drawn again; when none of :data:`TRIES` is good
    the amplitude of the poses is halved, and in the end the poses stay as they are.

    Args:
        scene: a checked scene.
        seed: the same seed gives the same scene.

    Returns:
        The varied scene; the argument is not changed.
    """
    amplitudes = [1.0] * TRIES
    for level in range(1, SHRINKS + 1):
        amplitudes.extend([0.5**level] * TRIES_SHRUNK)
    for attempt, amplitude in enumerate(amplitudes):
        draws = {name: _draw(seed, attempt, name) for name in scene.objects}
        varied = _varied(scene, draws, amplitude)
        if next(placement_problems(varied), None) is None:
            return resize(varied, seed)
    return resize(_varied(scene, {name: _draw(seed, 0, name) for name in scene.objects}, 0.0), seed)


def vary_truth(scene: Scene, seed: int) -> Scene:
    """A true world beside the planner's twin: as :func:`vary`, and what no twin is told.

    That is rolling friction and how the robot differs from its description. These have random
    streams of their own, so everything else is drawn as by :func:`vary`.
    """
    varied, bounds = vary(scene, seed), scene.variation
    objects = {}
    for name, item in varied.objects.items():
        if bounds.rolling_friction and not isinstance(item, (*FURNITURE, Mjcf)):
            rolling = ROLLING_DEFAULT if item.rolling_friction is None else item.rolling_friction
            (draw,) = uniform(seed, 1, name, "rolling")
            rolling *= 1.0 + bounds.rolling_friction * draw
            item = item.model_copy(update={"rolling_friction": min(rolling, MAX_ROLLING)})
        objects[name] = item
    pads, force, delay, *servo = uniform(seed, 3 + MAX_JOINTS, "", "robot")
    actuation = Actuation(
        pad_friction=1.0 + bounds.pad_friction * pads,
        gripper_force=1.0 + bounds.gripper_force * force,
        servo=tuple(1.0 + bounds.servo * draw for draw in servo) if bounds.servo else (),
        delay_s=bounds.delay_s * (1.0 + delay) / 2.0,
    )
    return varied.model_copy(update={"objects": objects, "actuation": actuation})


def _draw(seed: int, attempt: int, name: str) -> _Draw:
    import numpy as np  # here, because starting the program must not wait for it

    entropy = [seed % 2**64, attempt, zlib.crc32(name.encode())]
    return _Draw(*np.random.default_rng(entropy).uniform(-1.0, 1.0, 5).tolist())


def _varied(scene: Scene, draws: dict[str, _Draw], amplitude: float) -> Scene:
    moves = _Moves(scene, draws, amplitude, place_all(scene))
    objects = {}
    for name, item in scene.objects.items():
        draw, update = draws[name], moves.pose(name)
        friction = item.friction * (1.0 + scene.variation.friction * draw.friction)
        update["friction"] = _clipped(friction, FRICTION_BOUNDS)
        if item.mass is not None:
            mass = item.mass * (1.0 + scene.variation.mass * draw.mass)
            update["mass"] = _clipped(mass, MASS_BOUNDS)
        objects[name] = item.model_copy(update=update)
    return scene.model_copy(update={"objects": objects})


def _clipped(value: float, bounds: tuple[float, float]) -> float:
    return min(max(value, bounds[0]), bounds[1])


@dataclass(frozen=True, slots=True)
class _Moves:
    """How the objects of a scene move in one draw, which uses ``amplitude`` of the bounds."""

    scene: Scene
    draws: dict[str, _Draw]
    amplitude: float
    placed: dict[str, Placed]
    _known: dict[str, _Motion] = field(default_factory=dict)

    def motion(self, name: str) -> _Motion:
        """How an object moves as a whole: with what carries it, and its own part on top."""
        if name in self._known:
            return self._known[name]
        place, draw, bounds = self.placed[name], self.draws[name], self.scene.variation
        below = support_of(self.scene.objects[name])
        carried = _Motion() if below == DESK else self.motion(below)
        share = self.amplitude * self._own_share(name)
        reach, turn = share * bounds.position_m, share * bounds.yaw_deg
        x, y = carried.apply(place.x, place.y)
        self._known[name] = _Motion(
            place.x,
            place.y,
            x - place.x + reach * draw.x,
            y - place.y + reach * draw.y,
            carried.yaw_deg + turn * draw.yaw,
        )
        return self._known[name]

    def pose(self, name: str) -> dict[str, object]:
        """The pose fields of an object after its motion; heights stay."""
        item, place, motion = self.scene.objects[name], self.placed[name], self.motion(name)
        update: dict[str, object] = {}
        centred = item.at is None and self._own_share(name) == 0.0
        if not centred and (motion.dx or motion.dy):
            # An object that stood in the middle of its support gets a place of its own; one in a
            # vessel, or kept, stays in the middle wherever the support goes.
            height = item.at[2:] if item.at is not None else ()
            update["at"] = (place.x + motion.dx, place.y + motion.dy, *height)
        if motion.yaw_deg:
            if item.quaternion is None:
                update["yaw_deg"] = math.remainder(item.yaw_deg + motion.yaw_deg, 360.0)
            else:
                update["quaternion"] = _turned_quaternion(item.quaternion, motion.yaw_deg)
        return update

    def _own_share(self, name: str) -> float:
        """How much of the bounds an object moves by itself.

        Nothing in or on a vessel, whose rim and walls leave no choice, nor for what is kept.
        """
        objects = self.scene.objects
        if name in self.scene.variation.keep:
            return 0.0
        below = support_of(objects[name])
        if below == DESK:
            return 1.0
        # Of these the size of the hollow is not known here, or too small to move in.
        tight = isinstance(objects[below], Cup) or (
            objects[name].inside is not None and not isinstance(objects[below], FURNITURE)
        )
        return 0.0 if tight else OWN_SHARE


def _turned_quaternion(
    quaternion: tuple[float, float, float, float], yaw_deg: float
) -> tuple[float, float, float, float]:
    """A rotation w x y z, followed by a turn about z."""
    half = math.radians(yaw_deg) / 2
    c, s = math.cos(half), math.sin(half)
    w, x, y, z = quaternion
    return (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)
