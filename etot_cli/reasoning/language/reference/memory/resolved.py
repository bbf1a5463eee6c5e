"""What a noun phrase means in a scene, before it is spoken of again."""

from __future__ import annotations

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Thing


class Resolved(Struct, frozen=True):
    """What a phrase means.

    Args:
        options: alternative sets of things.
        definite: it may be something mentioned before.
        other: it is none of what was mentioned before with this noun.
        noun: the phrase's noun.
        every: it stands for all that fit.
        notes: what words were taken for, where that was a choice.
        again: it is some of what was spoken of before ("one of them").
        adjectives: the phrase's words before its noun.
        left_out: what the phrase says that it does not mean.
        either: it is one of several phrases ("the apple or the pear").
        idle: words of it for a side or size that tell one thing from no other.
        among: what its words for side and size single it out of.
        sides: words for the sides of other things that it is on.
        others: what it says would be true of as well, though it fits what is meant better.
    """

    options: tuple[tuple[Thing, ...], ...]
    definite: bool = False
    other: bool = False
    noun: str = ""
    every: bool = False
    notes: tuple[str, ...] = ()
    again: bool = False
    adjectives: tuple[str, ...] = ()
    left_out: tuple[Thing, ...] = ()
    others: tuple[Thing, ...] = ()
    idle: tuple[str, ...] = ()
    either: bool = False
    among: tuple[Thing, ...] = ()
    sides: tuple[str, ...] = ()
