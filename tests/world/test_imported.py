"""Objects from files: meshes with their cache, and MJCF models."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
import trimesh

from etot_cli.errors import WorldError
from etot_cli.world.build import pieces
from etot_cli.world.model import World, build_world
from tests.world.helpers import BALL, Stage, make_scene, set_up

RING = trimesh.creation.annulus(0.025, 0.045, 0.03, sections=12)


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ETOT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture(scope="module")
def ring_pieces(tmp_path_factory: pytest.TempPathFactory) -> list[Any]:
    """What the ring is split into; splitting takes more than a second."""
    folder = tmp_path_factory.mktemp("ring")
    RING.export(folder / "ring.stl")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ETOT_CACHE", str(folder / "cache"))
        made, split = [], pieces._decompose
        patch.setattr(pieces, "_decompose", lambda *args: made.append(split(*args)) or made[-1])
        mesh_world(folder, "ring.stl")
    (found,) = made
    return found


@pytest.fixture
def splits(ring_pieces: list[Any], monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Gets an entry for every mesh that is split instead of read; all into the ring's pieces."""
    made: list[int] = []
    monkeypatch.setattr(pieces, "_decompose", lambda *args: made.append(1) or ring_pieces)
    return made


def mesh_world(folder: Path, name: str, **more: Any) -> World:
    thing = {"kind": "mesh", "file": name, "at": [0.4, 0.0], "mass": 0.1}
    return build_world(make_scene(folder, thing=thing | more))


# -- meshes ----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["stl", "obj", "glb"])
def test_mesh_keeps_its_hole(
    tmp_path: Path, cache: Path, ending: str, ring_pieces: list[Any]
) -> None:
    """Convex pieces follow the ring: through its middle a line is free, through its wall not."""
    RING.export(tmp_path / f"ring.{ending}")
    stage = set_up(make_scene(tmp_path, thing={"kind": "mesh", "file": f"ring.{ending}",
                                               "at": [0.4, 0.0], "mass": 0.1}))  # fmt: skip
    assert stage.world.entries["thing"].info.size == pytest.approx((0.09, 0.09, 0.03), abs=1e-4)
    assert len(stage.world.geoms_of("thing")) > 3
    hit = np.zeros(1, dtype=np.int32)
    found = {}
    for name, x in (("hole", 0.0), ("wall", 0.035)):
        origin = stage.data.body("thing").xpos + np.array([x, 0.0, 0.2])
        mujoco.mj_ray(
            stage.world.model, stage.data, origin, np.array([0.0, 0.0, -1.0]), None, 1, -1, hit
        )
        found[name] = stage.world.geom_object[int(hit[0])]
    assert found == {"hole": "desk", "wall": "thing"}
    if ending == "stl":
        for piece, before in zip(kept(cache), ring_pieces, strict=True):
            np.testing.assert_array_equal(piece, before, "the same mesh, the same pieces")


def kept(cache: Path) -> list[Any]:
    """The pieces in the only entry of the cache."""
    (entry,) = cache.iterdir()
    with np.load(entry) as stored:
        return [stored[name] for name in stored.files]


def test_scale_and_offset(tmp_path: Path, cache: Path) -> None:
    """A file in millimetres whose origin lies far off is scaled and centred."""
    box = trimesh.creation.box(extents=(60, 40, 20))
    box.apply_translation((500, 0, 90))
    box.export(tmp_path / "box.stl")
    world = mesh_world(tmp_path, "box.stl", scale=0.001)
    assert world.entries["thing"].info.size == pytest.approx((0.06, 0.04, 0.02), abs=1e-6)
    stage = Stage(world, mujoco.MjData(world.model), memory=None)  # type: ignore[arg-type]
    stage.move("thing", [0.0, 0.0, 1.0], [1, 0, 0, 0])
    mujoco.mj_kinematics(world.model, stage.data)
    assert stage.data.body("thing").xipos == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)


