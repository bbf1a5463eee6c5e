"""A benchmark with a scripted model as the reasoner: its calls, tokens and cost in the table."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from etot_cli.cli.app import run
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.player import Player
from tests.benchmark.test_suite import write
from tests.benchmark.video_server import Server
from tests.opengl import missing_opengl
from tests.vlm.scripts import rule, with_common

ROOT = Path(__file__).parents[2]
PLAN = "[PICK UP, ball]"
RULES = with_common(
    [
        rule("branches", f"One branch:\nSubtasks of branch 1:\n1. {PLAN}"),
        rule("oneshot", f"1. {PLAN}"),
        rule("cot_scene", "A ball lies on the desk."),
        rule("cot_attention", "- nothing is in the way"),
        rule("cot_plan", f"1. {PLAN}"),
    ]
)
METHODS = ("rekep", "rekep_cot", "etot", "etot_kinematic")


@pytest.mark.slow
def test_what_a_model_costs_is_in_the_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    monkeypatch.setenv("ETOT_VLM_IMAGES", "0")
    monkeypatch.setenv("ETOT_VLM_CACHE", "off")
    monkeypatch.setenv("ETOT_VLM_PRICE_INPUT", "2")
    monkeypatch.setenv("ETOT_VLM_PRICE_OUTPUT", "10")
    monkeypatch.setenv("OPENAI_API_KEY", "sk-secret-1234567890")
    with FakeServer(Player(RULES)) as server:
        code = run(
            ["bench", str(write(tmp_path, "one")), "--trials", "1", "--methods", ",".join(METHODS),
             "--reasoner", "vlm", "--vlm-url", server.url, "--out", str(out)]
        )  # fmt: skip
        asked = len(server.requests)
    assert code == 0
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    means = {item["method"]: item for item in report["averages"]}
    assert sum(item["model_calls"] for item in means.values()) == asked
    assert means["rekep"]["model_calls"] == 1 < means["rekep_cot"]["model_calls"]
    for item in means.values():
        # The scripted server states 100 and 20 tokens per call.
        assert item["input_tokens"] == 100 * item["model_calls"]
        assert item["cost"] == pytest.approx(item["model_calls"] * (100 * 2 + 20 * 10) / 1e6)
    assert {row["method"]: row["successes"] for row in report["rows"]} == dict.fromkeys(METHODS, 1)
    shown = capsys.readouterr().out
    assert "calls" in shown and "US $" in shown
    everything = "".join(
        path.read_text(encoding="utf-8") for path in out.rglob("*") if path.is_file()
    )
    assert "sk-secret" not in everything + shown
    again = ["bench", "--resume", str(out), "--reasoner", "vlm", "--vlm-url", server.url]
    assert run([*again, "--judge", "state"]) == 2, "trials that another judge decided are others"
    assert "thinking" in capsys.readouterr().err


@pytest.mark.slow
def test_a_server_that_is_not_there_ends_the_run_and_tells_no_secret(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    small = {"IMAGES": "0", "CACHE": "off", "RETRIES": "1", "BACKOFF_S": "0.01",
             "HEADERS": '{"X-Team": "header-secret"}'}  # fmt: skip
    for name, value in small.items():
        monkeypatch.setenv(f"ETOT_VLM_{name}", value)
    monkeypatch.setenv("OPENAI_API_KEY", "sk-secret-1234567890")
    url = "http://user:pass-secret@127.0.0.1:9/v1?token=query-secret-1"
    words = ["bench", str(write(tmp_path, "one")), "--methods", "rekep,etot", "--html", "-v"]
    assert run([*words, "--reasoner", "vlm", "--vlm-url", url, "--out", str(out)]) == 3
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    assert report["status"] == "lost" and "127.0.0.1:9" in report["reason"]
    assert 3 <= len(report["trials"]) <= 5, "of twenty"
    said = capsys.readouterr()
    assert "--resume" in said.err
    page = (out / "report.html").read_text("utf-8")
    assert "Not all trials were run: the question" in page
    written = b"".join(path.read_bytes() for path in out.rglob("*") if path.is_file())
    assert b"secret" not in written and "secret" not in said.out + said.err


@pytest.mark.slow
@pytest.mark.render
def test_videos_as_the_world_model(server: Server, tmp_path: Path) -> None:
    """Every action considered is a video, and the model that looks at its frames is the judge.

    A process of its own: forked workers must not inherit the graphics context of other tests.
    """
    reason = missing_opengl()
    if reason:
        pytest.skip(reason)
    seen = '"before": [], "after": [{"object": "ball", "state": "in the hand"}]'
    rules = [rule("compare", "{" + seen + ', "outcome": "success"}'), *RULES]
    out = tmp_path / "out"
    small = {"ETOT_VLM_IMAGE_WIDTH": "96", "ETOT_VLM_CACHE": "off"}
    with FakeServer(Player(rules)) as model:
        done = subprocess.run(
            [sys.executable, "-m", "etot_cli", "bench", str(write(tmp_path, "one")),
             "--trials", "1", "--methods", "etot_kinematic", "--reasoner", "vlm",
             "--vlm-url", model.url, "--video-url", server.url, "--out", str(out), "-q"],
            env={**os.environ, **small, "PYTHONPATH": str(ROOT)}, cwd=ROOT, text=True,
            capture_output=True, timeout=120, check=False,
        )  # fmt: skip
        judged = [request for request in model.requests if request.role == "compare"]
    assert done.returncode == 0, done.stderr
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    assert report["rows"][0]["successes"] == 1, report["trials"]
    prompts = [request["prompt"] for request in server.requests]
    assert prompts == ["The robot arm picks up the ball."]
    assert len(judged) == 1 and len(judged[0].images) >= 2
