"""Known meshes are found again where they were rendered: pose, way of resting and scale."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
import trimesh

from etot_cli.errors import SpecError
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.options import Options
from etot_cli.reconstruction.pipeline import Twin, reconstruct
from etot_cli.reconstruction.registration.model import resting_turns
from etot_cli.specs.scene import Scene
from etot_cli.world.capture import KINECT, Picture, add_noise, write_capture
from tests.reconstruction.conftest import render
from tests.reconstruction.meshes import ALL, angle_block, mug, toy
from tests.reconstruction.scenes import scene

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("fitted_once")]


PLACES = {
    "angle_block": ([0.40, -0.22], 20),
    "mug": ([0.42, 0.02], 135),
    "toy": ([0.45, 0.24], 250),
}
CLEAN = (0.001, 1.0)
"""Largest errors of place [m] and of turn [deg] in clean pictures."""
HIDDEN = (0.005, 3.0)
SIDEWAYS = [0.7071068, 0.7071068, 0.0, 0.0]


def thing(name: str, **other: Any) -> dict[str, Any]:
    return {"kind": "mesh", "file": f"{name}.obj", "mass": 0.2, "color": "orange", **other}


def on_desk(folder: Path, **objects: dict[str, Any]) -> Scene:
    """A scene with the meshes written beside it."""
    for name, make in ALL.items():
        make().export(folder / f"{name}.obj")
    return scene(objects).model_copy(update={"directory": str(folder)})


def library(folder: Path, text: str, name: str = "known.yaml") -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def errors(solid: Solid, picture: Picture, name: str) -> tuple[float, float]:
    """Errors of the mesh's middle [m] and of its turn [deg]."""
    assert solid.model is not None
    true = picture.truth["objects"][name]
    vertices = np.asarray(ALL[name]().vertices)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    pose, turn = solid.model.pose, np.zeros(9)
    mujoco.mju_quat2Mat(turn, np.array(true["quaternion"]))
    cosine = (np.trace(turn.reshape(3, 3).T @ pose[:3, :3]) - 1) / 2
    place = pose[:3, :3] @ middle + pose[:3, 3]
    return (
        float(np.linalg.norm(place - true["position"])),
        float(np.degrees(np.arccos(np.clip(cosine, -1, 1)))),
    )


def solids(twin: Twin) -> dict[str, Solid]:
    return {solid.name: solid for solid in twin.solids}


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("known")


@pytest.fixture(scope="module")
def three(home: Path) -> Picture:
    """Three meshes that are alike from no two sides."""
    objects = {name: thing(name, at=place, yaw_deg=yaw) for name, (place, yaw) in PLACES.items()}
    picture = render(on_desk(home, **objects))
    write_capture(picture, home / "three")
    return picture


@pytest.fixture(scope="module")
def known(home: Path) -> Path:
    """A library of the three, in metres."""
    lines = [f"  {name}: {{kind: mesh, file: {name}.obj, mass: 0.25}}" for name in ALL]
    return library(home, "objects:\n" + "\n".join(lines) + "\n")


def test_known_meshes_in_a_clean_picture(three: Picture, home: Path, known: Path) -> None:
    twin = reconstruct(Options(capture=home / "three", library=known, settle=False))
    for name, solid in solids(twin).items():
        off, turned = errors(solid, three, name)
        assert off < CLEAN[0], f"{name} is off by {1000 * off:.2f} mm"
        assert turned < CLEAN[1], f"{name} is turned by {turned:.2f}°"
        assert solid.fit.explained > 0.98
        assert solid.warnings == ()
        assert twin.document["objects"][name]["mass"] == 0.25


def test_unknown_scale_is_found(three: Picture, home: Path, tmp_path: Path) -> None:
    """A mesh in millimetres, y up as GLB is."""
    mesh = mug()
    vertices = np.asarray(mesh.vertices) * 1000
    trimesh.Trimesh(vertices[:, [0, 2, 1]] * [1, 1, -1], mesh.faces).export(tmp_path / "it.glb")
    options = Options(capture=home / "three", meshes={"mug": tmp_path / "it.glb"}, settle=False)
    solid = solids(reconstruct(options))["mug"]
    assert solid.model is not None
    assert solid.model.metres_per_unit == pytest.approx(0.001, rel=0.01)
    true = three.truth["objects"]["mug"]
    assert np.linalg.norm(solid.center - true["position"]) < 0.0015
    # In the file y points up and the handle along x.
    assert solid.model.pose[:3, 1] == pytest.approx([0, 0, 1], abs=1e-6)
    heading = np.degrees(np.arctan2(solid.model.pose[1, 0], solid.model.pose[0, 0]))
    assert heading == pytest.approx(PLACES["mug"][1], abs=1.0)