@pytest.mark.slow
def test_hollow_mesh_is_a_container(tmp_path: Path, cache: Path, splits: list[int]) -> None:
    RING.export(tmp_path / "ring.stl")
    ball = BALL | {"diameter": 0.03, "inside": "thing", "mass": 0.01}
    thing = {"kind": "mesh", "file": "ring.stl", "at": [0.4, 0.0], "mass": 0.1}
    stage = set_up(make_scene(tmp_path, thing=thing | {"hollow": True}, ball=ball))
    assert stage.see("ball").inside == "thing"
    assert stage.look().infos["thing"].container
    assert not mesh_world(tmp_path, "ring.stl").entries["thing"].info.container


@pytest.mark.slow
def test_second_build_takes_the_pieces_from_the_cache(
    tmp_path: Path, cache: Path, splits: list[int]
) -> None:
    RING.export(tmp_path / "ring.stl")
    first = mesh_world(tmp_path, "ring.stl")
    entries = list(cache.iterdir())
    assert len(splits) == 1 and len(entries) == 1
    (tmp_path / "copy.stl").write_bytes((tmp_path / "ring.stl").read_bytes())
    second = mesh_world(tmp_path, "copy.stl")
    assert len(splits) == 1, "same content under another name"
    np.testing.assert_array_equal(first.model.mesh_vert, second.model.mesh_vert)
    trimesh.creation.annulus(0.02, 0.045, 0.03, sections=12).export(tmp_path / "ring.stl")
    mesh_world(tmp_path, "ring.stl")
    assert len(splits) == 2 and len(list(cache.iterdir())) == 2, "other content, other entry"


@pytest.mark.slow
@pytest.mark.parametrize("damage", ["garbage", "truncated", "empty"])
def test_damaged_cache_entry_is_made_again(
    tmp_path: Path, cache: Path, damage: str, splits: list[int]
) -> None:
    RING.export(tmp_path / "ring.stl")
    first = mesh_world(tmp_path, "ring.stl")
    entry = next(cache.iterdir())
    good = entry.read_bytes()
    entry.write_bytes(
        {"garbage": b"no archive at all", "truncated": good[: len(good) // 2], "empty": b""}[damage]
    )
    again = mesh_world(tmp_path, "ring.stl")
    assert len(splits) == 2
    np.testing.assert_array_equal(first.model.mesh_vert, again.model.mesh_vert)
    assert len(kept(cache)) > 3


@pytest.mark.slow
def test_cache_that_cannot_be_written_only_costs_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, splits: list[int]
) -> None:
    RING.export(tmp_path / "ring.stl")
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("ETOT_CACHE", str(tmp_path / "file"))
    assert len(mesh_world(tmp_path, "ring.stl").geoms_of("thing")) > 3


def test_convex_mesh_stays_one_piece(tmp_path: Path, cache: Path) -> None:
    trimesh.creation.icosphere(subdivisions=3, radius=0.04).export(tmp_path / "ball.stl")
    assert len(mesh_world(tmp_path, "ball.stl").geoms_of("thing")) == 1


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("bad.stl", b"solid nothing", "bad.stl: .*mesh"),
        ("bad.obj", b"\x00\xff\x13 not an object", "bad.obj: .*mesh"),
        ("bad.glb", b"glTF but not really", "bad.glb: not a readable mesh"),
        (
            "flat.obj",
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "flat.obj: .*found 1 faces; expected 4 to",
        ),
        ("none.stl", None, "none.stl: not a readable mesh"),
    ],
)
def test_broken_mesh_is_refused(
    tmp_path: Path, cache: Path, name: str, content: bytes | None, message: str
) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(WorldError, match=message):
        mesh_world(tmp_path, name)


def test_mesh_without_volume_is_refused(tmp_path: Path, cache: Path) -> None:
    lines = [f"v {x} {y} 0" for x in (0, 0.1) for y in (0, 0.1)]
    faces = ["f 1 2 3", "f 2 4 3", "f 3 2 1", "f 3 4 2"]
    (tmp_path / "sheet.obj").write_text("\n".join(lines + faces) + "\n")
    with pytest.raises(WorldError, match=r"sheet\.obj"):
        mesh_world(tmp_path, "sheet.obj")


