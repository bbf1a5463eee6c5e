"""The command line: flags, exit codes, what goes where."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from etot_cli import rooms
from etot_cli.cli import interrupts
from etot_cli.cli.app import run
from etot_cli.errors import ServiceError, SpecError
from etot_cli.planning.options import Ablation
from etot_cli.specs.task import Condition
from tests.planning.fakes import Rule, ToyReasoner, ToySimulator, fails
from tests.reporting.toy_rooms import SUCCESS, ToyRooms

SIMULATE = ["simulate", "toy.yaml", "--plan", "[PICK UP, cup] [PUT ON, desk]"]


@dataclass
class Answer:
    """What a run of the program left behind."""

    code: int
    out: str
    err: str

    @property
    def report(self) -> dict[str, object]:
        document: dict[str, object] = json.loads(self.out)
        return document


Etot = Callable[..., Answer]


@pytest.fixture
def etot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Etot:
    """Runs the program in an empty folder, with toy rooms."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")

    def call(
        *arguments: str,
        rule: Rule | None = None,
        branches: Sequence[str] = ("a b",),
        success: tuple[Condition, ...] = SUCCESS,
    ) -> Answer:
        reasoner = ToyReasoner(branches)
        toys = ToyRooms(ToySimulator(rule or fails()), reasoner, success=success)
        monkeypatch.setattr(rooms, "default_rooms", toys.rooms)
        code = run(arguments)
        captured = capsys.readouterr()
        return Answer(code, captured.out, captured.err)

    return call


def test_feasible_plan(etot: Etot, tmp_path: Path) -> None:
    answer = etot("plan", "toy.yaml", "--out", "here")
    assert answer.code == 0
    assert "feasible plan" in answer.out and "[PICK UP, b]" in answer.out
    report = json.loads((tmp_path / "here" / "report.json").read_text())
    assert report["status"] == "feasible"


def test_default_folder(etot: Etot, tmp_path: Path) -> None:
    etot("plan", "some/toy.yaml")
    (folder,) = (tmp_path / "results" / "plan").iterdir()
    assert folder.name.startswith("toy-") and (folder / "report.json").exists()


def test_no_plan_is_the_answer_no(etot: Etot) -> None:
    answer = etot("plan", "toy.yaml", rule=fails("a"))
    assert answer.code == 1
    assert "no feasible plan" in answer.out and "it was blocked" in answer.out


def test_limit_is_the_answer_no(etot: Etot) -> None:
    answer = etot("plan", "toy.yaml", "--max-nodes", "1")
    assert answer.code == 1 and "--max-nodes" in answer.out


def test_json_is_the_report_and_nothing_else(etot: Etot, tmp_path: Path) -> None:
    answer = etot("plan", "toy.yaml", "--json", "--out", "x", "--seed", "3")
    assert answer.report["seed"] == 3
    assert answer.out == (tmp_path / "x" / "report.json").read_text(encoding="utf-8")
    assert "[PICK UP, a]" in answer.err


def test_quiet_and_verbose(etot: Etot) -> None:
    quiet = etot("plan", "toy.yaml", "-q")
    assert (quiet.out, quiet.err) == ("feasible: [PICK UP, a] [PICK UP, b]\n", "")
    verbose = etot("plan", "toy.yaml", "-v")
    normal = etot("plan", "toy.yaml")
    assert len(verbose.err) > len(normal.err) > 0
    assert etot("plan", "toy.yaml", "-q", "-v").code == 2


def test_same_seed_same_report(etot: Etot) -> None:
    def settled(report: dict[str, object]) -> object:
        for key in ("timing", "statistics", "tree"):
            report.pop(key)
        return report

    first, second = (etot("plan", "toy.yaml", "--json").report for _ in range(2))
    assert settled(first) == settled(second)


