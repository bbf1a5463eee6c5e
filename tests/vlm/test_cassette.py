"""Recording, replaying, caching; and that no secret is ever on disk."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from etot_cli.errors import EtotError, ServiceError
from etot_cli.reasoning.vlm.chat import Picture, Question, Trouble, Turn
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.player import Player, Received, Reply, load_player
from tests.vlm.conftest import KEY, Make

PICTURE = Picture.of_pixels("Now:", np.full((40, 60, 3), 90, np.uint8))
QUESTION = Question("screen", "screen/1", (Turn("user", "Is it so?", (PICTURE,)),))
NOWHERE = "http://127.0.0.1:9/v1"


def answer(make: Make, url: str, question: Question = QUESTION, **more: object) -> str:
    client = ChatClient(make(url, images=2, **more))
    try:
        return client.ask(question).text
    finally:
        client.close()


def test_what_was_recorded_is_replayed_without_a_network(
    make_settings: Make, tmp_path: Path
) -> None:
    tape = tmp_path / "tape"
    with FakeServer(lambda _: Reply("yes")) as server:
        assert answer(make_settings, server.url, record=tape, model="m-1") == "yes"
    # The model's name comes from the tape.
    assert answer(make_settings, NOWHERE, replay=tape) == "yes"
    with pytest.raises(ServiceError, match="has no answer of other to this screen question"):
        answer(make_settings, NOWHERE, replay=tape, model="other")
    other = Question("screen", "screen/1", (Turn("user", "Is it really so?"),))
    with pytest.raises(ServiceError, match="has no answer"):
        answer(make_settings, NOWHERE, other, replay=tape)
    (exchange,) = tape.glob("*.json")
    data = json.loads(exchange.read_text())
    assert data["schema"] == "etot.exchange/1" and data["template"] == "screen/1"
    assert (tape / "pictures" / f"{PICTURE.digest}.jpg").stat().st_size > 100


def test_troubles_are_replayed_too(make_settings: Make, tmp_path: Path) -> None:
    with FakeServer(lambda _: Reply("[PICK", finish="length")) as server:
        answer(make_settings, server.url, record=tmp_path / "tape")
    client = ChatClient(make_settings(NOWHERE, replay=tmp_path / "tape"))
    assert client.ask(QUESTION).trouble is Trouble.CUT
    client.close()


def test_the_key_is_the_content(make_settings: Make) -> None:
    key = QUESTION.key("m")
    again = Question("screen", "screen/1", (Turn("user", "Is it so?", (PICTURE,)),))
    assert again.key("m") == key
    darker = Picture.of_pixels("Now:", np.full((40, 60, 3), 89, np.uint8))
    different = [
        QUESTION.key("n"),
        Question("screen", "screen/2", QUESTION.turns).key("m"),
        Question("screen", "screen/1", QUESTION.turns, None, 1).key("m"),
        Question("screen", "screen/1", QUESTION.turns, {"type": "object"}).key("m"),
        Question("screen", "screen/1", (Turn("user", "Is it so?"),)).key("m"),
        Question("screen", "screen/1", (Turn("user", "Is it so?", (darker,)),)).key("m"),
        QUESTION.followed_by(Turn("user", "?")).key("m"),
    ]
    assert len({key, *different}) == len(different) + 1


def test_nothing_is_asked_twice(make_settings: Make, tmp_path: Path) -> None:
    with FakeServer(lambda _: Reply("yes")) as server:
        for _ in range(3):
            assert answer(make_settings, server.url, cache=tmp_path / "c") == "yes"
        assert len(server.requests) == 1
        answer(make_settings, server.url, cache="off")
        assert len(server.requests) == 2
        for path in (tmp_path / "c").rglob("*.json"):
            path.write_text("{", encoding="utf-8")  # a damaged entry is asked anew
        answer(make_settings, server.url, cache=tmp_path / "c")
        assert len(server.requests) == 3


def test_refusals_are_not_cached(make_settings: Make, tmp_path: Path) -> None:
    with FakeServer(lambda _: Reply(None, message={"refusal": "no"})) as server:
        for _ in range(2):
            answer(make_settings, server.url, cache=tmp_path / "c")
        assert len(server.requests) == 2


def test_an_unwritable_cache_costs_nothing(make_settings: Make, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with FakeServer(lambda _: Reply("yes")) as server:
        assert answer(make_settings, server.url, cache=tmp_path / "file") == "yes"
        with pytest.raises(ServiceError, match="cannot write to"):
            answer(make_settings, server.url, record=tmp_path / "file" / "tape")


def test_bad_cassettes_are_told(make_settings: Make, tmp_path: Path) -> None:
    with pytest.raises(EtotError, match="there is no such folder"):
        answer(make_settings, NOWHERE, replay=tmp_path / "none")
    with pytest.raises(EtotError, match="no recorded exchanges"):
        answer(make_settings, NOWHERE, replay=tmp_path)
    for text in ("{", "[]", '{"schema": "etot.exchange/9"}', '{"schema": "etot.exchange/1"}'):
        path = tmp_path / f"screen-{QUESTION.key('gpt-4o')}.json"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(EtotError, match="not a recorded exchange"):
            answer(make_settings, NOWHERE, replay=tmp_path, model="gpt-4o")


def test_no_secret_on_disk(make_settings: Make, tmp_path: Path) -> None:
    """Neither the key that the client sends nor one that a server echoes."""
    tape, cache = tmp_path / "tape", tmp_path / "c"

    def echo(received: Received) -> Reply:
        return Reply(f"Your headers: {json.dumps(dict(received.headers))}")

    with FakeServer(echo) as server:
        url = server.url.replace("http://", "http://user:pass-word-9@")
        text = answer(make_settings, url, record=tape, cache=cache)
    assert KEY not in text and "[redacted]" in text
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert len(files) >= 3
    for path in files:
        content = path.read_bytes()
        for secret in (KEY, "3f9aQ7", "pass-word-9", "Bearer sk"):
            assert secret.encode() not in content, path


def test_a_server_plays_a_cassette(make_settings: Make, tmp_path: Path) -> None:
    with FakeServer(lambda _: Reply("as recorded")) as server:
        answer(make_settings, server.url, record=tmp_path / "tape")
    with FakeServer(load_player(tmp_path / "tape")) as server:
        assert answer(make_settings, server.url) == "as recorded"
        other = Question("screen", "screen/1", (Turn("user", "Something else?"),))
        with pytest.raises(ServiceError, match="the script has no answer to this screen question"):
            answer(make_settings, server.url, other)


def test_scripts_are_checked(tmp_path: Path) -> None:
    with pytest.raises(EtotError, match="no such folder"):
        load_player(tmp_path / "none")
    with pytest.raises(EtotError, match="neither recorded exchanges nor"):
        load_player(tmp_path)
    script = tmp_path / "script.json"
    for text, said in (("{", "cannot be read"), ("{}", "a list of rules"), ("[1]", "rule 1")):
        script.write_text(text)
        with pytest.raises(EtotError, match=said):
            load_player(tmp_path)
    script.write_text('[{"role": "screen", "times": 1, "reply": "a"}, {"reply": "b"}]')
    with FakeServer(load_player(tmp_path)) as server:
        assert isinstance(server._script, Player)
