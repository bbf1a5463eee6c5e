"""How many things are meant where that is told by how many others there are."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase


def counted(context: Context, group: PutGroup) -> PutGroup:
    """A group with a number for "as many as there are cups", as many as there are by now.

    Raises:
        ReferenceProblem: there are none, or it is unclear which are counted.
    """

    def told(np: NounPhrase) -> NounPhrase:
        if np.as_many_as is None:
            return np
        every = replace(np.as_many_as, determiner="all")
        things = dict.fromkeys(things_in(context.phrases.meaning(every, Role.ANY).options))
        parted = any(thing.address != thing.name for thing in things)
        if parted and len({thing.name for thing in things}) > 1:
            raise ReferenceProblem(np.as_many_as.text, "say which of them are counted", 2)
        names = ", ".join(thing.address for thing in things)
        context.discourse.notes.append(f"{np.text!r} as there are of these: {names}")
        return replace(np, determiner=str(len(things)), as_many_as=None)

    if all(np.as_many_as is None for np in group.things.phrases):
        return group
    things = replace(group.things, phrases=tuple(map(told, group.things.phrases)))
    return replace(group, things=things)