def test_options_reach_the_search(etot: Etot) -> None:
    flags = "--without priori --without reflective --worlds 3 --jobs 1 --time-limit 60 --vary"
    options = etot("plan", "toy.yaml", "--json", *flags.split()).report["options"]
    assert options == {
        "reasoner": "builtin",
        "vary": True,
        "jobs": 1,
        "worlds": 3,
        "look": "each",
        "without": [ablation.value for ablation in Ablation],
        "max_nodes": 200,
        "time_limit_s": 60.0,
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["plan"], "TASK.yaml"),
        (["plan", "toy.yaml", "--jobs", "0"], "--jobs"),
        (["plan", "toy.yaml", "--jobs", "many"], "--jobs"),
        (["plan", "toy.yaml", "--worlds", "0"], "--worlds"),
        (["plan", "toy.yaml", "--seed", "-1"], "--seed"),
        (["plan", "toy.yaml", "--max-nodes", "0"], "--max-nodes"),
        (["plan", "toy.yaml", "--time-limit", "nan"], "--time-limit"),
        (["plan", "toy.yaml", "--time-limit", "inf"], "--time-limit"),
        (["plan", "toy.yaml", "--without", "luck"], "--without"),
        (["plan", "toy.yaml", "--reasoner", "oracle"], "--reasoner"),
        (["plan", "toy.yaml", "--nonsense"], "--nonsense"),
        (["plan", "missing.yaml"], "missing.yaml: no such file"),
        (["plan", "toy.yaml", "--out", "/dev/null/x"], "cannot write"),
        (["simulate", "toy.yaml"], "--plan"),
        (["simulate", "toy.yaml", "--plan", "[JUMP, cup]"], "unknown action 'JUMP'"),
        (["simulate", "toy.yaml", "--plan", "none.json"], "none.json: cannot be read"),
        (["simulate", "toy.yaml", "--plan", ""], "'' is neither a plan such as"),
        (["simulate", "toy.yaml", "--plan", " "], "' ' is neither a plan such as"),
        (["levitate"], "levitate"),
    ],
)
def test_unusable_input_is_one_clear_message(
    etot: Etot, arguments: list[str], message: str
) -> None:
    answer = etot(*arguments)
    assert answer.code == 2
    assert answer.out == ""
    assert answer.err.startswith("error: ") and answer.err.count("\n") == 1
    assert message in answer.err


