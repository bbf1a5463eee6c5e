"""Every command that the documentation shows in a code block works as shown."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import typer

from etot_cli.cli.app import app
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.player import Player
from tests.opengl import missing_opengl
from tests.program import etot
from tests.shared import once, planned
from tests.vlm.scripts import rule, with_common

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCE = re.compile(r"^```[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)

RUN_BY_CI = {
    "demo": "CI runs it, and it would install the package once more",
    "test": "it is what runs this test",
    "test-fast": "it is part of what runs this test",
    "lint": "CI runs it",
    "format": "it would rewrite the sources that are being tested",
    "bench": "it measures for minutes",
    "bench-paper": "it runs 640 trials",
    "bench-random": "it runs 320 trials",
    "calibrate": "it simulates for minutes",
    "check-tasks": "it simulates for minutes",
    "check-random": "it plans for minutes",
    "check-reading": "it reads for minutes, and an eighth of it is read here",
    "check-execute": "it executes for an hour",
    "check-reconstruct": "it renders and fits for minutes",
    "schemas": "tests/reporting compares the schemas with the models",
    "soak": "it starts and stops programs for minutes",
    "docs": "tests/docs/test_site.py builds it",
    "figures": "it renders for minutes",
    "clean": "it would delete the environment of this test",
}
"""Targets of make that are not run here, and why; that they exist is checked."""
ANSWERS = {"[PICK UP, pen] [PUT INTO, black_holder]": 1}
"""Plans shown because they fail: exit code by plan; all other commands end with 0."""
LEFT_OUT = ("--video", "--frames", "--view")
"""Options that need OpenGL, which planning must do without, or somebody who looks; rendering and
viewing have tests of their own."""
FIRST = "etot plan tasks/task5.yaml"
"""Is run once for all tests that look at its report."""
FRAME_WIDTH = 160
"""Of what a scripted model is shown, which does not look at it [px]; drawing costs time."""
AT_ONCE = rule(
    "branches", "[PICK UP, apple] [PUT ON, desk] [PICK UP, pen] [PUT INTO, white_holder]"
)
"""What a scripted model answers for task 5: the right plan; models that err have tests of their
own."""
REPORT = "results/plan/…/report.json"
"""Stands for the report of the plan command shown before it."""


def commands() -> list[tuple[str, str]]:
    """Page and command, for all lines in code blocks that start with ``etot`` or ``make``."""
    found = []
    for page in PAGES:
        for block in FENCE.findall(page.read_text(encoding="utf-8")):
            for line in block.replace("\\\n", " ").splitlines():
                words = line.strip().removeprefix("$ ")
                if words.startswith(("etot ", "make ")):
                    found.append((str(page.relative_to(ROOT)), " ".join(words.split())))
    return list(dict.fromkeys(found))


ALL = commands()
ETOT = [item for item in ALL if item[1].startswith("etot ")]
MAKE = [item for item in ALL if item[1].startswith("make ")]
SYNOPSES = [item for item in ETOT if "[options]" in item[1] or "[--" in item[1]]
EXAMPLES = [item for item in ETOT if item not in SYNOPSES]
SERVED = {"--masks-url", "--mesh-url", "--pose-url", "--articulation-url"}
"""Options that hand a stage to a server, which is not there in this test: exit code 3."""


@pytest.fixture(scope="session")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report of the plan that the README makes first."""
    return planned(tmp_path_factory, ROOT / "tasks" / "task5.yaml") / "report.json"


