"""The client against a local server over real sockets: every way in which servers go wrong."""

from __future__ import annotations

import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from email.utils import formatdate
from typing import Any

import numpy as np
import pytest

from etot_cli.errors import ServiceError
from etot_cli.reasoning.protocol import ReasonerStopped
from etot_cli.reasoning.vlm.chat import Answer, Picture, Question, Trouble, Turn
from etot_cli.reasoning.vlm.client import ChatClient, completions_url
from etot_cli.reasoning.vlm.fake_server import FakeServer, Script
from etot_cli.reasoning.vlm.player import Received, Reply
from etot_cli.reasoning.vlm.schemas import VERDICT
from tests.vlm.conftest import KEY, Make

QUESTION = Question("screen", "screen/1", (Turn("user", "Is it so?"),), VERDICT)


def error(status: int, message: str, **more: Any) -> Reply:
    return Reply(status=status, raw=json.dumps({"error": {"message": message, **more}}).encode())


def one_after_the_other(*replies: Reply) -> Script:
    """The last reply is repeated."""
    left = list(replies)

    def script(_: Received) -> Reply:
        return left.pop(0) if len(left) > 1 else left[0]

    return script


@contextmanager
def opened(make: Make, url: str, **more: Any) -> Iterator[tuple[ChatClient, list[float]]]:
    waits: list[float] = []
    client = ChatClient(make(url, **more), sleep=waits.append)
    try:
        yield client, waits
    finally:
        client.close()


def ask(make: Make, script: Script, **more: Any) -> tuple[Answer, FakeServer, list[float]]:
    with FakeServer(script) as server, opened(make, server.url, **more) as (client, waits):
        return client.ask(QUESTION), server, waits


def failure(make: Make, script: Script, **more: Any) -> tuple[str, int, list[float]]:
    """Message, number of requests and waits of a question that cannot be answered."""
    with FakeServer(script) as server, opened(make, server.url, **more) as (client, waits):
        with pytest.raises(ServiceError) as caught:
            client.ask(QUESTION)
        assert caught.value.exit_code == 3
        assert caught.value.__cause__ is None
        assert KEY not in str(caught.value)
        return str(caught.value), len(server.requests), waits


def test_an_answer(make_settings: Make) -> None:
    answer, server, waits = ask(make_settings, one_after_the_other(Reply("yes")))
    assert answer.text == "yes" and answer.trouble is None and not waits
    assert (answer.usage.input_tokens, answer.usage.output_tokens) == (100, 20)
    (request,) = server.requests
    assert request.headers["Authorization"] == f"Bearer {KEY}"
    assert request.body["response_format"]["type"] == "json_schema"
    assert request.role == "screen" and request.key == QUESTION.key("gpt-4o")


@pytest.mark.parametrize("status", [408, 409, 429, 500, 502, 503, 504])
def test_passing_failures_are_retried(make_settings: Make, status: int) -> None:
    answer, server, waits = ask(
        make_settings, one_after_the_other(error(status, "busy"), Reply("yes"))
    )
    assert answer.text == "yes"
    assert len(server.requests) == 2 and len(waits) == 1


@pytest.mark.parametrize("status", [429, 503])
def test_lasting_failures_end_after_the_retries(make_settings: Make, status: int) -> None:
    message, requests, waits = failure(make_settings, one_after_the_other(error(status, "busy")))
    assert requests == 3
    assert f"HTTP {status}: busy after 3 attempts" in message.replace("(", "").replace(")", "")
    assert waits[0] < waits[1] * 2.01  # it backs off, with jitter


@pytest.mark.parametrize(
    ("header", "expected"),
    [("0", 0.0), ("7", 7.0), ("1e9", 60.0), ("soon", None), ("nan", None), ("inf", None)],
)
def test_retry_after(make_settings: Make, header: str, expected: float | None) -> None:
    busy = Reply(status=429, raw=b"{}", headers={"Retry-After": header})
    _, _, waits = ask(make_settings, one_after_the_other(busy, Reply("x")), patience_s=100.0)
    assert waits == [expected] if expected is not None else waits[0] <= 0.001


