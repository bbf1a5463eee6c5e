"""Plans and scenes for other programs."""

from __future__ import annotations

import re
import zipfile
from io import BytesIO
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest

from etot_cli.commands.export import write_exports
from etot_cli.commands.plan import Planning, PlanOptions, plan_task
from etot_cli.reporting.exports import NODES, behavior_tree, ground_plan
from etot_cli.specs.load import load_scene
from etot_cli.world.export import scene_archive
from etot_cli.world.model import build_world
from tests.planning.fakes import ToyReasoner, ToySimulator, fails
from tests.reporting.toy_rooms import ToyRooms

ROOT = Path(__file__).parents[2]
PLAN = "[PICK UP, cup] (vertical) [PUT ON, desk] [OPEN, box] [PICK UP, cup] [PUT INTO, box.lid]"


def planned(*branches: str) -> Planning:
    rooms = ToyRooms(ToySimulator(fails("a")), ToyReasoner(list(branches))).rooms()
    return plan_task(PlanOptions(task=Path("toy.yaml")), rooms=rooms)


def check_behavior_tree(text: str) -> list[ElementTree.Element]:
    """The rules of BehaviorTree.CPP 4 files that Groot2 insists on; returns the leaves."""
    root = ElementTree.fromstring(text.encode())
    assert root.tag == "root" and root.get("BTCPP_format") == "4"
    trees = {tree.get("ID"): tree for tree in root.findall("BehaviorTree")}
    assert root.get("main_tree_to_execute") in trees
    assert {child.tag for child in root} == {"BehaviorTree", "TreeNodesModel"}
    models = {}
    for entry in root.findall("TreeNodesModel/*"):
        assert entry.tag == "Action"
        for port in entry:
            assert port.tag == "input_port" and port.get("type") == "std::string"
        models[entry.get("ID")] = {port.get("name") for port in entry}
    (tree,) = trees.values()
    (control,) = tree
    assert control.tag == "Sequence"
    for leaf in control:
        assert not list(leaf)
        assert set(leaf.attrib) == models[leaf.tag] | {"name"}
    return list(control)


def test_behavior_tree_has_every_action_with_its_ports() -> None:
    report = planned(PLAN).report
    leaves = check_behavior_tree(behavior_tree(report))
    assert [leaf.tag for leaf in leaves] == ["PickUp", "PutOn", "Open", "PickUp", "PutInto"]
    assert leaves[0].get("pose") == "vertical" and leaves[1].get("object") == "cup"
    assert leaves[4].get("container") == "box.lid"
    assert {node for node, _ in NODES.values()} >= {leaf.tag for leaf in leaves}


def test_hostile_words_stay_words() -> None:
    report = planned(PLAN).report
    report.task.instruction = '"/><Evil x="\x07\n; (rm -rf)'
    assert len(check_behavior_tree(behavior_tree(report))) == 5
    assert ground_plan(report).splitlines()[0].startswith(";")
    assert len(ground_plan(report).splitlines()) == 7


def test_ground_plan_is_one_action_per_line() -> None:
    lines = ground_plan(planned(PLAN).report).splitlines()
    assert lines[1:] == [
        "(pick-up cup)", "(put-on cup desk)", "(open box)", "(pick-up cup)",
        "(put-into cup box-lid)", "; cost = 5 (unit cost)",
    ]  # fmt: skip
    assert all(re.fullmatch(r"\([a-z][a-z0-9_-]*( [a-z0-9_-]+)*\)", line) for line in lines[1:-1])


def test_files_are_written_by_their_ending(tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("bt.xml", "deep/plan.pddl.txt")]
    assert write_exports(planned("[PICK UP, cup]"), files) == []
    assert all(file.stat().st_size > 50 for file in files)


def test_without_a_plan_nothing_is_written(tmp_path: Path) -> None:
    (warning,) = write_exports(planned("a"), [tmp_path / "bt.xml"])
    assert "there is no plan" in warning and not (tmp_path / "bt.xml").exists()


@pytest.mark.parametrize("name", ["pen_and_holders", "microwave"])
def test_scene_archive_is_the_same_world(name: str, tmp_path: Path) -> None:
    scene = load_scene(ROOT / "scenes" / f"{name}.yaml")
    with zipfile.ZipFile(BytesIO(scene_archive(scene))) as archive:
        archive.extractall(tmp_path)
    (file,) = tmp_path.rglob("*.xml")
    model, world = mujoco.MjModel.from_xml_path(str(file)), build_world(scene)
    assert (model.nq, model.nv, model.ngeom) == (
        world.model.nq, world.model.nv, world.model.ngeom,
    )  # fmt: skip
    assert np.allclose(model.body_mass, world.model.body_mass, rtol=1e-4)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    for _ in range(100):
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all()
