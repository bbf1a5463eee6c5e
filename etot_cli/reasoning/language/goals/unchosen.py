"""What is left alone while something else is done: all else, or what a choice leaves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from itertools import combinations
from math import comb

from etot_cli.reasoning.builtin.goal import (
    Constraint,
    Keep,
    Pick,
    Put,
    Referent,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.words.lexicon import singular

_MOST_WAYS = 64
"""In which a choice may leave things, all of which are told."""


def is_not_chosen(context: Context, index: int, *, which: bool = False) -> bool:
    """Whether "the other one" is what a choice leaves, of which is noted; ``which``: it matters.

    Raises:
        ReferenceProblem: it matters, or the choice leaves more.
    """
    referents = context.discourse.referents
    referent = referents[index]
    if not referent.distinct_from or len(referent.options) < 2:
        return False
    chosen = sum(len(referents[other].options[0]) for other in referent.distinct_from)
    number = max(len(option) for option in referent.options)
    if which or len(things_in(referent.options)) - chosen > number:
        raise ReferenceProblem(referent.text, "say which one", 3)
    what = "is the one that is" if number == 1 else "are those that are"
    context.discourse.notes.append(f"{referent.text!r} {what} not chosen")
    return True


def keep_others(context: Context, keep: Keep, text: str) -> None:
    """Nothing but what was spoken of may be touched or moved, nor what is not chosen of that;
    ``text``: "the others" of "one of the cups" and "the rest" of that are the other cups.

    Raises:
        ReferenceProblem: which are chosen is not clear.
    """
    discourse, infos = context.discourse, context.scene.infos
    if text in ("the others", "the rest") and not discourse.mentions:
        raise ReferenceProblem(text, "nothing was spoken of before it", 2)
    moved = [i for step in context.done if isinstance(step, Put | Pick) for i in _moved(step)]
    of_these = [i for i in moved if text == "the others" or " of " in discourse.referents[i].text]
    if text in ("the others", "the rest") and of_these:
        left = _left_by_choice(context, of_these, text)
        several = all(len(referent.options[0]) > 1 for referent in left)
        if left and (several or text == "the rest"):
            _keep_unchosen(context, keep, left)
            return
    named, left_of_them = _but_named(context)
    if text in ("the others", "the rest") and {*()} < {*left_of_them} < {*named}:
        context.constraints.append(Constraint(keep, left_of_them))
        return
    if text == "the others" and (alike := _others_alike(context)):
        context.constraints.append(Constraint(keep, alike))
        return
    spoken = {thing.name for said in discourse.referents for thing in things_in(said.options)}
    if keep is Keep.UNMOVED:  # so is what something is put into or taken out of, unless it is moved
        done = {*moved, *discourse.put, *discourse.lifted}
        choices = {i for i, said in enumerate(discourse.referents) if said.options[1:]}
        spoken = {t.name for i in done | choices for t in things_in(discourse.referents[i].options)}
    spoken -= {*left_of_them}
    others = tuple(name for name, info in infos.items() if name not in spoken and info.movable)
    left = _left_by_choice(context, range(len(discourse.referents)), text)
    if others:
        context.constraints.append(Constraint(keep, others))
    _keep_unchosen(context, keep, left)


def _others_alike(context: Context) -> tuple[str, ...]:
    """The others of the one sort of which one was told from several by the clause before ("put it
    in the smallest pot"); none where that is not clear.
    """
    discourse, infos = context.discourse, context.scene.infos
    last = max((mention.clause for mention in discourse.mentions), default=0)
    found: set[tuple[str, ...]] = set()
    for mention in discourse.mentions:
        options = discourse.referents[mention.referent].options
        if mention.clause != last or not mention.adjectives or len(options) > 1:
            continue
        with suppress(ReferenceProblem):
            every = NounPhrase("all", (f"{singular(mention.noun)}s",))
            alike = context.phrases.meaning(every, Role.ANY).options[0]
            names = tuple(t.name for t in alike if t not in options[0] and t.part is None)
            found.add(tuple(name for name in names if name in infos and infos[name].movable))
    ways = [names for names in found if names]
    return ways[0] if len(ways) == 1 and len(ways[0]) > 1 else ()


def _but_named(context: Context) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Several things that were but named, and those of them that were not spoken of since, be it as
    one to choose ("there are three pots; put it in the smallest one and leave the others alone").
    """
    discourse, infos = context.discourse, context.scene.infos
    said = [discourse.referents[mention.referent].options for mention in discourse.mentions]
    single = {t.name for ways in said if ways[1:] or len(ways[0]) == 1 for t in things_in(ways)}
    for noun in reversed(discourse.nouns()):
        named = discourse.but_named(noun)
        if named and all(t.part is None and t.name in infos for t in named):
            names = tuple(thing.name for thing in named if infos[thing.name].movable)
            return names, tuple(name for name in names if name not in single)
    return (), ()


def _moved(step: Put | Pick) -> tuple[int, ...]:
    return step.what if isinstance(step, Put) else (step.what,)


def _keep_unchosen(context: Context, keep: Keep, left: Sequence[Referent]) -> None:
    first = len(context.discourse.referents)
    context.discourse.referents += left
    context.constraints += (Constraint(keep, (), referent=first + at) for at in range(len(left)))


def _left_by_choice(context: Context, indices: Iterable[int], text: str) -> list[Referent]:
    """What is not chosen of what can be moved.

    Raises:
        ReferenceProblem: that is not clear, or there are too many ways.
    """
    referents, infos = context.discourse.referents, context.scene.infos
    pools: dict[frozenset[Thing], list[int]] = {}
    for index in dict.fromkeys(indices):
        pool = frozenset(things_in(referents[index].options))
        free = all(t.name in infos and infos[t.name].movable and not t.part for t in pool)
        if free and len(referents[index].options) > 1:
            pools.setdefault(pool, []).append(index)
    found: list[Referent] = []
    for pool, chosen in pools.items():
        sizes = [{len(option) for option in referents[index].options} for index in chosen]
        rest = max(0, len(pool) - sum(map(max, sizes)))
        clear = all(len(size) == 1 for size in sizes)
        clear &= all(
            one in referents[other].distinct_from or other in referents[one].distinct_from
            for one, other in combinations(chosen, 2)
        )
        clear &= not any(pool & other for other in pools if other != pool)
        if not clear or comb(len(pool), rest) > _MOST_WAYS:
            raise ReferenceProblem(text, "say which ones", 3)
        things = sorted(pool, key=lambda thing: list(infos).index(thing.name))
        if rest:
            ways = tuple(combinations(things, rest))[::-1]
            found.append(Referent(ways, text, tuple(chosen)))
    return found
