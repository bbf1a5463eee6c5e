"""Whatever stands in a document: it loads, or there is one message, never a traceback."""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.errors import SpecError
from etot_cli.specs.checks import check_scene
from etot_cli.specs.document import Node, Place, read_document
from etot_cli.specs.include import as_include, project_root
from etot_cli.specs.problems import first_error, validate
from etot_cli.specs.references import task_problems
from etot_cli.specs.task import Task
from etot_cli.specs.vary import vary

TASKS = Path(__file__).parents[2] / "tasks"


def plain_task(name: str) -> Any:
    """A task's data with its scene written out."""
    file = TASKS / name
    root = read_document(file)
    assert isinstance(root.value, dict)
    scene, _ = as_include(root.value["scene"], file, project_root(file))
    return {"name": "t", **root.plain(), "scene": scene.plain()}


DATA = [plain_task(name) for name in ("task1.yaml", "task4.yaml", "task5.yaml", "disturbance.yaml")]

NUMBERS = st.floats(-5, 5) | st.integers(-1000, 1000) | st.sampled_from([0, 1e-9, 1e300, 10**40])
NAMES = ["desk", "pen", "apple", "drawer", "drawer.top", "drawer.bottom", "white_holder", "chosen"]
ODD_WORDS = ["sphere", "cup", "box", "mjcf", "mesh", "shelf", "red", "", "x" * 80, "a.b", "é\n"]
WORDS = st.sampled_from([*NAMES, *ODD_WORDS])
ODD = st.recursive(
    st.none() | st.booleans() | NUMBERS | WORDS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(WORDS, inner, max_size=3),
    max_leaves=6,
)


def node_of(value: Any, path: tuple[str | int, ...] = ()) -> Node:
    place = Place("t.yaml", 1, path)
    if isinstance(value, dict):
        return Node({key: node_of(item, (*path, key)) for key, item in value.items()}, place)
    if isinstance(value, list):
        return Node([node_of(item, (*path, index)) for index, item in enumerate(value)], place)
    return Node(value, place)


@st.composite
def damaged(draw: st.DrawFn) -> Any:
    """A valid task in which one to three values were replaced, removed or added."""
    data = deepcopy(draw(st.sampled_from(DATA)))
    for _ in range(draw(st.integers(1, 3))):
        holder: Any = data
        while True:
            steps = list(holder) if isinstance(holder, dict) else list(range(len(holder)))
            if not steps:
                break
            step = draw(st.sampled_from(steps))
            inner = holder[step]
            if not isinstance(inner, dict | list) or not inner or draw(st.integers(0, 3)) == 0:
                action = draw(st.sampled_from(["replace", "replace", "remove", "add"]))
                if action == "remove":
                    del holder[step]
                elif action == "add" and isinstance(holder, dict):
                    holder[draw(WORDS)] = draw(ODD)
                else:
                    holder[step] = draw(ODD)
                break
            holder = inner
    return data


@settings(max_examples=80, deadline=None)
@given(damaged(), st.integers(0, 100))
def test_damaged_tasks_load_or_are_refused_in_one_line(data: Any, seed: int) -> None:
    node = node_of(data)
    try:
        task = validate(Task, node)
        check_scene(task.scene, node.child("scene"))
        problems = task_problems(task)
        if problems:
            raise first_error(node, problems)
    except SpecError as error:
        assert "\n" not in str(error)
        assert str(error).startswith("t.yaml:1: ")
        assert len(str(error)) < 2000
    else:
        check_scene(vary(task.scene, seed))
