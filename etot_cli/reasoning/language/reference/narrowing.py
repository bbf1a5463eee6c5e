"""What a phrase means, narrowed by what was spoken of before it."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.language.reference.coreference import Discourse
from etot_cli.reasoning.language.reference.noun_phrases import Resolved
from etot_cli.reasoning.language.words.lexicon import same_noun


def spoken_part(resolved: Resolved, discourse: Discourse) -> Resolved:
    """After "the lower drawer" "the drawer" is that one, not the whole chest."""
    named = {(thing.name, thing.part) for option in resolved.options for thing in option}
    if not resolved.definite or resolved.other or len(named) != 1:
        return resolved
    ((owner, part),) = named
    for mention in reversed(discourse.mentions):
        things = discourse.things(mention.referent)
        parts = things and all(thing.name == owner and thing.part for thing in things)
        if part is None and parts and same_noun(mention.noun, resolved.noun):
            return replace(resolved, options=discourse.referents[mention.referent].options)
    return resolved


def of_spoken_owner(resolved: Resolved, discourse: Discourse) -> Resolved:
    """Of several pieces' doors "the door" is that of the piece that was spoken of last."""
    parts = all(len(option) == 1 and option[0].part for option in resolved.options)
    if not (resolved.definite and parts and len(resolved.options) > 1):
        return resolved
    for mention in reversed(discourse.mentions):
        named = {thing.name for thing in discourse.things(mention.referent)}
        own = tuple(option for option in resolved.options if {option[0].name} == named)
        if own:
            return replace(resolved, options=own)
    return resolved


def of_last_choice(resolved: Resolved, discourse: Discourse) -> Resolved:
    """After "a green cup", of two, "the other one" is green, too."""
    for referent in reversed(discourse.referents):
        if len(referent.options) == 2 and {*referent.options} < {*resolved.options}:
            return replace(resolved, options=referent.options)
    return resolved


def others(resolved: Resolved, discourse: Discourse) -> Resolved:
    """All others of a choice made before: which they are depends on it."""
    things = resolved.options[0]
    for referent in reversed(discourse.referents):
        chosen = [set(option) for option in referent.options]
        if len(chosen) > 1 and all(option <= set(things) for option in chosen):
            left = (tuple(t for t in things if t not in option) for option in chosen)
            return replace(resolved, options=tuple(option for option in left if option))
    return resolved
