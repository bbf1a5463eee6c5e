"""Rules for what stands before, or comes with, what a sentence asks for."""

from __future__ import annotations

from itertools import chain
from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.conditions.falling import UNHARMED
from etot_cli.reasoning.language.grammar.conditions.if_so import IF_ANYTHING_IS_THERE
from etot_cli.reasoning.language.grammar.conditions.left_alone import OTHERS_STILL, UNTOUCHED
from etot_cli.reasoning.language.grammar.conditions.predicates import BOTH_ARE
from etot_cli.reasoning.language.grammar.conditions.prohibitions import AVOID, WITHOUT
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    located,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.phrases.states import STATE, states
from etot_cli.reasoning.language.grammar.phrases.staying import WITH_KEPT_SO
from etot_cli.reasoning.language.grammar.requests.arrangements import STANDS_UP
from etot_cli.reasoning.language.grammar.requests.emptying import EMPTY, IS_EMPTY, NOTHING_THERE
from etot_cli.reasoning.language.grammar.requests.moves import IF_NOT_SO
from etot_cli.reasoning.language.grammar.requests.put_groups import PAIRS
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.requests.reaching import SEPARATING
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.requests.unstacking import UNSTACK
from etot_cli.reasoning.language.grammar.sentences.afterthoughts import TOLD_BEHIND
from etot_cli.reasoning.language.grammar.sentences.ahead import not_so
from etot_cli.reasoning.language.grammar.sentences.announced import (
    ONE_FOR_EACH,
    all_put,
    each_sorted,
    in_detail,
    one_for_each,
    parted,
    shared_out,
)
from etot_cli.reasoning.language.grammar.sentences.chains import (
    BARE_CHAIN,
    CHAIN,
    WITH_MORE_SO,
    Joined,
    chained,
    joint,
)
from etot_cli.reasoning.language.grammar.sentences.clauses import (
    Reading,
    plain,
)
from etot_cli.reasoning.language.grammar.sentences.headlines import (
    HEADLINE,
    PLACED,
    taken_out,
)
from etot_cli.reasoning.language.grammar.sentences.inversions import INVERTED
from etot_cli.reasoning.language.grammar.sentences.meanwhile import MEANWHILE
from etot_cli.reasoning.language.grammar.sentences.past import (
    ALL_LATER,
    EARLIER,
    SO,
    done_later,
    once_done,
    out_of_the_way,
    same_receiver,
)
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.sentences.togetherness import PARTED
from etot_cli.reasoning.language.grammar.sentences.topics import (
    AS_IT_IS,
    AS_IT_STANDS,
    FREEING,
    MAKING_ROOM,
    NAMED,
    SEEING,
    about,
    any_of_them,
    done_there,
    fit_for,
    for_a_reason,
    one_of_them,
)
from etot_cli.reasoning.language.grammar.sentences.wishes import TOLD_APART
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    EnsureClause,
    MoveClause,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    SwapClause,
    Turns,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    FILLED,
    Destination,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import (
    fillers,
    frames,
    manner,
    places,
    predicates,
    small_words,
    verbs,
)
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, singular


def _started_with(first: NounPhrase, done: Reading) -> Reading | None:
    """What is done with several things, the first of which is told before."""
    clause = done[0].clause
    if not isinstance(clause, PutClause | MoveClause) or clause.turns != Turns():
        return None
    return (replace(done[0], clause=replace(clause, turns=Turns(first=(first,)))), *done[1:])


_TARGET = either(
    sequence("with, using, taking", noun_phrase, f"as [the|a|its|your] ({places.TARGET})"),
    sequence(f"the ({places.TARGET}) is", noun_phrase),
)


_DONE_BEFORE = optional(sequence(CHAIN, LIST), ())


def _to_the_target(np: NounPhrase, before: Reading, at: int, things: Things) -> Reading:
    """What is put down with no place said goes to the one that is named as the target."""
    return (*before, Spoken(put_to(things, (Destination(Toward.TO, (np,), FILLED),)), at))


def _placed_there(np: NounPhrase, things: Things) -> PutClause:
    """Where the robot goes to put something down is where that goes."""
    return put_to(things, (Destination(Toward.TO, (np,)),))


def _swapped(things: Things, rest: Reading) -> Reading | None:
    """Two things that swap places, as it is said again ("swap them, the cup on the tray, …")."""
    groups: list[PutGroup] = []
    for said in rest:
        match said.clause:
            case PutClause(groups=placed):
                groups += placed
            case EnsureClause(states=states):
                if not all(so.destinations and not (so.denied or so.kept) for so in states):
                    return None
                groups += (PutGroup(Things(so.subjects), so.destinations) for so in states)
            case _:
                return None
    swap = SwapClause(things, placed=PutClause(tuple(groups)))
    return (replace(rest[0], clause=swap),)


