"""Pictures for people: what is in them, how soft they are, and who makes them."""

from __future__ import annotations

import time
from pathlib import Path

import mujoco
import numpy as np
import pytest

from etot_cli.control.simulated_world import SimulatedWorld
from etot_cli.specs.load import load_scene
from etot_cli.specs.scene import Scene
from etot_cli.world.captions import caption_strip, strip_height
from etot_cli.world.framing import workspace_camera
from etot_cli.world.model import build_world
from etot_cli.world.offscreen import OffscreenRenderer
from etot_cli.world.pictures import PictureRenderer, outline
from etot_cli.world.studio import FEW, Shot, Studio, take

SCENES = sorted((Path(__file__).parents[2] / "scenes").glob("*.yaml"))
SIZE = (320, 200)
SCENE = Scene.model_validate(
    {
        "objects": {
            "block": {"kind": "box", "at": [0.4, 0.2], "size": [0.06, 0.06, 0.06], "color": "red"},
            "chest": {"kind": "drawer_unit", "at": [0.45, -0.1], "yaw_deg": -90,
                      "size": [0.2, 0.18, 0.15], "drawers": [{"name": "top"}]},
        }
    }
)  # fmt: skip


def start(scene: Scene) -> np.ndarray:
    workshop = SimulatedWorld(scene)
    workshop.start()
    return np.array(workshop.data.qpos)


@pytest.fixture(scope="module")
def qpos() -> np.ndarray:
    return start(SCENE)


@pytest.mark.parametrize("path", SCENES, ids=[path.stem for path in SCENES])
def test_dressed_world_has_the_same_joints_and_contacts(path: Path) -> None:
    scene = load_scene(path)
    plain, dressed = build_world(scene), build_world(scene, dressed=True)
    assert plain.model.nq == dressed.model.nq and plain.model.nbody == dressed.model.nbody
    joints = [
        [world.model.joint(i).name for i in range(world.model.njnt)] for world in (plain, dressed)
    ]
    assert joints[0] == joints[1]
    touching = [int((world.model.geom_contype > 0).sum()) for world in (plain, dressed)]
    assert touching[0] == touching[1]
    assert plain.model.body_mass == pytest.approx(dressed.model.body_mass)


@pytest.mark.render
@pytest.mark.parametrize("path", SCENES, ids=[path.stem for path in SCENES])
@pytest.mark.slow
def test_robot_and_objects_are_wholly_in_the_picture(path: Path) -> None:
    scene = load_scene(path)
    world = build_world(scene, dressed=True)
    at = start(scene)
    camera = workspace_camera(world, at, *SIZE)
    data = mujoco.MjData(world.model)
    data.qpos[:] = at
    mujoco.mj_forward(world.model, data)
    with OffscreenRenderer(world.model, *SIZE) as renderer:
        renderer.look(data, camera)
        _, geoms = renderer.depth_and_geoms()
    owners = np.array([*world.geom_object, ""])[geoms]
    border = {*owners[0], *owners[-1], *owners[:, 0], *owners[:, -1]}
    for name in (*world.entries, "robot", "gripper"):
        assert (owners == name).any(), f"{name} is not seen"
        assert name not in border, f"{name} is cropped"
    rows, columns = np.nonzero(np.isin(owners, [*world.entries, "robot", "gripper"]))
    if not world.entries:
        return  # a desk with nothing on it
    assert np.ptp(rows) > 0.6 * SIZE[1] or np.ptp(columns) > 0.6 * SIZE[0], "much empty desk"


@pytest.mark.render
@pytest.mark.slow
def test_samples_soften_edges_and_shadows(qpos: np.ndarray) -> None:
    pictures = []
    for samples in (1, 8):
        with PictureRenderer(SCENE, qpos, *SIZE, samples) as renderer:
            pictures.append(renderer.take(qpos).astype(float))
    hard, soft = (np.abs(np.diff(picture, axis=1)).max(axis=2) for picture in pictures)
    assert (soft > 90).mean() < 0.8 * (hard > 90).mean(), "fewer jumps between neighbours"
    assert abs(pictures[0].mean() - pictures[1].mean()) < 2.0, "the same light"


@pytest.mark.render
@pytest.mark.slow
def test_culprits_are_outlined_in_red(qpos: np.ndarray) -> None:
    with PictureRenderer(SCENE, qpos, 640, 400, 1) as renderer:
        plain = renderer.take(qpos).astype(int)
        marked = renderer.take(qpos, ("chest",)).astype(int)
    changed = np.abs(plain - marked).sum(axis=2) > 60
    assert 200 < changed.sum() < 0.1 * 640 * 400


def test_an_unseen_object_gets_no_outline() -> None:
    image = np.full((40, 60, 3), 200, dtype=np.uint8)
    assert outline(image, np.zeros((40, 60), dtype=bool), "x") is image


def test_long_captions_are_cut() -> None:
    words = "long words " * 40
    height = strip_height(["", "short", words], 320)
    assert height == strip_height([words], 320) < 3 * strip_height(["short"], 320)
    strip = caption_strip(words, 320, height, "plain")
    assert strip.shape == (height, 320, 3)
    assert (strip[-20:-8] < 100).any(), "the last line is in it"
    assert strip[:, -4:].min() > 180 and strip[-2:, 10:].min() > 180, "nothing runs out of it"


@pytest.mark.render
@pytest.mark.slow
def test_captions_cover_nothing(qpos: np.ndarray) -> None:
    """Pictures of one film show the same piece of the world, whatever is written below them."""
    captions = ("", "short", "long words " * 40)
    taken = take(Studio(SCENE, qpos, *SIZE, samples=1), [Shot(qpos, (), text) for text in captions])
    seen = SIZE[1] - strip_height(list(captions), SIZE[0])
    first, *others = (image for image in taken if isinstance(image, np.ndarray))
    assert len(others) == 2 and first.shape == (SIZE[1], SIZE[0], 3)
    for image in others:
        assert np.array_equal(image[:seen], first[:seen])
        assert (image[seen:] != first[seen:]).any()


@pytest.mark.render
@pytest.mark.slow
def test_processes_take_the_same_pictures(qpos: np.ndarray) -> None:
    shots = [Shot(qpos + 0.01 * number) for number in range(FEW + 2)]
    studio = Studio(SCENE, qpos, *SIZE, samples=1)
    told: list[tuple[int, int]] = []
    here = take(studio, shots, jobs=1)
    there = take(studio, shots, jobs=2, progress=lambda *state: told.append(state))
    for one, other in zip(here, there, strict=True):
        assert isinstance(one, np.ndarray) and np.array_equal(one, other)
    assert told[-1] == (len(shots), len(shots))


@pytest.mark.render
@pytest.mark.slow
def test_time_limit_leaves_pictures_out(qpos: np.ndarray) -> None:
    began = time.monotonic()
    studio = Studio(SCENE, qpos, *SIZE, samples=1, encoding="webp")
    taken = take(studio, [Shot(qpos)] * 3, seconds=0.0)
    assert taken == [None] * 3
    assert time.monotonic() - began < 20
