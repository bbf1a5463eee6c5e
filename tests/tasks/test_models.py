"""What the world makes of models from files, of other arms and of a shelf's boards."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
import trimesh
import yaml

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.control.simulator import known_targets
from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.scene import Scene
from etot_cli.world.model import build_world
from etot_cli.world.state import SceneState

FOLDER = Path(__file__).parent
DOCS = FOLDER.parents[1] / "docs"

POT = """
<mujoco>
  <worldbody>
    <body name="pot">
      <geom type="cylinder" size="0.04 0.003" pos="0 0 -0.032" mass="0.1"/>
      <geom type="box" size="0.003 0.04 0.035" pos="0.04 0 0" mass="0.05"/>
      <geom type="box" size="0.003 0.04 0.035" pos="-0.04 0 0" mass="0.05"/>
      <geom type="box" size="0.04 0.003 0.035" pos="0 0.04 0" mass="0.05"/>
      <geom type="box" size="0.04 0.003 0.035" pos="0 -0.04 0" mass="0.05"/>
      <site name="hollow" type="box" size="0.037 0.037 0.032" pos="0 0 0.003"/>
    </body>
  </worldbody>
</mujoco>
"""


def started(scene: Scene) -> SceneState:
    return SimulatedWorld(scene, keep_frames=False).start()[1]


def scene_of(text: str, folder: Path) -> Scene:
    file = folder / "scene.yaml"
    file.write_text(text, encoding="utf-8")
    return load_scene(file)


def test_vessel_from_a_model(tmp_path: Path) -> None:
    (tmp_path / "pot.xml").write_text(POT, encoding="utf-8")
    scene = scene_of(
        """
objects:
  pot: {kind: mjcf, file: pot.xml, at: [0.4, 0.1], container_site: hollow}
  marble: {kind: sphere, inside: pot, diameter: 0.03, mass: 0.02}
  cover: {kind: box, on: pot, size: [0.09, 0.09, 0.006], mass: 0.05}
""",
        tmp_path,
    )
    state = started(scene)
    assert state.states["cover"].on == ("pot",) and state.states["cover"].inside is None
    assert state.infos["pot"].container and state.infos["pot"].movable
    assert state.states["marble"].inside == "pot"
    assert state.infos["pot"].mass == pytest.approx(0.3)


def test_chest_from_a_model() -> None:
    state = started(load_task(FOLDER / "mujoco_models.yaml").scene)
    caddy = state.infos["caddy"]
    assert [part.address for part in caddy.parts] == ["caddy.upper", "caddy.lower"]
    assert all(part.container for part in caddy.parts)
    assert caddy.surface and not caddy.container and not caddy.movable
    assert state.states["matchbox"].on == ("caddy",)


def test_boards_of_a_shelf(tmp_path: Path) -> None:
    scene = scene_of(
        """
objects:
  rack: {kind: shelf, at: [0.45, 0.1], size: [0.2, 0.3, 0.4], boards: [low, middle, high]}
  tin: {kind: cylinder, on: rack.high, diameter: 0.06, height: 0.08, mass: 0.1}
""",
        tmp_path,
    )
    state = started(scene)
    assert state.infos["rack"].boards == ("low", "middle", "high")
    assert state.states["tin"].on == ("rack.high",)
    assert {"rack", "rack.low", "rack.high"} <= set(known_targets(state))


def test_fingertips_are_measured() -> None:
    built_in = build_world(load_task(FOLDER / "too_big.yaml").scene).robot
    other = build_world(load_task(FOLDER / "seven_joints.yaml").scene).robot
    assert (built_in.tip, built_in.finger_half) == pytest.approx((0.0075, 0.0125))
    assert (other.tip, other.finger_half) == pytest.approx((0.018, 0.0135))
    assert len(other.qpos) == 7 and other.spec.gripper.opening == 0.11


def test_arm_starts_where_its_home_is() -> None:
    scene = load_task(FOLDER / "seven_joints.yaml").scene
    shop = SimulatedWorld(scene, keep_frames=False)
    shop.start()
    robot = shop.world.robot
    assert shop.data.qpos[robot.qpos] == pytest.approx(robot.spec.home, abs=0.01)
    tool = shop.twin.arm.forward(shop.data.qpos[robot.qpos])
    assert tool.rotation[2, 2] < -0.99
    assert shop.world.model.njnt == 7 + 2 + 3


def examples(page: str) -> list[str]:
    text = (DOCS / page).read_text(encoding="utf-8")
    return re.findall(r"```yaml\n(.*?)```", text, flags=re.DOTALL)


def test_robot_example_of_the_documentation() -> None:
    shown = yaml.safe_load(examples("robots.md")[1])
    file = FOLDER / "robots/heron/robot.yaml"
    assert shown == yaml.safe_load(file.read_text(encoding="utf-8"))


@pytest.mark.parametrize("text", examples("objects.md"))
def test_object_examples_of_the_documentation(text: str, tmp_path: Path) -> None:
    shutil.copytree(FOLDER / "objects", tmp_path / "objects")
    (tmp_path / "meshes").mkdir()
    trimesh.creation.box((90.0, 60.0, 50.0)).export(tmp_path / "meshes/teapot.obj")
    assert started(scene_of(text, tmp_path)).infos
