"""What people see: live tree, log lines, summaries."""

from __future__ import annotations

import importlib
import io
from pathlib import Path
from typing import get_args

import pytest
from rich.console import Console
from rich.text import Text

from etot_cli.commands.plan import PlanOptions, plan_task
from etot_cli.commands.simulate import SimulateOptions, run_simulate
from etot_cli.planning.result import SearchObserver
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment
from etot_cli.reporting.evidence import JudgedModel, moved_models
from etot_cli.reporting.live import LiveView, window
from etot_cli.reporting.log import PlainLog
from etot_cli.reporting.plan_report import DoubtModel, PlanReport
from etot_cli.reporting.plan_summary import MAX_FAILURES, plan_summary
from etot_cli.reporting.printer import Printer
from etot_cli.reporting.run_summary import simulate_summary
from etot_cli.reporting.style import LOOKS, Verbosity, make_console
from etot_cli.world.state import CauseKind
from tests.planning.fakes import ToyReasoner, ToySimulator, fails
from tests.reasoning import scenes
from tests.reasoning.records import changed, record
from tests.reporting.toy_rooms import ToyRooms


def toy_search(observer: SearchObserver) -> None:
    simulator = ToySimulator(fails("a", "c", kind=CauseKind.LOST))
    search(
        Assignment("do it"), simulator, ToyReasoner(["a b", "c"], {"a b @ 0": "x a b"}),
        observer=observer,
    )  # fmt: skip


class Stream(io.StringIO):
    """A text stream of a given encoding."""

    def __init__(self, encoding: str) -> None:
        super().__init__()
        self._name = encoding

    @property
    def encoding(self) -> str:  # type: ignore[override]
        return self._name


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_live_view_ends_with_the_whole_tree(encoding: str) -> None:
    stream = Stream(encoding)
    console = Console(file=stream, force_terminal=True, width=100, height=30, color_system=None)
    with LiveView(console, "toy") as view:
        toy_search(view)
    last = stream.getvalue()[stream.getvalue().rindex("toy") :]
    if encoding == "ascii":
        last.encode("ascii")
    assert "[PICK UP, a]  unsafe lost: it was lost" in last
    assert ("✓" if encoding == "utf-8" else "+") + " [PICK UP, x]" in last
    assert "5 evaluated" in last and "2 reflections" in last


@pytest.mark.parametrize("width", [30, 40, 60])
def test_live_view_says_why_on_a_narrow_screen(width: int) -> None:
    """... on lines of its own, none of them cut or too long, and the footer whole."""
    stream = Stream("utf-8")
    console = Console(file=stream, force_terminal=True, width=width, height=30, color_system=None)
    with LiveView(console, "toy") as view:
        toy_search(view)
    last = stream.getvalue()[stream.getvalue().rindex("toy") :]
    lines = [line.rstrip() for line in last.splitlines()]
    assert all(len(line) <= width for line in lines if "\x1b" not in line)
    assert "unsafe: it was lost" in last and "…" not in last
    assert "5 done · 0 waiting" in last


def test_live_view_in_detail_shows_removed_nodes() -> None:
    stream = Stream("utf-8")
    console = Console(file=stream, force_terminal=True, width=120, height=40, color_system=None)
    with LiveView(console, "toy", detailed=True) as view:
        toy_search(view)
    assert "- [PICK UP, b]" in stream.getvalue()
    assert "changed: x" in stream.getvalue()


def test_live_view_survives_an_exception() -> None:
    console = Console(file=io.StringIO(), force_terminal=True)
    with pytest.raises(RuntimeError), LiveView(console, "toy"):
        raise RuntimeError


def test_window_keeps_the_focus_in_sight() -> None:
    lines = [Text(str(number)) for number in range(100)]
    for focus in (0, 50, 99):
        shown = [line.plain for line in window(lines, focus, 10)]
        assert str(focus) in shown and len(shown) == 10
    assert "(46 more above)" in window(lines, 50, 10)[0].plain
    assert window(lines[:5], 0, 10) == lines[:5]


