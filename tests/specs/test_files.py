"""Files that scenes name: only from their own folder tree, present, small, of a known format."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.benchmark.suite import digest
from etot_cli.errors import SpecError
from etot_cli.specs import files
from etot_cli.specs.load import load_scene, load_task
from etot_cli.specs.objects import Mesh
from etot_cli.specs.scene import Scene
from tests.specs.helpers import objects, scene_error, write

MESH = "{{kind: mesh, file: {}, at: [0.4, 0]}}"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inner = tmp_path / "scenes"
    write(inner, "duck.obj", "v 0 0 0")
    write(inner, "parts/duck.STL", "x")
    write(inner, "parts/tap.xml", "x")
    write(tmp_path, "outside.obj", "x")
    (inner / "link.obj").symlink_to(tmp_path / "outside.obj")
    (inner / "parts" / "up").symlink_to(tmp_path)
    (inner / "renamed.obj").symlink_to(inner / "parts" / "tap.xml")
    (inner / "loop.obj").symlink_to(inner / "loop.obj")
    (inner / "folder.obj").mkdir()
    return inner


def mesh_file(scene: Scene) -> Path:
    duck = scene.objects["duck"]
    assert isinstance(duck, Mesh)
    return Path(scene.directory) / duck.file


@pytest.mark.parametrize("name", ["duck.obj", "parts/duck.STL", "./duck.obj"])
def test_found(name: str, folder: Path) -> None:
    scene = load_scene(write(folder, "scene.yaml", objects(duck=MESH.format(name))))
    assert mesh_file(scene).samefile(folder / name)
    assert scene.directory == str(folder.resolve())


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("goose.obj", "there is no file 'goose.obj' beside scene.yaml"),
        ("duck.fbx", "found 'duck.fbx', expected a file ending in .obj or .stl or .glb"),
        ("scene.yaml", "expected a file ending in .obj"),
        ("parts/tap.xml", "expected a file ending in .obj"),
        ("../outside.obj", "'../outside.obj' leaves the folder of the file that names it"),
        ("parts/../duck.obj", "leaves the folder of the file that names it"),
        ("parts/up/outside.obj", "leaves the folder of the file that names it"),
        ("link.obj", "'link.obj' leaves the folder of the file that names it"),
        ("/etc/x.obj", "found '/etc/x.obj', expected a relative path with forward slashes"),
        ("C:\\x.obj", "expected a relative path with forward slashes"),
        ('"a\\0.obj"', "expected a relative path"),
        ("renamed.obj", "'renamed.obj' is a link to a file of another format"),
        ("folder.obj", "there is no file 'folder.obj'"),
        ("loop.obj", "which cannot be followed"),
        ("x" * 3000 + ".obj", "objects.duck.file: "),
    ],
)
def test_refused(name: str, message: str, folder: Path) -> None:
    error = scene_error(folder, objects(duck=MESH.format(name)))
    assert error.startswith("scene.yaml:2: objects.duck.file: ")
    assert message in error


@pytest.mark.parametrize("name", ["/etc/x.obj", "../outside.obj", "goose.obj", "scene.yaml"])
@pytest.mark.parametrize("listed", [False, True])
def test_what_is_added_later_is_looked_at_alike(name: str, listed: bool, folder: Path) -> None:
    write(folder, "scene.yaml", objects(duck=MESH.format("duck.obj")))
    text = "instruction: x\nscene: scene.yaml\nsuccess: [{present: duck}]\ndisturbance:"
    deed = "{add: goose, object: {kind: mesh, file: %s, mass: 0.1, at: [0.4, 0.2]}}"
    deed = f"[{deed}]" if listed else deed
    with pytest.raises(SpecError, match=r"t\.yaml:4: disturbance(\[0\])?\.object\.file: "):
        load_task(write(folder, "t.yaml", f"{text} {deed % name}"))
    task = load_task(write(folder, "t.yaml", f"{text} {deed % 'duck.obj'}"))
    assert task.disturbances[0].object is not None


def test_too_large(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "MAX_FILE_BYTES", 3)
    assert "'duck.obj' is larger than" in scene_error(folder, objects(duck=MESH.format("duck.obj")))


def test_the_file_of_an_included_object_is_beside_its_own_document(folder: Path) -> None:
    write(folder, "scene.yaml", objects(duck=MESH.format("parts/duck.STL")))
    text = "include: ../scenes/scene.yaml\nobjects: {duck: {mass: 0.1}}"
    scene = load_scene(write(folder.parent / "mine", "s.yaml", text))
    assert scene.directory == str((folder.parent / "mine").resolve())
    assert mesh_file(scene).samefile(folder / "parts" / "duck.STL")
    # Given anew, it is relative to the file that gives it.
    text = "include: ../scenes/scene.yaml\nobjects: {duck: {file: duck.obj}}"
    error = scene_error(folder.parent / "mine", text, "own.yaml")
    assert "own.yaml:2: objects.duck.file: there is no file 'duck.obj' beside own.yaml" in error
    task = "instruction: x\nscene: ../scenes/scene.yaml\nsuccess: [{present: duck}]"
    assert mesh_file(load_task(write(folder.parent / "mine", "t.yaml", task)).scene).is_file()


def test_mjcf_and_robot_files(folder: Path) -> None:
    text = objects(tap="{kind: mjcf, file: parts/tap.xml, at: [0.4, 0]}")
    assert load_scene(write(folder, "scene.yaml", text)).objects["tap"].kind == "mjcf"
    error = scene_error(folder, objects(tap="{kind: mjcf, file: duck.obj, at: [0.4, 0]}"))
    assert "expected a file ending in .xml or .mjcf" in error
    write(folder, "arm.yaml", "x: 1")
    assert load_scene(write(folder, "scene.yaml", "robot: ./arm.yaml")).robot == "arm.yaml"
    assert "robot: there is no file 'leg.yaml'" in scene_error(folder, "robot: leg.yaml")
    assert "leaves the folder" in scene_error(folder, "robot: ../arm.yaml")
    assert load_scene(write(folder, "scene.yaml", "name: x")).robot == "xarm6"


def test_a_task_knows_its_files_by_their_content(folder: Path) -> None:
    write(folder, "arm.yaml", "x: 1")
    write(folder, "base.yaml", "robot: arm.yaml\n" + objects(duck=MESH.format("duck.obj")))
    write(folder, "scene.yaml", "include: base.yaml\nname: desk")
    write(folder.parent / "mine", "late.obj", "v 0 0 0")
    text = "instruction: x\nscene: ../scenes/scene.yaml\nsuccess: [{present: duck}]\n"
    text += "disturbance: {add: late, object: " + MESH.format("late.obj") + "}"
    task = write(folder.parent / "mine", "t.yaml", text)
    before = load_task(task).inputs
    scenes = [f"../scenes/{name}" for name in ("arm.yaml", "base.yaml", "duck.obj", "scene.yaml")]
    assert list(before) == [*scenes, "late.obj", "t.yaml"]
    known = digest(load_task(task))
    for changed in ("../scenes/duck.obj", "../scenes/arm.yaml", "late.obj"):
        write(task.parent, changed, "x: 2")
        loaded = load_task(task)
        after = loaded.inputs
        assert {name for name in before if before[name] != after[name]} == {changed}
        assert digest(loaded) != known, "a run with it is not gone on with without it"
        before, known = after, digest(loaded)
