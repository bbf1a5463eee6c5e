"""What each clause has spoken of, by the part that it played there."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse

TARGETS = (Role.SURFACE, Role.CONTAINER, Role.PLACE)
"""Roles of what something is put into or onto."""


def clauses_of(discourse: Discourse) -> list[int]:
    """The numbers of all clauses that spoke of anything, the latest first."""
    return sorted({mention.clause for mention in discourse.mentions}, reverse=True)


def mentioned_in(
    discourse: Discourse, clause: int, role: Role, excluded: Sequence[int]
) -> tuple[tuple[int, ...], tuple[int, ...], tuple[int, ...]]:
    """What a clause acted on, its places and its landmarks, so far as they fit a role."""
    acted_on: dict[int, None] = {}
    places: dict[int, None] = {}
    landmarks: dict[int, None] = {}
    for mention in discourse.mentions:
        referent = mention.referent
        single = any(len(option) == 1 for option in discourse.referents[referent].options)
        single = single and not mention.several and not (mention.whatever and role in TARGETS)
        single |= mention.collective
        meant = single and referent not in excluded and fits(discourse, referent, role)
        if mention.clause != clause or not meant:
            continue
        if mention.role in (Role.THEME, Role.PART):
            acted_on[referent] = None
        else:
            (landmarks if mention.role is Role.ANY else places)[referent] = None
    return (
        tuple(acted_on),
        tuple(index for index in places if index not in acted_on),
        tuple(index for index in landmarks if index not in {**acted_on, **places}),
    )


def candidates(discourse: Discourse, *, everywhere: bool = False) -> tuple[int, ...]:
    """All that "it" may mean where only what is said about it tells which: what the latest clause
    spoke of, or all that anything was done with.
    """
    acted: dict[int, None] = {}
    for clause in clauses_of(discourse):
        acted_on, places, landmarks = mentioned_in(discourse, clause, Role.ANY, ())
        if not everywhere and (found := (*acted_on, *places) or landmarks):
            return (*left_as_they_are(discourse, Role.ANY, found), *found)
        acted.update(dict.fromkeys(acted_on))
    return tuple(acted)


def openable(discourse: Discourse) -> tuple[int, ...]:
    """All drawers and doors that were spoken of, in whatever role."""
    spoken = dict.fromkeys(mention.referent for mention in discourse.mentions)
    return tuple(
        index
        for index in spoken
        if all(can_be(thing, Role.PART, discourse.scene) for thing in discourse.things(index))
    )


def are_several(discourse: Discourse, referent: int) -> bool:
    """Whether a referent stands for several things at once."""
    return any(len(option) > 1 for option in discourse.referents[referent].options)


def fits(discourse: Discourse, referent: int, role: Role) -> bool:
    """Whether a referent may stand for something that can play a role."""
    return any(can_be(thing, role, discourse.scene) for thing in discourse.things(referent))


def left_as_they_are(discourse: Discourse, role: Role, excluded: Sequence[int]) -> tuple[int, ...]:
    """What the clause before leaves as it is, which is nearer than all that was spoken of before
    that: "shut the drawer; the cup stays where it is, but the pen goes to the left of it".
    """
    number, spoken = discourse.spared
    near = () if role in (Role.THEME, Role.PART) or number != discourse.clause - 1 else spoken
    return tuple(i for i in near if i not in excluded and fits(discourse, i, role))


def left_unsaid(discourse: Discourse, text: str) -> tuple[int, ...]:
    """What is left out behind a verb: what was acted on last, be it several things.

    Raises:
        AmbiguousReference: something was emptied, and may be meant as well as what was in it.
        ReferenceProblem: nothing was acted on.
    """
    said = [mention for mention in discourse.mentions if mention.role is Role.THEME]
    if not said:
        raise ReferenceProblem(text, UNCLEAR, 2)
    latest = [mention.referent for mention in said if mention.clause == said[-1].clause]
    named = [discourse.referents[index].text for index in latest]
    if said[-1].clause == discourse.emptied:
        raise AmbiguousReference(text, [*named, *(name.split(maxsplit=2)[2] for name in named)])
    return tuple(dict.fromkeys(latest))


def without_place(discourse: Discourse, text: str) -> tuple[int, ...]:
    """What the clause before wants elsewhere without saying where ("clear the desk; use the box").

    Raises:
        ReferenceProblem: nothing, or it has a place already: what else that is to be used for, or
            instead of what, is not said.
    """
    latest = max((mention.clause for mention in discourse.mentions), default=0)
    said = [mention for mention in discourse.mentions if mention.clause == latest]
    found = [mention.referent for mention in said if mention.role is Role.THEME]
    chosen = {mention.referent for mention in said if mention.role is Role.ANY}
    moved = discourse.things(*{*found} - discourse.swept)
    places = [place for thing in moved for place in discourse.placed.get(thing, ())]
    if not found or any(not p or p.beside or p.where not in chosen for p in places):
        raise ReferenceProblem(text, "say what is to go there", 2)
    return tuple(dict.fromkeys(found))
