"""Rules for sentences: clauses, their order, and what joins them."""

from __future__ import annotations

from dataclasses import replace
from operator import add

from etot_cli.reasoning.language.grammar.chains import (
    CHAIN,
    JOINED,
    LEFT_SO,
    chained,
    joint,
    once_more,
    then_done,
)
from etot_cli.reasoning.language.grammar.clauses import (
    LEAD,
    LED_CLAUSE,
    LEFT_OUT,
    Reading,
    changed,
    of_the_things,
    plain,
)
from etot_cli.reasoning.language.grammar.common import (
    COMMA,
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
)
from etot_cli.reasoning.language.grammar.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.earlier import EARLIER, SO
from etot_cli.reasoning.language.grammar.input import Input
from etot_cli.reasoning.language.grammar.modifiers import CONTRASTED, noun_phrase
from etot_cli.reasoning.language.grammar.moves import IF_NOT_SO
from etot_cli.reasoning.language.grammar.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    NOTHING,
    complete,
    either,
    optional,
    sequence,
    silent,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.prohibitions import KEEP_STILL, OTHERS_STILL, WITHOUT
from etot_cli.reasoning.language.grammar.put_groups import PAIRS
from etot_cli.reasoning.language.grammar.putting import PUT, VERBLESS
from etot_cli.reasoning.language.grammar.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.states import (
    ENSURE,
    states,
)
from etot_cli.reasoning.language.grammar.syntax import (
    AgainClause,
    Destination,
    EnsureClause,
    Modifier,
    NounPhrase,
    PutClause,
    PutGroup,
    RemoveClause,
    SwapClause,
    Things,
    Toward,
    put_to,
)
from etot_cli.reasoning.language.grammar.text import QUESTION
from etot_cli.reasoning.language.grammar.topics import (
    AS_IT_IS,
    NAMED,
    SAID,
    about,
    all_put,
    each_sorted,
    for_a_reason,
    one_of_them,
    shared_out,
    sources,
)
from etot_cli.reasoning.language.words import small_words, verbs
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.patterns import words_of
from etot_cli.reasoning.language.words.places import Prep


