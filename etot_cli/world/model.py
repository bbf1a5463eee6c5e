"""Builds the physics world of a scene: one MuJoCo model with robot, desk, objects and an index."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.errors import WorldError
from etot_cli.specs import scene as specs
from etot_cli.world.build import furniture, imported, shapes, vessels
from etot_cli.world.build.material import ROLLING_DEFAULT, SOLIMP, SOLREF, Look
from etot_cli.world.colors import nearest_basic, rgb
from etot_cli.world.index import ObjectEntry, Part, Region, Surface
from etot_cli.world.robot import RobotSpec, load_robot
from etot_cli.world.state import DESK, ObjectInfo

TIMESTEP = 0.002
"""Physics step [s]; 5 ms loses grasps (docs/physics.md)."""
FLOOR_DEPTH = 0.7
"""The floor lies this far below the desk top [m]; what falls there is lost."""
MASS_TOLERANCE = 1e-6
ROBOT_PREFIX = "robot/"
TIP_MARGIN, FINGER_MARGIN = 0.0005, 0.0015
"""Added to the measured length and thickness of the fingers [m]."""
DEFAULT_COLOR = (0.62, 0.64, 0.66)


@dataclass(frozen=True)
class RobotIndex:
    """Addresses of the robot's joints, actuators and geoms in the model."""

    spec: RobotSpec
    qpos: NDArray[np.int64]
    """Joint positions in qpos, (n,)."""
    dof: NDArray[np.int64]
    ctrl: NDArray[np.int64]
    """Arm actuators in ctrl, (n,)."""
    gripper_ctrl: int
    finger_qpos: NDArray[np.int64]
    tool_site: int
    pads: tuple[int, int]
    finger_bodies: tuple[int, int]
    lower: NDArray[np.float64]
    """Joint limits [rad], (n,)."""
    upper: NDArray[np.float64]
    tip: float
    """How far the fingertips reach beyond the tool point [m]."""
    finger_half: float
    """Half thickness of the closed fingers, across the approach [m]."""


@dataclass(frozen=True)
class World:
    """A compiled scene: the model and what its numbers mean. Holds no state of the simulation."""

    scene: specs.Scene
    model: mujoco.MjModel
    robot: RobotIndex
    entries: dict[str, ObjectEntry]
    geom_address: tuple[str, ...]
    """For every geom: object, ``object.part`` or ``.board``, ``robot``, ``gripper``, ``desk`` or
    ``floor``.
    """

    @cached_property
    def geom_object(self) -> tuple[str, ...]:
        """As ``geom_address``, parts counted to their object."""
        return tuple(address.split(".")[0] for address in self.geom_address)

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


def build_world(scene: specs.Scene) -> World:
    """Compiles a scene.

    Raises:
        WorldError: a file or the combination of objects cannot be compiled.
        SpecError: the robot description is unusable.
    """
    robot = load_robot(scene.robot, scene.directory)
    mj = mujoco.MjSpec()
    _set_options(mj)
    _add_surroundings(mj, scene)
    _add_robot(mj, robot)
    drafts = {name: _add_object(mj, scene, name, spec) for name, spec in scene.objects.items()}
    try:
        model = mj.compile()
    except ValueError as error:
        raise WorldError(f"the scene does not compile: {error}") from error
    _scale_masses(model, scene)
    entries = {}
    for name, (entry, spec) in drafts.items():
        if isinstance(spec, specs.Mjcf):
            parts, regions, surfaces = imported.mjcf_parts(model, spec, name)
            size = _extents(model, name)
            entry = _entry(name, spec, parts, regions, surfaces, size)
        entries[name] = _with_mass(entry, model)
    return World(scene, model, _robot_index(model, robot), entries, _addresses(model, entries))


def _set_options(mj: mujoco.MjSpec) -> None:
    mj.compiler.degree = False
    mj.option.timestep = TIMESTEP
    mj.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    mj.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    mj.option.impratio = 10.0
    mj.option.iterations = 50
    mj.option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    mj.visual.global_.offwidth = 1920
    mj.visual.global_.offheight = 1440
    mj.visual.quality.shadowsize = 2048
    # All lights together stay below white on a bright level surface: colours keep their hue.
    mj.visual.headlight.ambient = [0.34, 0.34, 0.34]
    mj.visual.headlight.diffuse = [0.20, 0.20, 0.20]
    mj.visual.headlight.specular = [0.03, 0.03, 0.03]
    mj.visual.map.shadowclip = 2.0
    mj.visual.map.znear = 0.01
    mj.visual.map.zfar = 20.0