def test_partly_hidden_and_lying_on_a_side(home: Path, known: Path) -> None:
    screen = {"kind": "box", "size": [0.05, 0.05, 0.08], "color": "blue", "at": [0.54, 0.01]}
    what = on_desk(
        home, mug=thing("mug", at=[0.42, 0.02], yaw_deg=70), screen=screen,
        angle_block=thing("angle_block", at=[0.45, 0.26], quaternion=SIDEWAYS),
    )  # fmt: skip
    picture = render(what)
    write_capture(picture, home / "hidden")
    found = solids(reconstruct(Options(capture=home / "hidden", library=known, settle=False)))
    off, turned = errors(found["mug"], picture, "mug")
    assert off < HIDDEN[0] and turned < HIDDEN[1]
    off, turned = errors(found["angle_block"], picture, "angle_block")
    assert off < CLEAN[0] and turned < CLEAN[1]
    assert found["angle_block"].size[2] == pytest.approx(0.07, abs=0.001)


def test_noise_and_displaced_depth(three: Picture, home: Path, known: Path) -> None:
    noisy = add_noise(three, KINECT, np.random.default_rng(2))
    write_capture(noisy, home / "noisy", scale=KINECT.scale)
    found = solids(reconstruct(Options(capture=home / "noisy", library=known, settle=False)))
    for name, solid in found.items():
        off, turned = errors(solid, three, name)
        assert off < HIDDEN[0] and turned < HIDDEN[1], f"{name}: {1000 * off:.1f} mm, {turned:.1f}°"


def test_a_wrong_model_is_noticed(three: Picture, home: Path) -> None:
    """Asked for, it is used with a warning; from a library, it is not used."""
    alone = home / "alone"  # only one of the three is pointed out, so that only one is fitted
    write_capture(replace(three, masks={"toy": three.masks["toy"]}), alone)
    options = Options(capture=alone, meshes={"toy": home / "mug.obj"}, settle=False)
    solid = solids(reconstruct(options))["toy"]
    assert solid.kind == "mesh"
    assert any("does not fit what is seen" in text for text in solid.warnings)
    text = "objects:\n  block: {kind: mesh, file: mug.obj, names: [toy]}\n"
    wrong = library(home, text, "wrong.yaml")
    solid = solids(reconstruct(Options(capture=alone, library=wrong, settle=False)))["toy"]
    assert solid.model is None
    assert any("its shape is fitted instead" in text for text in solid.warnings)


def test_an_instruction_names_things_of_the_library(
    three: Picture, home: Path, known: Path
) -> None:
    """Masks are found here, and they may be less exact than given ones: a handle may be missing."""
    twin = reconstruct(
        Options(capture=home / "three", auto=True, library=known, settle=False,
                instruction="Put the mugs beside the angle block.")
    )  # fmt: skip
    found = solids(twin)
    assert {"mug", "angle_block"} <= set(found)
    assert errors(found["angle_block"], three, "angle_block")[0] < HIDDEN[0]
    assert sum(solid.model is not None for solid in twin.solids) == 2


