"""In which order steps are done: as the words say, else as they are said."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from etot_cli.reasoning.builtin.goal import Put, Step
from etot_cli.reasoning.language.grammar.syntax import Order


@dataclass(frozen=True, slots=True)
class Timed:
    """A clause's steps, when they are to be done, and the number of the sentence."""

    steps: tuple[Step, ...]
    order: Order
    sentence: int


def in_order(said: Sequence[Timed]) -> list[Step]:
    """All steps in the order in which they are to be done.

    "First" goes before everything that was said before it, "before that" before the clause before
    it, "last" after everything. Puts of one sentence that no word puts in an order are a run, a
    set of placements ("the red block on the green one and the green one on the blue one").
    """
    done: list[Timed] = []
    last: list[Timed] = []
    for item in said:
        if item.order is Order.FIRST:
            done.insert(0, item)
        elif item.order is Order.BEFORE_THAT:
            done.insert(max(len(done) - 1, 0), item)
        elif item.order is Order.LAST:
            last.append(item)
        else:
            done.append(item)
    steps: list[Step] = []
    run, sentence = 0, -1
    for item in [*done, *last]:
        waits = any(isinstance(step, Put) and step.aside for step in item.steps)
        if item.sentence != sentence or item.order is not Order.SAID:
            run, sentence = run + 1, item.sentence
        for step in item.steps:
            run += waits
            steps.append(replace(step, run=run) if isinstance(step, Put) else step)
    return steps
