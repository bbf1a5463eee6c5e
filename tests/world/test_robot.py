"""The built-in robot against the maker's table, and robots described by YAML."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.errors import SpecError, WorldError
from etot_cli.specs.scene import Scene
from etot_cli.world.model import build_world
from etot_cli.world.robot import BUILTIN_ROBOTS, load_robot
from tests.world.helpers import BALL, make_scene, set_up

HALF_PI = np.pi / 2
# Joint frames in their parents: x y z [m] and the turn about x [rad]; limits [rad]; effort [N m].
TABLE = [
    ((0.0, 0.0, 0.267), 0.0, (-6.283, 6.283), 200),
    ((0.0, 0.0, 0.0), -HALF_PI, (-2.059, 2.0944), 150),
    ((0.0535, -0.2845, 0.0), 0.0, (-3.8, 0.19198), 150),
    ((0.0775, 0.3425, 0.0), -HALF_PI, (-6.283, 6.283), 120),
    ((0.0, 0.0, 0.0), HALF_PI, (-1.69297, 3.14159), 100),
    ((0.076, 0.097, 0.0), -HALF_PI, (-6.283, 6.283), 120),
]
TOOL = 0.172
# Mass [kg], centre of mass [m], inertia about it xx yy zz xy xz yz [kg m²].
LINKS = [
    (2.3814, (0.00022, 0.02951, -0.0124),
     (0.0058562, 0.0050316, 0.003536652, -1.79e-5, 3.55e-6, -0.000888336)),
    (2.2675, (0.03881, -0.22783, 0.03496),
     (0.028315776, 0.0058, 0.0273447, 0.005, 0.00066546, -0.0045741)),
    (1.875, (0.07041, 0.11631, 0.0107),
     (0.0063483, 0.00379758, 0.00595768, -0.0015397, 0.00096858, 0.00186567)),
    (1.3192, (-0.00018, 0.01798, -0.02291),
     (0.004896, 0.00445694, 0.00134332, -6.925e-6, -1.418e-5, -0.00023186)),
    (1.33854, (0.0651, 0.03096, 0.00315),
     (0.00146378, 0.00184192, 0.002333524, -0.000450624, 0.000284306, 0.000130866)),
    (0.17, (0.0, -0.00677, -0.01098), (9.3e-5, 5.87e-5, 0.000132, 0.0, 0.0, -3.6e-6)),
]  # fmt: skip
ROBOT = load_robot("xarm6")


def forward(joints: np.ndarray) -> np.ndarray:
    """Tool pose (4, 4) by the table alone."""
    pose = np.eye(4)
    for (origin, roll, _, _), angle in zip(TABLE, joints, strict=True):
        fixed, turn = np.eye(4), np.eye(4)
        c, s = np.cos(roll), np.sin(roll)
        fixed[:3, :3] = [[1, 0, 0], [0, c, -s], [0, s, c]]
        fixed[:3, 3] = origin
        c, s = np.cos(angle), np.sin(angle)
        turn[:2, :2] = [[c, -s], [s, c]]
        pose = pose @ fixed @ turn
    tool = np.eye(4)
    tool[2, 3] = TOOL
    return pose @ tool


@pytest.fixture(scope="module")
def robot_model() -> mujoco.MjModel:
    return build_world(make_scene()).model


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=50, deadline=None)
def test_kinematics_are_those_of_the_table(robot_model: mujoco.MjModel, seed: int) -> None:
    rng = np.random.default_rng(seed)
    joints = np.array([rng.uniform(*limits) for _, _, limits, _ in TABLE])
    data = mujoco.MjData(robot_model)
    for name, value in zip(ROBOT.joints, joints, strict=True):
        data.joint(f"robot/{name}").qpos[0] = value
    mujoco.mj_kinematics(robot_model, data)
    expected = forward(joints)
    site = data.site(f"robot/{ROBOT.tool_site}")
    assert site.xpos == pytest.approx(expected[:3, 3], abs=1e-4)
    assert site.xmat.reshape(3, 3) == pytest.approx(expected[:3, :3], abs=1e-4)


def test_limits_are_those_of_the_table(robot_model: mujoco.MjModel) -> None:
    for name, (_, _, limits, effort) in zip(ROBOT.joints, TABLE, strict=True):
        joint = robot_model.joint(f"robot/{name}")
        assert joint.range == pytest.approx(limits)
        assert robot_model.jnt_limited[joint.id]
        actuator = robot_model.actuator(f"robot/{name}")
        assert actuator.ctrlrange == pytest.approx(limits)
        assert -effort <= actuator.forcerange[0] < 0 < actuator.forcerange[1] <= effort


@pytest.mark.parametrize("index", range(6))
def test_masses_and_inertias_are_those_of_the_table(
    robot_model: mujoco.MjModel, index: int
) -> None:
    mass, center, (xx, yy, zz, xy, xz, yz) = LINKS[index]
    link = robot_model.body(f"robot/link{index + 1}")
    assert link.mass[0] == pytest.approx(mass)
    assert link.ipos == pytest.approx(center, abs=1e-6)
    axes = np.zeros(9)
    mujoco.mju_quat2Mat(axes, link.iquat)
    rotation = axes.reshape(3, 3)
    expected = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    assert rotation @ np.diag(link.inertia) @ rotation.T == pytest.approx(expected, abs=1e-6)


def test_total_mass(robot_model: mujoco.MjModel) -> None:
    """Links by the table, and a gripper of well below a kilogram."""
    links = sum(mass for mass, _, _ in LINKS)
    moving = robot_model.body("robot/link1").subtreemass[0]
    assert links == pytest.approx(9.35164)
    assert 0.4 < moving - links < 1.0


def test_arm_holds_its_home_against_gravity() -> None:
    stage = set_up(make_scene(), settle=2.0)
    robot = stage.world.robot
    assert stage.data.qpos[robot.qpos] == pytest.approx(robot.spec.home, abs=0.01)


def test_speed_of_the_arm_stays_below_the_makers() -> None:
    assert ROBOT.speed <= 3.14


def test_gripper_opens_and_closes_by_its_command() -> None:
    stage = set_up(make_scene())
    robot, gripper = stage.world.robot, stage.world.robot.spec.gripper
    pads = [stage.world.model.geom_size[pad][1] for pad in robot.pads]
    for command, opening in ((gripper.command_open, gripper.opening), (0.03, 0.03), (0.0, 0.0)):
        stage.data.ctrl[robot.gripper_ctrl] = command
        stage.step(1.0)
        assert stage.data.qpos[robot.finger_qpos].sum() == pytest.approx(opening, abs=0.002)
        left, right = (stage.data.geom_xpos[pad] for pad in robot.pads)
        assert np.linalg.norm(left - right) - sum(pads) == pytest.approx(opening, abs=0.002)


def test_gripper_never_opens_beyond_its_stops() -> None:
    stage = set_up(make_scene())
    robot = stage.world.robot
    stage.data.qfrc_applied[:] = 0.0
    for body in robot.finger_side:
        stage.data.joint(int(stage.world.model.body_jntadr[body])).qfrc_applied[0] = 20.0
    stage.step(0.5)
    assert stage.data.qpos[robot.finger_qpos].sum() < robot.spec.gripper.opening + 0.002


def test_gripper_force_is_limited() -> None:
    model = build_world(make_scene()).model
    limit = model.actuator("robot/gripper").forcerange
    assert limit == pytest.approx([-ROBOT.gripper.force, ROBOT.gripper.force])


def test_no_collision_at_home_and_with_the_arm_stretched() -> None:
    stage = set_up(make_scene(ball=BALL | {"at": [0.4, 0.4]}), settle=0.0)
    robot = stage.world.robot
    for joints in (robot.spec.home, (0, -0.3, -0.9, 0, 1.2, 0), (1.5, -0.5, -1.2, 1.0, 1.2, 2.0)):
        stage.data.qpos[robot.qpos] = joints
        mujoco.mj_forward(stage.world.model, stage.data)
        touching = {frozenset(stage.world.geom_object[g] for g in pair)
                    for pair in stage.data.contact.geom}  # fmt: skip
        assert not any("robot" in pair or "gripper" in pair for pair in touching), joints


# -- robots by YAML --------------------------------------------------------------------------------

MODEL = """<mujoco><worldbody><body name="b"><joint name="a"/><geom size="0.01"/>
<body name="c"><joint name="d"/><geom size="0.01"/><body name="e"><joint name="f"/>
<geom size="0.01"/><site name="tip"/>
<body name="l"><joint name="l" type="slide" axis="0 1 0" range="0 0.02" armature="0.05"/>
<geom name="lp" size="0.005" pos="0 0.005 0"/></body>
<body name="r"><joint name="r" type="slide" axis="0 -1 0" range="0 0.02" armature="0.05"/>
<geom name="rp" size="0.005" pos="0 -0.005 0"/></body></body></body></body></worldbody>
<equality><joint joint1="l" joint2="r" polycoef="0 1 0 0 0"/></equality>
<actuator><position name="a" joint="a"/><position name="d" joint="d"/><position name="f" joint="f"/>
<position name="g" joint="l" kp="50" kv="5"/></actuator></mujoco>"""
YAML = """name: tiny
model: tiny.xml
joints: [a, d, f]
actuators: [a, d, f]
tool_site: tip
home: [0.0, 0.0, 0.0]
gripper: {actuator: g, fingers: [l, r], pads: [lp, rp], opening: 0.04, command_open: 0.02}
"""


def robot_folder(tmp_path: Path, *replace: tuple[str, str]) -> Path:
    text = YAML
    for old, new in replace:
        assert old in text
        text = text.replace(old, new)
    (tmp_path / "tiny.yaml").write_text(text)
    (tmp_path / "tiny.xml").write_text(MODEL)
    return tmp_path


def test_robot_of_ones_own(tmp_path: Path) -> None:
    folder = robot_folder(tmp_path)
    assert load_robot("tiny.yaml", folder).model_path == folder / "tiny.xml"
    world = build_world(Scene.model_validate({"robot": "tiny.yaml", "directory": str(folder)}))
    assert len(world.robot.qpos) == 3
    assert world.robot.spec.gripper.opening == 0.04


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "joints: [a, d, f]",
            "joints: [a, d]",
            "tiny.yaml:3: joints: found 2, expected at least 3 entries",
        ),
        ("joints: [a, d, f]", "joints: [a, d, a]", "tiny.yaml:3: joints: found 'a' twice"),
        ("home: [0.0, 0.0, 0.0]", "home: [0, 0]", "yaml:6: home: found 2 entries, expected 3"),
        (
            "home: [0.0, 0.0, 0.0]",
            "home: [0, .nan, 0]",
            r"yaml:6: home\[1\]: found .nan, exp.*finite",
        ),
        ("home: [0.0, 0.0, 0.0]", "home: [0, 1e30, 0]", r"yaml:6: home\[1\]: .*at most 100"),
        ("opening: 0.04", "opening: 40", "tiny.yaml:7: gripper.opening: found 40, expected"),
        ("opening: 0.04", "opening: wide", "tiny.yaml:7: gripper.opening: found 'wide', expected"),
        ("command_open: 0.02", "command_open: 0", "yaml:7: gripper.command_open: .*another"),
        ("pads: [lp, rp]", "pads: [lp, lp]", "yaml:7: gripper.pads: found 'lp' twice"),
        ("name: tiny", "name: tiny\ncolour: red", "tiny.yaml:2: colour: unknown key"),
        ("name: tiny", "name: tiny\ndirectory: /", "tiny.yaml:2: directory: unknown key"),
        ("name: tiny", "name: ''", "tiny.yaml:1: name: "),
        ("name: tiny", "name: x\ndriver: {torque: [1]}", "2: driver.torque: found 1 entries"),
        ("name: tiny", "name: x\ndriver: {pulses_open: 0}", "2: driver.pulses_open: .*another"),
        ("name: tiny", "name: x\ndriver: {workspace: {low: [2, 0, 0]}}", "2: driver.workspace: "),
        ("tool_site: tip\n", "", "tiny.yaml:1: missing key 'tool_site'"),
        ("model: tiny.xml", "model: gone.xml", "yaml:2: model: missing file 'gone.xml'"),
        ("model: tiny.xml", "model: ../x.xml", "yaml:2: model: .*below the robot's own folder"),
        ("name: tiny", "name: [tiny", "tiny.yaml:2: not valid YAML"),
    ],
)
def test_unusable_robot_yaml(tmp_path: Path, old: str, new: str, message: str) -> None:
    with pytest.raises(SpecError, match=message):
        load_robot("tiny.yaml", robot_folder(tmp_path, (old, new)))


@pytest.mark.parametrize("text", ["", "- a\n- b\n", "just words"])
def test_robot_yaml_must_be_a_mapping(tmp_path: Path, text: str) -> None:
    (tmp_path / "tiny.yaml").write_text(text)
    with pytest.raises(SpecError, match="expected keys and values"):
        load_robot("tiny.yaml", tmp_path)


@pytest.mark.parametrize("robot", ["panda", "gone.yaml", "../xarm6", ""])
def test_unknown_robot_lists_the_known_ones(tmp_path: Path, robot: str) -> None:
    with pytest.raises(SpecError, match="expected one of xarm6"):
        load_robot(robot, tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        ("joints: [a, d, f]", "joints: [a, d, elbow]", "joints: found 'elbow'"),
        ("actuators: [a, d, f]", "actuators: [a, d, elbow]", "actuators: found 'elbow'"),
        ("tool_site: tip", "tool_site: nose", "tool_site: found 'nose'"),
        ("pads: [lp, rp]", "pads: [lp, thumb]", "gripper.pads: found 'thumb'"),
        ("fingers: [l, r]", "fingers: [l, thumb]", "gripper.fingers: found 'thumb'"),
    ],
)
def test_names_that_the_model_lacks(tmp_path: Path, old: str, new: str, found: str) -> None:
    folder = robot_folder(tmp_path, (old, new))
    ball = {"kind": "sphere", "diameter": 0.05, "at": [0.4, 0.0]}
    scene = {"robot": "tiny.yaml", "directory": str(folder), "objects": {"ball": ball}}
    with pytest.raises(WorldError, match=rf"robot tiny: {found}, expected a name in tiny\.xml: "):
        build_world(Scene.model_validate(scene))


@pytest.mark.parametrize(
    ("joint", "message"),
    [('type="ball"', "the joint a in tiny.xml neither turns"),
     ('range="57 90"', "home has 0 for the joint a, .* 0.99")],
)  # fmt: skip
def test_joints_that_are_none_of_an_arm(tmp_path: Path, joint: str, message: str) -> None:
    folder = robot_folder(tmp_path)
    model = MODEL.replace('<joint name="a"/>', f'<joint name="a" {joint}/>')
    (folder / "tiny.xml").write_text(model)
    with pytest.raises(WorldError, match=message):
        build_world(Scene.model_validate({"robot": "tiny.yaml", "directory": str(folder)}))


def test_fingers_that_both_pads_are_on(tmp_path: Path) -> None:
    folder = robot_folder(tmp_path, ("fingers: [l, r]", "fingers: [b, c]"))
    with pytest.raises(WorldError, match="both pads are on one finger"):
        build_world(Scene.model_validate({"robot": "tiny.yaml", "directory": str(folder)}))


def test_model_that_is_none(tmp_path: Path) -> None:
    folder = robot_folder(tmp_path)
    (folder / "tiny.xml").write_text("<mujoco><nonsense/></mujoco>")
    with pytest.raises(WorldError, match=r"tiny\.xml: not a valid MJCF model"):
        build_world(Scene.model_validate({"robot": "tiny.yaml", "directory": str(folder)}))


@pytest.mark.parametrize("folder", sorted(p.parent for p in BUILTIN_ROBOTS.glob("*/robot.yaml")))
def test_every_built_in_robot_builds(folder: Path) -> None:
    world = build_world(Scene.model_validate({"robot": folder.name}))
    spec = world.robot.spec
    assert np.all(world.robot.lower <= spec.home) and np.all(spec.home <= world.robot.upper)


# -- grippers of other makes -----------------------------------------------------------------------

XARM = BUILTIN_ROBOTS / "xarm6"
PAD = '<geom name="finger_{0}_pad" class="pad" size="0.011 0.005 0.0205" pos="0 {1}0.005 0.0825"/>'
JOINTS = {"left": ("", "0 1 0"), "right": ("-", "0 -1 0")}


def gripper(
    tmp_path: Path, change: Callable[[str], str], yaml: Callable[[str], str] = str
) -> Scene:
    """A scene with an xArm6 whose model is changed."""
    model = change((XARM / "xarm6.xml").read_text())
    (tmp_path / "xarm6.xml").write_text(model)
    (tmp_path / "arm.yaml").write_text(yaml((XARM / "robot.yaml").read_text()))
    return Scene.model_validate({"robot": "arm.yaml", "directory": str(tmp_path)})


def pads_on_bodies_of_their_own(model: str) -> str:
    for side, (sign, _) in JOINTS.items():
        pad = PAD.format(side, sign)
        assert pad in model
        model = model.replace(pad, f'<body name="tip_{side}" gravcomp="1">{pad}</body>')
    return model


def swinging_fingers(model: str) -> str:
    """Each finger turns about a hinge behind it, the right one as the left one does."""
    for side, (sign, axis) in JOINTS.items():
        model = model.replace(
            f'<joint name="finger_{side}" axis="{axis}"/>',
            f'<joint name="finger_{side}" type="hinge" axis="{"-" if not sign else ""}1 0 0" '
            'range="0 0.6" armature="0.01" damping="0.5"/>',
        )
    drive = '<position name="gripper" tendon="opening" kp="2000" kv="100"'
    assert drive in model
    model = model.replace(drive, '<position name="gripper" joint="finger_left" kp="50" kv="2"')
    return model.replace('ctrlrange="0 0.085"', 'ctrlrange="0 0.5"')


def tool_site_beside_the_fingers(model: str) -> str:
    site = '<site name="tool" pos="0 0 0.172" size="0.004" rgba="1 0.3 0.1 0.6" group="4"/>'
    assert site in model
    return model.replace(site, f'<body name="flange">{site}</body>')


@pytest.mark.parametrize(
    ("change", "yaml"),
    [
        (pads_on_bodies_of_their_own, str),
        (tool_site_beside_the_fingers, str),
        (
            swinging_fingers,
            lambda text: text.replace("opening: 0.085 ", "opening: 0.056 ").replace(
                "command_open: 0.085", "command_open: 0.47"
            ),
        ),
    ],
    ids=["pads on child bodies", "tool site elsewhere", "hinged and mimicked"],
)
def test_fingers_stand_at_the_opening_that_is_asked_for(
    tmp_path: Path, change: Callable[[str], str], yaml: Callable[[str], str]
) -> None:
    world = build_world(gripper(tmp_path, change, yaml))
    robot, data = world.robot, mujoco.MjData(world.model)
    for opening in (0.01, 0.03, 0.05):
        robot.set_opening(data, opening)
        mujoco.mj_kinematics(world.model, data)
        gap = mujoco.mj_geomDistance(world.model, data, *robot.pads, 1.0, None)
        assert gap == pytest.approx(opening, abs=1e-3)
        assert robot.opening(data) == pytest.approx(opening, abs=1e-3)
    assert {world.geom_address[pad] for pad in robot.pads} == {"gripper"}
    assert [robot.finger_side[int(world.model.geom_bodyid[pad])] for pad in robot.pads] == [0, 1]


def shortened(model: str) -> str:
    for side, (sign, _) in JOINTS.items():
        pad = PAD.format(side, sign)
        short = pad.replace("0.0205", "0.0155").replace("0.0825", "0.0775")
        link = f'<geom name="nail_{side}" size="0.002 0.002 0.005" pos="0 {sign}0.011 0.098"/>'
        model = model.replace(pad, short + link)
    return model


@pytest.mark.parametrize(
    ("change", "yaml", "message"),
    [
        (shortened, str, "the pads end 10 mm above the fingertips"),
        (
            lambda m: m.replace('pos="0 0 0.172"', 'pos="0 0 0.22"'),
            str,
            "before the tool point tool",
        ),
        (str, lambda y: y.replace("opening: 0.085 ", "opening: 0.14 "), "an opening of 140 mm"),
        (
            lambda m: m.replace('<site name="tool"', '<site name="tool" euler="0 0 1.5708"'),
            str,
            "do not close along the y axis of tool",
        ),
    ],
    ids=["short pads", "tool point too far", "wrong opening", "wrong axis"],
)
def test_what_can_never_grasp_is_said_when_a_scene_is_built(
    tmp_path: Path,
    change: Callable[[str], str],
    yaml: Callable[[str], str],
    message: str,
) -> None:
    with pytest.raises(WorldError, match=message):
        build_world(gripper(tmp_path, change, yaml))
