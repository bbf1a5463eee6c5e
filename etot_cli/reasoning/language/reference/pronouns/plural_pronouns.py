"""What "them" stands for."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.roles import Role, can_be
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference, Mention
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.spoken_of import (
    TARGETS,
    are_several,
    clauses_of,
    fits,
    left_as_they_are,
    openable,
)
from etot_cli.reasoning.language.words.lexicon import singular


def meant_by_them(
    discourse: Discourse, role: Role, text: str, excluded: Sequence[int] = ()
) -> tuple[int, ...]:
    """What "them" stands for, by referent: none that is ``excluded``.

    Raises:
        AmbiguousReference: it may stand for several.
    """
    near = left_as_they_are(discourse, role, excluded)
    near = tuple(i for i in near if are_several(discourse, i)) or near
    if len(near) <= 1 and not any(are_several(discourse, index) for index in near):
        return _meant_before(discourse, role, text, excluded)
    before = () if discourse.spared_alone else _meant_before(discourse, role, text, excluded)
    if before and {*discourse.things(*before)} != {*discourse.things(*near)}:
        raise AmbiguousReference(text, [discourse.referents[i].text for i in (*near, *before)])
    return near


def _meant_before(
    discourse: Discourse, role: Role, text: str, excluded: Sequence[int]
) -> tuple[int, ...]:
    """The same, of what the clauses that asked for something spoke of.

    Raises:
        AmbiguousReference: it may stand for several.
    """
    for clause in clauses_of(discourse):
        if clause in discourse.stacks and role is not Role.CONTAINER:
            # What stands on the bottom goes with it; what goes on them goes on top.
            bottom, top = discourse.stacks[clause]
            return (bottom if role in (Role.THEME, Role.ANY) else top,)
        said = [m for m in discourse.mentions if m.clause == clause]
        found = tuple(i for i in acted_on(discourse, said, role) if i not in excluded)
        several = len(found) > 1 or any(are_several(discourse, index) for index in found)
        emptied = emptied_by(discourse, clause, role) if found else ()
        if emptied:
            # "Empty the bins and put them on the rack": what was in them, or these.
            named = [discourse.referents[index].text for index in (*found, *emptied)]
            raise AmbiguousReference(text, named)
        if several:
            return found
    found = tuple(i for i in acted_on(discourse, discourse.mentions, role) if i not in excluded)
    said = [mention for mention in discourse.mentions if mention.referent in found]
    options = [option for index in found for option in discourse.referents[index].options]
    single = len(found) == 1 and all(len(option) == 1 for option in options)
    plural = any(singular(mention.noun) != mention.noun for mention in said)  # "the pliers"
    if single and not plural and not any(item.several or item.whatever for item in said):
        others = _several_named(discourse, role) if role in (*TARGETS, Role.ANY) else ()
        if others and not {*others} & {*found}:
            return others  # "take the cup to the drawers and put it on them", of one chest
        two = the_two_named(discourse, role, excluded)
        parts = openable(discourse) if role is Role.PART else ()
        if len(parts) == len({*discourse.things(*parts)}) == 2:
            return parts  # "open the top drawer, put the pen in the lower one and close them"
        if not two:
            spoken = dict.fromkeys(mention.referent for mention in discourse.mentions)
            raise AmbiguousReference(text, [discourse.referents[i].text for i in spoken])
        return two  # "put the plum into the cup, then set them on the tray"
    if not found and role is Role.PART and len(openable(discourse)) > 1:
        return openable(discourse)  # "a pen in each of two drawers, and close them"
    return found or _several_named(discourse, role)


def _several_named(discourse: Discourse, role: Role) -> tuple[int, ...]:
    """The only several things of which but something was said ("the cups are dirty; put them")."""
    named = {
        mention.referent
        for mention in discourse.mentions
        if singular(mention.noun) != mention.noun or are_several(discourse, mention.referent)
        if fits(discourse, mention.referent, role)
    }
    return tuple(named) if len(named) == 1 else ()


def the_two_named(
    discourse: Discourse, role: Role, excluded: Sequence[int] = ()
) -> tuple[int, ...]:
    """The two things that were spoken of in all, be it as places, but for what they cannot be."""
    named = dict.fromkeys(item.referent for item in discourse.mentions)
    spoken = tuple(index for index in named if index not in excluded)
    things = [option for i in spoken for option in discourse.referents[i].options]
    both = len(things) == len(spoken) == 2 and all(
        len(option) == 1 and can_be(option[0], role, discourse.scene) for option in things
    )
    return spoken if both else ()


def emptied_by(discourse: Discourse, clause: int, role: Role) -> tuple[int, ...]:
    """What a clause took everything out of or off, where it is several things."""
    emptied = discourse.emptied_of.get(clause, ())
    return tuple(i for i in emptied if len(discourse.things(i)) > 1 and fits(discourse, i, role))


def acted_on(discourse: Discourse, mentions: Sequence[Mention], role: Role) -> tuple[int, ...]:
    """The referents that some mentions are of, in a role."""
    return tuple(
        dict.fromkeys(
            mention.referent
            for mention in mentions
            if mention.role in (Role.THEME, Role.PART) and fits(discourse, mention.referent, role)
        )
    )
