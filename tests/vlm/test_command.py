"""``etot plan --reasoner vlm`` with a toy world: exit codes, messages, bounds, whole reports."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from etot_cli import rooms
from etot_cli.cli.app import run
from etot_cli.reasoning.vlm.fake_server import FakeServer, Script
from etot_cli.reasoning.vlm.player import Player, Received, Reply
from etot_cli.reasoning.vlm.probe import probe_picture
from etot_cli.reasoning.vlm.rendered import RenderedFrames
from tests.planning.fakes import Rule, ToyReasoner, ToySimulator, fails
from tests.reporting.toy_rooms import ToyRooms
from tests.vlm.conftest import KEY
from tests.vlm.scripts import rule

ROOT = Path(__file__).parents[2]
SCHEMA = json.loads((ROOT / "docs" / "schemas" / "etot.plan-1.json").read_text(encoding="utf-8"))
GOOD = [
    rule("scene", "The cup is on the desk."),
    rule("branches", "1. [PICK UP, cup]\n2. [PUT ON, box]"),
    rule("compare", '{"before": [], "after": [], "outcome": "success", "explanation": ""}'),
    rule("reflect", "None."),
]


@dataclass
class Answer:
    code: int
    out: str
    err: str
    requests: list[Received]
    report: dict[str, Any]


Etot = Callable[..., Answer]


class Forgetful(list[tuple[str, str]]):
    """Actions that differ in their safe place alone look the same to the toy world."""

    def __contains__(self, item: object) -> bool:
        return False


@pytest.fixture
def etot(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Etot:
    settings = {
        "OPENAI_API_KEY": KEY,
        "ETOT_VLM_IMAGES": "0",
        "ETOT_VLM_CACHE": "off",
        "ETOT_VLM_BACKOFF_S": "0.001",
        "ETOT_VLM_RETRIES": "1",
        "ETOT_VLM_READ_TIMEOUT_S": "0.3",
        "ETOT_VLM_DEADLINE_S": "1",
    }
    for name, value in settings.items():
        monkeypatch.setenv(name, value)

    def call(
        script: Script | Sequence[Any], *arguments: str, world: Rule | None = None, url: str = ""
    ) -> Answer:
        simulator = ToySimulator(world or fails())
        simulator.submitted = Forgetful()
        toys = ToyRooms(simulator, ToyReasoner([]))
        monkeypatch.setattr(rooms, "default_rooms", toys.rooms)
        for old in Path("out").glob("*"):
            old.unlink()
        with FakeServer(script if callable(script) else Player(script)) as server:
            given = [] if "builtin" in arguments else ["--vlm-url", url or server.url]
            code = run(
                ["plan", "toy.yaml", "--reasoner", "vlm", "--out", "out", *given, *arguments]
            )
        captured = capsys.readouterr()
        report: dict[str, Any] = {}
        if Path("out/report.json").exists():
            report = json.loads(Path("out/report.json").read_text(encoding="utf-8"))
            jsonschema.validate(report, SCHEMA)
            assert KEY not in json.dumps(report)
        assert KEY not in captured.out + captured.err
        assert "Traceback" not in captured.err
        return Answer(code, captured.out, captured.err, server.requests, report)

    return call


@pytest.mark.slow
def test_a_plan(etot: Etot) -> None:
    answer = etot(GOOD, "--model", "some-model")
    assert answer.code == 0
    assert answer.report["plan"] == ["[PICK UP, cup]", "[PUT ON, box]"]
    vlm = answer.report["vlm"]
    assert vlm["model"] == "some-model" and vlm["judge"] == "both" and not vlm["replayed"]
    assert set(vlm["roles"]) == {"scene", "branches", "compare"}
    assert vlm["total"]["requests"] == 4 and vlm["total"]["input_tokens"] == 400
    assert "some-model: 4 requests" in answer.out


def test_builtin_reports_no_model(etot: Etot) -> None:
    assert etot(GOOD, "--reasoner", "builtin").report["vlm"] is None


@pytest.mark.slow
def test_a_disagreement_is_in_the_report(etot: Etot) -> None:
    rules = [
        rule(
            "compare",
            '{"before": [], "after": [], "outcome": "unsafe", "explanation": "It broke."}',
            contains=["[PUT ON, box]"],
        ),
        *GOOD,
    ]
    answer = etot(rules)
    assert answer.code == 0
    (note,) = [n for n in answer.report["vlm"]["notes"] if n["kind"] == "disagreement"]
    assert note["action"] == "[PUT ON, box]" and "It broke." in note["text"]
    assert etot(rules, "--judge", "vlm").code == 1
    silent = etot(rules, "--judge", "state")
    assert silent.code == 0 and "compare" not in silent.report["vlm"]["roles"]


# -- models that do not help ---------------------------------------------------------------------


@pytest.mark.parametrize(
    "nonsense",
    [
        "Bananas.",
        "",
        "[[[[",
        '{"a": 1}',
        "yes",
        "1.\n2.\n3.",
        "None.",
        "[PICK UP, banana]",
        "Step 1: [FLY, cup]",
    ],
)
@pytest.mark.slow
def test_a_model_that_always_answers_nonsense(etot: Etot, nonsense: str) -> None:
    answer = etot(lambda _: Reply(nonsense))
    assert answer.code == 1 and answer.report["status"] == "infeasible"
    assert "no plan that is well formed" in answer.report["stopped"]
    assert not answer.report["tree"]["nodes"] and not answer.report["understood"]["goal_holds"]
    assert len(answer.requests) <= 8
    assert any(note["kind"] == "dropped" for note in answer.report["vlm"]["notes"])


@pytest.mark.slow
def test_a_model_that_always_proposes_the_same_failing_plan(etot: Etot) -> None:
    answer = etot(lambda _: Reply("1. [PICK UP, cup]\n2. [PUT ON, box]"), world=fails("cup"))
    assert answer.code == 1 and answer.report["status"] == "infeasible"
    assert answer.report["statistics"]["nodes_evaluated"] == 1
    assert len(answer.requests) <= 2 + 4 + 4
    notes = [n["text"] for n in answer.report["vlm"]["notes"] if n["role"] == "reflect"]
    assert notes and all("this is the plan that failed" in text for text in notes)


@pytest.mark.slow
def test_a_model_that_varies_a_hopeless_plan_without_end(etot: Etot) -> None:
    count = 0

    def script(received: Received) -> Reply:
        nonlocal count
        count += received.role == "reflect"
        more = "[PICK UP, cup] [PUT ON, desk] (safe place) " * (count % 20 + 1)
        return Reply(more + "[OPEN, box]" if received.role != "screen" else "no")

    def hopeless(history: str, action: Any, world: int) -> Any:
        return fails("[OPEN, box]")("", action, world)

    answer = etot(script, world=hopeless)
    assert answer.code == 1
    assert answer.report["statistics"]["reflections"] <= 8
    assert len(answer.requests) < 400


@pytest.mark.slow
def test_a_model_that_stalls(etot: Etot) -> None:
    begun = time.monotonic()
    answer = etot(lambda _: Reply(stall_s=3.0))
    assert time.monotonic() - begun < 5.0
    assert answer.code == 3 and answer.report["statistics"]["limit"] == "service"
    assert len(answer.requests) == 2
    assert answer.err.endswith("after 2 attempts\n") and "http://127.0.0.1" in answer.err
    assert answer.report["status"] == "limit" and "fell silent" in answer.report["stopped"]


@pytest.mark.slow
def test_a_service_that_dies_on_the_way(etot: Etot) -> None:
    def script(received: Received) -> Reply:
        dead = received.role == "compare" and "PUT ON" in received.text
        return Reply(status=503, raw=b"{}") if dead else Player(GOOD)(received)

    answer = etot(script)
    assert answer.code == 3 and "HTTP 503" in answer.err
    statuses = [node["status"] for node in answer.report["tree"]["nodes"]]
    assert statuses == ["success", "pending"]


@pytest.mark.slow
def test_a_refused_key(etot: Etot) -> None:
    body = json.dumps({"error": {"message": f"Incorrect API key provided: {KEY}."}}).encode()
    answer = etot(lambda _: Reply(status=401, raw=body))
    assert answer.code == 3 and len(answer.requests) == 1
    assert "OPENAI_API_KEY" in answer.err and "[redacted]" in answer.err


@pytest.mark.slow
def test_nobody_listens(etot: Etot) -> None:
    answer = etot(GOOD, url="http://127.0.0.1:9/v1")
    assert answer.code == 3 and "no connection" in answer.err and answer.report["stopped"]


def press_ctrl_c() -> None:
    """A real signal, which also ends a wait for the network."""
    main = threading.main_thread().ident
    assert main is not None
    signal.pthread_kill(main, signal.SIGINT)


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Signals as in a terminal; a shell's background jobs have SIGINT ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
@pytest.mark.slow
def test_ctrl_c_while_a_server_stalls(etot: Etot) -> None:
    def script(received: Received) -> Reply:
        if received.role == "compare":
            threading.Timer(0.1, press_ctrl_c).start()
            return Reply(stall_s=1.0)
        return Player(GOOD)(received)

    answer = etot(script)
    assert answer.code == 130 and answer.report["interrupted"]
    assert [node["status"] for node in answer.report["tree"]["nodes"]] == ["pending"] * 2


def test_a_missing_key_is_told_before_anything_is_asked(
    etot: Etot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("OPENAI_API_KEY")
    answer = etot(GOOD, url="https://api.openai.com/v1")
    assert answer.code == 3 and "set OPENAI_API_KEY" in answer.err and not answer.report


# -- limits and settings -------------------------------------------------------------------------


@pytest.mark.slow
def test_limits_end_it_cleanly(etot: Etot) -> None:
    answer = etot(GOOD, "--max-calls", "3")
    assert answer.code == 1 and len(answer.requests) == 3
    assert answer.report["status"] == "limit"
    assert answer.report["statistics"]["limit"] == "max_calls" and "--max-calls" in answer.out
    answer = etot(GOOD, "--max-cost", "0.0008")
    assert answer.report["statistics"]["limit"] == "max_cost" and len(answer.requests) == 2
    assert 0.0008 <= answer.report["vlm"]["total"]["cost"] < 0.0015


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--max-cost", "1", "--model", "unheard-of"], "--max-cost needs the price of unheard-of"),
        (["--vlm-url", "nowhere"], "--vlm-url"),
        (["--judge", "jury"], "--judge"),
        (["--replay", "none"], "--replay none: there is no such folder"),
        (["--max-calls", "-1"], "--max-calls"),
        (["--max-cost", "nan"], "--max-cost"),
    ],
)
def test_unusable_settings(etot: Etot, arguments: list[str], said: str) -> None:
    answer = etot(GOOD, *arguments)
    assert answer.code == 2 and said in answer.err and answer.err.count("\n") == 1
    assert not answer.requests and not answer.report


@pytest.mark.slow
def test_record_and_replay_give_the_same_tree(etot: Etot) -> None:
    first = etot(GOOD, "--record", "tape", world=fails("[PICK UP, cup] [PUT ON, box]"))
    again = etot(
        [],
        "--replay",
        "tape",
        world=fails("[PICK UP, cup] [PUT ON, box]"),
        url="http://127.0.0.1:9/v1",
    )
    assert first.code == again.code == 1
    assert again.report["vlm"]["replayed"] and again.report["vlm"]["total"]["requests"] == 0
    for report in (first.report, again.report):
        for node in report["tree"]["nodes"]:
            del node["wall_s"]
    assert first.report["tree"] == again.report["tree"]
    assert first.report["vlm"]["notes"] == again.report["vlm"]["notes"]
    other = etot([], "--replay", "tape", "--seed", "5")
    assert other.code == 3 and "has no answer" in other.err


@pytest.mark.slow
def test_the_cache_is_on_by_default(etot: Etot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ETOT_VLM_CACHE")
    with FakeServer(Player(GOOD)) as server:
        for _ in range(2):
            assert etot(GOOD, url=server.url).code == 0
        assert len(server.requests) == 4


# -- sight ---------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.render
def test_a_model_that_does_not_see_is_found_out(
    etot: Etot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ETOT_VLM_IMAGES", "2")
    # The toy world's things are not in the scene that is rendered.
    monkeypatch.setattr(RenderedFrames, "view", lambda *_, **__: [])
    answer = etot([rule("probe", "A lovely sunset over the sea."), *GOOD])
    assert answer.code == 3 and len(answer.requests) == 1
    assert "does not see" in answer.err and "ETOT_VLM_IMAGES=0" in answer.err
    colors = " and ".join(probe_picture(0)[1])
    assert f"half {probe_picture(0)[1][0]}" in answer.err
    monkeypatch.setenv("ETOT_VLM_READ_TIMEOUT_S", "5")
    seen = etot([rule("probe", f"{colors}."), *GOOD], "--max-calls", "1")
    assert seen.report["statistics"]["limit"] == "max_calls"
    monkeypatch.setenv("ETOT_VLM_PROBE", "false")
    assert "probe" not in etot(GOOD, "--max-calls", "1").report["vlm"]["roles"]


@pytest.mark.slow
def test_help_imports_no_http_client() -> None:
    script = (
        "import sys\nfrom etot_cli.cli.app import run\n"
        "assert run(['plan', '--help']) == 0\n"
        "found = {'httpx', 'anyio', 'pydantic_settings', 'mujoco'} & set(sys.modules)\n"
        "assert not found, found\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "--vlm-url" in done.stdout
