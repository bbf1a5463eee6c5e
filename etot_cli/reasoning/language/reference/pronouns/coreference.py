"""What pronouns mean: "it", "them", "inside", told by what was spoken of and how."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Place, Relation
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.parsers.trees import UNPLACED, UNSAID
from etot_cli.reasoning.language.reference.memory.antecedents import UNCLEAR, AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.spoken_of import (
    left_unsaid,
    without_place,
)
from etot_cli.reasoning.language.reference.pronouns.one_thing import meant_by_it, telling
from etot_cli.reasoning.language.reference.pronouns.plural_pronouns import (
    acted_on,
    emptied_by,
    meant_by_them,
)
from etot_cli.reasoning.language.words import categories

PLURAL_PRONOUNS = frozenset({"them", "they", "these", "those"})


PERSONAL_PRONOUNS = frozenset({"he", "him", "she", "her"})
"""Of what is called like an animal or a doll; of people nothing is known."""


def antecedents(
    discourse: Discourse,
    pronoun: str,
    role: Role,
    text: str,
    excluded: Sequence[int] = (),
    *,
    topmost: bool = False,
) -> tuple[int, ...]:
    """The referents that a pronoun means.

    Args:
        discourse: what was spoken of.
        pronoun: as written.
        role: what it is used for.
        text: the whole phrase, for messages.
        excluded: referents that it cannot mean.
        topmost: it is what something goes on top of, so what was put somewhere rather than that.

    Raises:
        AmbiguousReference: several things are as likely to be meant.
        ReferenceProblem: nothing before it fits.
    """
    if pronoun == UNSAID:
        return left_unsaid(discourse, text)
    if pronoun == UNPLACED:
        return without_place(discourse, text)
    if pronoun in PLURAL_PRONOUNS:
        found = meant_by_them(discourse, role, text, excluded)
        if not found:
            raise ReferenceProblem(text, UNCLEAR, 2)
        return found
    if pronoun in PERSONAL_PRONOUNS:
        indices = range(len(discourse.referents))
        excluded = (*excluded, *(i for i in indices if not is_like_people(discourse, i)))
    return (meant_by_it(discourse, role, text, excluded, topmost=topmost),)


def is_like_people(discourse: Discourse, referent: int) -> bool:
    """Whether a referent is spoken of as "he" or "she"."""
    infos = discourse.scene.infos
    names = [thing.name for thing in discourse.things(referent)]
    return all(
        name in infos and any(map(categories.is_like_people, (name, infos[name].label)))
        for name in names
    )


def latest_place(
    discourse: Discourse, relation: Relation, excluded: Sequence[int], text: str
) -> Place:
    """What "inside" or "on top" without an object means: nothing that but tells what is put there
    ("the jar closest to the cart").

    Raises:
        ReferenceProblem: nothing before it fits, or several things do.
    """
    role = Role.CONTAINER if relation is Relation.INSIDE else Role.SURFACE
    told_by = telling(discourse)
    return Place(relation, meant_by_it(discourse, role, text, (*excluded, *told_by)))


def told_by_them(discourse: Discourse, pronoun: str, text: str) -> list[tuple[int, ...]]:
    """All that "them" may mean where it tells what something is in, on or beside: behind "empty the
    bins" what was in them, or these.
    """
    latest = max((mention.clause for mention in discourse.mentions), default=-1)
    said = [mention for mention in discourse.mentions if mention.clause == latest]
    found = acted_on(discourse, said, Role.ANY)
    if found and (emptied := emptied_by(discourse, latest, Role.ANY)):
        return [found, emptied]
    try:
        return [antecedents(discourse, pronoun, Role.ANY, text)]
    except AmbiguousReference:
        # "Without moving the plates, take the cup off them": what was spoken of before that
        before = {m.referent for m in discourse.mentions if m.clause < discourse.clause}
        several = [index for index in before if len(discourse.things(index)) > 1]
        if len(several) != 1:
            raise
        return [(several[0],)]
