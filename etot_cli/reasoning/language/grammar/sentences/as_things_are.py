"""Rules for what is asked for only if things are so by now, and for what is asked for otherwise.

The scene says whether they are; what depends on anything else is not read.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.how_things_are import (
    ASKED,
    CONDITION,
    EMPTY,
    IS_SO,
    NOW,
    condition_of,
    with_it,
)
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    quiet,
    sequence,
    spanned,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    ahead,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    ReorientClause,
    named,
    put_to,
    themes,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Condition,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import small_words, verbs
from etot_cli.reasoning.language.words.lexicon import word_set
from etot_cli.reasoning.language.words.patterns import openings_of

_VERBS = openings_of(
    (verbs.PICK, verbs.PUT, verbs.REMOVE, verbs.OPEN, verbs.CLOSE, verbs.KEEP)
) - word_set("house hand jam post seat station stuff")
"""With which a request begins behind a condition without a comma."""
_THAT_CASE = "that case"
NOTHING = ReorientClause(Things(()), only_named=True)
_IS_THERE = {"there": True, "not there": False}


def _only_if(condition: Condition, reading: Reading) -> Reading:
    return tuple(replace(said, only_if=condition, far_fetched=1) for said in reading)


def _otherwise(condition: Condition) -> Condition:
    return replace(condition, so=not condition.so)


def _held_by(nps: tuple[NounPhrase, ...], condition: Condition) -> Condition:
    """The same of what is in or on one of several things."""
    place = condition.place
    return condition if place is None else replace(condition, place=replace(place, targets=nps))


def _of_what_was_named(said: tuple[Reading, Condition]) -> list[tuple[Reading, Condition]]:
    """A condition behind what is asked for, with what its pronoun may mean: whatever fits its
    state, or what is to go elsewhere from where it is. "Its door" is that of whatever has one, and
    "that drawer" the one that was named.
    """
    reading, condition = said
    clause = reading[0].clause
    if len(reading) > 1 or reading[0].order is not Order.SAID or not themes(clause):
        return []
    (about, *more) = condition.subjects
    if condition.more:
        found = _of_what_was_named((reading, replace(condition, more=())))
        return [
            (again, replace(whole, more=rest))
            for again, whole in found
            for rest in [_of_the_same(condition, whole)]
            if rest
        ]
    if about.determiner == "its" and about.owner is None and not more:
        whose = (np for np in named(clause) if not (np.pronoun or np.modifiers or np.owner))
        parts = (replace(about, determiner="the", owner=np) for np in whose)
        return [(reading, replace(condition, subjects=(part,))) for part in parts]
    like = [np for np in named(clause) if about.words and np.words[-1:] == about.words]
    if about.determiner in ("that", "this") and not (more or about.modifiers) and like:
        return [(reading, replace(condition, subjects=(np,))) for np in like]
    if not about.pronoun:
        it = condition.place is not None and condition.place.targets[0].pronoun
        holders = tuple(np for np in named(clause) if not np.pronoun and np != about)
        return [(reading, _held_by(holders, condition))] if it and holders else [said]
    meant = themes(clause) if condition.place else named(clause)
    open_to = condition.place or condition.word == EMPTY
    if more or (open_to and meant[1:]):
        return []
    return [(reading, replace(condition, subjects=(np,))) for np in meant if not np.pronoun]


def _both_asked(before: Reading, after: Reading) -> Reading | None:
    """What is asked for and what by a condition, which is another one than any before it."""
    given = {replace(said.only_if, so=True) for said in before if said.only_if}
    again = any(said.only_if and replace(said.only_if, so=True) in given for said in after)
    return None if again else (*before, *after)


def _of_the_same(condition: Condition, whole: Condition) -> tuple[Condition, ...]:
    """What else is said of what the first condition turned out to be about; nothing if a pronoun
    stays unclear.
    """
    same = (
        replace(part, subjects=whole.subjects) if part.subjects == condition.subjects else part
        for part in condition.more
    )
    found = tuple(with_it(part, None) for part in same)
    return tuple(part for part in found if part) if all(found) else ()


def _another_way(before: Clause, instead: Any) -> list[Clause]:
    """What is asked for of other things, or to another place, by the verb said before."""
    match before, instead:
        case ((MoveClause() | PickClause()), Things()):
            return [replace(before, things=instead)]
        case PutClause(groups=(PutGroup(destinations=where),)), Things(phrases=nps):
            # "…, otherwise the cup" goes there instead, or is where it goes
            place = put_to(Things(themes(before)), (Destination(Toward.TO, nps),))
            return [put_to(instead, where), *([] if nps[1:] else [place])]
        case ((PutClause() | EnsureClause()), (Destination(), *_)) if themes(before):
            return [put_to(Things(themes(before)), instead)]
    return []


def _or_else(condition: Condition, reading: Reading, otherwise: Any) -> list[Reading]:
    """What is asked for where the condition holds, and else."""
    if otherwise is None:
        return [_only_if(condition, reading)]
    said, instead = otherwise
    if isinstance(said, tuple):  # "if it is open …, if it is closed …"
        nps, word = said
        same = {np.words for np in nps if not np.pronoun} <= {np.words for np in condition.subjects}
        opposite = {word, condition.word} == {"open", "closed"}
        if condition.denied or condition.more or not (same and opposite):
            return []
        said = False
    if said in _IS_THERE:  # "put it there, if it is there already …"
        if condition.place is None or condition.more:
            return []
        said = _IS_THERE[said]
    if said is (condition.so != condition.denied) or (said == _THAT_CASE and condition.so):
        return []  # "if it is open …, if it is …"
    if isinstance(said, bool) and condition.more and any(p.denied for p in condition.parts):
        return []  # "if it is open and that is not empty …, if it is not …"
    if isinstance(instead, tuple) and isinstance(instead[0], Spoken):
        ways = [_of_its_own(condition, instead) if said is True else instead]
    else:
        clauses = _another_way(reading[0].clause, instead) if len(reading) == 1 else []
        at = reading[0].position + 1
        ways = [(replace(reading[0], clause=clause, position=at),) for clause in clauses]
    return [(*_only_if(condition, reading), *_only_if(_otherwise(condition), way)) for way in ways]


def _done_meanwhile(condition: Condition, reading: Reading) -> Reading | None:
    """What is done once "as long as" things are so; nobody knows how long else something lasts."""
    lasting = (
        isinstance(s.clause, AvoidClause | EnsureClause) or _stays(s.clause) for s in reading
    )
    return None if any(lasting) else _only_if(condition, _of_its_own(condition, reading))


def _stays(clause: Clause) -> bool:
    return isinstance(clause, PutClause) and clause.stays


def _put_elsewhere(
    reading: Reading, change: Callable[[Destination], Destination], *spoken_of: str
) -> Reading:
    """What first puts things somewhere, with that changed, unless these are ``spoken_of`` by any
    of some pronouns.
    """
    clause = reading[0].clause
    if not isinstance(clause, PutClause) or len(clause.groups) > 1:
        return reading
    (group,) = clause.groups
    if any(np.pronoun in spoken_of for np in group.things.phrases):
        return reading
    group = replace(group, destinations=tuple(map(change, group.destinations)))
    return (replace(reading[0], clause=replace(clause, groups=(group,))), *reading[1:])


def _into(fits: Callable[[NounPhrase], bool], other: NounPhrase) -> Any:
    """Changes what something goes into."""

    def changed(item: Destination) -> Destination:
        inside = item.toward is Toward.INSIDE and not item.beside
        return item.going_to(lambda np: other if fits(np) else np) if inside else item

    return changed


def _of_its_own(condition: Condition, reading: Reading) -> Reading:
    """What goes "in it" behind a condition goes into what that says to be open, or empty, and what
    goes "there" where it says that something is.
    """
    (about, *more), where = condition.subjects, condition.place
    if condition.more or (where is not None and where.targets[0].pronoun):
        return reading
    if where is not None:
        at = where
        return _put_elsewhere(
            reading, lambda to: at if to == Destination(Toward.HERE, word="there") else to
        )
    if more or condition.word == "closed" or about.pronoun or condition.there:
        return reading
    own = _into(lambda np: np.pronoun == "it" and not np.modifiers, about)
    return _put_elsewhere(reading, own, "it", "this", "that")


def _answered(asked: Condition, answer: tuple[Any, Any], other: Any) -> Any:
    """What is asked for if the answer to a question is yes, or no."""
    said, instead = answer
    plain = isinstance(said, bool) and not asked.denied
    if not plain or not (isinstance(instead, tuple) and isinstance(instead[0], Spoken)):
        return None
    return replace(asked, so=said), _of_its_own(asked, instead), other


def _likewise(before: Reading, text: str, also: tuple[Any, ...]) -> Reading | None:
    """What is asked for if other things are so, too ("if the box is empty, put the pen in it; if
    the bag is, the cup").
    """
    nps, denied, asked = also
    first = before[0].only_if
    if any(np.pronoun for np in nps):
        return None  # "…; if it is, …" speaks of the same thing
    if first is None or first.more or first.some or len({said.only_if for said in before}) > 1:
        return None
    condition = condition_of(nps, denied, (first.place,) if first.place else first.word)
    if condition is None:
        return None
    if isinstance(asked, Things):
        clauses = _another_way(before[0].clause, asked)[:1]
        if first.place or before[1:] or first.subjects[1:] or nps[1:] or not clauses:
            return None
        one = first.subjects[0].words
        again = (Spoken(clauses[0], before[0].position + 1),)
        asked = _put_elsewhere(
            again, _into(lambda np: np.words == one and not np.modifiers, nps[0])
        )
    condition = replace(condition, text=f"{text} {condition.word}".strip())
    return (*before, *_only_if(condition, _of_its_own(condition, asked)))


def as_things_are(sentence: Parser) -> Parser:
    """What is asked for only if things are so, and what otherwise.

    Args:
        sentence: what may be asked for.
    """
    sentence = either(sentence, plain(phrase(small_words.DO_NOTHING, NOTHING)))
    otherwise = sequence(
        OPTIONAL_COMMA,
        optional("and, but, or"),
        either(
            one_of(
                {
                    None: small_words.OTHERWISE,
                    False: small_words.IF_NOT,
                    True: small_words.IF_SO,
                    _THAT_CASE: small_words.IN_THAT_CASE,
                    **{there: small_words.IF_THERE[so] for there, so in _IS_THERE.items()},
                }
            ),
            sequence("if", NP_LIST, "is, are", NOW, OPEN_OR_CLOSED, NOW, build=lambda *said: said),
        ),
        OPTIONAL_COMMA,
        optional("then"),
        either(sentence, DESTINATIONS, THINGS),
        build=lambda said, instead: (said, instead),
    )
    behind = variants(
        sequence(
            sentence, OPTIONAL_COMMA, CONDITION, build=lambda said, condition: (said, condition)
        ),
        _of_what_was_named,
    )
    second_choice = variants(
        sequence(
            sentence,
            OPTIONAL_COMMA,
            "or, but",
            OPTIONAL_COMMA,
            CONDITION,
            COMMA,
            either(DESTINATIONS, THINGS),
            build=lambda said, condition, instead: (said, condition, instead),
        ),
        lambda found: [
            (reading, condition, found[2])
            for reading, condition in _of_what_was_named((found[0], found[1]))
        ],
    )
    leading = variants(
        sequence(
            EMPTY_WORDS,
            CONDITION,
            either(COMMA, sequence(OPTIONAL_COMMA, "then"), ahead(*_VERBS)),
            sentence,
            optional(otherwise, None),
            build=lambda condition, *said: (condition, _of_its_own(condition, said[0]), said[1]),
        ),
        lambda found: _or_else(*found),
    )
    as_long_as = sequence(
        EMPTY_WORDS, "(as|so) long as", IS_SO, COMMA, sentence, build=_done_meanwhile
    )
    also = spanned(
        sequence(
            "if",
            NP_LIST,
            "is, are",
            optional(phrase("not", True), False),
            COMMA,
            either(sentence, THINGS),
            build=lambda *said: said,
        ),
        lambda text, said: (text.removeprefix("if ").partition(",")[0], said),
    )
    return either(
        leading,
        as_long_as,
        variants(
            quiet(
                sequence(EMPTY_WORDS, ASKED, otherwise, optional(otherwise, None), build=_answered)
            ),
            lambda found: _or_else(*found),
        ),
        sequence(
            leading,
            OPTIONAL_COMMA,
            optional("and, but"),
            OPTIONAL_COMMA,
            also,
            build=lambda before, said: _likewise(before, *said),
        ),
        sequence(
            either(sentence, leading),
            OPTIONAL_COMMA,
            "and, but",
            OPTIONAL_COMMA,
            leading,
            build=_both_asked,
        ),
        variants(
            sequence(
                behind,
                optional(otherwise, None),
                build=lambda found, instead: (found[1], found[0], instead),
            ),
            lambda found: _or_else(*found),
        ),
        variants(
            second_choice,
            lambda found: _or_else(_otherwise(found[1]), found[0], (None, found[2])),
        ),
    )
