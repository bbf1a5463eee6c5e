"""In which order clauses are done, and the several things of one clause have their turns."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import combinations

from msgspec import Struct, structs

from etot_cli.reasoning.builtin.goal import Open, Pick, Put, Step, Thing, referents_of
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.grammar.syntax.clauses import Turns
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.reference.choosing.selection import in_line
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.lexicon import OF_TWO, is_descriptive, singular
from etot_cli.world.state import DESK

POINTING = frozenset({"these", "those"})
"""Of things that are told next."""


def in_turns(
    context: Context, spoken: Things, turns: Turns, role: Role, excluded: Sequence[int] = ()
) -> list[int]:
    """Referents of things in the order in which they have their turns.

    Raises:
        ReferenceProblem: a phrase cannot be resolved, or the words for order do not order them.
    """
    (np, *_) = spoken.phrases
    first, *_ = np.determiner.split() or [np.pronoun]
    if turns.listed and first in POINTING:
        return context.phrases.things(_those_listed(context, spoken, turns), role, excluded)
    found = context.phrases.things(spoken, role, excluded)
    if turns == Turns():
        return found
    things = [thing for index in found for thing in context.only(index, "say which ones")]
    text = spoken.text
    if len(things) == 1:
        # In "open the left one, but shut the middle drawer first" the drawer has no turn.
        raise ReferenceProblem(text, f"{things[0].name} alone has no turn", 3)
    if turns.sweep:
        if len(spoken.phrases) > 1:
            why = "say in which order they go, or beside what each of them is to be"
            raise ReferenceProblem(text, why, 3)
        ordered = in_line(turns.sweep.split()[0], things, context.scene, text)
        names = ", ".join(thing.part or thing.board or thing.name for thing in ordered)
        context.discourse.notes.append(f"one after the other: {names}")
    else:
        ahead = _picked_out(context, spoken, turns.first or turns.all or turns.listed, things, role)
        behind = _picked_out(context, spoken, turns.last, things, role)
        between = [thing for thing in things if thing not in ahead and thing not in behind]
        if (turns.all or turns.listed) and between:
            names = " and ".join(thing.name for thing in between)
            raise ReferenceProblem(text, f"say when it is the turn of {names}", 2)
        ordered = [*ahead, *between, *behind]
        for below, upon in combinations(ordered, 2):
            if {below, upon} <= {*between} or below.name not in carriers(context.scene, upon.name):
                continue
            why = f"{upon.name} would come along with {below.name}; say {upon.name} first"
            raise ReferenceProblem(text, why, 4)
    return [context.single(thing, text) for thing in ordered]


def _those_listed(context: Context, spoken: Things, turns: Turns) -> Things:
    """What "these blocks … in this order: …" are, where nothing else tells which they are.

    Raises:
        ReferenceProblem: there are more of them, or fewer, than are said to be.
    """
    (np, *more) = spoken.phrases
    count = quantity_of(np.determiner).count
    if more or np.modifiers or count not in (None, len(turns.listed)):
        raise ReferenceProblem(spoken.text, "say which ones, each with its turn", 2)
    noun = np.words[-1:]
    listed = (_with_noun(item, noun, context) for item in turns.listed)
    return Things(tuple(structs.replace(np, determiner=np.determiner or "the") for np in listed))


def _picked_out(
    context: Context,
    spoken: Things,
    phrases: Sequence[NounPhrase],
    things: Sequence[Thing],
    role: Role,
) -> list[Thing]:
    """What "blue first" or "the small one last" means among several things."""
    noun = spoken.phrases[-1].words[-1:]
    found: list[Thing] = []
    for phrase in phrases:
        own = {*map(singular, noun)} <= {*map(singular, phrase.words)}  # "vial 2" of the vials
        left = [thing for thing in things if thing not in found]
        if quantity_of(phrase.determiner).other and phrase.words in ((), ("one",), noun):
            if len(left) != 1:
                raise ReferenceProblem(phrase.text, "say which one of them", 2)
            found += left
            continue
        full = phrase if own else _with_noun(phrase, noun, context)
        resolved = None
        with suppress(ReferenceProblem):  # of "the white bottles, the right one first": of these
            resolved = context.phrases.resolver.resolve(full, role, among=things)
        resolved = resolved or context.phrases.meaning(full, role)
        if len(resolved.options) != 1:
            raise ReferenceProblem(phrase.text, "say which one of them", 2)
        if not all(thing in things for thing in resolved.options[0]):
            raise ReferenceProblem(phrase.text, "it is none of what is to be put", 2)
        found += resolved.options[0]
    return found


def _with_noun(phrase: NounPhrase, noun: tuple[str, ...], context: Context) -> NounPhrase:
    """An elliptic phrase ("blue first") with the noun that it leaves out."""
    single = tuple(map(singular, noun))
    if {*phrase.words[:1]} & {*OF_TWO}:
        return phrase
    if phrase.is_elliptic:
        return phrase.called(*(single if phrase.head == "one" else noun))
    # An adjective alone leaves its noun out; so does a word that names nothing.
    adjectives = all(map(is_descriptive, phrase.words)) or not context.phrases.named(phrase.words)
    return structs.replace(phrase, words=(*phrase.words, *single)) if adjectives else phrase


class Timed(Struct, frozen=True):
    """A clause's steps, when they are to be done, and the number of the sentence; ``stays``: it
    says where things stay; ``led``: the word for when stands before it.
    """

    steps: tuple[Step, ...]
    order: Order
    sentence: int
    stays: bool = False
    led: bool = False


def continues(item: Timed, after: Timed, discourse: Discourse) -> bool:
    """Whether what one clause takes, the one behind it puts somewhere ("first take the cup and put
    it …"): both are done when the first one is, unless it goes back to where it was ("take the lid
    off first, and put it back on afterwards").
    """
    if item.order is Order.FIRST and any(_goes_back(step, discourse) for step in after.steps):
        return False
    taken = [
        (step.what,) if isinstance(step, Pick) else step.what
        for step in item.steps
        if isinstance(step, Pick) or (isinstance(step, Put) and step.removal)
    ]
    put = [step.what for step in after.steps if isinstance(step, Put) and not step.removal]
    further = after.order in (Order.SAID, Order.THEN) and after.sentence == item.sentence
    return len(taken) == len(item.steps) and taken == put != [] and further


def _goes_back(step: Step, discourse: Discourse) -> bool:
    """Whether a step puts things in or on what they were in or on at the start."""
    if not isinstance(step, Put):
        return False
    places = [place.where for place in step.places if place.where is not None]
    return any(
        touches(thing, there, discourse.scene)
        for thing in discourse.things(*step.what)
        for there in discourse.things(*places)
        if there.name != DESK
    )


def _goes_elsewhere(item: Timed, said: Sequence[Timed], discourse: Discourse) -> bool:
    """Whether what a place is to be without in the end is put somewhere by what else is asked."""

    def moved(steps: Sequence[Step], *, off: bool) -> set[Thing]:
        puts = (step for step in steps if isinstance(step, Put) and step.removal == off)
        return {thing for step in puts for thing in discourse.things(*step.what)}

    taken = moved(item.steps, off=True)
    return any(taken & moved(other.steps, off=False) for other in said if other is not item)


def _goes_on(item: Timed, last: Timed, discourse: Discourse) -> bool:
    """Whether what is said in one with what comes last goes on about the same things ("finally put
    it in the drawer and close that").
    """
    further = item.order in (Order.SAID, Order.THEN) and item.sentence == last.sentence
    if not (last.led and further):
        return False
    mine, others = (
        {thing.name for step in timed.steps for thing in discourse.things(*referents_of(step))}
        for timed in (item, last)
    )
    return bool((mine & others) - {DESK})


def _check_between(before: Sequence[Timed]) -> None:
    """Whether two things are said to be done one after the other.

    Raises:
        ReferenceProblem: nothing is "in between".
    """
    said = [item.order for item in before[-2:]]
    if len(said) < 2 or not (said[1] in (Order.THEN, Order.LAST) or said[0] is Order.FIRST):
        raise ReferenceProblem("in between", "say before or after what", 3)


def _but_again(item: Timed, later: Sequence[Timed], discourse: Discourse) -> Timed:
    """A clause without what is named again behind what comes before that ("close the box, but
    before you close it, put the pen in", "open A and B, but close A before opening B").

    Raises:
        ReferenceProblem: of all that it opens, closes or puts somewhere, one is named so again.
    """

    def things(step: Step) -> set[Thing]:
        return {*discourse.things(*(step.what if isinstance(step, Put) else (step.what,)))}

    def without(step: Step) -> Step | None:
        for at, other in enumerate(later):
            (again, *more) = other.steps or (None,)
            if at == 0 or other.order is not Order.THEN or more or type(again) is not type(step):
                continue
            assert again is not None
            between = {t for one in later[:at] for s in one.steps for t in things(s)}
            if isinstance(step, Open):
                places = (s for one in later[:at] for s in one.steps if isinstance(s, Put))
                between |= {t for s in places for t in discourse.things(*referents_of(s))}
            if again == step:
                return step if between & things(step) else None
            if isinstance(step, Put) and isinstance(again, Put):
                left = tuple(index for index in step.what if index not in again.what)
                same = replace(again, what=step.what) == step and left != step.what
                if same and not between & things(again):
                    return replace(step, what=left)
            elif things(again) < things(step) and not between & things(again):
                text = discourse.referents[referents_of(step)[0]].text
                raise ReferenceProblem(text, "name them one by one, in the order meant", 3)
        return step

    turned = (s if isinstance(s, Pick) else without(s) for s in item.steps)
    return structs.replace(item, steps=tuple(step for step in turned if step is not None))


def in_order(said: Sequence[Timed], discourse: Discourse) -> list[Step]:
    """All steps in the order in which they are to be done.

    "First" goes before everything that was said before it, "…, but first" before what its sentence
    says, "before that" before the clause before it, "last" after everything. Puts of one sentence
    that no word puts in an order are a run, a set of placements ("the red block on the green one
    and the green one on the blue one"); what was said before what goes ahead of it is not of that
    one's run.
    """
    said = [_but_again(item, said[n + 1 :], discourse) for n, item in enumerate(said)]
    done: list[Timed] = []
    last: list[Timed] = []
    ahead: Timed | None = None
    for number, item in enumerate(said):
        along = ahead is not None and item.sentence == ahead.sentence and item.order is Order.SAID
        # A door that is named last is rather closed behind all of it.
        along = along and all(isinstance(step, Put) for step in item.steps)
        that = ahead if along else said[number - 1] if number else None
        queue = last if any(other is that for other in last) else done
        if item.order in (Order.BEFORE_THAT, Order.BETWEEN):
            if item.order is Order.BETWEEN:
                _check_between(said[:number])
            here = (at for at, other in enumerate(queue) if other is that)
            queue.insert(next(here, max(len(queue) - 1, 0)), item)
        elif along:  # "…, but before that take the cup off and put the pen in the box"
            queue.insert(next(at for at, other in enumerate(queue) if other is that) + 1, item)
        elif item.order is Order.FIRST:
            own = (at for at, other in enumerate(done) if other.sentence == item.sentence)
            done.insert(next(own, 0) if item.led else 0, item)
        elif (item.order is Order.LAST and not _goes_elsewhere(item, said, discourse)) or (
            last and _goes_on(item, last[-1], discourse)
        ):
            last.append(item)
        else:
            done.append(item)
        # "First …" begins what is told in its order; "…, but first …" goes back.
        back = item.order is Order.FIRST and item.led and number > 0
        back = back and said[number - 1].sentence == item.sentence
        ahead = item if along or back or item.order is Order.BEFORE_THAT else None
    steps: list[Step] = []
    run, sentence = 0, -1
    position = {id(item): at for at, item in enumerate(said)}
    before = -1
    for item in [*done, *last]:
        waits = any(isinstance(step, Put) and step.aside for step in item.steps)
        overtaken, before = position[id(item)] < before, position[id(item)]
        if item.sentence != sentence or item.order is not Order.SAID or overtaken:
            run, sentence = run + 1, item.sentence
        for step in item.steps:
            run += waits
            steps.append(replace(step, run=run) if isinstance(step, Put) else step)
    return steps