def test_retry_after_as_a_date(make_settings: Make) -> None:
    busy = Reply(status=503, raw=b"", headers={"Retry-After": formatdate(time.time() + 5)})
    _, _, waits = ask(make_settings, one_after_the_other(busy, Reply("x")))
    assert 2.0 < waits[0] <= 5.0


def test_a_wait_longer_than_the_patience_ends_it(make_settings: Make) -> None:
    busy = Reply(status=429, raw=b"{}", headers={"Retry-After": "50"})
    message, requests, waits = failure(make_settings, one_after_the_other(busy), patience_s=5.0)
    assert requests == 1 and not waits and "out of patience" in message


@pytest.mark.parametrize(
    ("reply", "said"),
    [
        (
            error(401, f"Incorrect API key provided: {KEY}"),
            "OPENAI_API_KEY (or ETOT_VLM_KEY) was not accepted",
        ),
        (error(403, "not for you"), "OPENAI_API_KEY"),
        (error(404, "model not found"), "check --vlm-url and --model"),
        (error(429, "no money", code="insufficient_quota"), "quota is used up"),
        (error(413, "too large"), "too large"),
        (error(400, "you cannot do this"), "you cannot do this"),
        (error(400, "image input is not supported by this model"), "takes no images"),
        (error(500, "mmproj: image input is not supported"), "takes no images"),
        (
            Reply(status=302, raw=b"", headers={"Location": "http://elsewhere/v1"}),
            "redirects to http://elsewhere/v1",
        ),
        (Reply(raw=b"<html>login</html>", content_type="text/html"), "text/html, not JSON"),
        (Reply(raw=b"hello", content_type="text/plain"), "text/plain, not JSON"),
        (Reply(raw=b"hello", content_type=""), "no content type"),
        (
            Reply(raw=b'{"error": {"message": "bad key", "code": "invalid_api_key"}}'),
            "OPENAI_API_KEY",
        ),
        (Reply(raw=b"x" * (9 * 2**20)), "larger than 8 MiB"),
    ],
)
def test_what_a_person_must_mend_is_said_at_once(
    make_settings: Make, reply: Reply, said: str
) -> None:
    message, requests, _ = failure(make_settings, one_after_the_other(reply), retries=0)
    assert requests == 1 and said in message


def test_an_unset_key_is_named(make_settings: Make) -> None:
    message, _, _ = failure(make_settings, one_after_the_other(error(401, "who?")), key="")
    assert "OPENAI_API_KEY (or ETOT_VLM_KEY) is not set" in message


@pytest.mark.parametrize(
    "reply",
    [
        Reply(raw=b'{"choices": [{"message": {"content": "ye'),
        Reply(raw=b'{"choices": []}'),
        Reply(raw=b'{"choices": null}'),
        Reply(raw=b'{"choices": [{"finish_reason": "stop"}]}'),
        Reply(raw=b"[1, 2]"),
        Reply(raw=b'{"choices": [3]}'),
        Reply(raw=b"[" * 100_000),
        Reply("yes", cut=25),
        Reply(reset=True),
        error(200, "overloaded"),
    ],
)
def test_damaged_answers_are_retried_then_given_up(make_settings: Make, reply: Reply) -> None:
    answer, _, _ = ask(make_settings, one_after_the_other(reply, Reply("yes")))
    assert answer.text == "yes"
    _, requests, _ = failure(make_settings, one_after_the_other(reply))
    assert requests <= 3 + 2  # the format may be relaxed twice on the way


