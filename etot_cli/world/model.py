"""Builds the physics world of a scene: one MuJoCo model with robot, desk, objects and an index."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs import objects as specs
from etot_cli.specs.placement import fastened_at, place_all
from etot_cli.specs.scene import Scene
from etot_cli.world.build.mjcf_panels import with_panel
from etot_cli.world.build.mjcf_parts import mjcf_parts
from etot_cli.world.build.objects import add_object, entry_of
from etot_cli.world.build.pads import add_pad_pairs
from etot_cli.world.build.surroundings import add_surroundings, set_options
from etot_cli.world.fingers import root_of
from etot_cli.world.index import ObjectEntry, Part, Region, Surface
from etot_cli.world.robot import RobotSpec, load_robot
from etot_cli.world.robot_index import ROBOT_PREFIX, RobotIndex, actuate, add_robot, robot_index
from etot_cli.world.state import owner_of

MASS_TOLERANCE = 1e-6
"""Masses that differ by a smaller share are the same: the digits of a file."""
SEEN_ONLY = ("cam", "light", "mat", "name", "nbuf", "nmat", "nname", "npath", "ntex", "path", "tex")
"""Beginnings of the model's fields that physics does not depend on."""


@dataclass(frozen=True)
class World:
    """A compiled scene: the model and what its numbers mean. Holds no state of the simulation."""

    scene: Scene
    model: mujoco.MjModel
    robot: RobotIndex
    entries: dict[str, ObjectEntry]
    geom_address: tuple[str, ...]
    """For every geom: object, ``object.part`` or ``.board``, ``robot``, ``gripper``, ``desk`` or
    ``floor``.
    """

    @cached_property
    def digest(self) -> str:
        """SHA-256 of everything in the model that physics depends on, hexadecimal."""
        found = hashlib.sha256()
        for owner in (self.model, self.model.opt):
            for key in dir(owner):
                if key.startswith(("_", *SEEN_ONLY)) or key.endswith("rgba"):
                    continue
                value = getattr(owner, key)
                if isinstance(value, int | float | np.ndarray):
                    found.update(key.encode() + np.ascontiguousarray(value).tobytes())
        return found.hexdigest()

    @cached_property
    def geom_object(self) -> tuple[str, ...]:
        """As ``geom_address``, parts counted to their object."""
        return tuple(owner_of(address) for address in self.geom_address)

    @cached_property
    def regions(self) -> dict[str, Region]:
        """Containers by address."""
        return {region.address: region for e in self.entries.values() for region in e.regions}

    @cached_property
    def surfaces(self) -> dict[str, Surface]:
        """Surfaces of objects by address, the desk not included."""
        return {surface.address: surface for e in self.entries.values() for surface in e.surfaces}

    @cached_property
    def parts(self) -> dict[str, Part]:
        """Movable parts by address and by ``object.part``."""
        found = {}
        for entry in self.entries.values():
            for part in entry.parts:
                found[part.info.address] = part
                found[f"{part.info.owner}.{part.info.name}"] = part
        return found

    def geoms_of(self, name: str) -> NDArray[np.int64]:
        """Colliding geom ids of an object, its parts included."""
        ids = [
            i
            for i, owner in enumerate(self.geom_object)
            if owner == name and self.model.geom_contype[i]
        ]
        return np.array(ids, dtype=np.int64)


def build_world(scene: Scene, *, dressed: bool = False, loose_furniture: bool = False) -> World:
    """Compiles a scene.

    Args:
        scene: what is built.
        dressed: for pictures; the same bodies and joints, with materials, floor and wall.
        loose_furniture: where fastened things stand is state (``mocap_pos``, ``mocap_quat``), for a
            belief that has them elsewhere than they are. Not for stepping: MuJoCo then takes
            contacts between furniture and its own doors and drawers for none.

    Raises:
        WorldError: a file or the combination of objects cannot be compiled.
        SpecError: the robot description is unusable.
    """
    robot = load_robot(scene.robot, scene.directory)
    mj, drafts = _drafted(scene, robot)
    if loose_furniture:
        for name, entry in drafts.items():
            mj.body(name).mocap = not entry.free
    if dressed:
        from etot_cli.world.build.dressing import dress

        dress(mj, scene)
    try:
        model = mj.compile()
    except ValueError as error:
        raise WorldError(f"the scene does not compile: {error}") from error
    _scale_masses(model, scene)
    entries, placed = {}, place_all(scene)
    for name, entry in drafts.items():
        spec = scene.objects[name]
        if isinstance(spec, specs.Mjcf):
            parts, regions, surfaces = mjcf_parts(model, spec, name)
            parts = tuple(with_panel(model, part) for part in parts)
            size = _extents(model, name)
            entry = entry_of(name, spec, parts, regions, surfaces, size)
        mass = float(model.body(entry.body).subtreemass[0])
        on, inside = (None, None) if entry.free else fastened_at(spec, placed[name], scene.desk.top)
        info = replace(entry.info, mass=mass, on=on, inside=inside)
        entries[name] = replace(entry, info=info)
    index = robot_index(model, robot)
    actuate(model, index, scene.actuation)
    return World(scene, model, index, entries, _addresses(model, entries, index))


