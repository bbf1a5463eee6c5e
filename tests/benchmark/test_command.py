"""The command: reports, resuming, comparing, and one small run of the real program."""

from __future__ import annotations

import csv
import json
import sys
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

from etot_cli.benchmark.running.runner import TrialWork
from etot_cli.benchmark.trial import TrialResult, TrialStatus
from etot_cli.cli.app import run
from etot_cli.commands import bench
from etot_cli.commands.bench import BenchOptions, run_bench
from etot_cli.commands.bench_compare import compare
from etot_cli.errors import EtotError, SpecError
from etot_cli.reporting.bench_report import BenchReport, CompareReport
from etot_cli.reporting.bench_table import BenchSummary, significantly_worse
from etot_cli.reporting.files import write_report
from etot_cli.reporting.style import Verbosity, make_console
from tests.benchmark import toys
from tests.benchmark.test_suite import suite, write
from tests.docs.schemas import schema_text

TOYS = toys.perform, toys.begin


def lucky(item: TrialWork) -> TrialResult:
    """Everything works but what is asked of one method."""
    bad = item.key.method == "rekep"
    status = TrialStatus.FAILURE if bad else TrialStatus.SUCCESS
    return replace(toys.result(item), status=status, reason="it fell" if bad else "")


def options(*inputs: Path, **more: object) -> BenchOptions:
    given: dict[str, object] = {"methods": ("etot", "rekep"), "trials": 4, **more}
    return BenchOptions(inputs=tuple(map(str, inputs)), **given)  # type: ignore[arg-type]


@pytest.fixture
def task(tmp_path: Path) -> Path:
    return write(tmp_path / "given", "one")


@pytest.mark.parametrize(
    "damage",
    ["", "{", "[]", "[" * 100_000, {"inputs": [1]}, {"trials": 10**30}, {"trials": "x"},
     {"seed": None}, {"methods": [["x"]]}, {"more": 1}],
)  # fmt: skip
def test_a_damaged_description_is_refused(tmp_path: Path, task: Path, damage: object) -> None:
    folder = made(tmp_path / "out")
    run_bench(options(task, trials=1), folder, perform=TOYS)
    path = folder / "bench.json"
    good = json.loads(path.read_text("utf-8"))
    text = damage if isinstance(damage, str) else json.dumps({**good, **dict(damage)})  # type: ignore[call-overload]
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SpecError, match=r"bench\.json: .*no benchmark's description"):
        run_bench(BenchOptions(inputs=(), resume=True), folder, perform=TOYS)


def test_trials_of_other_worlds_are_refused(tmp_path: Path, task: Path) -> None:
    folder = made(tmp_path / "out")
    run_bench(options(task, trials=1), folder, perform=TOYS)
    lines = folder / "trials.jsonl"
    lines.write_text(lines.read_text("utf-8").replace('"seed": 0', '"seed": 8'), encoding="utf-8")
    with pytest.raises(SpecError, match=r"seed 8; expected 0"):
        run_bench(options(task, trials=1, resume=True), folder, perform=TOYS)


