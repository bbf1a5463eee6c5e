"""Which things the layers of a tower are, where that is left open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import TowerClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.choosing.selection import select
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.words.lexicon import SIZES, basic_color, head_of
from etot_cli.reasoning.language.words.nouns import THE_WORDS

AS_WIDE_M = 0.001
"""Widths that differ by no more are the same: sizes from noisy captures are off by 0.9 % in the
median (docs/results.md), so two equal things of 50 mm differ by 0.6 mm in the median."""


def any_of(context: Context, themes: Sequence[int], clause: TowerClause, before: int) -> list[int]:
    """A referent for each of the things to be stacked, where it is open which they are.

    They are a choice as long as it makes no difference which of them lies below. ``before``: how
    many referents there were before the clause.
    """
    discourse, infos = context.discourse, context.scene.infos
    for index in themes:
        _no_vessel(context, index)
    _alike_in_kind(context, themes)
    said = [discourse.referents[index] for index in themes]
    first = next((referent for referent in said if len(referent.options) > 1), None)
    if first is None:
        return []
    count = len(first.options[0])
    if count == len(themes) == 1:
        return [*themes]
    pool = things_in(first.options)
    widths = {max(infos[thing.name].size[:2]) for thing in pool}
    alike = max(widths) - min(widths) <= AS_WIDE_M
    ends = [np for np in (clause.bottom, clause.middle, clause.top) if np]
    if len(ends) == count and len(themes) == 1:
        # "Stack three blocks, the red one at the bottom, the blue one in the middle, …"
        return _chosen_layers(context, ends, pool)
    singly = all(len(option) == 1 for referent in said for option in referent.options)
    if clause.upward is not None and singly:
        if len(themes) < len(clause.things.phrases):
            raise ReferenceProblem(first.text, "say which ones to stack", 2)
        _choose_apart(context, themes, before)
        return [*themes][:: 1 if clause.upward else -1]  # "one red block, then the other"
    ordered = clause.upward is not None or clause.not_at or ends
    if len(themes) > 1 or ordered or not alike:
        raise ReferenceProblem(first.text, "say which ones to stack", 2)
    found: list[int] = []
    for _ in range(count):
        one = discourse.add(Resolved(tuple((thing,) for thing in pool)), first.text, Role.THEME)
        referent = replace(discourse.referents[one], distinct_from=tuple(found))
        discourse.referents[one] = referent
        found.append(one)
    return found


def _choose_apart(context: Context, themes: Sequence[int], before: int) -> None:
    """No layer is chosen for two places; of "red" any will do.

    Raises:
        AmbiguousReference: it may be the one that was spoken of before, or another one.
    """
    discourse = context.discourse
    earlier = {option for said in discourse.referents[:before] for option in said.options}
    for at, index in enumerate(themes):
        one = discourse.referents[index]
        others = dict.fromkeys((*one.distinct_from, *themes[:at]))
        discourse.referents[index] = replace(one, distinct_from=tuple(others))
        if len(one.options) > 1 and _is_color(one.text):
            if index < before or earlier & {*one.options}:
                names = [thing.name for thing in things_in(one.options)]
                raise AmbiguousReference(one.text, names)
            discourse.undecided -= {index}


def _chosen_layers(
    context: Context, layers: Sequence[NounPhrase], pool: Sequence[Thing]
) -> list[int]:
    """A referent for each layer of a tower; of "red" and "a red one" any will do."""
    found: list[int] = []
    for phrase in layers:
        things = _meant_in(context, phrase, pool)
        if len(things) > 1 and phrase.determiner not in THE_WORDS:
            index = context.discourse.add(
                Resolved(tuple((thing,) for thing in things)), phrase.text, Role.THEME
            )
            one = context.discourse.referents[index]
            context.discourse.referents[index] = replace(one, distinct_from=tuple(found))
        else:
            thing = end_of(context, phrase, pool)
            index = context.single(thing, thing.name)
        found.append(index)
    return found


def _alike_in_kind(context: Context, themes: Sequence[int]) -> None:
    """Of what "red" may mean beside "blue" and "green" a layer is what is called as the others are,
    where all can be called alike in one way only.
    """
    discourse, infos = context.discourse, context.scene.infos
    said = [discourse.referents[index] for index in themes]
    if len(said) < 2 or all(len(referent.options) == 1 for referent in said):
        return
    kinds: list[dict[str, list[tuple[Thing, ...]]]] = []
    for referent in said:
        kinds.append({})
        for option in referent.options:
            if len(option) == 1 and option[0].name in infos:
                noun = head_of(infos[option[0].name].label.replace(" ", "_"))
                kinds[-1].setdefault(noun, []).append(option)
    shared = set.intersection(*(set(kind) for kind in kinds))
    if len(shared) != 1 or not all(_is_color(referent.text) for referent in said):
        return
    (noun,) = shared
    for index, referent, kind in zip(themes, said, kinds, strict=True):
        discourse.referents[index] = replace(referent, options=tuple(kind[noun]))
    discourse.notes.append(f"took each for a {noun}")


def _is_color(text: str) -> bool:
    """Whether this is a colour alone, perhaps with a size."""
    *sizes, color = text.split()
    return basic_color(color) is not None and all(word in SIZES for word in sizes)


def _no_vessel(context: Context, index: int) -> None:
    """Of what "blue" may mean in a tower, no vessel is one of its layers."""
    referent = context.discourse.referents[index]
    solid = [
        option
        for option in referent.options
        if not any(can_be(thing, Role.CONTAINER, context.scene) for thing in option)
    ]
    if len(solid) == 1 < len(referent.options) and basic_color(referent.text):
        context.discourse.referents[index] = replace(referent, options=(solid[0],))
        context.discourse.notes.append(f"took {solid[0][0].name} for {referent.text!r}")


def end_of(context: Context, phrase: NounPhrase, things: Sequence[Thing]) -> Thing:
    """The one of some things that is said to be at an end."""
    found = _meant_in(context, phrase, things)
    if len(found) > 1:
        raise AmbiguousReference(phrase.text, [thing.name for thing in found])
    if not found:
        raise ReferenceProblem(phrase.text, "it is not one of what is to be stacked", 2)
    return found[0]


def _meant_in(context: Context, phrase: NounPhrase, things: Sequence[Thing]) -> list[Thing]:
    """Those of some things that a phrase may mean."""
    alone = not (phrase.determiner or phrase.is_elliptic or phrase.modifiers)
    told = phrase.words[:-1] if phrase.is_elliptic and not phrase.modifiers else ()
    told = phrase.words if alone else told
    if told and all(word in SIZES for word in told):
        found = select(told, (), list(things), 1, context.scene, phrase.text)
    else:
        options = context.phrases.meaning(phrase, Role.THEME).options
        found = [option[0] for option in options if option[0] in things]
    return found