def test_log_lines() -> None:
    stream = io.StringIO()
    toy_search(PlainLog(stream))
    assert "x [PICK UP, a]  unsafe: it was lost" in stream.getvalue().replace("!", "x")
    assert "revised" not in stream.getvalue()
    stream = io.StringIO()
    toy_search(PlainLog(stream, detailed=True))
    assert "revised: [PICK UP, x] [PICK UP, a] [PICK UP, b]" in stream.getvalue()
    assert "no revision" in stream.getvalue()


def summary_text(verbosity: Verbosity, *, worlds: int = 1, feasible: bool = True) -> str:
    simulator = ToySimulator(fails("a", "c"), worlds=worlds)
    revisions = {"a b @ 0": "x a b"} if feasible else {}
    rooms = ToyRooms(simulator, ToyReasoner(["a b", "c"], revisions)).rooms()
    report = plan_task(PlanOptions(task=Path("toy.yaml"), worlds=worlds), rooms=rooms).report
    stream = Stream("utf-8")
    plan_summary(Printer(make_console(stream), verbosity), report, Path("out/report.json"))
    return stream.getvalue()


def test_plan_summary() -> None:
    text = summary_text(Verbosity.NORMAL)
    assert "✓ feasible plan  Leave the cup alone." in text
    assert "1 ✓ [PICK UP, x]" in text and "3 ✓ [PICK UP, b]" in text
    assert "failure, blocked: it was blocked" in text
    assert "5 nodes evaluated, 2 reflections" in text
    assert "report: out/report.json" in text
    assert "\x1b" not in text


def test_plan_summary_with_worlds() -> None:
    assert "holds in 3 of 3 varied worlds: 100%" in summary_text(Verbosity.NORMAL, worlds=3)


def test_plan_summary_without_a_plan() -> None:
    assert "✗ no feasible plan" in summary_text(Verbosity.NORMAL, feasible=False)


def test_quiet_is_one_line() -> None:
    text = summary_text(Verbosity.QUIET)
    assert text == "feasible: [PICK UP, x] [PICK UP, a] [PICK UP, b]\n"


def toy_report(branches: list[str], *failing: str) -> PlanReport:
    rooms = ToyRooms(ToySimulator(fails(*failing)), ToyReasoner(branches)).rooms()
    return plan_task(PlanOptions(task=Path("toy.yaml")), rooms=rooms).report


def shown(report: PlanReport, console: Console, verbosity: Verbosity = Verbosity.NORMAL) -> str:
    path = Path("out") / ("deep" * 12) / "report.json"
    plan_summary(Printer(console, verbosity), report, path)
    stream = console.file
    assert isinstance(stream, io.StringIO)
    return stream.getvalue()


def test_failures_come_with_the_history_that_led_to_them() -> None:
    report = toy_report(["a b", "c d"], "a b")
    text = shown(report, make_console(Stream("utf-8")))
    assert "[PICK UP, a] [PICK UP, b]" in text


def test_narrow_terminal_loses_no_word() -> None:
    report = toy_report(["a b", "c d"], "a b")
    report.tree.nodes[1].cause.text = "the long word about what was in the way of all this"
    console = Console(
        file=Stream("utf-8"), force_terminal=True, width=40, height=30, color_system=None
    )
    text = shown(report, console)
    lines = text.splitlines()
    assert all(len(line) <= 40 for line in lines if "out/" not in line)
    words = " ".join(text.split())
    assert "the long word about what was in the way of all this" in words
    assert "…" not in text


def test_piped_lines_are_whole() -> None:
    report = toy_report(["a b", "c d"], "a b")
    report.tree.nodes[1].cause.text = "because " + "of something far away " * 10
    text = shown(report, make_console(Stream("utf-8")))
    assert report.tree.nodes[1].cause.text.strip() in text
    assert not any(line.endswith(" ") for line in text.splitlines() if "because" not in line)