def _add_surroundings(mj: mujoco.MjSpec, scene: specs.Scene) -> None:
    desk, world = scene.desk, mj.worldbody
    mj.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.82, 0.87, 0.92],
        rgb2=[0.45, 0.52, 0.60],
        width=256,
        height=1536,
    )
    thickness = 0.03
    top = world.add_geom(
        name=DESK,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[desk.size[0] / 2, desk.size[1] / 2, thickness / 2],
        pos=[*desk.center, desk.top - thickness / 2],
    )
    top.rgba = [*rgb(desk.color), 1.0]
    top.friction = [desk.friction, 0.005, ROLLING_DEFAULT]
    top.solref = SOLREF
    top.solimp = SOLIMP
    floor = world.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[4, 4, 0.1],
        pos=[0, 0, desk.top - FLOOR_DEPTH],
    )
    floor.rgba = [0.55, 0.57, 0.6, 1.0]
    # A stand under the robot, so that it does not float beside a small desk.
    stand = world.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[0.09, 0.09, FLOOR_DEPTH / 2],
        pos=[0, 0, -FLOOR_DEPTH / 2 - 0.001],
    )
    stand.rgba = [0.35, 0.37, 0.4, 1.0]
    stand.contype = 0
    stand.conaffinity = 0
    for position, strength in (((0.6, -1.2, 2.4), 0.42), ((0.8, 1.4, 2.2), 0.20)):
        light = world.add_light(pos=list(position), dir=[-v for v in position])
        light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        light.diffuse = [strength] * 3
        light.specular = [0.1] * 3
        light.castshadow = strength > 0.3
    for name, camera in scene.cameras.items():
        _add_camera(world, name, camera)


def _add_camera(world: Any, name: str, camera: specs.Camera) -> None:
    rotation = camera_rotation(camera)
    # MuJoCo cameras look along -z with y up; the optical frame looks along +z with y down.
    flipped = rotation @ np.diag([1.0, -1.0, -1.0])
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, flipped.ravel())
    world.add_camera(
        name=name,
        pos=list(camera.position),
        quat=quaternion.tolist(),
        resolution=[camera.width, camera.height],
        sensor_size=[camera.width * 1e-5, camera.height * 1e-5],
        focal_pixel=[camera.fx, camera.fy],
        principal_pixel=[camera.cx - camera.width / 2, camera.height / 2 - camera.cy],
    )


def camera_rotation(camera: specs.Camera) -> NDArray[np.float64]:
    """Rotation (3, 3) from the OpenCV optical frame to the base frame."""
    if camera.quaternion is not None:
        matrix = np.zeros(9)
        mujoco.mju_quat2Mat(matrix, np.array(camera.quaternion) / np.linalg.norm(camera.quaternion))
        return matrix.reshape(3, 3)
    target = np.array(camera.look_at if camera.look_at is not None else (0.4, 0.0, 0.13))
    forward = target - np.array(camera.position)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    if np.linalg.norm(right) < 1e-6:
        right = np.array([0.0, -1.0, 0.0])
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward], axis=1)


def _add_robot(mj: mujoco.MjSpec, robot: RobotSpec) -> None:
    try:
        child = mujoco.MjSpec.from_file(str(robot.model_path))
    except ValueError as error:
        raise WorldError(f"{robot.model_path.name}: not a valid MJCF model ({error})") from error
    mj.attach(child, prefix=ROBOT_PREFIX, frame=mj.worldbody.add_frame())


