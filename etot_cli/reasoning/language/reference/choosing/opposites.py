"""Words that tell one thing from no other, though it may be spoken of as two: "the left plate … the
right plate" where there is one.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier
from etot_cli.reasoning.language.reference.choosing.selection import side_word
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.naming.matching import Match
from etot_cli.reasoning.language.reference.naming.states import state_holds
from etot_cli.reasoning.language.words.lexicon import SIDES, SIZES, STATES
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_OPPOSITES = ({"left", "right"}, {"front", "back"}, {"near", "far"})


def idle_words(
    match: Match,
    modifiers: Sequence[Modifier],
    things: Sequence[Thing],
    scene: SceneState,
    phrase: str,
    notes: list[str],
) -> tuple[str, ...]:
    """Words for sides and sizes that tell one thing from no other, the first of them noted.

    Raises:
        ReferenceProblem: one compares the only thing that is called so, or is the opposite of what
            that is called itself.
    """
    words = match.selectors
    states = [word for word in words if word in STATES]
    things = [t for t in things if all(state_holds(word, t, scene) for word in states)]
    asides = (item for item in modifiers if item.prep is Prep.SIDE and not item.denied)
    told = (*words, *(side_word(" ".join(item.words)) or "" for item in asides))
    idle = tuple(word for word in told if word in SIDES or word in SIZES)
    if len(things) != 1 or not idle:
        return ()
    only = f"only {things[0].name} is called so"
    for word in idle if len(match.entries) == 1 else ():
        named = [own for own in (*SIDES, *SIZES) if match.entries[0].has_word(own)]
        if any(_are_opposite(word, own) for own in named):
            raise ReferenceProblem(phrase, f"{only}, which is not {word}", 2, word=word)
        if word in SIZES and word.endswith(("er", "est")):
            why = f"{only}; {word!r} compares it with nothing"
            raise ReferenceProblem(phrase, why, 2, word=word)
    # "In front box" may be meant to be before it.
    if phrase.startswith("front ") and not things[0].part:
        raise ReferenceProblem(phrase, f"{only}; say 'in front of' or 'in'", 2, word="front")
    notes.append(f"{idle[0]!r} or not, {only}")
    return idle


def check_opposites(discourse: Discourse) -> None:
    """Looks through what was spoken of.

    Raises:
        ReferenceProblem: one thing is called by a word and by its opposite, or it is told from no
            other where it was spoken of before ("the pen next to the cup, and the left one").
    """
    idle = [
        (discourse.things(item.referent), word) for item in discourse.mentions for word in item.idle
    ]
    for (things, one), (others, other) in combinations(idle, 2):
        if things == others and _are_opposite(one, other):
            name = things[0].name
            why = f"only {name} is called so, which is not {one} and {other} at once"
            raise ReferenceProblem(other, why, 4)
    for at, item in enumerate(discourse.mentions):
        before = (m for m in discourse.mentions[:at] if m.referent == item.referent)
        told = {*item.idle} & {*(item.adjectives or item.idle)}
        told = told if item.role is Role.THEME else set()
        if any(told - {*mention.adjectives} for mention in before):
            only = f"only {discourse.things(item.referent)[0].name} is called so"
            raise ReferenceProblem(item.idle[0], f"{only}; say what is meant", 3)


def _are_opposite(one: str, other: str) -> bool:
    if one in SIZES and other in SIZES:
        (of, sign), (of_other, sign_other) = SIZES[one], SIZES[other]
        return of == of_other and sign != sign_other
    return {SIDES.get(one), SIDES.get(other)} in _OPPOSITES