def test_plans_that_are_refused_for_the_same_reason_are_told_once() -> None:
    report = toy_report(["a"], "a")
    report.doubts = [
        DoubtModel(actions=["[PICK UP, a]"] * (9 - number), why="it is open" if number else "lost")
        for number in range(8)
    ]
    text = shown(report, make_console(Stream("utf-8")))
    told = [line for line in text.splitlines() if "not what was asked for" in line]
    assert [line.count("[PICK UP, a]") for line in told] == [9, 2], "the shortest of those alike"
    assert told[1].endswith("it is open; so it is with 6 other plans")
    for doubt, why in zip(report.doubts, "abcdefgh", strict=True):
        doubt.why = why
    text = shown(report, make_console(Stream("utf-8")))
    assert text.count("not what was asked for") == MAX_FAILURES
    assert "2 other reasons to refuse plans in the report" in text


def test_many_failures_fit_the_screen() -> None:
    names = [f"x{number}" for number in range(9)]
    report = toy_report([*names, "good"], *names)
    console = Console(
        file=Stream("utf-8"), force_terminal=True, width=80, height=24, color_system=None
    )
    text = shown(report, console)
    assert len(text.splitlines()) <= 24
    assert "more in the report" in text


def test_quiet_names_the_cause() -> None:
    report = toy_report(["a b"], "a b")
    text = shown(report, make_console(Stream("utf-8")), Verbosity.QUIET)
    assert text == "infeasible: [PICK UP, a] [PICK UP, b]: it was blocked\n"


def test_one_is_singular() -> None:
    stream = io.StringIO()
    rooms = ToyRooms(ToySimulator(fails()), ToyReasoner(["a"])).rooms()
    report = plan_task(PlanOptions(task=Path("toy.yaml")), PlainLog(stream), rooms=rooms).report
    assert "1 branch proposed, 1 node\n" in stream.getvalue()
    assert "1 node evaluated, 0 reflections" in shown(report, make_console(Stream("utf-8")))


def test_simulate_summary() -> None:
    rooms = ToyRooms(ToySimulator(fails("[PICK UP, cup]")), ToyReasoner([])).rooms()
    options = SimulateOptions(task=Path("toy.yaml"), plan="[PICK UP, cup] [PUT ON, desk]")
    report = run_simulate(options, rooms=rooms).report
    stream = Stream("utf-8")
    out = Printer(make_console(stream), Verbosity.NORMAL)
    simulate_summary(out, report, Path("out/report.json"))
    text = stream.getvalue()
    assert "✗ the plan fails" in text
    assert "not tried" in text
    assert "✓ cup on desk: holds" in text


def test_what_was_put_down_lying_is_told() -> None:
    """It stood before; what lay before is not told again."""
    start = scenes.scene(scenes.cup("tin", (0.4, 0.1)), scenes.ball("nut", (0.4, -0.1)))
    lying = changed(start, tin={"toppled": True, "tilt_deg": 90.0})
    for before, told in ((start, "tin (lying)"), (lying, "tin")):
        moved = moved_models(record(before, lying), ["tin", "nut"])
        judged = JudgedModel.model_construct(changes=["tin", "nut"], moved=moved)
        assert judged.told() == [told, "nut"]


def test_what_hangs_askew_in_the_hand_is_not_told_to_lie() -> None:
    start = scenes.scene(scenes.item("case", at=(0.4, 0.1)))
    askew = changed(start, case={"toppled": True, "tilt_deg": 45.0, "in_hand": True, "on": ()})
    lying = changed(start, case={"toppled": True, "tilt_deg": 90.0})
    for before, after, told in (
        (start, askew, "case"),
        (askew, start, "case"),
        (askew, lying, "case (lying)"),
    ):
        moved = moved_models(record(before, after), ["case"])
        judged = JudgedModel.model_construct(changes=["case"], moved=moved)
        assert judged.told() == [told]


def test_every_status_of_a_report_has_a_look() -> None:
    modules = ("plan", "simulate", "execute", "bench", "reconstruct")
    statuses: set[str] = set()
    for name in modules:
        module = importlib.import_module(f"etot_cli.reporting.{name}_report")
        for model in vars(module).values():
            field = getattr(model, "model_fields", {}).get("status")
            statuses |= set() if field is None else set(get_args(field.annotation))
    assert {"feasible", "partial", "interrupted"} <= statuses
    assert statuses <= set(LOOKS)