def _add_object(
    mj: mujoco.MjSpec, scene: specs.Scene, name: str, spec: Any
) -> tuple[ObjectEntry, Any]:
    body = mj.worldbody.add_body(name=name)
    fixed = is_fixed(spec)
    if not fixed:
        body.add_freejoint(name=name)
    look = _look(spec)
    parts: tuple[Part, ...] = ()
    regions: tuple[Region, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    axis = None
    if isinstance(spec, specs.Sphere):
        shapes.add_sphere(body, spec, look)
        size = (spec.diameter,) * 3
    elif isinstance(spec, specs.Box):
        shapes.add_box(body, spec, look)
        size = spec.size
        surfaces = (Surface(name, name, (0, 0, size[2] / 2), (size[0] / 2, size[1] / 2)),)
    elif isinstance(spec, specs.Cylinder):
        shapes.add_cylinder(body, spec, look)
        size = (spec.diameter, spec.diameter, spec.height)
        radius = spec.diameter / 2
        surfaces = (Surface(name, name, (0, 0, size[2] / 2), (radius, radius), round=True),)
    elif isinstance(spec, specs.Capsule):
        shapes.add_capsule(body, spec, look)
        size = (spec.length, spec.diameter, spec.diameter)
        axis = (1.0, 0.0, 0.0)
    elif isinstance(spec, specs.Pen):
        shapes.add_pen(mj, body, spec, look, name)
        size = (spec.length, spec.diameter, spec.diameter)
        axis = (1.0, 0.0, 0.0)
    elif isinstance(spec, specs.Cup):
        vessels.add_cup(mj, body, spec, look, name)
        size = (spec.diameter, spec.diameter, spec.height)
        regions = (vessels.cup_region(spec, name),)
    elif isinstance(spec, specs.DrawerUnit):
        parts, regions, surfaces = furniture.add_drawer_unit(body, spec, look, name)
        size = spec.size
    elif isinstance(spec, specs.Cabinet):
        parts, regions, surfaces = furniture.add_cabinet(body, spec, look, name)
        size = spec.size
    elif isinstance(spec, specs.Shelf):
        parts, regions, surfaces = furniture.add_shelf(body, spec, look, name)
        size = spec.size
    elif isinstance(spec, specs.Mesh):
        size = tuple(imported.add_mesh(mj, body, spec, look, name, scene.directory))
        if spec.hollow:
            regions = (vessels.hollow_region(size, name),)
    else:
        imported.attach_mjcf(mj, body, spec, name, scene.directory)
        size = (0.1, 0.1, 0.1)
    if fixed:
        body.pos = _fixed_position(scene, name, spec, size)
        body.quat = list(resting_quaternion(spec))
    entry = _entry(name, spec, parts, regions, surfaces, size, axis)
    return entry, spec


def _look(spec: Any) -> Look:
    rolling = ROLLING_DEFAULT if spec.rolling_friction is None else spec.rolling_friction
    color = rgb(spec.color) if spec.color is not None else DEFAULT_COLOR
    mass = (
        spec.mass
        if isinstance(spec, specs.Sphere | specs.Box | specs.Cylinder | specs.Capsule)
        else None
    )
    return Look((*color, 1.0), spec.friction, rolling, spec.slippery, mass, shapes.DENSITY)


def is_fixed(spec: Any) -> bool:
    """Whether an object is fastened: said so, or furniture."""
    return bool(spec.fixed) if spec.fixed is not None else isinstance(spec, specs.FURNITURE)


def resting_quaternion(spec: Any) -> tuple[float, float, float, float]:
    """Orientation w x y z as the scene gives it."""
    if spec.quaternion is not None:
        norm = math.sqrt(sum(value * value for value in spec.quaternion))
        w, x, y, z = (value / norm for value in spec.quaternion)
        return w, x, y, z
    half = math.radians(spec.yaw_deg) / 2
    return math.cos(half), 0.0, 0.0, math.sin(half)


def _fixed_position(
    scene: specs.Scene, name: str, spec: Any, size: tuple[float, ...]
) -> list[float]:
    if spec.at is not None and len(spec.at) == 3:
        return list(spec.at)
    if spec.inside is not None or (spec.on is not None and spec.on != DESK):
        raise WorldError(
            f"{name} is fastened and stands on another object: give its centre as at: [x, y, z]"
        )
    base = scene.desk.top if isinstance(spec, specs.Mjcf) else scene.desk.top + size[2] / 2
    return [*spec.at, base]


def _entry(
    name: str,
    spec: Any,
    parts: tuple[Part, ...],
    regions: tuple[Region, ...],
    surfaces: tuple[Surface, ...],
    size: tuple[float, ...],
    axis: tuple[float, float, float] | None = None,
) -> ObjectEntry:
    fixed = is_fixed(spec)
    behind_parts = {part.info.address for part in parts if part.info.container}
    boards = [surface.address.partition(".")[2] for surface in surfaces]
    info = ObjectInfo(
        name=name,
        kind=spec.kind,
        label=(spec.label or name.replace("_", " ")).lower(),
        color=nearest_basic(spec.color) if spec.color is not None else None,
        size=(float(size[0]), float(size[1]), float(size[2])),
        mass=0.0,
        movable=not fixed and not isinstance(spec, specs.FURNITURE),
        container=bool({region.address for region in regions} & {name} - behind_parts),
        surface=bool(surfaces),
        elongated=axis is not None and size[0] > 3 * size[1],
        parts=tuple(part.info for part in parts),
        boards=tuple(board for board in boards if board),
    )
    upright = not isinstance(spec, specs.Sphere | specs.Pen | specs.Capsule)
    return ObjectEntry(info, name, not fixed, parts, regions, surfaces, upright, axis)


def _scale_masses(model: mujoco.MjModel, scene: specs.Scene) -> None:
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


def _with_mass(entry: ObjectEntry, model: mujoco.MjModel) -> ObjectEntry:
    from dataclasses import replace

    mass = float(model.body(entry.body).subtreemass[0])
    return replace(entry, info=replace(entry.info, mass=mass))


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
        box = model.geom_aabb[geom]
        for corner in np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T:
            local = box[:3] + corner * box[3:]
            point = data.geom_xpos[geom] + data.geom_xmat[geom].reshape(3, 3) @ local
            point = rotation.T @ (point - root.xpos)
            low, high = np.minimum(low, point), np.maximum(high, point)
    x, y, z = (float(value) for value in high - low)
    return x, y, z


def _robot_index(model: mujoco.MjModel, spec: RobotSpec) -> RobotIndex:
    def name(item: str) -> str:
        return ROBOT_PREFIX + item

    try:
        joints = [model.joint(name(item)) for item in spec.joints]
        actuators = [model.actuator(name(item)) for item in spec.actuators]
        fingers = [model.body(name(item)) for item in spec.gripper.fingers]
        pads = [model.geom(name(item)).id for item in spec.gripper.pads]
        gripper = model.actuator(name(spec.gripper.actuator)).id
        site = model.site(name(spec.tool_site)).id
    except KeyError as error:
        raise WorldError(
            f"robot {spec.name}: its YAML names something that {spec.model} lacks ({error})"
        ) from error
    finger_joints = [
        int(model.jnt_qposadr[int(body.jntadr[0])]) for body in fingers if body.jntnum[0]
    ]
    lower, upper = np.array([joint.range for joint in joints]).T
    tip, finger_half = _fingertips(model, int(site), [int(pad) for pad in pads])
    return RobotIndex(
        spec=spec,
        qpos=np.array([int(joint.qposadr[0]) for joint in joints]),
        dof=np.array([int(joint.dofadr[0]) for joint in joints]),
        ctrl=np.array([int(actuator.id) for actuator in actuators]),
        gripper_ctrl=int(gripper),
        finger_qpos=np.array(finger_joints),
        tool_site=int(site),
        pads=(int(pads[0]), int(pads[1])),
        finger_bodies=(int(fingers[0].id), int(fingers[1].id)),
        lower=lower,
        upper=upper,
        tip=tip,
        finger_half=finger_half,
    )


def _fingertips(model: mujoco.MjModel, site: int, pads: list[int]) -> tuple[float, float]:
    """Reach of the pads beyond the tool point, and their half thickness when closed [m]."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    rotation, point = data.site_xmat[site].reshape(3, 3), data.site_xpos[site]
    corners = []
    for pad in pads:
        box = model.geom_aabb[pad]
        for signs in product((-1, 1), repeat=3):
            local = data.geom_xmat[pad].reshape(3, 3) @ (box[:3] + np.array(signs) * box[3:])
            corners.append(rotation.T @ (data.geom_xpos[pad] + local - point))
    across, tip = np.abs(corners)[:, :2].max(), np.array(corners)[:, 2].max()
    return round(float(tip), 6) + TIP_MARGIN, round(float(across), 6) + FINGER_MARGIN


def _addresses(model: mujoco.MjModel, entries: dict[str, ObjectEntry]) -> tuple[str, ...]:
    part_bodies = {
        part.body: f"{part.info.owner}.{part.info.name}"
        for entry in entries.values()
        for part in entry.parts
    }
    boards = {f"{name}.{board}" for name, e in entries.items() for board in e.info.boards}
    addresses: list[str] = []
    hand = _hand_bodies(model)
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
    for body in range(1, model.nbody):
        if int(model.body_parentid[body]) in hand:
            hand.add(body)
    return hand