def test_a_new_run_leaves_nothing_of_the_old_one(tmp_path: Path, task: Path) -> None:
    folder = made(tmp_path / "out")
    run_bench(options(task, trials=1), folder, perform=TOYS)
    old = folder / "trials" / "rekep" / "other-0.json"
    own = folder / "tasks" / "mine.yaml"
    for file in (old, own, folder / "report.html"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    elsewhere = made(tmp_path / "elsewhere") / "kept.json"
    elsewhere.touch()
    (folder / "trials" / "etot").symlink_to(elsewhere.parent)
    with pytest.raises(SpecError):
        run_bench(options(tmp_path / "no.yaml", force=True), folder, perform=TOYS)
    assert old.exists(), "what cannot be begun throws nothing away"
    report = run_bench(options(task, trials=2, force=True), folder, perform=TOYS)
    assert len(report.trials) == 4 and not old.exists()
    assert not (folder / "report.html").exists()
    assert own.exists() and elsewhere.exists(), "what no run wrote stays"


def test_more_trials_than_a_report_can_hold(tmp_path: Path, task: Path) -> None:
    second = write(tmp_path / "given", "two")
    with pytest.raises(EtotError, match="160000 trials; expected at most 100000"):
        run_bench(options(task, second, methods=None, trials=10_000), made(tmp_path / "out"))


@pytest.mark.parametrize(
    ("flags", "code", "told"),
    [
        (["--reasoner", "vlm"], 3, "there is no key"),
        (["--reasoner", "vlm", "--vlm-url", "http://h", "--model", "own", "--max-cost", "1"], 2,
         "needs the price of own"),
        (["--reasoner", "vlm", "--vlm-url", "ftp://u:hidden@h"], 2, "no http(s) URL"),
        (["--video-url", "ftp://u:hidden@h/?key=hidden", "--reasoner", "vlm", "--vlm-url",
          "http://127.0.0.1:9"], 2, "--video-url"),
    ],
)  # fmt: skip
def test_what_no_trial_could_do_without_is_missed_before_the_first(
    tmp_path: Path, task: Path, flags: list[str], code: int, told: str,
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    for name in ("OPENAI_API_KEY", "ETOT_VLM_KEY", "OPENAI_BASE_URL", "ETOT_VLM_URL"):
        monkeypatch.delenv(name, raising=False)
    assert run(["bench", str(task), *flags, "--out", str(tmp_path / "out")]) == code
    said = capsys.readouterr().err
    assert told in said and "hidden" not in said
    assert not (tmp_path / "out" / "bench.json").exists()


@pytest.mark.slow
def test_a_task_that_no_trial_could_read_is_missed_before_the_first(
    tmp_path: Path, task: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = write(task.parent, "two")
    other.write_text(other.read_text("utf-8").replace("Pick up", "Frobnicate"), encoding="utf-8")
    out = tmp_path / "out"
    assert run(["bench", str(task.parent), "--out", str(out)]) == 2
    assert "two.yaml:2: instruction: cannot read the instruction" in capsys.readouterr().err
    assert not out.exists()


def made(folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    return folder


@pytest.mark.slow
def test_a_report_keeps_to_its_schema(tmp_path: Path, task: Path) -> None:
    folder = made(tmp_path / "out")
    report = run_bench(options(task), folder, perform=TOYS)
    path = write_report(report, folder)
    jsonschema.validate(json.loads(path.read_text("utf-8")), json.loads(schema_text(BenchReport)))
    assert report.status == "success" and len(report.trials) == 8
    assert [method.name for method in report.methods] == ["rekep", "etot"], "in the table's order"
    (pair,) = report.comparisons
    assert (pair.first, pair.second) == ("etot", "rekep")
    for row in report.rows:
        own = [t for t in report.trials if (t.method, t.task) == (row.method, row.task)]
        assert row.successes == sum(trial.status == "success" for trial in own)
    rows = list(csv.DictReader((folder / report.files["trials"]).open(encoding="utf-8")))
    assert [row["success"] for row in rows] == [
        str(int(trial.status == "success")) for trial in report.trials
    ]


def test_a_table_that_cannot_be_written_does_not_cost_the_report(
    tmp_path: Path, task: Path
) -> None:
    folder = made(tmp_path / "out")
    (folder / "rows.csv").mkdir()
    report = run_bench(options(task), folder, perform=TOYS)
    assert report.status == "lost" and "rows.csv" in report.reason and len(report.trials) == 8


@pytest.mark.parametrize("where", ["open_engine", "write_csv"])
def test_ctrl_c_at_any_moment_of_a_run_keeps_its_trials(
    tmp_path: Path, task: Path, where: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = made(tmp_path / "out")
    genuine = getattr(bench, where)

    def once(*given: object) -> object:
        monkeypatch.setattr(bench, where, genuine)
        raise KeyboardInterrupt

    monkeypatch.setattr(bench, where, once)
    report = run_bench(options(task), folder, perform=TOYS)
    assert report.interrupted and len(report.trials) == (8 if where == "write_csv" else 0)


def test_a_run_is_gone_on_with_and_not_begun_anew(tmp_path: Path, task: Path) -> None:
    folder = made(tmp_path / "out")
    noted = toys.noted, toys.begin
    first = run_bench(options(task, trials=2), folder, perform=noted)
    # The file may have moved; the task in it is the same.
    again = write(tmp_path / "moved", "one")
    more = run_bench(options(again, trials=2, resume=True), folder, perform=noted)
    assert more.trials == first.trials and more.rows == first.rows
    # Whole worlds, so that methods can be compared, and in each the method first that simulates.
    begun = (folder / "begun").read_text(encoding="utf-8").splitlines()
    assert begun == ["etot/one-0", "rekep/one-0", "etot/one-1", "rekep/one-1"]
    bare = BenchOptions(inputs=(), resume=True)
    assert run_bench(bare, folder, perform=noted).rows == first.rows, "the folder knows it all"


@pytest.mark.parametrize(
    ("change", "told"),
    [({"trials": 3}, "trials 2"), ({"seed": 1}, "seed 0"), ({"methods": ("etot",)}, "methods")],
)
def test_a_folder_of_another_run_is_refused(
    tmp_path: Path, task: Path, change: dict[str, object], told: str
) -> None:
    folder = made(tmp_path / "out")
    run_bench(options(task, trials=2), folder, perform=TOYS)
    lines = (folder / "trials.jsonl").read_bytes()
    with pytest.raises(EtotError, match=told):
        run_bench(options(task, **{"trials": 2, "resume": True, **change}), folder, perform=TOYS)
    with pytest.raises(EtotError, match="--resume"):
        run_bench(options(task, trials=2), folder, perform=TOYS)
    write(task.parent, "one", 0.06)
    with pytest.raises(EtotError, match="tasks"):
        run_bench(options(task, trials=2, resume=True), folder, perform=TOYS)
    assert (folder / "trials.jsonl").read_bytes() == lines
    with pytest.raises(EtotError, match="no run in"):
        run_bench(options(task, resume=True), made(tmp_path / "empty"), perform=TOYS)


def test_a_suite_says_what_the_command_line_does_not(tmp_path: Path, task: Path) -> None:
    own = suite(task.parent, "tasks: [one.yaml]\nmethods: [etot]\nseeds: [3, 5]\n")
    report = run_bench(BenchOptions(inputs=(str(own),)), made(tmp_path / "out"), perform=TOYS)
    assert [(t.method, t.seed) for t in report.trials] == [("etot", 3), ("etot", 5)]


@pytest.mark.slow
def test_what_got_significantly_worse_is_found(tmp_path: Path, task: Path) -> None:
    before, after = made(tmp_path / "before"), made(tmp_path / "after")
    good = options(task, trials=12, methods=("etot", "reflect", "rekep"))
    write_report(run_bench(good, before, perform=(_all_good, toys.begin)), before)
    write_report(run_bench(good, after, perform=(lucky, toys.begin)), after)
    found = compare(before, after / "report.json")
    jsonschema.validate(json.loads(found.model_dump_json()), json.loads(schema_text(CompareReport)))
    assert [pair.second for pair in found.comparisons if significantly_worse(pair)] == ["rekep"]
    assert not any(map(significantly_worse, compare(before, before).comparisons))
    assert (found.status, compare(after, before).status) == ("failure", "success")
    assert run(["bench", "--compare", str(before), str(after)]) == 1
    kept = tmp_path / "kept"
    assert run(["bench", "--compare", str(after), str(before), "--out", str(kept)]) == 0
    assert CompareReport.model_validate_json((kept / "report.json").read_text()).comparisons
    assert "no method got significantly worse" in (kept / "report.html").read_text()
    assert run(["bench", "--compare", str(after), str(before), "--out", str(kept)]) == 2


@pytest.mark.parametrize(
    ("flags", "told"),
    [
        (["--compare", "a", "b", "--trials", "3"], "--trials has no place beside --compare"),
        (["--compare", "a", "b", "--no-html"], "--no-html has no place beside --compare"),
        (["--compare", "a", "b", "TASK"], "TASKS has no place beside --compare"),
        (["TASK", "--judge", "state", "--max-calls", "3"], "--judge, --max-calls: the builtin"),
        (["TASK", "--out", ""], "found '', expected a folder"),
        (["--resume", "FOLDER", "--force"], "--force has no place beside it"),
        (["TASK", "--methods", "rekep, x"], "no method 'x'"),
    ],
)
def test_flags_that_mean_nothing_are_refused(
    tmp_path: Path, task: Path, flags: list[str], told: str,
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    names = {"TASK": str(task), "FOLDER": str(task.parent)}
    assert run(["bench", *(names.get(word, word) for word in flags)]) == 2
    assert told in capsys.readouterr().err
    assert [item.name for item in tmp_path.iterdir()] == ["given"], "nothing is left behind"


def test_reports_that_cannot_be_compared(tmp_path: Path, task: Path) -> None:
    first, second = made(tmp_path / "a"), made(tmp_path / "b")
    write_report(run_bench(options(task, seed=1), first, perform=TOYS), first)
    write_report(run_bench(options(task, seed=2), second, perform=TOYS), second)
    with pytest.raises(EtotError, match="no trial in common"):
        compare(first, second)
    (tmp_path / "other.json").write_text('{"schema": "etot.plan/1"}', encoding="utf-8")
    with pytest.raises(SpecError, match=r"other\.json.*etot\.bench/1"):
        compare(tmp_path / "other.json", second)


def _all_good(item: TrialWork) -> TrialResult:
    return replace(toys.result(item), status=TrialStatus.SUCCESS, reason="")


@pytest.mark.parametrize("tasks", [1, 12])
def test_the_table_is_readable_in_80_columns(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], tasks: int
) -> None:
    files = [write(tmp_path / "given", f"a_rather_long_name_{n}") for n in range(tasks)]
    report = run_bench(
        options(*files, methods=None, trials=1), made(tmp_path / "out"), perform=TOYS
    )
    piped = make_console(sys.stdout)
    BenchSummary(piped, Verbosity.VERBOSE).show(report, tmp_path / "out" / "report.json")
    text = capsys.readouterr().out
    (head,) = [line for line in text.splitlines() if line.startswith("method")]
    assert all(file.stem in head for file in files), "in a pipe the table is as the paper's"
    terminal = make_console(sys.stdout)
    terminal._force_terminal, terminal.width = True, 80  # what rich knows of a real terminal
    BenchSummary(terminal, Verbosity.NORMAL).show(report, Path("r.json"))
    lines = capsys.readouterr().out.splitlines()
    table = [line for line in lines if "/1" in line]
    assert len(table) >= tasks and all(len(line) <= 80 for line in table)
    terminal.width = 40
    BenchSummary(terminal, Verbosity.NORMAL).show(report, Path("r.json"))
    narrow = capsys.readouterr().out
    assert "EToT: plan s 0.5, nodes 3.0" in narrow, "lines where a table would be cut"


@pytest.mark.slow
def test_the_real_program_on_a_small_scene(tmp_path: Path, task: Path) -> None:
    out = tmp_path / "out"
    words = ["bench", str(task), "--trials", "1", "--methods", "etot,rekep", "--html", "-q"]
    assert run([*words, "--out", str(out)]) == 0
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    assert {row["method"]: row["successes"] for row in report["rows"]} == {"etot": 1, "rekep": 1}
    assert report["peak_mib"] < 700
    own = json.loads((out / report["trials"][0]["report"]).read_text(encoding="utf-8"))
    assert own["schema"] == "etot.trial/1" and own["trial"]["conditions"][0]["held"]
    assert set(own["times"]) >= {"physics", "inverse_kinematics", "rendering", "reasoning"}
    assert sum(own["times"].values()) == pytest.approx(own["wall_s"], rel=0.05)
    links = (out / "report.html").read_text(encoding="utf-8")
    pages = [path.relative_to(out).as_posix() for path in out.glob("trials/*/*.html")]
    assert len(pages) == 2 and all(page in links for page in pages)
    lines = (out / "trials.jsonl").read_bytes()
    assert run(["bench", "--resume", str(out), "-q"]) == 0
    assert (out / "trials.jsonl").read_bytes() == lines
    assert run([*words, "--out", str(out)]) == 2, "a finished run is not replaced"
