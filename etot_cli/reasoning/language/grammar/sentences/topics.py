"""Rules for what is named before a clause speaks of it, and for what is only said of it."""

from __future__ import annotations

from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.asides.asides import ASIDE
from etot_cli.reasoning.language.grammar.conditions.occupied import ALREADY
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    quiet,
    sequence,
    silent,
    spanned,
)
from etot_cli.reasoning.language.grammar.parsers.common import WORDS, noun_phrase
from etot_cli.reasoning.language.grammar.parsers.trees import nodes, pronouns
from etot_cli.reasoning.language.grammar.phrases.descriptions import ADJECTIVES, DESCRIBED
from etot_cli.reasoning.language.grammar.phrases.levels import THAT
from etot_cli.reasoning.language.grammar.phrases.modifiers import MODIFIERS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.sentences.clauses import Reading, plain
from etot_cli.reasoning.language.grammar.sentences.hindrances import HINDRANCE, UNFIT
from etot_cli.reasoning.language.grammar.sentences.spoken import Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    MoveClause,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import fillers, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import (
    JOINT_NOUNS,
    is_descriptive,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep


def _topic(things: Things) -> ReorientClause | None:
    """What is named, be it with "or"; "milk out of the fridge" rather says what is to be done."""
    named = replace(things, either=False)
    return None if sources(things) else ReorientClause(named, only_named=True)


def sources(things: Things) -> list[Modifier]:
    """What says of a thing where it is taken from."""
    return [m for np in things.phrases for m in np.modifiers[-1:] if m.prep is Prep.FROM]


def _identified(
    np: NounPhrase, words: tuple[str, ...], modifiers: tuple[Modifier, ...]
) -> Things | None:
    """What is told from others of its sort by what it is ("my mug is the left one")."""
    if not np.words or not (words or modifiers):
        return None
    return Things((replace(np.told_by(*modifiers), words=(*np.words[:-1], *words, np.head)),))


def _all_of_any(np: NounPhrase) -> Things | None:
    """All of which any will do."""
    any_one = np.determiner.split()[:1] in (["any"], ["either"]) and np.words
    return Things((np.called(f"{singular(np.head)}s"),)) if any_one else None


def _remark(said: str, things: Things) -> ReorientClause | None:
    """What is said of things and asked of none; "any cup is fine" leaves a choice open, and what is
    "already used" is a vessel that something is in.
    """
    open_choice = any(np.determiner in ("any", "either") for np in things.phrases)
    return (
        None
        if open_choice or said.endswith(" already used")
        else ReorientClause(things, only_named=True, remark=said)
    )


def _the_some(things: Things) -> Things:
    """In "there is some cheese in the fridge" it is the cheese there."""
    phrases = (replace(np, determiner="the") if np.determiner == "some" and np.modifiers else np
               for np in things.phrases)  # fmt: skip
    return replace(things, phrases=tuple(phrases))


_STATED = either(
    sequence(
        optional("(i|we) (noticed|notice|see|saw|think|believe|guess|know) [that]"),
        noun_phrase,
        fillers.FOUND,
        DESCRIBED,
        silent(optional(f"{fillers.SO_LONG}, {fillers.BY_NOW}")),
        build=lambda np, said: Things((np.told_by(said),)),
    ),
    sequence(
        noun_phrase,
        fillers.FELL,
        one_of({Prep.IN: "in, into, inside", Prep.ON: "on, onto"}),
        noun_phrase,
        build=lambda np, prep, at: Things((np.told_by(Modifier(prep, (at,))),)),
    ),
    sequence(
        # "My mug is the one on the tray", "the left one"
        noun_phrase,
        "is the, are the, 's the",
        optional(ADJECTIVES, ()),
        "one, ones",
        MODIFIERS,
        build=_identified,
    ),
    sequence(
        fillers.SOMEBODY_LEFT,
        noun_phrase,
        optional(DESCRIBED, None),
        build=lambda np, said: (
            Things((np.told_by(*([said] if said else [])),)) if said or np.modifiers else None
        ),
    ),
    sequence(
        noun_phrase,
        fillers.ANY_WILL_DO,
        build=_all_of_any,
    ),
    sequence(
        f"there is, there are, (i|you|we) [can] see, you have, {predicates.OTHERS_WANT}",
        ALL_THINGS,
        build=_the_some,
    ),
)
"""How things are, said of them before something is asked of them."""


def _meant_for(things: Things, words: tuple[str, ...]) -> Things | None:
    """A vessel and things that it is for, of which some may be spoken of next."""
    several = singular(words[-1]) != words[-1]
    return Things((*things.phrases, NounPhrase("the", words))) if several else None


_REMARK = either(
    sequence(ALL_THINGS, "(is|are|stands|lies) [right] in the way of", silent(noun_phrase)),
    sequence(ALL_THINGS, "is for, are for", WORDS, build=_meant_for),
    sequence(ALL_THINGS, either(fillers.REMARKS, sequence("is for, are for", silent(WORDS)))),
    sequence(fillers.DONE_WITH, ALL_THINGS, silent(optional(small_words.ANY_MORE))),
    sequence("(i|we) do not need", ALL_THINGS, small_words.ANY_MORE),
    sequence(
        "(i|we) (need|want|have) to (get (at|into|inside|in)|reach [into]), let me get (at|into)",
        ALL_THINGS,
    ),
    sequence("(i|we) do not want", ALL_THINGS, "(rolling|lying|standing|sitting) (around|about)"),
)
MAKING_ROOM = spanned(
    sequence(verbs.MAKE_ROOM, ALL_THINGS, silent(optional(sequence("in, on", noun_phrase)))),
    lambda said, things: ReorientClause(things, only_named=True, remark=said),
)
"""What something else is done for."""


def _freed(said: str, things: Things) -> ReorientClause | None:
    """A drawer or door that is freed by what is done next; a tray is rather cleared."""
    joints = sum(JOINT_NOUNS.values(), ())
    moving = all(np.words and matches_any(np.head, joints) for np in things.phrases)
    return ReorientClause(things, only_named=True, remark=said) if moving else None


FREEING = spanned(
    sequence("free[ing] [up], unblock[ing], clear[ing] the way to", ALL_THINGS), _freed
)


SEEING = spanned(
    sequence(
        "let (me|us) (see|check|look at) what is (in|inside),"
        "let (me|us) [have|take] [a] (look|peek|peep) (in|inside|into),"
        "show (me|us) (what is (in|inside)|the (inside|contents) of)",
        ALL_THINGS,
    ),
    lambda said, things: ReorientClause(things, only_named=True, remark=said),
)
"""What somebody wants to see, which what is asked for next lets him."""


def _stands_there(np: NounPhrase, said: Modifier) -> ReorientClause | None:
    """What is in or on something; "the vase is off limits" is no such thing."""
    there = said.prep in (Prep.IN, Prep.ON) and not said.denied
    return ReorientClause(Things((np.told_by(said),)), only_named=True) if there else None


AS_IT_IS = plain(
    either(
        sequence(either(ALREADY, HINDRANCE), build=partial(ReorientClause, only_named=True)),
        spanned(UNFIT, _remark),
    )
)
"""How things are by now, before what is asked for in that case."""
AS_IT_STANDS = plain(
    quiet(
        sequence(
            noun_phrase,
            f"{predicates.BE}, {predicates.LIES}",
            DESCRIBED,
            build=_stands_there,
        )
    )
)
"""The same without a word for it, before "so"."""
SAID = either(
    sequence(either(_STATED, ALREADY, HINDRANCE), build=partial(ReorientClause, only_named=True)),
    spanned(either(_REMARK, UNFIT), _remark),
    sequence(ALL_THINGS, ASIDE, build=partial(ReorientClause, only_named=True, remark=ASIDE)),
)


NAMED = plain(either(sequence(THINGS, build=_topic), SAID))


def about(topic: Reading, rest: Reading) -> Reading | None:
    """What is named before a clause speaks of it ("the red mug: put it on the plate")."""
    remark = isinstance(topic[0].clause, ReorientClause) and topic[0].clause.remark
    therein = any(item is Toward.HERE for item in nodes(rest[0].clause))
    spoken = (
        remark
        or therein
        or any(
            isinstance(np, NounPhrase) and np.pronoun and np != THAT for np in nodes(rest[0].clause)
        )
    )
    return (*topic, *rest) if spoken else one_of_them(topic, rest)


def done_there(topic: Reading, rest: Reading) -> Reading | None:
    """What is taken out of, or opened of, what the robot goes to ("go to the fridge, take out the
    cup").
    """
    named, clause = topic[0].clause, rest[0].clause
    place, *more = named.things.phrases if isinstance(named, ReorientClause) else ()
    match clause:
        case RemoveClause(source=None) if not (more or sources(clause.things)):
            there: Clause = replace(clause, source=place)
        case MoveClause(things=Things(phrases=(part,))) if not (more or part.owner):
            if not (part.words and matches_any(part.head, sum(JOINT_NOUNS.values(), ()))):
                return None
            there = replace(clause, things=Things((replace(part, owner=place),)))
        case _:
            return None
    return (*topic, replace(rest[0], clause=there), *rest[1:])


def for_a_reason(topic: Reading, rest: Reading) -> Reading | None:
    """What is done with one thing for what is said of it, in whatever words."""
    return (*topic, *rest) if {"it", "that", "them"} & {*pronouns(rest[0].clause)} else None


def one_of_them(topic: Reading, rest: Reading) -> Reading | None:
    """Several things are named before a clause speaks of some of them ("of the cups take the left
    one", "… put one on the tray and the other in the sink").
    """
    nps = [item for item in nodes(rest[0].clause) if isinstance(item, NounPhrase)]
    some = are_several(topic[0].clause) and any(map(_is_one_of_them, nps))
    return (*topic, *rest) if some else None


def _is_one_of_them(np: NounPhrase) -> bool:
    """Whether a phrase takes up a noun that was said before, or speaks of another one."""
    adjectives = np.words and all(map(is_descriptive, np.words))
    if np.determiner in ("the", "only the") and adjectives:
        return True
    noun_left_out = np.is_elliptic or not (np.words or np.pronoun)
    return noun_left_out or "other" in np.determiner.split()


def are_several(topic: Clause) -> bool:
    """Whether several things are named."""
    nps = topic.things.phrases if isinstance(topic, ReorientClause) else ()
    return len(nps) > 1 or any(singular(np.head) != np.head for np in nps)


def any_of_them(topic: NounPhrase, rest: Reading) -> Reading | None:
    """Any of some things will do for what is to be done with "it"."""
    put = Spoken(ReorientClause(Things((topic,)), only_named=True), -1)
    return (put, *rest) if _all_of_any(topic) and "it" in pronouns(rest[0].clause) else None


_SUCH_A_ONE = (NounPhrase("one", text="one"), NounPhrase("", ("one",), text="one"))


def fit_for(place: NounPhrase, theme: NounPhrase, rest: Reading) -> Reading | None:
    """What is fine for something that is put there ("any cup is fine for the pen, so put it in
    one").
    """
    match rest[0].clause:
        case PutClause(
            groups=(
                PutGroup(
                    things=Things(phrases=(NounPhrase(pronoun="it" | "them"),)),
                    destinations=(Destination(beside=()) as where,),
                ),
            ),
            stays=False,
        ) if all(np.pronoun or np in _SUCH_A_ONE for np in where.targets):
            toward = Toward.TO if where.toward is Toward.HERE else where.toward
            put = put_to(Things((theme,)), (Destination(toward, (place,)),))
            return (replace(rest[0], clause=put), *rest[1:])
    return None
