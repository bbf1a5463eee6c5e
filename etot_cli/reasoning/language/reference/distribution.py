"""Words inside a destination that say whether things share it: "the same box", "different cups"."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.syntax import Destination, NounPhrase, PutGroup
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep


def is_matching(phrase: NounPhrase) -> bool:
    """Whether a phrase asks for the colour of what it goes with."""
    return any(item.prep is Prep.MATCHING for item in phrase.modifiers)


def unmatched(phrase: NounPhrase) -> NounPhrase:
    """A phrase that asks for no colour, whatever its number."""
    kept = tuple(item for item in phrase.modifiers if item.prep is not Prep.MATCHING)
    return replace(phrase, modifiers=kept)


_DIFFERENT = frozenset({"different", "separate", "distinct"})


def is_different(group: PutGroup) -> bool:
    """Whether a place is to be "a different one", of several things or from where it is now."""
    targets = [target for item in group.destinations for target in item.targets]
    return any(target.words[:1] == ("different",) for target in targets)


def elsewhere(group: PutGroup) -> PutGroup:
    """Of one thing "a different shelf" is another one than that on which it stands."""
    return group.going_to(
        lambda np: (
            replace(np, determiner="another", words=np.words[1:])
            if np.words[:1] == ("different",)
            else np
        )
    )


def distributed(group: PutGroup, grouping: Grouping) -> tuple[tuple[Destination, ...], Grouping]:
    """The destinations without such words, and what they say.

    Args:
        group: things and destinations.
        grouping: what the rest of the sentence says; such words overrule it.
    """
    destinations = []
    for destination in group.destinations:
        targets = []
        for target in destination.targets:
            plain, said = _target(target)
            grouping = said or grouping
            targets.append(plain)
        destinations.append(replace(destination, targets=tuple(targets)))
    return tuple(destinations), grouping


def _target(phrase: NounPhrase) -> tuple[NounPhrase, Grouping | None]:
    words = phrase.words
    if words[:1] == ("own",) and phrase.determiner in ("its", "their"):
        return replace(phrase, determiner="one", words=words[1:]), Grouping.SEPARATELY
    if words and words[0] in _DIFFERENT:
        determiner = "one" if singular(words[-1]) == words[-1] else ""
        return replace(phrase, determiner=determiner, words=words[1:]), Grouping.SEPARATELY
    return phrase, None