@pytest.fixture(scope="session")
def captured(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A rendered capture; an empty folder where there is no OpenGL."""

    def make(folder: Path) -> None:
        done = etot("simulate", "tasks/task2.yaml", "--capture", folder)
        assert done.returncode == (3 if missing_opengl() else 0), done.stderr

    return once(tmp_path_factory, "capture", make)


@pytest.fixture(scope="session")
def tape(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cassette of a run against a scripted model."""

    def make(folder: Path) -> None:
        words = ["plan", "tasks/task5.yaml", "--reasoner", "vlm", "--record", str(folder / "tape")]
        with pytest.MonkeyPatch.context() as patch, scripted_model(patch, folder):
            done = etot(*words, "--out", str(folder / "out"), "--force", "-q")
        assert done.returncode == 0, done.stderr

    return once(tmp_path_factory, "tape", make) / "tape"


@contextmanager
def scripted_model(patch: pytest.MonkeyPatch, folder: Path) -> Iterator[None]:
    """A model that answers in place of the one that the pages talk about, and sees small frames."""
    with FakeServer(Player(with_common([AT_ONCE]))) as server:
        patch.setenv("OPENAI_BASE_URL", server.url)
        patch.setenv("OPENAI_API_KEY", "sk-of-no-use")
        patch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
        patch.setenv("ETOT_VLM_IMAGE_WIDTH", str(FRAME_WIDTH))
        patch.setenv("ETOT_VLM_PRICE_INPUT", "1")
        patch.setenv("ETOT_VLM_PRICE_OUTPUT", "1")
        yield


def test_documentation_shows_commands() -> None:
    pages = {page for page, _ in ALL}
    assert {"README.md", "docs/plan.md", "docs/simulate.md"} <= pages
    assert len(EXAMPLES) >= 3 and MAKE


OPTION = re.compile(r"(?<![\w-])--?[a-z][a-z-]*")


@pytest.mark.parametrize(("page", "command"), SYNOPSES, ids=[c for _, c in SYNOPSES])
def test_tables_name_the_options_of_a_command(page: str, command: str) -> None:
    """Those that it has, and all of them; the model's may be told on the page about models."""
    program = typer.main.get_command(app)
    assert isinstance(program, typer.main.TyperGroup)
    parameters = program.commands[command.split()[1]].params
    names = [{*item.opts, *item.secondary_opts} for item in parameters]
    options = {name for group in names for name in group if name.startswith("-")}
    tables = [line for line in (ROOT / page).read_text("utf-8").splitlines() if line[:1] == "|"]
    told = {name for line in tables for name in OPTION.findall(line.split("|")[1])}
    assert told <= options, f"{page}: {command.split()[1]} has no {told - options}"
    told |= set(OPTION.findall("\n".join(tables)))
    told |= set(OPTION.findall((ROOT / "docs" / "vlm.md").read_text("utf-8")))
    for group in names:
        hidden = not any(name.startswith("-") for name in group) or group & told
        assert hidden, f"{page} does not tell of {group}"


@pytest.mark.slow
@pytest.mark.parametrize(("page", "command"), EXAMPLES, ids=[c for _, c in EXAMPLES])
def test_example_works(
    page: str,
    command: str,
    tmp_path: Path,
    report: Path,
    tape: Path,
    captured: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    words = shlex.split(command, comments=True)[1:]
    if words[0] in ("new", "tasks"):
        words = [str(tmp_path / word) if word == "my.yaml" else word for word in words]
        done = etot(*words)
        assert done.returncode == 0, f"{page}: {done.stdout}{done.stderr}"
        return
    if "vlm" in words:
        if "--vlm-url" in words:
            del words[words.index("--vlm-url") : words.index("--vlm-url") + 2]
        words = [str(tape) if word == "tape" and "--replay" in words else word for word in words]
        words = [str(tmp_path / "tape") if word == "tape" else word for word in words]
        with scripted_model(monkeypatch, tmp_path):
            done = etot(*words, "--out", str(tmp_path / "out"), "--force", "-q")
        assert done.returncode == 0, f"{page}: {done.stdout}{done.stderr}"
        return
    words = [str(captured) if word in ("CAPTURE", "CAPTURE_DIR") else word for word in words]
    if SERVED & set(words):
        done = etot(*words, "--out", str(tmp_path / "out"), "--force", "-q")
        assert done.returncode == 3, f"{page}: {done.stdout}{done.stderr}"
        assert "Traceback" not in done.stderr
        return
    if command == FIRST:
        assert json.loads(report.read_text(encoding="utf-8"))["status"] == "feasible"
        assert (report.parent / "code").read_text() == "0"
        return
    words = [str(report) if word == REPORT else word for word in words if word not in LEFT_OUT]
    while "--export" in words:
        name = words[words.index("--export") + 1]
        del words[words.index("--export") : words.index("--export") + 2]
        words += [f"--export={tmp_path / name}"]
    if "--out" in words:
        del words[words.index("--out") : words.index("--out") + 2]
    done = etot(*words, "--out", str(tmp_path / "out"), "--force", "-q")
    expected = next((code for plan, code in ANSWERS.items() if plan in words), 0)
    assert done.returncode == expected, f"{page}: {done.stdout}{done.stderr}"
    found = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert found["status"] in (("feasible", "success") if expected == 0 else ("failure", "unsafe"))


@pytest.mark.parametrize(("page", "command"), MAKE, ids=[c for _, c in MAKE])
def test_make_target_exists(page: str, command: str) -> None:
    target = shlex.split(command, comments=True)[1]
    assert target in RUN_BY_CI, f"{page}: {command} is neither run by CI nor excused"
    done = subprocess.run(
        ["make", "--dry-run", target], cwd=ROOT, text=True, capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_every_make_target_is_accounted_for() -> None:
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    phony = re.search(r"^\.PHONY: (.*)$", text, re.MULTILINE)
    assert phony is not None
    assert set(phony[1].split()) == set(RUN_BY_CI)
    for target in ("lint", "test", "demo"):
        assert f"make {target}" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")


def test_links_between_pages_lead_somewhere() -> None:
    for page in PAGES:
        for link in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), f"{page.name}: {link}"
