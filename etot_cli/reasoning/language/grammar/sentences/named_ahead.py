"""Rules for requests about what is named before them, or done for what is told before them."""

from __future__ import annotations

from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.trees import nodes, pronouns
from etot_cli.reasoning.language.grammar.phrases.exclusions import changed
from etot_cli.reasoning.language.grammar.phrases.levels import THAT
from etot_cli.reasoning.language.grammar.requests.reaching import SEPARATING
from etot_cli.reasoning.language.grammar.sentences.chains import BARE_CHAIN, CHAIN
from etot_cli.reasoning.language.grammar.sentences.headlines import PLACED
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.sentences.topics import (
    AS_IT_IS,
    AS_IT_STANDS,
    FREEING,
    MAKING_ROOM,
    NAMED,
    SEEING,
    all_of_any,
    are_several,
    sources,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
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
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import fillers, places, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import (
    JOINT_NOUNS,
    OF_TWO,
    THING_NOUNS,
    is_descriptive,
    matches_any,
)
from etot_cli.reasoning.language.words.places import Prep

_FORMER = tuple((word,) for word in OF_TWO)
_LEAVING_OUT = (Prep.EXCEPT, Prep.CONTRAST)


def _opened_for(seen: Reading, rest: Reading) -> Reading | None:
    """What somebody wants to look into is opened, and whatever is done besides."""
    first = rest[0].clause
    opens = isinstance(first, MoveClause) and first.opens
    return (*seen, *rest) if opens else None


def _about_at_first(order: Order, topic: Reading, rest: Reading) -> Reading | None:
    """What is named before a clause speaks of it, which is done first where that is said."""
    (said, *more) = rest
    timed = rest if order is Order.SAID else (replace(said, order=order), *more)
    return _about(topic, timed)


def _about(topic: Reading, rest: Reading) -> Reading | None:
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
    return (*topic, *rest) if spoken else _one_of_them(topic, rest)


def _room_for(topic: Reading, rest: Reading) -> Reading | None:
    """What is put where room is made for it; without it nobody knows how much room that is."""
    where = [to for to in nodes(rest[0].clause) if isinstance(to, Destination)]
    there = any(to.toward is Toward.HERE or any(np.pronoun for np in to.targets) for to in where)
    return (*topic, *rest) if there else None


def _done_there(topic: Reading, rest: Reading) -> Reading | None:
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


def _for_a_reason(topic: Reading, rest: Reading) -> Reading | None:
    """What is done with one thing for what is said of it, in whatever words."""
    return (*topic, *rest) if {"it", "that", "them"} & {*pronouns(rest[0].clause)} else None


def _one_of_them(topic: Reading, rest: Reading) -> Reading | None:
    """Several things are named before a clause speaks of some of them ("of the cups take the left
    one", "… put one on the tray and the other in the sink").
    """
    # In "the cups and balls go there, except the red ones" these are some of the phrase's own.
    told = (item for item in nodes(rest[0].clause) if isinstance(item, Modifier))
    left_out = {np for item in told if item.prep in _LEAVING_OUT for np in item.phrases}
    nps = {item for item in nodes(rest[0].clause) if isinstance(item, NounPhrase)} - left_out
    some = are_several(topic[0].clause) and any(map(_is_one_of_them, nps))
    return (*topic, *rest) if some else None


def _is_one_of_them(np: NounPhrase) -> bool:
    """Whether a phrase takes up a noun that was said before, or speaks of another one."""
    adjectives = np.words and all(map(is_descriptive, np.words))
    if np.determiner in ("the", "only the") and (adjectives or np.words[:1] in _FORMER):
        return True
    noun_left_out = np.is_elliptic or not (np.words or np.pronoun)
    return noun_left_out or "other" in np.determiner.split()


def _named_among(whole: NounPhrase, rest: Reading) -> Reading | None:
    """What is one of the things somewhere ("of everything on the tray, only the cup …")."""

    def alone(np: NounPhrase) -> NounPhrase | None:
        known = np.determiner in ("the", "only the") and not (np.is_elliptic or np.modifiers)
        return whole.told_by(Modifier(Prep.EXCEPT, (np,), denied=True)) if known else None

    if not (whole.modifiers and matches_any(whole.head, THING_NOUNS)):
        return None
    match rest[0].clause:
        case PutClause(stays=False) | PickClause() | EnsureClause(states=(State(kept=False),)):
            clause = changed(rest[0].clause, alone)
            return None if clause is None else (replace(rest[0], clause=clause), *rest[1:])
    return None


def _any_of_them(topic: NounPhrase, rest: Reading) -> Reading | None:
    """Any of some things will do for what is to be done with "it"."""
    put = Spoken(ReorientClause(Things((topic,)), only_named=True), -1)
    return (put, *rest) if all_of_any(topic) and "it" in pronouns(rest[0].clause) else None


_SUCH_A_ONE = (NounPhrase("one", text="one"), NounPhrase("", ("one",), text="one"))


def _fit_for(place: NounPhrase, theme: NounPhrase, rest: Reading) -> Reading | None:
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


_AND = either(COMMA, "and, and then, then")
NAMED_AHEAD = either(
    sequence(small_words.LOOK_FOR, NAMED, _AND, CHAIN, build=_done_there),
    sequence(
        optional(
            either(phrase(small_words.LOOK_FOR, Order.SAID), phrase("first", Order.FIRST)),
            Order.SAID,
        ),
        NAMED,
        either(COMMA, "[~comma] and, and then, then, [~comma] so"),
        CHAIN,
        build=_about_at_first,
    ),
    sequence(NAMED, COLON, BARE_CHAIN, build=_about),
    sequence(
        noun_phrase,
        fillers.ANY_WILL_DO,
        either(COMMA, "so, ~comma so"),
        CHAIN,
        build=_any_of_them,
    ),
    sequence(
        noun_phrase,
        f"({fillers.ANY_WILL_DO}) for",
        noun_phrase,
        either(COMMA, "so, ~comma so"),
        CHAIN,
        build=_fit_for,
    ),
    sequence(AS_IT_IS, "[~comma] [and] so, ~comma [and] so, ~comma [and]", CHAIN, build=add),
    sequence(AS_IT_STANDS, "[~comma] [and] so", CHAIN, build=add),
    sequence("of, among, from among, out of", NAMED, OPTIONAL_COMMA, CHAIN, build=_one_of_them),
    sequence("of, among", noun_phrase, OPTIONAL_COMMA, CHAIN, build=_named_among),
    sequence(plain(either(MAKING_ROOM, FREEING, SEPARATING)), "by, ~colon", CHAIN, build=add),
    sequence(plain(SEEING), "[~comma] by, ~comma, ~colon", CHAIN, build=_opened_for),
    sequence(plain(MAKING_ROOM), _AND, CHAIN, build=_room_for),
    sequence(CHAIN, "to, in order to, so as to", plain(MAKING_ROOM), build=add),
    sequence("[let us] (start|begin) with", NAMED, _AND, CHAIN, build=_about),
    sequence(
        # "Use the box as a base: the cup goes on it"
        verbs.USE,
        NAMED,
        places.AS_A_BASE,
        "~comma, ~colon, [~comma] and",
        CHAIN,
        build=_for_a_reason,
    ),
    sequence(f"{verbs.THROW_AWAY}, get[ting] rid of", NAMED, COMMA, PLACED, build=_for_a_reason),
    sequence(
        "mov(e|ing), get[ting], put[ting], tak(e|ing), bring[ing]",
        NAMED,
        "(out of the way|closer) by",
        CHAIN,
        build=_about,
    ),
)
