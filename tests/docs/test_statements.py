"""What pages say of names, defaults and output is what the code says."""

from __future__ import annotations

import io
import re
from pathlib import Path

import pytest
from pydantic import AliasChoices, BaseModel

from etot_cli.errors import SpecError
from etot_cli.reasoning.vlm.prompts import Prompts
from etot_cli.reasoning.vlm.settings import VlmSettings
from etot_cli.reporting.execute_report import TrialModel
from etot_cli.reporting.plan_report import PlanReport
from etot_cli.reporting.plan_summary import plan_summary
from etot_cli.reporting.printer import Printer
from etot_cli.reporting.style import Verbosity, make_console
from etot_cli.specs.load import load_scene
from etot_cli.world.robot import DriverSpec, GripperSpec, RobotSpec
from etot_cli.world.state import CauseKind
from tests.docs.schemas import REPORTS
from tests.shared import planned

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.glob("*.md"))]
UNTOLD = {"url", "key", "cache", "marks", "hints", "directory", "gripper"}
"""Whose default is told in words, that the loader sets, or that has a table of its own."""


def rows(page: Path) -> dict[str, list[str]]:
    """The cells of a page's tables by each name that stands in the first of them."""
    found: dict[str, list[str]] = {}
    for line in page.read_text("utf-8").splitlines():
        if line.startswith("| `"):
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            found.update(dict.fromkeys(re.findall(r"`([^`]+)`", cells[0]), cells[1:]))
    return found


def same(told: str, default: object) -> bool:
    """Whether a cell tells a default that is a number, a word or nothing at all."""
    if isinstance(default, bool):
        return told.strip("`") == str(default).lower()
    if isinstance(default, int | float):
        return float(told.strip("`")) == default
    return not isinstance(default, str) or not default or told.strip("`") == default


def test_settings_of_the_model() -> None:
    told = rows(DOCS / "vlm.md")
    for name, field in VlmSettings.model_fields.items():
        alias = field.validation_alias
        names = alias.choices if isinstance(alias, AliasChoices) else [f"ETOT_VLM_{name.upper()}"]
        for variable in map(str, names):
            assert variable in told, variable
            if name not in UNTOLD:
                assert same(told[variable][0], field.default), variable


def test_fields_of_the_prompts() -> None:
    told = rows(DOCS / "prompts.md")
    prompts = Prompts()
    for name in prompts.versions:
        assert set(re.findall(r"`(\w+)`", told[name][1])) == prompts[name].fields, name


@pytest.mark.parametrize("model", [RobotSpec, GripperSpec, DriverSpec])
def test_keys_of_a_robot(model: type[BaseModel]) -> None:
    told = rows(DOCS / "robots.md")
    for name, field in model.model_fields.items():
        if name in UNTOLD or isinstance(field.default, BaseModel):
            continue
        if field.is_required():
            assert told[name][0] == "required", name
        elif name not in ("speed", "leaning_reach"):  # of two tables; one told in words
            assert same(told[name][0], field.default), name


def test_variables_of_the_environment() -> None:
    text = "".join(page.read_text("utf-8") for page in PAGES)
    for file in (ROOT / "etot_cli").rglob("*.py"):
        for name in re.findall(r'"(ETOT_[A-Z_]*[A-Z])"', file.read_text("utf-8")):
            assert name in text, f"{file.name} reads {name}, which no page tells of"


def test_the_message_about_a_scene_is_that_of_today(tmp_path: Path) -> None:
    page = (DOCS / "scene_format.md").read_text("utf-8")
    scene, told = re.findall(r"```(?:yaml|text)\n(.*?)```", page, re.DOTALL)[:2]
    file = tmp_path / "scenes" / "breakfast.yaml"
    file.parent.mkdir()
    file.write_text(scene.replace("diameter: 0.075", "diameter: 75"), encoding="utf-8")
    with pytest.raises(SpecError) as caught:
        load_scene(file)
    assert str(caught.value).endswith(told.strip())


@pytest.mark.parametrize("eyes", ["state", "camera"])
def test_the_figures_of_the_readme_are_those_of_the_results(eyes: str) -> None:
    section = (DOCS / "results.md").read_text("utf-8").partition(f"with {eyes} perception\n")[2]
    table = section.partition("\n## ")[0]
    pairs = re.findall(r"^\| \w+ \| (\d+)/(\d+) \|", table, re.MULTILINE)
    done, trials = (sum(int(pair[column]) for pair in pairs) for column in (0, 1))
    assert trials >= 160
    assert f"{done} of {trials}" in (ROOT / "README.md").read_text("utf-8")


@pytest.mark.slow
def test_files_and_classes_that_are_named_are_there() -> None:
    files = {f"/{path.relative_to(ROOT)}" for top in ("etot_cli", "tests", "docs")
             for path in (ROOT / top).rglob("*.py")}  # fmt: skip
    for page in PAGES:
        for word in re.findall(r"`([^`\s]+)`", page.read_text("utf-8")):
            if word.endswith(".py"):
                assert any(file.endswith(f"/{word}") for file in files), f"{page.name}: {word}"
            elif word.startswith(("etot_cli/", "tests/", "suites/", "docs/")):
                assert (ROOT / word).exists(), f"{page.name}: {word}"
    sources = "".join(path.read_text("utf-8") for path in (ROOT / "etot_cli").rglob("*.py"))
    rooms = [line for line in (DOCS / "design.md").read_text("utf-8").splitlines()
             if re.match(r"\| `\w+` \| .* \| .* \|$", line)]  # fmt: skip
    handed = {name for line in rooms for name in re.findall(r"`([A-Z]\w+)`", line.split("|")[3])}
    assert len(handed) > 10
    for name in handed:
        assert re.search(rf"^class {name}\b", sources, re.MULTILINE), f"there is no {name}"


def test_messages_that_are_explained_are_said() -> None:
    sources = "".join(path.read_text("utf-8") for path in (ROOT / "etot_cli").rglob("*.py"))
    for page in ("troubleshooting.md", "robots.md"):
        for line in (DOCS / page).read_text("utf-8").splitlines():
            for told in re.findall(r"`([^`]* [^`]*)`", line.split("|")[1] if "|" in line else ""):
                for part in told.split("…"):
                    assert part.strip() in sources, f"{page}: {part}"


def test_every_kind_of_cause_and_every_field_of_a_report_is_told() -> None:
    text = (DOCS / "reports.md").read_text("utf-8")
    for kind in CauseKind:
        assert f"`{kind.value}`" in text, kind
    text += (DOCS / "execute.md").read_text("utf-8")
    for model in (*REPORTS.values(), TrialModel):
        for name, field in model.model_fields.items():
            told = re.escape(field.alias or name)
            assert re.search(rf"`{told}[`.]", text), f"{model.__name__} has {told}"


@pytest.mark.slow
@pytest.mark.parametrize("page", ["README.md", "docs/index.md"])
def test_the_output_that_is_shown_is_that_of_today(
    page: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    made = planned(tmp_path_factory, ROOT / "tasks" / "task5.yaml") / "report.json"
    report = PlanReport.model_validate_json(made.read_text("utf-8"))
    stream = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    plan_summary(Printer(make_console(stream), Verbosity.NORMAL), report, made)
    shown = (ROOT / page).read_text("utf-8").partition("\n✓ feasible plan")[2].partition("\n```")[0]
    stream.seek(0)
    told = stream.read().partition("✓ feasible plan")[2]
    seconds = re.compile(r"in [\d.]+ s")
    for line in shown.splitlines():
        if not line.startswith(("  page:", "  report:")):
            assert seconds.sub("in", line) in seconds.sub("in", told), line
