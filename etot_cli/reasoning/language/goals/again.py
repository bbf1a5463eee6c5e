"""What was asked for last, asked for of other things or with another place."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Close, Grouping, Pick, Put, Relation, Step
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.by_color import is_matching
from etot_cli.reasoning.language.goals.closer import certain
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.goals.putting import put
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    AvoidClause,
    EnsureClause,
    PutClause,
    TowerClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.words.lexicon import same_noun


def again(context: Context, clause: AgainClause) -> None:
    """Adds the step that was asked for last once more, for other things; what is ``added`` after
    something was taken out goes in there.
    """
    before = context.done
    if clause.things is None:
        _onward(context, clause, before)
        return
    text = clause.things.text
    removed = bool(before) and isinstance(before[-1], Put) and before[-1].removal
    if clause.added and (removed or not (before and isinstance(before[-1], Put))):
        where = Destination(Toward.HERE, word="there" if removed else "in")
        put(context, put_to(clause.things, (where,)))
        return
    if not before:
        raise ReferenceProblem(text, "nothing was asked for before that it could share", 2)
    step = before[-1]
    last = context.last
    if isinstance(last, AvoidClause):
        ways = ("what is left alone", "what something is done with")
        raise AmbiguousReference(text, ways, "it may be one more of")
    if isinstance(last, PutClause | EnsureClause) and any(
        isinstance(item, NounPhrase) and is_matching(item) for item in nodes(last)
    ):
        # A cup of its own colour is another one for something else.
        if not isinstance(last, PutClause) or len(last.groups) > 1:
            raise ReferenceProblem(text, "say where it goes", 3)
        put(
            context,
            structs.replace(last, groups=(structs.replace(last.groups[0], things=clause.things),)),
        )
        return
    if isinstance(step, Put):
        if any(not isinstance(item, Put) or item.places != step.places for item in before):
            raise ReferenceProblem(text, "say again what is to be done", 2)
        themes = context.phrases.things(clause.things, Role.THEME)
        there = certain(context, step.what)
        _check_another(context, clause.things, themes)
        _check_not_elsewhere(context, clause.things, themes)
        # "All toys into the box, the bear too": it is one of them.
        themes = [i for i in themes if not {*context.discourse.things(i)} <= there]
        if not (themes or clause.trailing):  # "…, followed by the cup on the desk" is another one
            raise ReferenceProblem(text, "it has been put somewhere; say what is meant", 3)
        if set(themes) & {index for place in step.places for index in place.referents()}:
            raise ReferenceProblem(text, "nothing can be put into or on itself", 2)
        if clause.trailing and any(_like_a_place(context, step, index) for index in themes):
            why = "say whether it goes there, too, or is one more place to go to"
            raise ReferenceProblem(text, why, 4)
        if clause.side_by_side and not _on_one_thing(step):
            raise ReferenceProblem(text, "say what each of them is to stand on", 3)
        if isinstance(context.last, TowerClause):
            raise ReferenceProblem(text, "say where in the stack it goes", 3)
        if themes:
            add_put(context, themes, step.places, Grouping.ANY, removal=step.removal)
        return
    if isinstance(step, Close) and (put_in := _closed_behind(context, step, clause.things)):
        themes = context.phrases.things(clause.things, Role.THEME)
        _check_another(context, clause.things, themes)
        add_put(context, themes, put_in.places, Grouping.ANY)
        context.steps.append(step)
        return
    role = Role.THEME if isinstance(step, Pick) else Role.PART
    for index in context.phrases.things(clause.things, role):
        if isinstance(step, Pick) and index == step.what:
            raise ReferenceProblem(text, "say again what is to be done with it", 2)
        context.steps.append(replace(step, what=index))


def _closed_behind(context: Context, step: Close, things: Things) -> Put | None:
    """What put the one thing that was moved into what was closed then, where the same is asked for
    of things that are not closed themselves ("put the pen in the drawer and close it; do the same
    with the cup").
    """
    (put_in, *more) = context.puts or (None,)
    if put_in is None or more or put_in.removal or len(context.discourse.things(*put_in.what)) > 1:
        return None
    into = [i for place in put_in.places for i in place.referents()]
    inside, closed = ([*context.discourse.things(*at)] for at in (into, [step.what]))
    alike = [(a.name, a.part or b.part) == (b.name, b.part) for a in inside for b in closed]
    if alike != [True]:
        return None
    with suppress(ReferenceProblem):
        for phrase in things.phrases:
            context.phrases.meaning(phrase, Role.PART)
        return None
    return put_in


def _on_one_thing(step: Put) -> bool:
    """Whether all that is put there lies on the same thing, and so on nothing else."""
    return len(step.places) == 1 and step.places[0].relation is Relation.ON


def _check_another(context: Context, things: Things, themes: Sequence[int]) -> None:
    """Whether "the white one, too" is another thing than those that were put somewhere.

    Raises:
        ReferenceProblem: it has a place already.
    """
    for phrase, theme in zip(things.phrases, themes, strict=False):
        if phrase.is_elliptic and theme in context.discourse.put:
            raise ReferenceProblem(phrase.text, "it has been put somewhere; say what is meant", 3)


def _check_not_elsewhere(context: Context, things: Things, themes: Sequence[int]) -> None:
    """Whether what goes there before something else has not been put somewhere: "not before the
    cup" may only say when ("put the cup on the tray; put the pen in the box, but not before …").

    Raises:
        ReferenceProblem: it has.
    """
    done = {*context.discourse.things(*context.discourse.put, *context.discourse.lifted)}
    if context.order is Order.BEFORE_THAT and done & {*context.discourse.things(*themes)}:
        raise ReferenceProblem(things.text, "it has been put somewhere; say what is meant", 3)


def _onward(context: Context, clause: AgainClause, before: Sequence[Step]) -> None:
    """Adds a step that brings what was put somewhere on to another place."""
    named = [np.text for item in clause.destinations for np in item.targets]
    named += [near.text for item in clause.destinations for near in item.beside]
    text = " or ".join(named)
    if not (len(before) == 1 and isinstance(before[0], Put)):
        raise ReferenceProblem(text, "say what goes there", 2)
    if clause.trailing and not before[0].removal:
        raise ReferenceProblem(text, "another place was said before", 2)
    themes = before[0].what
    places = context.places.of(clause.destinations, themes)
    add_put(context, themes, places, Grouping.ANY)
    context.discourse.last_places = places


def _like_a_place(context: Context, step: Put, theme: int) -> bool:
    """Whether "A on B and C, too" may say that A goes on B and C: they share their noun."""
    discourse = context.discourse
    places = {index for place in step.places for index in place.referents()}
    nouns = [mention.noun for mention in discourse.mentions if mention.referent in places]
    own = [mention.noun for mention in discourse.mentions if mention.referent == theme]
    return any(same_noun(one, other) for one in nouns for other in own)
