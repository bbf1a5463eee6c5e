"""Rules for what is announced of several things before it is said where each of them goes."""

from __future__ import annotations

from collections.abc import Callable
from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import COLON, COMMA, WORDS
from etot_cli.reasoning.language.grammar.phrases.gapping import beside_what, told_beside
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.sentences.chains import BARE_CHAIN, CHAIN
from etot_cli.reasoning.language.grammar.sentences.headlines import PLACED
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.sentences.togetherness import PARTED
from etot_cli.reasoning.language.grammar.sentences.topics import NAMED, are_several
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    EnsureClause,
    PutClause,
    PutGroup,
    ReorientClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Things,
)
from etot_cli.reasoning.language.words import predicates, verbs
from etot_cli.reasoning.language.words.categories import members_of
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    LEVELS,
    MATERIALS,
    is_descriptive,
    singular,
)
from etot_cli.world.spatial import Nearby


def _named_in(rest: Reading) -> list[NounPhrase] | None:
    """What is put somewhere, or said to be somewhere; None where something else is asked for."""
    match rest[0].clause:
        case PutClause(groups=groups):
            return [np for group in groups for np in group.things.phrases]
        case EnsureClause(states=states):
            return [np for state in states for np in state.subjects]
        case _:
            return None


def _by_material(rest: Reading) -> Reading:
    """With a noun for what is told by its material alone ("sort the cups: glass on the tray")."""

    def named(np: NounPhrase) -> NounPhrase:
        bare = not np.determiner and not np.modifiers and len(np.words) == 1
        return replace(np, words=(*np.words, "ones")) if bare and np.head in MATERIALS else np

    return _with_things(named, rest)


_ALL_ELSE = frozenset({"everything else", "all else", "anything else", "the rest", "all the rest"})
_REST_OF_THEM = "all other"


def _rest_of(topic: Reading, rest: Reading) -> Reading:
    """With "everything else" as what else there is of the only sort of things that was announced,
    not of all that stands about ("sort the fruit: …, everything else goes into the basket").
    """
    announced = topic[0].clause
    if not isinstance(announced, ReorientClause) or len(announced.things.phrases) != 1:
        return rest
    (whole,) = announced.things.phrases
    if not whole.words or announced.things.are_any:
        return rest

    def limited(np: NounPhrase) -> NounPhrase:
        if np.text not in _ALL_ELSE or np.modifiers:
            return np
        return replace(whole, determiner=_REST_OF_THEM, text=np.text)

    return _with_things(limited, rest)


def _with_things(change: Callable[[NounPhrase], NounPhrase], rest: Reading) -> Reading:
    """The same with other phrases for what is put somewhere, or said to be somewhere."""

    def told(said: Spoken) -> Spoken:
        match said.clause:
            case PutClause(groups=groups) as put:
                less = tuple(replace(group, things=_each(change, group.things)) for group in groups)
                return replace(said, clause=replace(put, groups=less))
            case EnsureClause(states=states) as ensured:
                so = tuple(replace(s, subjects=tuple(map(change, s.subjects))) for s in states)
                return replace(said, clause=replace(ensured, states=so))
            case _:
                return said

    return tuple(map(told, rest))


def _each(change: Callable[[NounPhrase], NounPhrase], things: Things) -> Things:
    return replace(things, phrases=tuple(map(change, things.phrases)))


def _each_sorted(topic: Reading, rest: Reading) -> Reading | None:
    """Where each of several things goes ("sort the cars: the red one into the bin, …")."""
    rest = _by_material(_rest_of(topic, rest))
    named = _named_in(rest)
    everything = [np for said in rest for np in _named_in((said,)) or () if np.text in _ALL_ELSE]
    swept = any(np.determiner != _REST_OF_THEM and " else" in np.text for np in everything)
    if named is None or swept:
        return None  # "everything else" would be more than these
    topics = topic[0].clause.things.phrases if isinstance(topic[0].clause, ReorientClause) else ()
    bare = [not np.determiner and all(map(is_descriptive, np.words or (".",))) for np in named]
    of_them = any(
        np.head == "ones" or adjectives for np, adjectives in zip(named, bare, strict=True)
    )
    if len({np.head for np in topics}) > 1 and of_them:
        return None  # of the cups and the plates "the red ones" would be plates alone
    alone = ({"one", "other", "others", "rest"} & {*np.text.split()[-1:]} for np in named)
    sorts = frozenset[str]().union(*(members_of(np.head) for np in topics))
    told = all(
        np.is_elliptic or adjectives or last or singular(np.head) in sorts
        for np, adjectives, last in zip(named, bare, alone, strict=True)
    )
    return (*topic, *rest) if told else None


_SIDES = [Nearby.LEFT, Nearby.RIGHT]


def _sides(group: PutGroup) -> list[Nearby]:
    return [item.relation for where in group.destinations for item in where.beside]