@pytest.mark.parametrize(
    ("reply", "trouble"),
    [
        (Reply("[PICK UP, sp", finish="length"), Trouble.CUT),
        (Reply("", finish="content_filter"), Trouble.FILTERED),
        (Reply(None, message={"refusal": "I cannot help with that."}), Trouble.REFUSAL),
        (Reply(None), Trouble.EMPTY),
        (Reply("  \n "), Trouble.EMPTY),
        (Reply(message={"content": []}), Trouble.EMPTY),
        (Reply(message={"content": {"odd": 1}}), Trouble.EMPTY),
        (Reply("<think>only thoughts</think>"), Trouble.EMPTY),
    ],
)
def test_unusable_replies_are_told_apart(
    make_settings: Make, reply: Reply, trouble: Trouble
) -> None:
    answer, server, _ = ask(make_settings, one_after_the_other(reply))
    assert answer.trouble is trouble and answer.detail
    assert len(server.requests) == 1


@pytest.mark.parametrize(
    "reply",
    [
        Reply(message={"content": [{"type": "text", "text": "yes"}]}),
        Reply("<think>is it?</think>\nyes"),
        Reply("is it?</think>yes"),
        Reply(
            None,
            finish="tool_calls",
            message={
                "tool_calls": [
                    {"type": "function", "function": {"name": "answer", "arguments": "yes"}}
                ]
            },
        ),
        Reply(None, message={"function_call": {"name": "answer", "arguments": "yes"}}),
        Reply("yes", usage=None),
        Reply("yes", finish=None),
        Reply("yes", content_type="application/json; charset=utf-8"),
        Reply("yes", usage={"prompt_tokens": "many", "completion_tokens": -3, "cost": "free"}),
    ],
)
def test_unusual_shapes_are_understood(make_settings: Make, reply: Reply) -> None:
    answer, _, _ = ask(make_settings, one_after_the_other(reply))
    assert answer.text.strip() == "yes" and answer.trouble is None


# -- time --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("reply", "more"),
    [
        (Reply("yes", stall_s=3.0), {"read_timeout_s": 0.2}),
        (Reply("yes", stall_s=3.0), {"deadline_s": 0.2}),
        (Reply("yes", drip_s=0.05), {"deadline_s": 0.4}),
    ],
)
def test_slow_servers_do_not_hold_it_up(
    make_settings: Make, reply: Reply, more: dict[str, float]
) -> None:
    begun = time.monotonic()
    message, requests, _ = failure(make_settings, one_after_the_other(reply), retries=1, **more)
    assert time.monotonic() - begun < 2.5
    assert requests == 2
    assert "fell silent" in message or "no complete answer within" in message


def test_a_drip_within_the_headers_ends_at_the_deadline(make_settings: Make) -> None:
    """Each byte comes in time, so that no per-read timeout ever strikes."""
    stop = threading.Event()

    def drip(listener: socket.socket) -> None:
        connection, _ = listener.accept()
        with connection:
            connection.recv(65536)
            for byte in b"HTTP/1.1 200 OK\r\nX-Slow: " + b"x" * 1000:
                if stop.wait(0.05):
                    return
                try:
                    connection.send(bytes([byte]))
                except OSError:
                    return

    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=drip, args=(listener,))
        thread.start()
        url = f"http://127.0.0.1:{listener.getsockname()[1]}/v1"
        begun = time.monotonic()
        with (
            opened(make_settings, url, retries=0, deadline_s=0.5) as (client, _),
            pytest.raises(ServiceError, match=r"no complete answer within 0\.5 s"),
        ):
            client.ask(QUESTION)
        assert time.monotonic() - begun < 2.0
        stop.set()
        thread.join(5)


def test_nobody_there(make_settings: Make) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    with (
        opened(make_settings, f"http://127.0.0.1:{port}/v1") as (client, waits),
        pytest.raises(ServiceError, match="no connection") as caught,
    ):
        client.ask(QUESTION)
    assert len(waits) == 2 and "after 3 attempts" in str(caught.value)


def test_the_patience_bounds_everything(make_settings: Make) -> None:
    begun = time.monotonic()
    with FakeServer(one_after_the_other(Reply(stall_s=2.0))) as server:
        client = ChatClient(make_settings(server.url, retries=20, patience_s=0.6))
        with pytest.raises(ServiceError):
            client.ask(QUESTION)
        client.close()
    assert time.monotonic() - begun < 2.5