def test_known_kinds_keep_their_size(table: Scene, folder: Path, picture: Picture) -> None:
    """Whatever the picture says about size, the library knows better."""
    text = """
    objects:
      tumbler: {kind: cup, diameter: 0.0925, height: 0.0785, names: [mug], mass: 0.4}
      parcel: {kind: box, size: [0.06, 0.14, 0.10], names: [crate], label: parcel}
      biro: {kind: pen, length: 0.12, diameter: 0.018, names: [marker]}
      bead: {kind: sphere, diameter: 0.01, names: [ball]}
    """
    twin = reconstruct(Options(capture=folder, library=library(folder, text), settle=False))
    found, objects = solids(twin), twin.document["objects"]
    assert (objects["mug"]["diameter"], objects["mug"]["height"]) == (0.0925, 0.0785)
    assert objects["mug"]["mass"] == 0.4
    assert sorted(objects["crate"]["size"]) == [0.06, 0.10, 0.14]
    assert objects["crate"]["size"][2] == 0.06
    assert objects["marker"]["length"] == 0.12
    assert any("bead" in text and "does not fit" in text for text in found["ball"].warnings)
    for name in ("mug", "crate", "marker"):
        true = picture.truth["objects"][name]["position"]
        assert np.linalg.norm(found[name].center - true) < 0.002


def test_another_size_than_the_picture_s_is_noticed(folder: Path) -> None:
    text = "objects:\n  mug: {kind: cup, diameter: 0.0925, height: 0.0985}\n"
    known = library(folder, text, "tall.yaml")
    found = solids(reconstruct(Options(capture=folder, library=known, settle=False)))
    assert found["mug"].size[2] == 0.0985
    assert any("picture alone says" in text for text in found["mug"].warnings)
    right = library(folder, text.replace("0.0985", "0.0785"), "right.yaml")
    found = solids(reconstruct(Options(capture=folder, library=right, settle=False)))
    assert not any("picture alone says" in text for text in found["mug"].warnings)


BAD = {
    "no objects": ("models: {}", r"known\.yaml:1: missing key 'objects'"),
    "a list": ("objects: []", r"known\.yaml:1: objects: found .*, expected known things by name"),
    "no file": ("objects:\n  cup: {kind: mesh, file: gone.obj}",
                r"known\.yaml:2: objects\.cup\.file: there is no file 'gone\.obj'"),
    "outside": ("objects:\n  cup: {kind: mesh, file: ../it.obj}", "leaves the folder"),
    "size": ("objects:\n  cup:\n    kind: cup\n    diameter: 80\n    height: 0.1",
             r"known\.yaml:4: objects\.cup\.diameter: found 80, expected a length in metres"),
    "unknown key": ("objects:\n  ball: {kind: sphere, diameter: 0.1, weight: 3}",
                    r"known\.yaml:2: objects\.ball\.weight: unknown key 'weight'"),
    "names": ("objects:\n  ball:\n    kind: sphere\n    diameter: 0.1\n    names: orb",
              r"known\.yaml:5: objects\.ball\.names: found 'orb', expected a list"),
    "shared name": ("objects:\n  a: {kind: sphere, diameter: 0.1, names: [ball]}\n"
                    "  ball: {kind: sphere, diameter: 0.2}",
                    r"known\.yaml:3: objects\.ball: is called 'ball', which 'a' is called too"),
    "kind": ("objects:\n  rack: {kind: shelf, size: [0.1, 0.1, 0.1]}", "a shelf cannot be looked"),
    "no mesh": ("objects:\n  cup: {kind: mesh, file: broken.obj}",
                r"objects\.cup\.file: broken\.obj: "),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_a_bad_library_is_one_clear_error(case: str, folder: Path, tmp_path: Path) -> None:
    text, message = BAD[case]
    (tmp_path / "broken.obj").write_text("v 0 0 0\nf 1 1 1\n")
    options = Options(capture=folder, library=library(tmp_path, text), settle=False)
    with pytest.raises(SpecError, match=message):
        reconstruct(options)


def test_ways_of_resting() -> None:
    """The identity first; a slab has two large sides, which tip last."""
    slab = np.asarray(trimesh.creation.box([0.1, 0.06, 0.02]).vertices)
    turns = resting_turns(slab)
    assert np.array_equal(turns[0], np.eye(3))
    assert len(turns) == 6
    for turn in turns:
        assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-9)
        assert np.linalg.det(turn) == pytest.approx(1.0)
    heights = [float(np.ptp(slab @ turn.T, axis=0)[2]) for turn in turns]
    assert heights[:2] == pytest.approx([0.02, 0.02])
    assert len(resting_turns(np.asarray(angle_block().vertices))) >= 5
    assert len(resting_turns(np.asarray(toy().vertices))) >= 4