@pytest.mark.parametrize(
    "command",
    [
        "plan loop.yaml",
        "plan loop.yaml/task.yaml",
        "plan toy.yaml --out loop.yaml",
        "plan toy.yaml --out loop.yaml/x",
        "plan toy.yaml --export loop.yaml/a.xml",
        "simulate toy.yaml --plan loop.json",
        "reconstruct loop.yaml",
    ],
)
def test_links_that_lead_nowhere_are_one_clear_message(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    command: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    shipped = Path(__file__).parents[2] / "tasks" / "task3.yaml"
    command = command.replace("toy.yaml", str(shipped))
    for name in ("loop.yaml", "loop.json"):
        Path(name).symlink_to(name)
    assert run(command.split()) == 2
    said = capsys.readouterr().err
    assert said.startswith("error: ") and said.count("\n") == 1
    assert "loop." in said and said.count("cannot be read") <= 1


@pytest.mark.parametrize("place", ["folder.xml", "file/a.xml", "/proc/a.xml"])
def test_an_export_that_cannot_be_is_noticed_before_the_search(etot: Etot, place: str) -> None:
    Path("folder.xml").mkdir()
    Path("file").touch()
    searched: list[object] = []
    answer = etot("plan", "toy.yaml", "--export", place, rule=lambda *given: searched.append(given))
    assert answer.code == 2 and "cannot write" in answer.err and not searched
    assert not Path("results").exists()


def test_an_export_makes_its_folder_only_when_it_is_written(etot: Etot) -> None:
    export = ("plan", "toy.yaml", "--export", "a/b/c.xml")
    assert etot(*export, branches=("bad",), rule=fails("bad")).code == 1
    assert not Path("a").exists()
    assert etot(*export).code == 0
    assert Path("a/b/c.xml").is_file()


def test_no_command_shows_the_help(etot: Etot) -> None:
    answer = etot()
    assert answer.code == 2 and "Commands:" in answer.err


def test_simulate(etot: Etot) -> None:
    answer = etot(*SIMULATE, "--json")
    assert answer.code == 0
    assert answer.report["schema"] == "etot.simulate/1"
    assert etot(*SIMULATE, rule=fails("[PICK UP, cup]")).code == 1


def test_plan_and_simulate_go_together(etot: Etot) -> None:
    etot("plan", "toy.yaml", "--out", "first", branches=["cup box"])
    for given in ("first/report.json", "first"):
        answer = etot("simulate", "toy.yaml", "--plan", given, "--json")
        assert answer.code == 0
        assert answer.report["plan"] == ["[PICK UP, cup]", "[PICK UP, box]"]


def test_errors_below_keep_their_exit_code(etot: Etot, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> rooms.Rooms:
        raise ServiceError("no OpenGL here")

    etot("plan", "toy.yaml")
    monkeypatch.setattr(rooms, "default_rooms", missing)
    assert run(["plan", "toy.yaml"]) == ServiceError.exit_code == 3
    assert SpecError.exit_code == 2


def test_defects_are_confessed_in_a_sentence(etot: Etot) -> None:
    def defect(*_: object) -> None:
        raise ZeroDivisionError("oh")

    answer = etot("plan", "toy.yaml", "-q", rule=defect)
    assert answer.code == 70
    assert answer.err.count("\n") == 1 and "ZeroDivisionError: oh" in answer.err
    detailed = etot("plan", "toy.yaml", "-v", rule=defect)
    assert "Traceback" in detailed.err


def test_missing_opengl_is_told_after_the_report_is_saved(
    etot: Etot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "etot_cli.world.film", None)
    answer = etot(*SIMULATE, "--video", "--out", "x")
    assert answer.code == 3 and "OpenGL" in answer.err
    assert json.loads((tmp_path / "x" / "report.json").read_text())["status"] == "success"


NOT_DONE = (
    Condition.model_validate({"on": ["cup", "desk"]}),
    Condition.model_validate({"in_hand": "cup"}),
)


def test_a_plan_after_which_the_task_is_not_done_is_no_success(etot: Etot) -> None:
    answer = etot("plan", "toy.yaml", success=NOT_DONE)
    assert answer.code == 1
    assert "feasible plan" in answer.out
    assert "the task is not done after it: cup in hand does not hold" in answer.out
    assert "cup on desk: holds" in answer.out
    quiet = etot("plan", "toy.yaml", "-q", success=NOT_DONE)
    assert quiet.code == 1 and len(quiet.out.splitlines()) == 1 and "not done" in quiet.out
    report = etot("plan", "toy.yaml", "--json", success=NOT_DONE).report
    assert report["status"] == "feasible"
    assert report["success"] == {
        "holds": False,
        "conditions": [
            {"condition": "cup on desk", "holds": True},
            {"condition": "cup in hand", "holds": False},
        ],
    }


def test_a_goal_that_seems_to_hold_is_checked_too(etot: Etot) -> None:
    answer = etot("plan", "toy.yaml", branches=(), success=NOT_DONE)
    assert answer.code == 1 and "not done" in answer.out


def test_a_limit_shows_how_far_the_search_came(etot: Etot) -> None:
    answer = etot("plan", "toy.yaml", "--max-nodes", "1", branches=("a b c",))
    assert answer.code == 1
    assert "As far as it came" in answer.out and "then [PICK UP, b] [PICK UP, c]" in answer.out
    assert "1 actions were simulated" in answer.out or "1 action was simulated" in answer.out
    report = etot("plan", "toy.yaml", "--max-nodes", "1", "--json", branches=("a b c",)).report
    assert report["status"] == "limit" and report["success"] is None
    assert report["prefix"] == {
        "actions": ["[PICK UP, a]"],
        "nodes": [1],
        "missing": ["[PICK UP, b]", "[PICK UP, c]"],
    }


@pytest.mark.slow
def test_page_is_written_beside_the_report(
    etot: Etot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ETOT_HTML", "1")
    assert etot("plan", "toy.yaml", "--out", "x").code == 0
    report = json.loads((tmp_path / "x" / "report.json").read_text())
    assert report["files"]["page"] == "report.html"
    assert "[PICK UP, a]" in (tmp_path / "x" / "report.html").read_text()
    assert report["timing"]["phases"]["render"] >= 0
    assert etot(*SIMULATE, "--out", "y").code == 0
    assert (tmp_path / "y" / "report.html").is_file()
    assert etot("plan", "toy.yaml", "--out", "z", "--no-html").code == 0
    assert not (tmp_path / "z" / "report.html").exists()


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (ZeroDivisionError("oh"), "ZeroDivisionError: oh (a defect of etot)"),
        (OSError(24, "Too many open files"), "[Errno 24] Too many open files\n"),
    ],
)
def test_page_that_cannot_be_written_changes_no_answer(
    etot: Etot, monkeypatch: pytest.MonkeyPatch, error: Exception, said: str
) -> None:
    def fail(*given: object) -> None:
        raise error

    monkeypatch.setattr("etot_cli.commands.pages.write_plan_page", fail)
    answer = etot("plan", "toy.yaml", "--html", "--out", "x", "--json")
    assert answer.code == 0 and answer.report["status"] == "feasible"
    assert f"warning: no page was written: {said}" in answer.err


def test_interrupted_rendering_keeps_the_plan(
    etot: Etot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(*given: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("etot_cli.commands.pages.write_plan_page", stop)
    answer = etot("plan", "toy.yaml", "--html", "--out", "x", "--json")
    assert answer.code == 130
    assert answer.report["plan"] and answer.report["interrupted"] is True


def test_export_needs_a_known_ending(etot: Etot, tmp_path: Path) -> None:
    answer = etot("plan", "toy.yaml", "--export", "plan.doc")
    assert answer.code == 2 and ".pddl.txt" in answer.err
    answer = etot("plan", "toy.yaml", "--export", "bt.xml", "--export", "plan.pddl.txt", "-q")
    assert answer.code == 0
    assert (tmp_path / "bt.xml").is_file() and (tmp_path / "plan.pddl.txt").is_file()


def test_report_tells_how_long_the_reasoner_took(etot: Etot) -> None:
    cost = etot("plan", "toy.yaml", "--json").report["statistics"]
    assert isinstance(cost, dict) and 0 <= cost["reasoning_s"] <= cost["wall_s"] + 0.01


@pytest.mark.parametrize(
    "words",
    [["plan"], ["bench", "--methods", "rekep"], ["execute"], ["simulate", "--plan", "[OPEN, x]"],
     ["reconstruct"]],
    ids=lambda words: words[0],
)  # fmt: skip
def test_a_signal_that_a_library_kept_to_itself_is_heeded(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(interrupts, "_signals", [0.0])
    out = tmp_path / "out"
    assert run([words[0], "tasks/task3.yaml", *words[1:], "--out", str(out)]) == 130
    assert not out.exists()


@pytest.mark.parametrize("command", ["plan", "execute --robot sim"])
@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("instruction: Frobnicate the cup.", ":2: instruction: cannot read the instruction at "),
        ("goal: [{not: {upright: cup}}]", ":2: goal: cup: no skill makes 'upright' untrue; "),
        ("robot: panda", ":5: scene.robot: no robot 'panda'"),
    ],
)
def test_what_is_found_out_in_use_is_told_with_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str, asked: str, told: str
) -> None:
    file = tmp_path / "mine.yaml"
    cup = "{kind: cup, at: [0.4, 0.0], diameter: 0.08, height: 0.09, mass: 0.1}"
    robot = f"  {asked}\n" if asked.startswith("robot") else ""
    words = "instruction: Pick up the cup." if robot else asked
    file.write_text(f"# mine\n{words}\nscene:\n  objects: {{cup: {cup}}}\n{robot}")
    out = ["--out", str(tmp_path / "out"), "--no-html"]
    assert run([*command.split(), str(file), *out]) == 2
    assert capsys.readouterr().err.startswith(f"error: {file}{told}")


@pytest.mark.parametrize(
    ("plan", "told"),
    [
        ("[PICK UP, pen] [PUT ON, desk] (left of pen)", "left of pen is no place for pen"),
        ("[PICK UP, pen] [PUT ON, desk] (between vase and vase)", "is no place for pen"),
    ],
)
def test_nothing_is_put_beside_itself(
    plan: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    shipped = Path(__file__).parents[2] / "tasks" / "task3.yaml"
    assert run(["simulate", str(shipped), "--plan", plan, "--no-html"]) == 2
    assert told in capsys.readouterr().err