def test_mesh_in_the_wrong_unit_is_refused_with_a_remedy(tmp_path: Path, cache: Path) -> None:
    trimesh.creation.box(extents=(60, 40, 20)).export(tmp_path / "box.stl")
    with pytest.raises(WorldError, match=r"largest side is 60 m; .*set 'scale', e\.g\. 0\.001"):
        mesh_world(tmp_path, "box.stl")
    trimesh.creation.box(extents=(6e-4, 4e-4, 2e-4)).export(tmp_path / "box.stl")
    with pytest.raises(WorldError, match=r"expected 0\.002 to 2 m"):
        mesh_world(tmp_path, "box.stl")


def test_mesh_of_too_many_faces_is_refused(tmp_path: Path, cache: Path) -> None:
    count = 200_001
    triangle = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0.1]], dtype="<f4")
    record = np.zeros(count, dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    record["v"] = triangle + np.linspace(0, 0.1, count, dtype="<f4")[:, None, None]
    (tmp_path / "huge.stl").write_bytes(bytes(80) + np.uint32(count).tobytes() + record.tobytes())
    with pytest.raises(WorldError, match=r"huge\.stl: .*200001 faces; expected 4 to 200000"):
        mesh_world(tmp_path, "huge.stl")


# -- MJCF ------------------------------------------------------------------------------------------

CHEST = """<mujoco model="chest">
  <worldbody>
    <body name="case">
      <geom type="box" size="0.1 0.1 0.005" pos="0 0 0.005"/>
      <geom type="box" size="0.005 0.1 0.05" pos="-0.095 0 0.06"/>
      <geom type="box" size="0.1 0.1 0.005" pos="0 0 0.115"/>
      <site name="top" type="box" size="0.1 0.1 0.001" pos="0 0 0.12"/>
      <body name="tray" pos="0 0 0.02">
        <joint name="runner" type="slide" axis="1 0 0" range="0 0.12" damping="2"/>
        <geom type="box" size="0.08 0.08 0.003"/>
        <geom type="box" size="0.004 0.08 0.03" pos="0.08 0 0.03"/>
        <site name="room" type="box" size="0.07 0.07 0.03" pos="0 0 0.033"/>
      </body>
    </body>
  </worldbody>
</mujoco>"""
PARTS = {"tray": {"joint": "runner", "container_site": "room"}}


def mjcf_scene(folder: Path, text: str, **more: Any) -> Any:
    (folder / "thing.xml").write_text(text)
    thing = {"kind": "mjcf", "file": "thing.xml", "at": [0.45, 0.0], "fixed": True}
    return make_scene(folder, thing=thing | more)


def test_mjcf_object_with_a_drawer(tmp_path: Path) -> None:
    scene = mjcf_scene(tmp_path, CHEST, parts=PARTS, surface_site="top")
    stage = set_up(scene)
    part = stage.world.parts["thing"]
    assert part.info.joint_type == "slide" and part.info.travel == pytest.approx(0.12)
    assert part.info.container and stage.world.parts["thing.tray"] is part
    assert set(stage.world.regions) == {"thing"}
    assert "thing.tray" in stage.world.geom_address
    stage.slide(part.joint, 0.09)
    assert stage.see("thing").openness == {"tray": pytest.approx(0.75)}


def test_things_go_on_and_into_an_mjcf_object(tmp_path: Path) -> None:
    (tmp_path / "thing.xml").write_text(CHEST)
    thing = {"kind": "mjcf", "file": "thing.xml", "at": [0.45, 0.0], "fixed": True,
             "parts": PARTS, "surface_site": "top"}  # fmt: skip
    above, below = BALL | {"diameter": 0.04}, BALL | {"diameter": 0.03}
    stage = set_up(
        make_scene(tmp_path, thing=thing, a=above | {"on": "thing"}, b=below | {"inside": "thing"})
    )
    scene = stage.look()
    assert scene.states["a"].on == ("thing",)
    assert scene.states["a"].position[2] == pytest.approx(stage.top + 0.12 + 0.02, abs=0.003)
    assert scene.states["b"].inside == "thing" and scene.states["b"].on == ("thing.tray",)


def test_free_mjcf_object_rests_on_the_desk(tmp_path: Path) -> None:
    """Its own free joint is dropped, the scene's pose counts."""
    text = """<mujoco><worldbody><body name="b"><freejoint/>
    <geom type="box" size="0.02 0.03 0.04" pos="0 0 0.1"/></body></worldbody></mujoco>"""
    stage = set_up(mjcf_scene(tmp_path, text, fixed=False), settle=1.0)
    assert stage.world.entries["thing"].free
    state = stage.see("thing")
    assert state.on == ("desk",) and not state.toppled and not state.lost


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('<asset><mesh name="m" file="../secret.stl"/></asset>', "names '../secret.stl', which"),
        ('<asset><mesh name="m" file="/etc/passwd"/></asset>', "names '/etc/passwd', which lies"),
        ('<include file="../other.xml"/>', "names '../other.xml', which lies outside"),
        ('<asset><texture name="t" type="2d" file="sub/../../t.png"/></asset>', "lies outside"),
        ('<compiler meshdir=".."/><asset><mesh name="m" file="m.stl"/></asset>', "lies outside"),
        ('<extension><plugin plugin="mujoco.sdf"/></extension>', "plugins are not accepted"),
    ],
)
def test_mjcf_with_files_elsewhere_is_refused(tmp_path: Path, text: str, message: str) -> None:
    folder = tmp_path / "scene"
    folder.mkdir()
    RING.export(tmp_path / "secret.stl")
    RING.export(tmp_path / "m.stl")
    body = '<worldbody><body><geom type="sphere" size="0.03"/></body></worldbody>'
    scene = mjcf_scene(folder, f"<mujoco>{text}{body}</mujoco>")
    with pytest.raises(WorldError, match=message):
        build_world(scene)