def _opened_for(seen: Reading, rest: Reading) -> Reading | None:
    """What somebody wants to look into is opened, and whatever is done besides."""
    first = rest[0].clause
    opens = isinstance(first, MoveClause) and first.opens
    return (*seen, *rest) if opens else None


def _taken_first(wanted: Reading) -> Reading | None:
    """What is wanted off something, and what goes where besides; "the pen from the cup" may go
    there, too.
    """
    first = wanted[0].clause
    if not isinstance(first, RemoveClause) or not wanted[1:]:
        return None
    away = first.source or {"off", "out"} & {*first.things.text.split()}
    return wanted if away else None


def _all_so(wanted: Reading) -> Reading | None:
    """How several things are to be, the first of which with something in it; alone, it may be
    wanted itself.
    """
    so = all(isinstance(said.clause, EnsureClause | AvoidClause | RemoveClause) for said in wanted)
    first = wanted[0].clause
    return wanted if so and wanted[1:] and isinstance(first, EnsureClause) else None


def _of_one_thing(denied: Reading) -> Reading | None:
    """What is not to be done with one thing while others go somewhere ("do not touch the cup: pen
    in the box"); of several things it may rather be told where they are.
    """
    clause = denied[0].clause
    nps = clause.things.phrases if isinstance(clause, AvoidClause) and clause.things else ()
    single = nps and all(np.words and singular(np.head) == np.head for np in nps)
    known = all(np.determiner in ("the", "") and np.head not in THING_NOUNS for np in nps)
    return denied if single and known else None


def _holding(content: NounPhrase, toward: Toward, rest: Reading) -> Reading | None:
    """What something is to hold that is told next to be somewhere, or is closed then ("with the pen
    in it, the mug should stand on the tray"); of what was spoken of before, "it" rather is that.
    """
    clause = rest[0].clause
    match clause:
        case EnsureClause(states=(State(subjects=(first, *more), destinations=(_, *_)), *_)):
            closed = False
        case (
            MoveClause(things=Things(phrases=(first, *more)), opens=False)
            | EnsureClause(states=(State(subjects=(first, *more), word="closed"),))
        ):
            closed = True
        case _:
            return None
    known = first.words and first.determiner in ("the", "") and not first.modifiers
    if more or not known or content.pronoun:
        return None
    held = EnsureClause((State((content,), (Destination(toward, (first,)),)),))
    if closed:
        return once_done((Spoken(held, rest[0].position, far_fetched=1),), rest)
    return (rest[0], Spoken(held, rest[0].position, far_fetched=1), *rest[1:])


def _turned_before(said: str, rest: Reading) -> Reading | None:
    """What has been turned by the time that it goes somewhere."""
    first = rest[0].clause
    if not isinstance(first, PutClause | EnsureClause) or "it" in said.split():
        return None
    turned = ReorientClause(Things((NounPhrase(pronoun="it", text="it"),)), meanwhile=True)
    return (rest[0], Spoken(turned, rest[0].position), *rest[1:])


_SO_OR_EMPTY = plain(
    either(sequence(STATE, build=lambda state: EnsureClause((state,))), IS_EMPTY, NOTHING_THERE)
)
IN_THE_END = either(_SO_OR_EMPTY, plain(either(BOTH_ARE, TOLD_APART)), HEADLINE)
"""How things are, where it is said that they are to be so in the end."""


def _made_so(first: Reading, more: Joined) -> Reading | None:
    """How things are to be, some of them empty; else it is one clause."""
    done = chained(first, more)
    so = done and all(isinstance(said.clause, EnsureClause) for said in done)
    return None if so else done


_AND = either(COMMA, "and, and then, then")

_SO_BY_THEN = plain(
    either(
        SO,
        sequence(ALL_THINGS, build=taken_out),
        sequence(
            ALL_THINGS,
            optional(f"{predicates.BE}, out of the way, staying, safely, {predicates.DONE}"),
            DESTINATIONS,
            build=put_to,
        ),
        sequence(ALL_THINGS, predicates.TAKEN_AWAY, optional(SOURCE, None), build=RemoveClause),
        sequence(
            ALL_THINGS,
            "[safely] [moved|put] (out of the way|aside)",
            build=lambda things: RemoveClause(things, by_then=True, aside=True),
        ),
        STANDS_UP,
        UNTOUCHED,
    )
)
"""How things are by then, behind "with" ("with the drawer open, …")."""