def scene_spec(scene: Scene, *, robot: bool = True) -> mujoco.MjSpec:
    """A scene's model before it is compiled, masses not yet scaled; with its robot or without.

    Raises:
        WorldError: a file or the combination of objects cannot be compiled.
        SpecError: the robot description is unusable.
    """
    return _drafted(scene, load_robot(scene.robot, scene.directory) if robot else None)[0]


def _drafted(scene: Scene, robot: RobotSpec | None) -> tuple[mujoco.MjSpec, dict[str, ObjectEntry]]:
    mj = mujoco.MjSpec()
    set_options(mj)
    add_surroundings(mj, scene)
    if robot is not None:
        add_robot(mj, robot)
    drafts = {name: add_object(mj, scene, name, spec) for name, spec in scene.objects.items()}
    if robot is not None:
        pads = [ROBOT_PREFIX + pad for pad in robot.gripper.pads]
        add_pad_pairs(mj, pads, list(scene.objects), scene.actuation.pad_friction)
    return mj, drafts


def _scale_masses(model: mujoco.MjModel, scene: Scene) -> None:
    """Makes every object as heavy as the scene says, parts included, inertia in proportion."""
    changed = False
    for name, spec in scene.objects.items():
        if spec.mass is None:
            continue
        root = model.body(name).id
        factor = spec.mass / float(model.body_subtreemass[root])
        if abs(factor - 1.0) < MASS_TOLERANCE:
            continue
        own = [b for b in range(model.nbody) if int(model.body_rootid[b]) == root]
        model.body_mass[own] *= factor
        model.body_inertia[own] *= factor
        changed = True
    if changed:
        mujoco.mj_setConst(model, mujoco.MjData(model))


def _extents(model: mujoco.MjModel, name: str) -> tuple[float, float, float]:
    """Size of an MJCF object's geoms in its own frame at zero joint values."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    root = data.body(name)
    rotation = root.xmat.reshape(3, 3)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        if model.body(int(model.body_rootid[body])).name != name:
            continue
        box, turn = model.geom_aabb[geom], rotation.T @ data.geom_xmat[geom].reshape(3, 3)
        middle = rotation.T @ (data.geom_xpos[geom] - root.xpos) + turn @ box[:3]
        half = np.abs(turn) @ box[3:]
        low, high = np.minimum(low, middle - half), np.maximum(high, middle + half)
    x, y, z = (float(value) for value in high - low)
    return x, y, z


def _addresses(
    model: mujoco.MjModel, entries: dict[str, ObjectEntry], robot: RobotIndex
) -> tuple[str, ...]:
    part_bodies = {
        part.body: f"{part.info.owner}.{part.info.name}"
        for entry in entries.values()
        for part in entry.parts
    }
    boards = {f"{name}.{board}" for name, e in entries.items() for board in e.info.boards}
    addresses: list[str] = []
    hand = _hand_bodies(model) | set(robot.finger_side)
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        root = model.body(int(model.body_rootid[body])).name
        if body == 0:
            addresses.append(model.geom(geom).name or "stand")
        elif root in entries:
            address = root
            while body != 0:
                address = part_bodies.get(model.body(body).name, address)
                if address != root:
                    break
                body = int(model.body_parentid[body])
            own = model.geom(geom).name
            addresses.append(own if own in boards else address)
        else:
            addresses.append("gripper" if body in hand else "robot")
    return tuple(addresses)


def _hand_bodies(model: mujoco.MjModel) -> set[int]:
    """Bodies of the gripper: those that hang on the tool site's body."""
    sites = [i for i in range(model.nsite) if model.site(i).name.startswith(ROBOT_PREFIX)]
    hand = {int(model.site_bodyid[i]) for i in sites}
    return {body for body in range(1, model.nbody) if root_of(model, body, hand)}