def _verbless(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """A sentence without a verb; one that begins like a question is none."""
    clause = first[0].clause
    asks = isinstance(clause, PutClause) and clause.groups[0].things.phrases[0].text
    return None if str(asks).startswith("what") else chained(first, more)


def _first_placed(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """What comes first without a verb, and then more."""
    return _verbless(first, more) if any(said == "then" for said, _ in more) else None


_NOT_THIS = sequence(
    "instead of, rather than, not", noun_phrase, build=lambda np: Modifier(Prep.CONTRAST, (np,))
)


def _without(out: Modifier, rest: Reading) -> Reading | None:
    """A sentence that begins with what is left out; "it" behind that is what is not meant ("not the
    tray, the cup on it").
    """
    (first, *more) = out.phrases

    def told(np: NounPhrase) -> NounPhrase:
        upon = (
            replace(item, phrases=(first,)) if [n.pronoun for n in item.phrases] == ["it"] else item
            for item in np.modifiers
        )
        contrasted = out.prep is Prep.CONTRAST and not more
        return (replace(np, modifiers=tuple(upon)) if contrasted else np).told_by(out)

    clause = changed(rest[0].clause, told)
    return None if clause is None else (replace(rest[0], clause=clause), *rest[1:])


def _headline(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading | None:
    """Headlines have no articles; "the drawer shut" lacks a verb."""
    clause = first[0].clause
    bare = isinstance(clause, EnsureClause) and not clause.states[0].subjects[0].determiner
    return chained(first, more) if bare or (isinstance(clause, RemoveClause) and more) else None


def _taken_out(things: Things) -> RemoveClause | None:
    """What is taken from somewhere, without a verb."""
    all_of_them = len(sources(things)) == len(things.phrases)
    doing = VERB_WORDS | words_of((verbs.CLOSE,))  # "shut off the fridge"
    return RemoveClause(things) if all_of_them and things.phrases[0].head not in doing else None


_PLACED = plain(
    either(
        VERBLESS,
        sequence(VERBLESS, OPTIONAL_COMMA, either(CONTRASTED, LEFT_OUT), build=of_the_things),
        sequence(ALL_THINGS, build=_taken_out),
    )
)


def _placed_there(np: NounPhrase, things: Things) -> PutClause:
    """Where the robot goes to put something down is where that goes."""
    return put_to(things, (Destination(Toward.TO, (np,)),))


UNORDERED = sequence(LEAD, build=lambda orders: None if orders else NOTHING)
"""What stands before a sentence, without a word for order."""


def _swapped(things: Things, rest: Reading) -> Reading | None:
    """Two things that swap places, as it is said again ("swap them, the cup on the tray, …")."""
    match rest:
        case (Spoken(clause=PutClause() as clause) as said,):
            return (replace(said, clause=SwapClause(things, placed=clause)),)
        case (Spoken(clause=EnsureClause(states=said_so)) as said,):
            groups = tuple(PutGroup(Things(so.subjects), so.destinations) for so in said_so)
            known = all(so.destinations and not (so.denied or so.kept) for so in said_so)
            swap = SwapClause(things, placed=PutClause(groups))
            return (replace(said, clause=swap),) if known else None
    return None


_WITH_MORE_BEFORE_IT = either(
    sequence(
        optional(small_words.LOOK_FOR),
        NAMED,
        either(COMMA, "[~comma] and, and then, then, [~comma] so"),
        CHAIN,
        build=about,
    ),
    sequence(
        # "Here is how the shelf should look: books on the upper board, …"
        either(
            sequence("(here|this|that) is how", NAMED, "(should|must|has to|is to) (look|be)"),
            sequence(NAMED, "(should|must|has to) (look|be) like this"),
            sequence(small_words.LIKE_THIS, NAMED, "like this, as follows, this way"),
        ),
        COMMA,
        either(CHAIN, _PLACED),
        build=add,
    ),
    sequence(AS_IT_IS, "[~comma] [and] so, ~comma [and] so, ~comma and", CHAIN, build=add),
    sequence("of, among, from among, out of", NAMED, OPTIONAL_COMMA, CHAIN, build=one_of_them),
    plain(
        sequence(
            "(go|move|drive) [over] (to|towards)",
            noun_phrase,
            "and, and then, then, ~comma, ~comma then, ~comma and",
            f"{verbs.PLACE}, stor(e|ing), leav(e|ing)",
            ALL_THINGS,
            build=_placed_there,
        )
    ),
    sequence("put[ting], stow[ing]", NAMED, "away", COMMA, _PLACED, build=add),
    sequence("put[ting] away, stow[ing] [away]", NAMED, COMMA, CHAIN, build=each_sorted),
    sequence(
        "tak(e|ing), grab[bing], get[ting], pick[ing] up", NAMED, COMMA, _PLACED, build=each_sorted
    ),
    sequence("[let us] (start|begin) with", NAMED, COMMA, CHAIN, build=about),
    sequence(f"{verbs.THROW_AWAY}, get[ting] rid of", NAMED, COMMA, _PLACED, build=for_a_reason),
    sequence(verbs.TIDY, NAMED, COMMA, _PLACED, build=each_sorted),
    sequence(
        verbs.SWAP,
        THINGS,
        silent(optional("around, over")),
        COMMA,
        either(_PLACED, plain(either(PUT, ENSURE))),
        build=_swapped,
    ),
    sequence(verbs.TIDY_AWAY, COMMA, plain(PAIRS)),
    sequence(
        "tak(e|ing), get[ting], grab[bing], pick[ing] up",
        NAMED,
        "and, and then, ~comma and",
        CHAIN,
        build=shared_out,
    ),
    sequence(verbs.TIDY_AWAY, NAMED, "[away|up] (~comma|and)", CHAIN, build=all_put),
    sequence(
        f"{small_words.TASK}, {small_words.END_STATE}", plain(sequence(states, build=EnsureClause))
    ),
    sequence(
        plain(IF_NOT_SO),
        optional(sequence(OPTIONAL_COMMA, "and, but", plain(OTHERS_STILL)), ()),
        build=add,
    ),
    sequence(
        "with",
        plain(
            either(
                SO,
                sequence(ALL_THINGS, build=_taken_out),
                sequence(
                    ALL_THINGS, optional(f"{verbs.BE}, out of the way"), DESTINATIONS, build=put_to
                ),
            )
        ),
        COMMA,
        valued(CHAIN, then_done),
        build=add,
    ),
    sequence(LEFT_OUT, COMMA, CHAIN, build=_without),
    sequence(_NOT_THIS, OPTIONAL_COMMA, CHAIN, build=_without),
    sequence(plain(WITHOUT), OPTIONAL_COMMA, CHAIN, build=add),
    sequence(EARLIER, OPTIONAL_COMMA, valued(CHAIN, then_done), build=add),
    sequence(
        small_words.BEFORE,
        LED_CLAUSE,
        OPTIONAL_COMMA,
        CHAIN,
        build=lambda later, rest: rest + then_done(later),
    ),
)
SENTENCE = either(
    CHAIN,
    sequence(UNORDERED, _WITH_MORE_BEFORE_IT),
    plain(SAID),
    plain(
        sequence(
            # "Somewhere next to the plate will do"
            optional("somewhere, anywhere"),
            DESTINATIONS,
            "will do, is fine, would be fine, is ok, is okay, is good, works",
            build=lambda where: AgainClause(None, trailing=True, destinations=where),
        )
    ),
    sequence(
        f"{small_words.LEADING_THEN}, [and] now",
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        plain(sequence(THINGS, build=once_more), Order.THEN),
    ),
)
_END = sequence(OPTIONAL_COMMA, EMPTY_WORDS, OPTIONAL_COMMA)
WHOLE = either(
    sequence(SENTENCE, _END, optional(QUESTION)),
    sequence(
        EMPTY_WORDS,
        OPTIONAL_COMMA,
        optional(f"{small_words.TIDY_UP}, {small_words.TASK}"),
        optional(sequence(small_words.LEADING_THEN, OPTIONAL_COMMA)),
        _PLACED,
        some(JOINED, most=12),
        _END,
        build=_verbless,
    ),
    sequence(
        # "First the ball into the box, then the cup"
        EMPTY_WORDS,
        either(sequence("first, firstly", OPTIONAL_COMMA, _PLACED), sequence(_PLACED, "first")),
        some(JOINED, least=1, most=12),
        _END,
        build=_first_placed,
    ),
    sequence(
        # "The plate stays where it is, spoon to the right of it"
        EMPTY_WORDS,
        plain(either(KEEP_STILL, ENSURE)),
        some(JOINED, most=6),
        joint("and", LIST, _PLACED),
        some(JOINED, most=6),
        _END,
        build=lambda first, more, placed, rest: chained(first, (*more, placed, *rest)),
    ),
    sequence(
        EMPTY_WORDS,
        either(LEFT_SO, plain(sequence(ALL_THINGS, build=_taken_out))),
        some(either(JOINED, joint("and", LIST, _PLACED)), most=6),
        _END,
        build=_headline,
    ),
)


def readings(given: Input) -> list[Reading]:
    """All readings of a sentence, each as clauses in the order in which the sentence puts them."""
    return complete(WHOLE, given)