def _in_detail(first: Reading, rest: Reading) -> Reading | None:
    """Where several things go, and behind a colon where each of them goes there."""
    (said, *others), (each, *more) = first, rest
    match said.clause:
        case PutClause(groups=(whole,)):
            pass
        case EnsureClause(states=(State(denied=False, kept=False, word="") as so,)):
            whole = PutGroup(Things(so.subjects), so.destinations)
        case _:
            return None
    if others or more or not isinstance(each.clause, PutClause) or not each.clause.groups[1:]:
        return None
    if _sides(whole) == _SIDES:
        # "On either side of the plate: the red one on the left, …"
        marks = beside_what(whole)
        groups = tuple(told_beside(group, marks) for group in each.clause.groups)
        named = Spoken(ReorientClause(whole.things, only_named=True), -1)
        told = sorted(side for group in groups for side in _sides(group)) == sorted(_SIDES)
        return (named, replace(each, clause=PutClause(groups))) if told else None
    return (replace(said, clause=PutClause((whole, *each.clause.groups))),)


def _shared_out(topic: Reading, rest: Reading) -> Reading | None:
    """Several things are taken, and each of them goes somewhere of its own."""
    return _each_sorted(topic, rest) if are_several(topic[0].clause) else None


def _parted(topic: Reading, rest: Reading) -> Reading | None:
    """Several things that are to be in different places, and then which of them goes where."""
    where: list[tuple[Destination, ...]] = []
    for said in rest:
        match said.clause:
            case PutClause(groups=groups):
                where += [group.destinations for group in groups]
            case EnsureClause(states=states):
                where += [so.destinations for so in states if so.destinations]
    apart = len(where) > 1 and len({*where}) == len(where)
    return _each_sorted(topic, rest) if apart else None


def _each_and_one(words: tuple[str, ...], places: tuple[str, ...]) -> Reading:
    """Each of several places, and things, which were spoken of last."""
    plural = (*words[:-1], f"{singular(words[-1])}s")
    topics = (NounPhrase("each", places), NounPhrase("the", plural))
    return tuple(Spoken(ReorientClause(Things((np,)), only_named=True), -1) for np in topics)


_ONE_FOR_EACH = either(
    sequence(
        silent(optional(f"{verbs.PUT}, {predicates.WANTED}, there should be")),
        "one, a, an",
        WORDS,
        "(in|into|on|onto|to|for) (each|every), per",
        WORDS,
        build=_each_and_one,
    ),
    sequence(
        "one",
        WORDS,
        "each for [the|my|both], for each of [the|my]",
        WORDS,
        build=lambda places, words: _each_and_one(words, places),
    ),
)
"""What each of several places gets, before it is said which ("one cup on each tray: …")."""


def _one_for_each(topics: Reading, rest: Reading) -> Reading | None:
    """One thing for each of several places, which may leave their noun out ("on the lower")."""
    announced, (said, *more) = topics[0].clause, rest
    put = said.clause
    if not isinstance(announced, ReorientClause) or not isinstance(put, PutClause) or more:
        return None
    (place,) = announced.things.phrases

    def named(np: NounPhrase) -> NounPhrase:
        bare = all(is_descriptive(word) or word in LEVELS for word in np.words)
        return replace(np, words=(*np.words, *place.words)) if bare else np

    groups = tuple(group.going_to(named) for group in put.groups)
    targets = [np for group in groups for w in group.destinations for np in w.targets]
    kinds = (*(BOARD_NOUNS if place.head in BOARD_NOUNS else (place.head,)), "one")
    each = len(groups) > 1 and all(len(group.things.phrases) == 1 for group in groups)
    if not each or any(np.head not in kinds for np in targets):
        return None
    return (*topics, replace(said, clause=replace(put, groups=groups)))


def _all_put(topic: Reading, rest: Reading) -> Reading | None:
    """Where all that is to be tidied up goes ("tidy up the cars and put them …")."""
    named = _named_in(rest)
    if named is None:
        return None
    spoken = all(np.pronoun in ("them", "they") or np.text.endswith(" of them") for np in named)
    return (*topic, *rest) if spoken else None


ANNOUNCED_PLACES = either(
    sequence(plain(either(PUT, ENSURE)), COLON, PLACED, build=_in_detail),
    sequence(plain(PARTED), COMMA, either(BARE_CHAIN, CHAIN), build=_parted),
    sequence(_ONE_FOR_EACH, COLON, BARE_CHAIN, build=_one_for_each),
    sequence(NAMED, COMMA, BARE_CHAIN, build=_each_sorted),
    sequence("put[ting], stow[ing]", NAMED, "away", COMMA, PLACED, build=add),
    sequence("put[ting] away, stow[ing] [away]", NAMED, COMMA, CHAIN, build=_each_sorted),
    sequence(verbs.STACK, NAMED, COMMA, PLACED, build=_each_sorted),
    sequence(
        verbs.TIDY,
        NAMED,
        optional("by (color|colour|kind|type|size)"),
        COMMA,
        either(BARE_CHAIN, CHAIN),
        build=_each_sorted,
    ),
    sequence(
        "tak(e|ing), get[ting], grab[bing], pick[ing] up",
        NAMED,
        either(sequence(COMMA, PLACED), sequence("and, and then, ~comma and", CHAIN)),
        build=_shared_out,
    ),
    sequence(
        f"{verbs.TIDY_AWAY}, put[ting] away, stow[ing] [away]",
        NAMED,
        "[away|up] (~comma|and)",
        CHAIN,
        build=_all_put,
    ),
)
