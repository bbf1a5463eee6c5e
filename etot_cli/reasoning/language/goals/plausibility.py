"""Which of several equally simple readings is the likeliest."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Put, Relation
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.turns import Timed
from etot_cli.reasoning.language.reference.landmarks import ROUGHLY
from etot_cli.reasoning.language.reference.sifting import TAKEN_FOR
from etot_cli.reasoning.language.reference.vessels import goes_in


def guesses(context: Context, said: Sequence[Timed]) -> int:
    """How much speaks against a reading: words that are taken for something near them, since what
    is said is said of what it is true of ("everything on the desk that is red"), what is moved from
    but roughly where a phrase says, and what has no room where it is to go ("clear the board into
    the bowl").
    """
    things = context.discourse.things
    inside = [
        (theme, place.where)
        for item in said
        for step in item.steps
        if isinstance(step, Put)
        for place in step.places
        if place.relation is Relation.INSIDE and place.where is not None
        for theme in step.what
    ]
    cramped = sum(not goes_in(things(what), things(at), context.scene) for what, at in inside)
    notes = context.discourse.notes
    moved = {
        thing.name
        for item in said
        for s in item.steps
        if isinstance(s, Put)
        for thing in things(*s.what)
    }
    rough = [note.removesuffix(ROUGHLY).split(": ")[-1] for note in notes if note.endswith(ROUGHLY)]
    roughly = sum(bool(moved & {*names.split()}) for names in rough)
    return cramped + roughly + sum(note.startswith(TAKEN_FOR) for note in notes)