def _about_at_first(order: Order, topic: Reading, rest: Reading) -> Reading | None:
    """What is named before a clause speaks of it, which is done first where that is said."""
    (said, *more) = rest
    timed = rest if order is Order.SAID else (replace(said, order=order), *more)
    return about(topic, timed)


WITH_MORE_BEFORE_IT = either(
    sequence(small_words.LOOK_FOR, NAMED, _AND, CHAIN, build=done_there),
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
    sequence(
        # "Here is how the shelf should look: books on the upper board, …"
        either(
            sequence("(here|this|that) is how", NAMED, "(should|must|has to|is to) (look|be)"),
            sequence(NAMED, "(should|must|has to) (look|be) like this"),
            sequence(frames.LIKE_THIS, NAMED, "like this, as follows, this way"),
        ),
        COMMA,
        either(CHAIN, PLACED),
        build=add,
    ),
    sequence(
        # "Set up the shelf so that the cans are on the upper board"
        verbs.ARRANGE,
        NAMED,
        small_words.SO_THAT,
        plain(sequence(states, build=EnsureClause)),
        build=add,
    ),
    sequence(NAMED, COLON, BARE_CHAIN, build=about),
    sequence(
        # "I want the cup off the tray and the plate there instead"
        predicates.WANTED,
        sequence(BARE_CHAIN, build=_taken_first),
    ),
    sequence(
        # "I want the box with the pen in it and the tray empty"
        predicates.WANTED,
        sequence(BARE_CHAIN, build=_all_so),
    ),
    sequence(plain(either(PUT, ENSURE)), COLON, PLACED, build=in_detail),
    sequence(plain(PARTED), COMMA, either(BARE_CHAIN, CHAIN), build=parted),
    sequence(ONE_FOR_EACH, COLON, BARE_CHAIN, build=one_for_each),
    sequence(plain(either(EMPTY, UNSTACK)), COLON, BARE_CHAIN, build=add),
    sequence(sequence(plain(AVOID), build=_of_one_thing), COLON, BARE_CHAIN, build=add),
    sequence(NAMED, COMMA, BARE_CHAIN, build=each_sorted),
    sequence(
        noun_phrase,
        fillers.ANY_WILL_DO,
        either(COMMA, "so, ~comma so"),
        CHAIN,
        build=any_of_them,
    ),
    sequence(
        noun_phrase,
        f"({fillers.ANY_WILL_DO}) for",
        noun_phrase,
        either(COMMA, "so, ~comma so"),
        CHAIN,
        build=fit_for,
    ),
    sequence(AS_IT_IS, "[~comma] [and] so, ~comma [and] so, ~comma [and]", CHAIN, build=add),
    sequence(AS_IT_STANDS, "[~comma] [and] so", CHAIN, build=add),
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
    sequence(
        either(
            sequence(f"{verbs.SET_DOWN}, {verbs.FETCH}", ALL_THINGS),
            sequence(ALL_THINGS, predicates.MODAL),
            sequence(verbs.ENSURE, ALL_THINGS, predicates.BE),
        ),
        places.NOT_IN_THE_WAY,
        _AND,
        CHAIN,
        build=out_of_the_way,
    ),
    TOLD_BEHIND,
    sequence(TOLD_BEHIND, "~comma [so|and|then]", CHAIN, build=add),
    sequence(plain(either(MAKING_ROOM, FREEING, SEPARATING)), "by, ~colon", CHAIN, build=add),
    sequence(plain(SEEING), "[~comma] by, ~comma, ~colon", CHAIN, build=_opened_for),
    sequence(CHAIN, "to, in order to, so as to", plain(MAKING_ROOM), build=add),
    sequence("put[ting], stow[ing]", NAMED, "away", COMMA, PLACED, build=add),
    sequence("put[ting] away, stow[ing] [away]", NAMED, COMMA, CHAIN, build=each_sorted),
    sequence(verbs.STACK, NAMED, COMMA, PLACED, build=each_sorted),
    sequence("[let us] (start|begin) with", NAMED, _AND, CHAIN, build=about),
    sequence(
        # "Use the box as a base: the cup goes on it"
        verbs.USE,
        NAMED,
        places.AS_A_BASE,
        "~comma, ~colon, [~comma] and",
        CHAIN,
        build=for_a_reason,
    ),
    sequence(f"{verbs.THROW_AWAY}, get[ting] rid of", NAMED, COMMA, PLACED, build=for_a_reason),
    sequence(
        verbs.TIDY,
        NAMED,
        optional("by (color|colour|kind|type|size)"),
        COMMA,
        either(BARE_CHAIN, CHAIN),
        build=each_sorted,
    ),
    sequence(
        "mov(e|ing), get[ting], put[ting], tak(e|ing), bring[ing]",
        NAMED,
        "(out of the way|closer) by",
        CHAIN,
        build=about,
    ),
    sequence(
        verbs.SWAP,
        THINGS,
        silent(optional(verbs.SWAPPED_ROUND)),
        either(COMMA, sequence(OPTIONAL_COMMA, small_words.SO_THAT)),
        sequence(
            either(IN_THE_END, plain(either(PUT, ENSURE))),
            some(joint("and", LIST, IN_THE_END), most=2),
            build=chained,
        ),
        build=_swapped,
    ),
    sequence(verbs.TIDY_AWAY, COMMA, plain(PAIRS)),
    sequence(
        "tak(e|ing), get[ting], grab[bing], pick[ing] up",
        NAMED,
        either(sequence(COMMA, PLACED), sequence("and, and then, ~comma and", CHAIN)),
        build=shared_out,
    ),
    sequence(
        f"{verbs.TIDY_AWAY}, put[ting] away, stow[ing] [away]",
        NAMED,
        "[away|up] (~comma|and)",
        CHAIN,
        build=all_put,
    ),
    sequence(
        f"{frames.TASK}, {small_words.END_STATE}",
        IN_THE_END,
        some(either(joint("and", LIST, IN_THE_END), WITH_MORE_SO), most=6),
        build=chained,
    ),
    sequence(
        # "Make sure that the box holds the pen and that nothing is on the tray"
        verbs.ENSURE,
        _SO_OR_EMPTY,
        some(
            joint("and", LIST, optional("that"), either(_SO_OR_EMPTY, plain(UNHARMED))),
            least=1,
            most=5,
        ),
        build=_made_so,
    ),
    sequence(
        plain(either(IF_NOT_SO, IF_ANYTHING_IS_THERE)),
        optional(sequence(OPTIONAL_COMMA, "and, but", plain(OTHERS_STILL)), ()),
        build=add,
    ),
    sequence(
        "if you (could|would)", CHAIN, COMMA, f"[then] ({frames.WOULD_BE_NICE}), that would do"
    ),
    sequence(
        # "With the drawer kept shut, …"
        plain(WITH_KEPT_SO),
        COMMA,
        CHAIN,
        build=add,
    ),
    sequence(
        "with",
        _SO_BY_THEN,
        some(sequence(LIST, optional("with"), _SO_BY_THEN), most=3),
        COMMA,
        CHAIN,
        build=lambda first, more, rest: once_done((*first, *chain(*more)), rest),
    ),
    sequence(
        "with",
        noun_phrase,
        one_of(
            {
                Toward.INSIDE: "[already|safely] (in|inside) it, [safely] inside",
                Toward.ON: "[already|safely] on [top of] it, on top",
            }
        ),
        COMMA,
        CHAIN,
        build=_holding,
    ),
    not_so(CHAIN),
    MEANWHILE,
    sequence(
        # "Once turned, the pen goes in the mug": "it" is what comes next
        phrase(manner.TURNED_AS_NEEDED),
        OPTIONAL_COMMA,
        CHAIN,
        build=_turned_before,
    ),
    sequence(plain(WITHOUT), OPTIONAL_COMMA, CHAIN, build=add),
    sequence(manner.STARTING_WITH, noun_phrase, COMMA, CHAIN, build=_started_with),
    sequence(
        # "With the cup as the target, pick up the ball and place it"
        _TARGET,
        either(COMMA, COLON),
        _DONE_BEFORE,
        located(sequence(verbs.SET_DOWN, THINGS), lambda at, things: (at, things)),
        build=lambda np, before, put: _to_the_target(np, before, *put),
    ),
    sequence(
        _DONE_BEFORE,
        located(sequence(verbs.SET_DOWN, THINGS), lambda at, things: (at, things)),
        OPTIONAL_COMMA,
        _TARGET,
        build=lambda before, put, np: _to_the_target(np, before, *put),
    ),
    sequence(
        EARLIER,
        OPTIONAL_COMMA,
        optional("[and] only then, [and] not before [then|that], [and] (no|not) (sooner|earlier)"),
        OPTIONAL_COMMA,
        either(CHAIN, INVERTED),
        build=lambda earlier, rest: once_done(earlier, same_receiver(earlier, rest)),
    ),
    sequence(
        ALL_LATER,
        OPTIONAL_COMMA,
        not_ahead("and", "then"),
        CHAIN,
        build=lambda later, rest: done_later(later, same_receiver(later, rest)),
    ),
)
