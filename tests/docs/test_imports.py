"""The rooms and who may import whom, as docs/design.md draws them; read from the sources."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "etot_cli"

ORDER = (
    "specs", "world", "skills", "control", "reasoning", "planning", "execution", "benchmark",
)  # fmt: skip
BELOW: dict[str, set[str]] = {room: {*ORDER[:rank]} for rank, room in enumerate(ORDER)} | {
    "services": set(),
    "reconstruction": {"specs", "world"},
    "reporting": {*ORDER},
    "commands": {*ORDER, "reporting", "reconstruction"},
    "cli": {"specs", "planning", "reasoning", "reporting", "commands"},
}
"""Rooms that each room may import besides itself and ``errors``."""
DOORS = {"commands": {"rooms"}, "cli": {"rooms"}}
"""Who may import the module with the doors to all rooms."""
BELOW["execution"].add("reconstruction")
for _room in ("reasoning", "reconstruction", "execution", "benchmark", "commands"):
    BELOW[_room].add("services")
LANGUAGE = PACKAGE / "reasoning" / "language"
LANGUAGE_ORDER = {
    "grammar": (
        "text", "syntax", "parsers", "asides", "paraphrasing", "phrases", "requests", "conditions",
        "sentences",
    ),
    "reference": ("memory", "geometry", "naming", "choosing", "pronouns", ".", "places"),
}  # fmt: skip
"""The folders of the two large rooms, the lowest first; ``.`` is the room itself."""
WITHOUT_MUJOCO = (
    "specs", "reasoning/builtin", "reasoning/language", "planning", "reporting", "commands",
    "cli",
)  # fmt: skip
WITHOUT_HTTP = (
    "specs", "world", "skills", "control", "reasoning/builtin", "planning", "reporting",
)  # fmt: skip
PLAIN_DATA = {
    "etot_cli.world": {"state", "colors", "spatial", "stance", "carrying"},
    "etot_cli.skills": {"action", "deadline"},
    "etot_cli.control": {"simulated"},
}
"""The modules of lower rooms that carry data alone; physics is behind a protocol."""
ON_PLAIN_DATA = ("planning", "reasoning/builtin", "reasoning/language")


def rooms() -> list[str]:
    return sorted(path.name for path in PACKAGE.iterdir() if (path / "__init__.py").is_file())


def imports(path: Path) -> set[str]:
    """Modules that a file imports anywhere, in functions and for type checking too."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            assert node.module is not None
            found.add(node.module)
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def files(room: str) -> list[Path]:
    return sorted((PACKAGE / room).rglob("*.py"))


def test_every_room_is_drawn() -> None:
    assert set(rooms()) == set(BELOW)
    text = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    for room in rooms():
        assert f"`{room}`" in text, f"docs/design.md does not say what {room} is"
    folders = {path.parent.name for path in LANGUAGE.glob("*/__init__.py")}
    told = dict(
        re.findall(r"^\| `(\w+)` \| [^|]+ \| (`[a-z_/]+`, `[a-z_/]+`) \|$", text, re.MULTILINE)
    )
    assert folders == set(told)
    for folder, modules in told.items():
        for module in re.findall(r"[\w/]+", modules):
            assert (LANGUAGE / folder / f"{module}.py").is_file(), f"{folder}/{module}"


@pytest.mark.parametrize("room", sorted(BELOW))
def test_a_room_imports_only_lower_ones(room: str) -> None:
    allowed = {room, "errors"} | BELOW[room] | DOORS.get(room, set())
    for path in files(room):
        for module in imports(path):
            parts = module.split(".")
            if parts[0] == "etot_cli" and len(parts) > 1:
                assert parts[1] in allowed, f"{path.relative_to(ROOT)} imports {module}"


@pytest.mark.parametrize("room", sorted(LANGUAGE_ORDER))
def test_a_folder_of_the_language_imports_only_lower_ones(room: str) -> None:
    order = LANGUAGE_ORDER[room]
    here = LANGUAGE / room
    prefix = f"etot_cli.reasoning.language.{room}."
    text = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    found = {path.parent.name for path in here.glob("*/__init__.py")}
    assert found == {*order} - {"."}
    for folder in found:
        assert f"`{room}/{folder}`" in text, f"docs/design.md does not say what {folder} is"
    for path in sorted(here.rglob("*.py")):
        own = path.parent.relative_to(here).as_posix()
        for module in imports(path):
            if module.startswith(prefix):
                first = module.removeprefix(prefix).split(".")[0]
                other = first if first in found else "."
                assert order.index(other) <= order.index(own), f"{path} imports {module}"


@pytest.mark.parametrize("room", ON_PLAIN_DATA)
def test_planning_and_builtin_reasoning_see_plain_data_only(room: str) -> None:
    assert files(room)
    for path in files(room):
        for module in imports(path):
            for lower, modules in PLAIN_DATA.items():
                if module.startswith(f"{lower}."):
                    name = module.removeprefix(f"{lower}.").split(".")[0]
                    assert name in modules, f"{path.relative_to(ROOT)} imports {module}"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("library", "without"), [("mujoco", WITHOUT_MUJOCO), ("httpx", WITHOUT_HTTP)]
)
def test_physics_and_network_stay_in_their_rooms(library: str, without: tuple[str, ...]) -> None:
    for room in without:
        for path in files(room):
            used = {module.split(".")[0] for module in imports(path)}
            assert library not in used, f"{path.relative_to(ROOT)} imports {library}"
    everywhere = {m.split(".")[0] for room in rooms() for p in files(room) for m in imports(p)}
    assert "mujoco" in everywhere, "the parser finds imports at all"


@pytest.mark.slow
def test_who_plans_a_motion_does_not_step_physics() -> None:
    """Skills read a belief; only control steps a world."""
    for path in files("skills"):
        assert not any(m.startswith("etot_cli.control") for m in imports(path)), path
        called = {
            node.func.attr
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
        }
        assert not called & {"mj_step", "mj_step1", "mj_step2", "rollout"}, path


@pytest.mark.slow
def test_the_judge_of_trials_is_not_that_of_actions() -> None:
    """They share the state alone; a formal goal is read as a task's conditions are."""
    for module in ("execution/evaluation.py", "planning/conditions.py"):
        used = {name for name in imports(PACKAGE / module) if name.startswith("etot_cli.")}
        rooms_used = {".".join(name.split(".")[:3]) for name in used}
        assert not {name for name in rooms_used if name.startswith("etot_cli.reasoning")}, module
    judging = [path for room in ("reasoning", "skills", "control") for path in files(room)]
    searching = [PACKAGE / "planning" / name for name in ("search.py", "findings.py")]
    for path in [*judging, *searching]:
        assert not any("conditions.holds" in name or "planning.conditions" in name
                       for name in imports(path)), path  # fmt: skip


def test_a_method_sees_nothing_of_the_world_that_it_acts_in() -> None:
    seen = {
        name
        for path in files("benchmark/methods")
        for name in imports(path)
        if name.startswith("etot_cli.execution.")
    }
    assert {name.split(".")[3] for name in seen if name.count(".") == 3} == {
        "FailureClass", "Planned", "Planner", "Trial", "planned_by",
    }  # fmt: skip


def test_rules_have_no_circle() -> None:
    order: list[str] = []
    while len(order) < len(BELOW):
        ready = [room for room in BELOW if room not in order and BELOW[room] <= set(order)]
        assert ready, "rooms import each other in a circle"
        order += ready
    assert order.index("specs") < order.index("world") < order.index("skills")
    assert order.index("reasoning") < order.index("planning") < order.index("commands")
