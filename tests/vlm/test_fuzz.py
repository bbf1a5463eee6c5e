"""Thousands of fuzzed replies, over real sockets: never a crash, a stranger, or an endless run."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from etot_cli.planning.options import Limits
from etot_cli.planning.search import search
from etot_cli.reasoning.protocol import Assignment
from etot_cli.reasoning.vlm.asking import Asker
from etot_cli.reasoning.vlm.client import ChatClient
from etot_cli.reasoning.vlm.fake_server import FakeServer
from etot_cli.reasoning.vlm.notes import Notebook
from etot_cli.reasoning.vlm.player import Received, Reply
from etot_cli.reasoning.vlm.prompts import Prompts
from etot_cli.reasoning.vlm.reasoner import VlmReasoner
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import Cause
from tests.planning.fakes import ToyReasoner, ToySimulator, cause
from tests.vlm.conftest import Make
from tests.vlm.test_command import Forgetful

REPLIES = 2000
NAMES = ("cup", "box", "desk")
MAX_NODES = 8

name = st.sampled_from(
    [*NAMES, "the cup", "lid", "CUP", "knife", "", "cup, box", "box.lid", "7", "()"]
)
verb = st.sampled_from([v.value for v in Verb] + ["pick", "open", "FLY", "put", "[OPEN", "exec"])
step = st.one_of(
    st.tuples(verb, name).map(lambda pair: f"[{pair[0]}, {pair[1]}]"),
    st.sampled_from(
        [
            "[PICK UP, cup]",
            "[PUT ON, desk] (safe place)",
            "[OPEN, box]",
            "[CLOSE, box]",
            "[PUT ON, box]",
            "[PUT INTO, box]",
            "open the box",
            "pick(cup)",
        ]
    ),
)
listed = st.lists(step, max_size=6).map(
    lambda steps: "\n".join(f"{n}. {text}" for n, text in enumerate(steps, 1))
)
likely = st.sampled_from(
    [
        "1. [OPEN, box]",
        "1. [PICK UP, cup]\n2. [PUT ON, box]",
        "[PICK UP, cup]",
        "1. [PICK UP, cup]\n2. [PUT ON, desk] (safe place)\n3. [OPEN, box]",
        "None.",
        "Yes",
        "No.",
        "1. [OPEN, box]\n2. [PICK UP, cup]\n3. [PUT INTO, box]\n4. [CLOSE, box]",
    ]
)
scalars = st.one_of(st.none(), st.booleans(), st.integers(-9, 99), st.floats(), name, verb)
keys = st.sampled_from(
    [
        "steps",
        "branches",
        "action",
        "object",
        "pose",
        "note",
        "reason",
        "before",
        "after",
        "outcome",
        "state",
        "goal_holds",
        "verdict",
        "arguments",
        "plan",
    ]
)
values: st.SearchStrategy[Any] = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(keys, inner, max_size=5),
    max_leaves=15,
)
texts = st.one_of(likely, listed, values.map(json.dumps), st.text(max_size=80))
odd = st.sampled_from(
    [
        Reply(raw=b"{}"),
        Reply(raw=b'{"choices": [{"message": {"content": 5}}]}'),
        Reply(
            None, message={"tool_calls": [{"function": {"arguments": {"steps": ["[OPEN, box]"]}}}]}
        ),
        Reply(None, message={"tool_calls": 3}),
        Reply("x", finish="length"),
        Reply(None),
        Reply("", finish=None),
        Reply(None, message={"refusal": "no"}),
        Reply(message={"content": [1, {"text": 3}, {"text": "No"}]}),
    ]
)
replies = st.one_of(texts.map(Reply), texts.map(Reply), texts.map(Reply), odd)


def world(history: str, action: Action, _: int) -> Cause | None:
    """Opening hits the cup until it has been put aside."""
    blocked = action.verb is Verb.OPEN and "[PICK UP, cup] [PUT ON, desk]" not in history
    on_lid = action.target == "box" and action.verb is Verb.PUT_ON
    return cause() if blocked or on_lid else None


@pytest.mark.slow
def test_fuzzed_replies(make_settings: Make) -> None:
    served: list[int] = [0]
    reached: set[str] = set()
    queue: list[Reply] = []

    def script(_: Received) -> Reply:
        served[0] += 1
        return queue[served[0] % len(queue)]

    with FakeServer(script) as server:
        client = ChatClient(make_settings(server.url, retries=1, backoff_s=0.0))
        prompts = Prompts()

        @settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
        @given(st.lists(replies, min_size=3, max_size=12))
        def one_run(given_replies: list[Reply]) -> None:
            queue[:] = given_replies
            reasoner = VlmReasoner(
                Asker(client, prompts, Notebook(), 0), frames=None, state=ToyReasoner([])
            )
            simulator = ToySimulator(world)
            simulator.submitted = Forgetful()
            before = served[0]
            result = search(
                Assignment("Do it."),  # in words that the built-in reader cannot hold plans to
                simulator,
                reasoner,
                limits=Limits(max_nodes=MAX_NODES, revisions_per_branch=3),
            )
            reached.add(result.status.value)
            cost = result.statistics
            questions = 2 + cost.nodes_evaluated + 1 + 2 * (cost.reflections + 1)
            # Each question is repaired three times at most, each request tried twice.
            assert served[0] - before <= questions * 4 * 2 + 4
            for node in result.tree:
                assert isinstance(node.action.verb, Verb) and node.action.target in NAMES

        one_run()
        client.close()
    print(f"{served[0]} replies")
    assert served[0] >= REPLIES
    assert {"infeasible", "feasible"} <= reached