def test_mjcf_included_from_its_own_folder_is_checked_too(tmp_path: Path) -> None:
    folder = tmp_path / "scene"
    folder.mkdir()
    RING.export(tmp_path / "secret.stl")
    (folder / "part.xml").write_text(
        '<mujoco><asset><mesh name="m" file="../secret.stl"/></asset></mujoco>'
    )
    body = '<worldbody><body><geom type="mesh" mesh="m"/></body></worldbody>'
    scene = mjcf_scene(folder, f'<mujoco><include file="part.xml"/>{body}</mujoco>')
    with pytest.raises(WorldError, match="outside"):
        build_world(scene)


def test_mjcf_may_use_files_of_its_own_folder(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    RING.export(tmp_path / "parts" / "ring.stl")
    text = """<mujoco><asset><mesh name="m" file="parts/ring.stl"/></asset>
    <worldbody><body><geom type="mesh" mesh="m"/></body></worldbody></mujoco>"""
    world = build_world(mjcf_scene(tmp_path, text))
    assert world.entries["thing"].info.size[0] == pytest.approx(0.09, abs=0.002)


@pytest.mark.parametrize(
    ("text", "more", "message"),
    [
        ("<mujoco><worldbody>", {}, "thing.xml: not readable as XML"),
        ("<mujoco><worldbody><nonsense/></worldbody></mujoco>", {}, "not a valid MJCF model"),
        (CHEST, {"parts": {"tray": {"joint": "rail"}}}, "no joint 'rail'; it has runner"),
        (CHEST, {"container_site": "hole"}, "no site 'hole'; it has room, top"),
    ],
)
def test_broken_mjcf_is_refused(
    tmp_path: Path, text: str, more: dict[str, Any], message: str
) -> None:
    with pytest.raises(WorldError, match=message):
        build_world(mjcf_scene(tmp_path, text, **more))


def test_missing_mjcf_file_is_refused(tmp_path: Path) -> None:
    thing = {"kind": "mjcf", "file": "gone.xml", "at": [0.4, 0.0]}
    with pytest.raises(WorldError, match=r"gone\.xml"):
        build_world(make_scene(tmp_path, thing=thing))


def test_two_objects_from_one_file_do_not_clash(tmp_path: Path) -> None:
    (tmp_path / "thing.xml").write_text(CHEST)
    thing = {"kind": "mjcf", "file": "thing.xml", "parts": PARTS, "fixed": True}
    world = build_world(
        make_scene(tmp_path, a=thing | {"at": [0.45, 0.2]}, b=thing | {"at": [0.45, -0.2]})
    )
    assert {"a", "b", "a.tray", "b.tray"} == set(world.parts)
    assert world.parts["a"].joint != world.parts["b"].joint


LOCKER = """<mujoco model="locker">
  <worldbody>
    <body name="case">
      <geom type="box" size="0.15 0.18 0.005" pos="0 0 0.005" friction="0.6 0.005 0.0001"/>
      <geom type="box" size="0.15 0.18 0.005" pos="0 0 0.275" friction="0.6 0.005 0.0001"/>
      <geom type="box" size="0.005 0.18 0.13" pos="-0.145 0 0.14"/>
      <geom type="box" size="0.145 0.005 0.13" pos="0.005 0.175 0.14"/>
      <geom type="box" size="0.145 0.005 0.13" pos="0.005 -0.175 0.14"/>
      <site name="room" type="box" size="0.135 0.165 0.13" pos="0 0 0.14"/>
      <body name="door" pos="0.156 0.18 0.14">
        <joint name="hinge" type="hinge" axis="{axis}" range="0 114.6" damping="0.3" armature="0.02"
               frictionloss="0.2"/>
        <geom type="box" size="0.005 0.18 0.14" pos="0 -0.18 0" mass="0.8"/>
      </body>
    </body>
  </worldbody>
</mujoco>"""
DOOR = {"door": {"joint": "hinge", "container_site": "room"}}


def test_door_on_an_upright_hinge_closes_a_side(tmp_path: Path) -> None:
    turned = {"parts": DOOR, "yaw_deg": 130}
    world = set_up(mjcf_scene(tmp_path, LOCKER.format(axis="0 0 1"), **turned)).world
    assert world.parts["thing"].info.front
    assert world.regions["thing"].opening == pytest.approx((1.0, 0.0, 0.0))
    lid = set_up(mjcf_scene(tmp_path, LOCKER.format(axis="1 0 0"), **turned)).world
    assert not lid.parts["thing"].info.front
    assert lid.regions["thing"].opening == (0.0, 0.0, 1.0)


@pytest.mark.parametrize(("opened", "share"), [({}, 0.0), ({"open_deg": 57.3}, 0.5)])
def test_part_of_an_mjcf_object_may_stand_open(
    tmp_path: Path, opened: dict[str, float], share: float
) -> None:
    parts = {"door": DOOR["door"] | opened}
    stage = set_up(mjcf_scene(tmp_path, LOCKER.format(axis="0 0 1"), parts=parts))
    assert stage.see("thing").openness["door"] == pytest.approx(share, abs=0.01)


@pytest.mark.parametrize(
    ("text", "parts", "message"),
    [
        (LOCKER, {"door": DOOR["door"] | {"open": 0.1}}, "joint is a hinge; use"),
        (LOCKER, {"door": DOOR["door"] | {"open_deg": 150}}, "further than its joint's range, 114"),
        (CHEST, {"tray": PARTS["tray"] | {"open": 0.2}}, "further than its joint's range, 0.12 m"),
    ],
)  # fmt: skip
def test_part_that_cannot_stand_so_is_refused(
    tmp_path: Path, text: str, parts: dict[str, Any], message: str
) -> None:
    with pytest.raises(WorldError, match=message):
        set_up(mjcf_scene(tmp_path, text.replace("{axis}", "0 0 1"), parts=parts))


def test_hinge_through_the_middle_is_refused(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="passes through the middle"):
        set_up(mjcf_scene(tmp_path, LOCKER.format(axis="0 1 0"), parts=DOOR))


@pytest.mark.parametrize(
    ("old", "new", "parts", "message"),
    [
        (' range="0 0.12"', "", PARTS, "joint: 'runner' has no range"),
        ('type="slide" axis="1 0 0" range="0 0.12"', 'type="ball"', PARTS,
         "joint: 'runner' is a ball joint; expected a slide or a hinge"),
        ('"room" type="box"', '"room" type="sphere"', PARTS, "container_site: 'room' is a sphere"),
        ("", "", {"tray": PARTS["tray"] | {"front_site": "top"}},
         "front_site: 'top' is on the body 'case'; expected it on 'tray', which 'runner' moves"),
    ],
)  # fmt: skip
def test_part_that_opens_nothing_is_refused(
    tmp_path: Path, old: str, new: str, parts: dict[str, Any], message: str
) -> None:
    with pytest.raises(WorldError, match=rf"thing\.parts\.tray\.{message}"):
        build_world(mjcf_scene(tmp_path, CHEST.replace(old, new), parts=parts))
