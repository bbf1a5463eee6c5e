"""A compiled scene: masses, sizes, and what may and may not be in the model."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from etot_cli.errors import WorldError
from etot_cli.specs.load import load_task
from etot_cli.specs.scene import Actuation, Scene
from etot_cli.world.build.surroundings import TIMESTEP
from etot_cli.world.model import World, build_world
from etot_cli.world.placing import object_bounds
from tests.world.helpers import BALL, BOX, CUP, UNIT, make_scene, set_up

ROOT = Path(__file__).parents[2]
MASS = 0.31

MJCF = """<mujoco><worldbody><body name="base">
<geom type="box" size="0.02 0.03 0.04"/><geom type="sphere" size="0.02" pos="0 0 0.06"/>
</body></worldbody></mujoco>"""

HANDLE = {"width": 0.08, "depth": 0.035}
KINDS: dict[str, dict[str, Any]] = {
    "sphere": {"kind": "sphere", "diameter": 0.07},
    "box": {"kind": "box", "size": [0.05, 0.06, 0.07]},
    "cylinder": {"kind": "cylinder", "diameter": 0.05, "height": 0.1},
    "capsule": {"kind": "capsule", "diameter": 0.03, "length": 0.1},
    "pen": {"kind": "pen", "diameter": 0.016, "length": 0.17},
    "cup": {"kind": "cup", "diameter": 0.09, "height": 0.08},
    "cone": {"kind": "cup", "diameter": 0.09, "height": 0.08, "foot_diameter": 0.05},
    "bowl": {"kind": "bowl", "diameter": 0.16, "height": 0.05, "foot_diameter": 0.09},
    "drawer_unit": {
        "kind": "drawer_unit",
        "size": [0.24, 0.18, 0.15],
        "drawers": [{"name": "top"}, {"name": "low", "travel": 0.0}],
    },
    "cabinet": {"kind": "cabinet", "size": [0.2, 0.3, 0.25]},
    "shelf": {"kind": "shelf", "size": [0.2, 0.3, 0.25], "boards": ["a", "b", "c"]},
    "mjcf": {"kind": "mjcf", "file": "thing.xml"},
    "mesh": {"kind": "mesh", "file": "thing.stl"},
}
SIZES = {
    "sphere": (0.07, 0.07, 0.07),
    "box": (0.05, 0.06, 0.07),
    "cylinder": (0.05, 0.05, 0.1),
    "capsule": (0.1, 0.03, 0.03),
    "pen": (0.17, 0.016, 0.016),
    "cup": (0.09, 0.09, 0.08),
    "cone": (0.09, 0.09, 0.08),
    "bowl": (0.16, 0.16, 0.05),
    "drawer_unit": (0.24, 0.18, 0.15),
    "cabinet": (0.2, 0.3, 0.25),
    "shelf": (0.2, 0.3, 0.25),
    "mjcf": (0.04, 0.06, 0.12),
    "mesh": (0.06, 0.04, 0.02),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    import trimesh

    folder = tmp_path_factory.mktemp("files")
    (folder / "thing.xml").write_text(MJCF)
    trimesh.creation.box(extents=SIZES["mesh"]).export(folder / "thing.stl")
    return folder


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ETOT_CACHE", str(tmp_path / "cache"))


def build(folder: Path, kind: str, **more: Any) -> World:
    return build_world(make_scene(folder, thing=KINDS[kind] | {"at": [0.4, 0.0]} | more))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("fastened", [None, False])
def test_mass_is_the_one_of_the_scene(folder: Path, kind: str, fastened: bool | None) -> None:
    world = build(folder, kind, mass=MASS, fixed=fastened)
    assert world.model.body("thing").subtreemass[0] == pytest.approx(MASS, rel=0.01)
    assert world.entries["thing"].info.mass == pytest.approx(MASS, rel=0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_mass_without_a_number_is_that_of_a_household_thing(folder: Path, kind: str) -> None:
    world = build(folder, kind)
    x, y, z = SIZES[kind]
    mass = world.entries["thing"].info.mass
    assert 5.0 < mass / (x * y * z) < 1500.0


@pytest.mark.parametrize("kind", KINDS)
def test_colliding_geoms_fill_the_stated_size(folder: Path, kind: str) -> None:
    world = build(folder, kind)
    data = mujoco.MjData(world.model)
    if world.entries["thing"].free:
        data.joint("thing").qpos[:] = [0, 0, 0, 1, 0, 0, 0]
    mujoco.mj_kinematics(world.model, data)
    low, high = object_bounds(world, data, "thing")
    # Staves of a round wall lie between the circumscribed and the inscribed circle.
    tolerance = 0.012 * SIZES[kind][0] if kind in ("cup", "cone", "bowl") else 0.0012
    assert high - low == pytest.approx(SIZES[kind], abs=tolerance)
    assert world.entries["thing"].info.size == pytest.approx(SIZES[kind], abs=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_inertia_is_that_of_a_real_body(folder: Path, kind: str) -> None:
    """Principal moments are positive, keep the triangle inequality and suit the size."""
    world = build(folder, kind, mass=MASS)
    body = world.model.body("thing")
    if body.mass[0] == 0.0:  # the mass sits in the bodies of the file
        body = world.model.body(int(np.argmax(world.model.body_parentid == body.id)))
    a, b, c = np.sort(body.inertia)
    assert a > 0.0
    assert a + b >= c * (1 - 1e-6)
    assert c <= body.mass[0] * float(np.sum(np.square(SIZES[kind]))) / 4 + 1e-9


@pytest.mark.slow
def test_only_furniture_is_fastened(folder: Path) -> None:
    for kind in KINDS:
        entry = build(folder, kind).entries["thing"]
        furniture = kind in ("drawer_unit", "cabinet", "shelf")
        assert entry.free is not furniture
        assert entry.info.movable is not furniture
    assert not build(folder, "box", fixed=True).entries["thing"].info.movable
    assert build(folder, "shelf", fixed=False).entries["thing"].free


def test_physics_settings() -> None:
    option = build_world(make_scene()).model.opt
    assert option.timestep == TIMESTEP == 0.002
    assert option.integrator == mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    assert option.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    assert option.impratio == 10.0
    # A restored state continues bit-identically only with sleeping off.
    assert not option.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP
    assert option.gravity == pytest.approx([0, 0, -9.81])
    assert option.disableflags == mujoco.mjtDisableBit.mjDSBL_AUTORESET


# -- no cheating -----------------------------------------------------------------------------------


def whole_world(folder: Path) -> World:
    spots = {name: [0.3 + 0.3 * (i % 2), -0.9 + 0.3 * (i // 2)] for i, name in enumerate(KINDS)}
    return build_world(make_scene(folder, **{n: k | {"at": spots[n]} for n, k in KINDS.items()}))


def shipped(name: str) -> World:
    return build_world(load_task(ROOT / "tasks" / f"{name}.yaml").scene)


@pytest.fixture(scope="module", params=["kinds", *(p.stem for p in (ROOT / "tasks").glob("*"))])
def any_world(request: pytest.FixtureRequest, folder: Path) -> World:
    return whole_world(folder) if request.param == "kinds" else shipped(request.param)


def test_nothing_is_welded(any_world: World) -> None:
    """The only equality couples the two fingers of the gripper."""
    model = any_world.model
    fingers = set()
    for body in any_world.robot.finger_side:
        fingers.add(int(model.body_jntadr[body]))
    for index in range(model.neq):
        assert model.eq_type[index] == mujoco.mjtEq.mjEQ_JOINT
        assert {int(model.eq_obj1id[index]), int(model.eq_obj2id[index])} == fingers
    assert model.neq == 1


def test_every_solid_geom_collides(any_world: World) -> None:
    model = any_world.model
    for geom in range(model.ngeom):
        collides = model.geom_contype[geom] == 1 and model.geom_conaffinity[geom] == 1
        only_seen = model.geom_group[geom] == 2 or any_world.geom_address[geom] == "stand"
        assert collides != only_seen, model.geom(geom).name
    for name in any_world.entries:
        assert len(any_world.geoms_of(name)) > 0


def test_contacts_are_excluded_only_within_the_robot(any_world: World) -> None:
    model = any_world.model
    robot = {b for b in range(model.nbody) if model.body(b).name.startswith("robot/")}
    for signature in model.exclude_signature:
        assert {int(signature) >> 16, int(signature) & 0xFFFF} <= robot


def test_objects_fall_freely(any_world: World) -> None:
    """No object is held up by anything but contact: without contact it falls as it must."""
    stage = set_up(any_world.scene, settle=0.0)
    free = [name for name, entry in stage.world.entries.items() if entry.free]
    for rank, name in enumerate(free):
        stage.move(name, [5.0 + rank, 5.0, 3.0])
    before = {name: float(stage.data.joint(name).qpos[2]) for name in free}
    stage.step(0.2)
    for name in free:
        fallen = before[name] - float(stage.data.joint(name).qpos[2])
        assert fallen == pytest.approx(0.5 * 9.81 * 0.2**2, rel=0.03), name


# -- what the numbers mean -------------------------------------------------------------------------


def test_geoms_know_whose_they_are() -> None:
    stage = set_up(make_scene(unit=UNIT | {"at": [0.45, 0.0]}, cup=CUP | {"at": [0.4, 0.4]}))
    model, world = stage.world.model, stage.world
    assert world.geom_address[model.geom("desk").id] == "desk"
    pads = {world.geom_address[pad] for pad in world.robot.pads}
    assert pads == {"gripper"}
    assert world.geom_address[model.geom("robot/link2_upper_arm").id] == "robot"
    assert {"unit", "unit.top", "cup"} <= set(world.geom_address)
    for geom in range(model.ngeom):
        if model.body(int(model.geom_bodyid[geom])).name == "unit.top":
            assert world.geom_address[geom] == "unit.top"
            assert world.geom_object[geom] == "unit"


def test_slippery_goes_before_the_pads_friction() -> None:
    world = build_world(
        make_scene(
            wet=BOX | {"at": [0.4, 0.2], "friction": 0.15, "slippery": True},
            dry=BOX | {"at": [0.4, -0.2], "friction": 0.15},
        )
    )
    pad = world.robot.pads[0]
    for name, more_important in (("wet", True), ("dry", False)):
        geom = int(world.geoms_of(name)[0])
        assert world.model.geom_friction[geom][0] == pytest.approx(0.15)
        priority = world.model.geom_priority
        assert bool(priority[geom] > priority[pad]) is more_important


def pad_frictions(scene: Scene, name: str) -> list[float]:
    """Sliding friction of each contact pair that the pads have with an object."""
    world = build_world(scene)
    model, own = world.model, set(world.geoms_of(name).tolist())
    pads = set(world.robot.pads)
    return [
        float(model.pair_friction[pair][0])
        for pair in range(model.npair)
        if {int(model.pair_geom1[pair]), int(model.pair_geom2[pair])} & pads
        and {int(model.pair_geom1[pair]), int(model.pair_geom2[pair])} & own
    ]


def test_the_friction_between_pads_and_a_thing_is_the_things_own_too() -> None:
    scene = make_scene(
        usual=BOX | {"at": [0.4, 0.2]},
        smooth=BOX | {"at": [0.4, -0.2], "friction": 0.15},
        wet=BOX | {"at": [0.4, 0.0], "friction": 0.15, "slippery": True},
    )
    assert pad_frictions(scene, "smooth") == pytest.approx([0.25, 0.25])
    assert pad_frictions(scene, "usual") == []  # 1.0, what MuJoCo takes anyway
    assert pad_frictions(scene, "wet") == []  # its own, by priority
    worn = scene.model_copy(update={"actuation": Actuation(pad_friction=0.8)})
    assert pad_frictions(worn, "smooth") == pytest.approx([0.2, 0.2])
    assert pad_frictions(worn, "usual") == pytest.approx([0.8, 0.8])
    assert pad_frictions(worn, "wet") == []


def test_a_robot_is_as_strong_as_it_is_drawn() -> None:
    scene = make_scene(box=BOX | {"at": [0.4, 0.2]})
    one = build_world(scene)
    weak = Actuation(servo=(0.9,) * len(one.robot.ctrl), gripper_force=0.5)
    two = build_world(scene.model_copy(update={"actuation": weak}))
    arm, gripper = one.robot.ctrl, one.robot.gripper_ctrl
    gains = two.model.actuator_gainprm[arm, 0] / one.model.actuator_gainprm[arm, 0]
    np.testing.assert_allclose(gains, 0.9)
    np.testing.assert_allclose(
        two.model.actuator_biasprm[arm, 1], -two.model.actuator_gainprm[arm, 0]
    )
    np.testing.assert_allclose(
        two.model.actuator_biasprm[arm, 2], 0.9 * one.model.actuator_biasprm[arm, 2]
    )
    np.testing.assert_allclose(
        two.model.actuator_forcerange[gripper], one.model.actuator_forcerange[gripper] / 2
    )


@pytest.mark.parametrize(("slippery", "slides"), [(True, True), (False, False)])
def test_slippery_things_slide_down_where_others_stay(slippery: bool, slides: bool) -> None:
    """On a rough tilted board (friction 0.9) a thing of friction 0.1 slides only if slippery."""
    tilt = np.radians(20)
    board = {"kind": "box", "size": [0.3, 0.3, 0.01], "friction": 0.9, "fixed": True,
             "at": [0.4, 0.0, 0.4],
             "quaternion": [np.cos(tilt / 2), np.sin(tilt / 2), 0, 0]}  # fmt: skip
    thing = {"kind": "box", "size": [0.05, 0.05, 0.02], "friction": 0.1, "slippery": slippery,
             "at": [0.4, -0.015 * np.sin(tilt), 0.4 + 0.0155 * np.cos(tilt)],
             "quaternion": board["quaternion"], "mass": 0.1}  # fmt: skip
    stage = set_up(make_scene(board=board, thing=thing), settle=0.0)
    before = stage.data.body("thing").xpos.copy()
    stage.step(0.4)
    moved = float(np.linalg.norm(stage.data.body("thing").xpos - before))
    assert (moved > 0.05) is slides
    assert moved < 0.005 or slides


def test_a_ball_stops_rolling() -> None:
    stage = set_up(make_scene(ball=BALL | {"at": [0.4, 0.0], "rolling_friction": 0.002}))
    stage.data.joint("ball").qvel[0] = 0.1
    stage.data.joint("ball").qvel[4] = 0.1 / 0.025
    stage.step(0.1)
    assert stage.data.joint("ball").qvel[0] > 0.03
    stage.step(1.5)
    assert abs(stage.data.joint("ball").qvel[0]) < 0.002


def test_fastened_thing_on_another_needs_a_full_position() -> None:
    scene = make_scene(box=BOX | {"at": [0.4, 0.0]}, top=BOX | {"on": "box", "fixed": True})
    with pytest.raises(WorldError, match="top is fastened and stands on another object"):
        build_world(scene)


def test_equal_scenes_compile_to_equal_models() -> None:
    one, two = (shipped("task5").model for _ in range(2))
    sizes = mujoco.mj_sizeModel(one)
    buffers = [np.zeros(sizes, dtype=np.uint8) for _ in range(2)]
    for model, buffer in zip((one, two), buffers, strict=True):
        mujoco.mj_saveModel(model, None, buffer)
    np.testing.assert_array_equal(*buffers)
