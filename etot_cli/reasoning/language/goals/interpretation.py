"""From syntax trees to a goal: every phrase gets its referents, every clause its steps."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Goal, Put, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.reasoning.language.goals.alone import check_alone_at_last
from etot_cli.reasoning.language.goals.best_reading import best_reading
from etot_cli.reasoning.language.goals.checks import (
    check_circle,
    check_everything,
    check_held,
    check_kept,
    check_one_of_several,
    check_run,
    check_shut,
    check_shut_away,
    check_stays,
    check_swept_away,
    check_turns,
    with_room_made,
)
from etot_cli.reasoning.language.goals.knocked_over import carried_standing
from etot_cli.reasoning.language.goals.left_out import (
    without_needless,
    without_places,
    without_ruled_out,
)
from etot_cli.reasoning.language.goals.prohibitions import gone_along
from etot_cli.reasoning.language.goals.understanding import Understanding
from etot_cli.reasoning.language.grammar.sentences.reader import Sentence
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    EnsureClause,
    ReorientClause,
)
from etot_cli.reasoning.language.grammar.text.splitting import ASIDE
from etot_cli.reasoning.language.reference.choosing.noun_phrases import Resolver
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.world.state import SceneState

_BACK = Expression(
    r"\b(?:put|place|return|bring|set|move|go|goes)\b[^.,;]*(?<!the )\bback\b"
    r"(?! (?:of|left|right)\b)"
)
"""What is said of what is to be returned to where it was taken from."""


def interpret(sentences: Sequence[Sentence], scene: SceneState, vocabulary: Vocabulary) -> Goal:
    """The goal of an instruction about a scene.

    Raises:
        ReferenceProblem: no reading of a sentence fits the scene, or several fit that ask for
            different things.
    """
    returning = any(_BACK.search(sentence.text) for sentence in sentences)
    _check_else(" ".join(sentence.text for sentence in sentences))
    discourse = Discourse(scene, returning=returning)
    state = Understanding(scene, discourse, Resolver(scene, vocabulary))
    for sentence in sentences:
        known = state.context.discourse.undecided
        state = best_reading(state, sentence)
        _leave_open(state.context.discourse, known, sentence.text)
    goal = carried_standing(state.context, state.goal(complete=True))
    goal = gone_along(state.context, goal)
    goal = with_room_made(goal, state.context.in_the_way)
    check_alone_at_last(state.context, goal)
    check_kept(goal, scene)
    check_shut(goal, scene)
    check_shut_away(goal, scene)
    check_everything(goal)
    check_run(goal)
    check_circle(goal)
    _check_remarks(goal, state.context.discourse)
    check_turns(state.timed, state.context.discourse)
    check_stays(state.timed, state.context.discourse)
    check_one_of_several(state.timed, state.context.discourse)
    goal = without_ruled_out(without_places(goal, state.context.discourse), scene)
    goal = settled(goal, scene, state.context.turned)
    check_held(state.timed, goal, scene)
    check_swept_away(goal, state.context.discourse.swept)
    _check_decided(goal, state.context.discourse)
    last = state.context.last
    forbidden = goal.constraints or isinstance(last, AvoidClause)
    named = isinstance(last, ReorientClause) and last.only_named
    allowed = isinstance(last, EnsureClause) and all(state.allowed for state in last.states)
    remark = last.remark if isinstance(last, ReorientClause) else ""
    wished = " is for " in remark or " are for " in remark  # to be put there?
    if wished or not (goal.steps or state.asked or not (forbidden or named or allowed)):
        said = "how things are" if named else "what may be" if allowed else "what not to do"
        asked = [item.text for item in sentences if not item.text.endswith(ASIDE)]
        text = (asked or [sentences[0].text])[-1 if wished else 0]
        raise ReferenceProblem(text, f"this says {said}, but not what to do", 2)
    return without_needless(goal)


_ARTICLE = Expression(
    r"\b(?:the|an?|my|our|your|this|that|these|those|both|all|one|it|them|its|their|every|each)\b"
)


_ALL_ELSE = r"(?:(?:everything|anything|all) else|(?:all )?the (?:rest|others?))\b"
_IN_THERE = (
    r"(?! (?:from|out of|off|of|(?:in|on|inside) (?:it|there)) ?"
    r"| (?:in|on) the (?:\w+ )?\w+ (?:goes|comes|should|must|belongs|has)\b)"
)
_FOR = r"\b(?:is|are) (?:(?:only|just|exclusively) )?for "
_ELSE = Expression(
    rf"(?:{_FOR}(?!(?:the|my|our|all|both)\b)\w[^~]*?\b(?P<else>{_ALL_ELSE}){_IN_THERE}"
    rf"|{_FOR}(?P<for>{_ALL_ELSE})(?! (?:in|on) )"
    rf"|{_FOR}[^~]*?\b(?P<out>{_ALL_ELSE})(?= (?:\w+ ){{0,3}}(?:out|off|away)\b(?! of)))"
)
"""What else there is beside what something is for."""


def _leave_open(discourse: Discourse, known: frozenset[int], sentence: str) -> None:
    """In a sentence without any article "pen in holder" is about a holder, whichever that is."""
    if _ARTICLE.search(sentence):
        return
    for index in sorted(discourse.undecided - known):
        referent = discourse.referents[index]
        if len(referent.options) > 1:
            names = " or ".join(thing.address for thing in things_in(referent.options))
            discourse.notes.append(f"{referent.text!r} is any: {names}")
            discourse.undecided -= {index}


def _check_else(text: str) -> None:
    """Whether "the bowl is for lemons; everything else goes on the plate" leaves it open what else.

    Raises:
        ReferenceProblem: it may be all else in the bowl, or all else there is.
    """
    if found := _ELSE.search(text):
        why = "say whether that is all else in there, or all else there is"
        raise ReferenceProblem(found[found.lastgroup or 0], why, 3)


def _used(goal: Goal) -> set[int]:
    """The referents that the steps of a goal are about."""
    puts = [step for step in goal.steps if isinstance(step, Put)]
    used = {step.what for step in goal.steps if not isinstance(step, Put)}
    used |= {index for step in puts for index in step.what}
    return used | {index for step in puts for place in step.places for index in place.referents()}


def _check_decided(goal: Goal, discourse: Discourse) -> None:
    """Whether "the cup" means one thing.

    Raises:
        AmbiguousReference: several things fit, and neither words nor state tell them apart.
    """
    for index in sorted(_used(goal) & discourse.undecided):
        referent = goal.referents[index]
        if len(referent.options) > 1:
            names = [thing.address for thing in things_in(referent.options)]
            raise AmbiguousReference(referent.text, names)


def _check_remarks(goal: Goal, discourse: Discourse) -> None:
    """Whether something was said of one of several things that may be meant ("the red bowl is
    broken; put the pear in a bowl").
    """
    told = {*discourse.things(*discourse.remarked)}
    for index in sorted(_used(goal)):
        referent = goal.referents[index]
        if index in discourse.remarked and len(referent.options) > 1:  # "one of them is dirty"
            raise AmbiguousReference(referent.text, [t.name for t in things_in(referent.options)])
        free = [option for option in referent.options if not told & {*option}]
        if 0 < len(free) < len(referent.options):
            names = [thing.name for thing in things_in((*free, *referent.options))]
            raise AmbiguousReference(referent.text, names, "something was said of one of them:")