def test_requests_at_the_same_time_are_limited(make_settings: Make) -> None:
    lock, running, most = threading.Lock(), 0, 0

    def script(_: Received) -> Reply:
        nonlocal running, most
        with lock:
            running += 1
            most = max(most, running)
        time.sleep(0.05)
        with lock:
            running -= 1
        return Reply("yes")

    with (
        FakeServer(script) as server,
        opened(make_settings, server.url, concurrency=2) as (client, _),
    ):
        threads = [threading.Thread(target=client.ask, args=(QUESTION,)) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert len(server.requests) == 8 and most == 2


# -- what the server can take ------------------------------------------------------------------


@pytest.mark.parametrize(
    "refusal",
    [
        error(400, "Invalid parameter: 'response_format' of type 'json_schema' is not supported"),
        error(422, "extra fields", param="response_format"),
        error(400, "json_schema is not available with this model"),
        error(500, "cannot compile the json_schema to a grammar"),
    ],
)
def test_the_format_ladder(make_settings: Make, refusal: Reply) -> None:
    def script(request: Received) -> Reply:
        return refusal if "response_format" in request.body else Reply("yes")

    with FakeServer(script) as server, opened(make_settings, server.url) as (client, waits):
        assert client.ask(QUESTION).text == "yes"
        assert client.ask(QUESTION).text == "yes"
    kinds = [r.body.get("response_format", {}).get("type") for r in server.requests]
    # What it refused once it is not asked again.
    assert kinds == ["json_schema", "json_object", None, None] and not waits
    assert '"verdict"' in server.requests[-1].text  # the schema stands in the prompt instead


def test_a_bare_500_on_a_schema_is_tried_without(make_settings: Make) -> None:
    def script(request: Received) -> Reply:
        kind = request.body.get("response_format", {}).get("type")
        return error(500, "Internal Server Error") if kind == "json_schema" else Reply("yes")

    answer, server, waits = ask(make_settings, script)
    assert answer.text == "yes" and len(server.requests) == 3 and len(waits) == 1


def test_parameters_that_a_model_does_not_know(make_settings: Make) -> None:
    def script(request: Received) -> Reply:
        if "max_tokens" in request.body:
            return error(
                400,
                "Unsupported parameter: 'max_tokens' is not supported with this "
                "model. Use 'max_completion_tokens' instead.",
                param="max_tokens",
            )
        if "temperature" in request.body:
            return error(
                400, "Unsupported value: 'temperature' does not support 0", param="temperature"
            )
        return error(400, "unknown field seed") if "seed" in request.body else Reply("yes")

    answer, server, _ = ask(make_settings, script)
    assert answer.text == "yes" and len(server.requests) == 4
    assert server.requests[-1].body["max_completion_tokens"] == 2000


@pytest.mark.slow
def test_pictures_shrink_until_they_are_taken(make_settings: Make) -> None:
    noise = np.random.default_rng(0).integers(0, 255, (600, 800, 3)).astype(np.uint8)
    picture = Picture.of_pixels("Now:", noise)
    question = Question("scene", "scene/1", (Turn("user", "What is there?", (picture,)),))

    def script(request: Received) -> Reply:
        large = len(request.images[0]) > 60_000
        return error(413, "Payload Too Large") if large else Reply("a desk")

    with FakeServer(script) as server, opened(make_settings, server.url, images=4) as (client, _):
        assert client.ask(question).text == "a desk"
        first = len(server.requests)
        assert client.ask(question).text == "a desk"
        assert 2 < first < 10 and len(server.requests) == first + 1
    with FakeServer(one_after_the_other(error(413, "too large"))) as server:
        with (
            opened(make_settings, server.url, images=4) as (client, _),
            pytest.raises(ServiceError, match="too large"),
        ):
            client.ask(question)
        assert len(server.requests) <= 13


@pytest.mark.slow
def test_pictures_fit_their_limits(make_settings: Make) -> None:
    noise = np.random.default_rng(0).integers(0, 255, (600, 800, 3)).astype(np.uint8)
    question = Question("scene", "scene/1", (Turn("user", "?", (Picture.of_pixels("", noise),)),))
    for kind, head in (("jpeg", b"\xff\xd8"), ("png", b"\x89PNG")):
        with (
            FakeServer(one_after_the_other(Reply("x"))) as server,
            opened(make_settings, server.url, image_format=kind, image_bytes=20_000) as (c, _),
        ):
            c.ask(question)
        (image,) = server.requests[0].images
        assert image.startswith(head) and len(image) <= 20_000


@pytest.mark.parametrize(
    ("base", "expected"),
    [
        ("http://h:1", "http://h:1/v1/chat/completions"),
        ("http://h/v1/", "http://h/v1/chat/completions"),
        ("https://h/openai/v1", "https://h/openai/v1/chat/completions"),
        (
            "https://h/x/chat/completions?api-version=3",
            "https://h/x/chat/completions?api-version=3",
        ),
    ],
)
def test_addresses(base: str, expected: str) -> None:
    assert completions_url(base) == expected


def test_other_key_headers(make_settings: Make) -> None:
    _, server, _ = ask(make_settings, one_after_the_other(Reply("x")), key_header="api-key")
    assert server.requests[0].headers["api-key"] == KEY
    assert "Authorization" not in server.requests[0].headers


# -- limits ------------------------------------------------------------------------------------


def test_calls_are_limited(make_settings: Make) -> None:
    with FakeServer(one_after_the_other(error(429, "busy"))) as server:
        with (
            opened(make_settings, server.url, max_calls=2, retries=10) as (client, _),
            pytest.raises(ReasonerStopped, match="--max-calls 2") as caught,
        ):
            client.ask(QUESTION)
        assert len(server.requests) == 2
    assert caught.value.exit_code == 1


@pytest.mark.parametrize(
    ("usage", "more", "calls"),
    [
        (
            {"prompt_tokens": 1000, "completion_tokens": 100},
            {"price_input": 1.0, "price_output": 10.0},
            2,
        ),
        ({"prompt_tokens": 1, "completion_tokens": 1, "cost": 0.004}, {}, 1),
        ({"prompt_tokens": 1000, "completion_tokens": 100}, {}, 1),
    ],
)
def test_costs_are_limited_and_booked_per_role(
    make_settings: Make, usage: dict[str, Any], more: dict[str, float], calls: int
) -> None:
    with (
        FakeServer(one_after_the_other(Reply("x", usage=usage))) as server,
        opened(make_settings, server.url, max_cost=0.0031, **more) as (client, _),
    ):
        with pytest.raises(ReasonerStopped, match=r"--max-cost 0\.0031"):
            for number in range(5):
                client.ask(Question(f"role{number}", "x", QUESTION.turns))
        assert len(server.requests) == calls
        assert set(client.accounts.roles) == {f"role{n}" for n in range(calls)}
        assert client.accounts.total.cost is not None


def test_unstated_usage_is_estimated_and_said_so(make_settings: Make) -> None:
    with (
        FakeServer(one_after_the_other(Reply("x" * 400, usage=None))) as server,
        opened(make_settings, server.url) as (client, _),
    ):
        client.ask(QUESTION)
        total = client.accounts.total
    assert total.estimated == 1 and total.output_tokens == 100


@pytest.mark.slow
def test_the_openai_package_agrees_with_the_fake_server() -> None:
    import openai  # takes a second to load, which collecting need not pay

    with FakeServer(one_after_the_other(Reply("yes"))) as server:
        client: Callable[..., Any] = openai.OpenAI(
            base_url=server.url, api_key="x"
        ).chat.completions.create
        done = client(model="m", messages=[{"role": "user", "content": "?"}])
    assert done.choices[0].message.content == "yes"
