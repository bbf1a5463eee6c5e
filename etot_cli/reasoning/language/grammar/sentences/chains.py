"""Rules for clauses one after the other, and what joins them."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import OF_SEVERAL
from etot_cli.reasoning.language.grammar.conditions.left_alone import UNTOUCHED
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Part,
    either,
    one_of,
    optional,
    phrase,
    remembered,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
    after,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED, SHUT, ensured
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import (
    NP_LIST,
    THINGS,
    begins_like_a_verb,
)
from etot_cli.reasoning.language.grammar.phrases.states import BESIDES_SO, holding_only, states
from etot_cli.reasoning.language.grammar.phrases.staying import MEANWHILE_SO, kept_so
from etot_cli.reasoning.language.grammar.requests.arrangements import (
    STANDING_BESIDES,
    STAYING_UPRIGHT,
)
from etot_cli.reasoning.language.grammar.requests.emptying import IS_EMPTY, is_emptying
from etot_cli.reasoning.language.grammar.requests.grasping import WITH_A_GRASP
from etot_cli.reasoning.language.grammar.requests.taking import DESKS
from etot_cli.reasoning.language.grammar.requests.word_order import PLACE_AHEAD
from etot_cli.reasoning.language.grammar.sentences.clauses import (
    LED_CLAUSE,
    NOT_OF_ONE,
    Reading,
    plain,
)
from etot_cli.reasoning.language.grammar.sentences.doubles import so_in_turn
from etot_cli.reasoning.language.grammar.sentences.headlines import (
    HEADLINE,
    LEFT_SO,
    PLACED,
    left_so,
    timed,
)
from etot_cli.reasoning.language.grammar.sentences.not_before import NOT_BEFORE
from etot_cli.reasoning.language.grammar.sentences.passives import (
    ALSO_DONE,
    BEFORE_PLACED,
    NARRATED,
    THEN_HELD,
    THEN_PLACED,
    THEN_TURNED,
    goes_on,
)
from etot_cli.reasoning.language.grammar.sentences.past import (
    ALL_LATER,
    EARLIER,
    EARLIER_ALONE,
    LATER,
    UNDER_WAY,
    ahead_of,
    done_later,
    once_done,
    then_done,
)
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.grammar.sentences.topics import sources
from etot_cli.reasoning.language.grammar.sentences.verbless import VERBLESS
from etot_cli.reasoning.language.grammar.sentences.which_clauses import (
    THAT,
    WHERE_MORE_GOES,
    WHICH_FIRST_GETS,
    WHICH_GOES_ON,
    WHICH_IN_TURN_IS,
    WHICH_IS_MOVED,
    held_by,
    named_last,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AgainClause,
    AvoidClause,
    Clause,
    EnsureClause,
    MoveClause,
    PickClause,
    PutClause,
    PutGroup,
    RemoveClause,
    TowerClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import predicates, small_words
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep

Joined = tuple[tuple[str, Reading], ...]
"""Readings with what joins them."""


def _onward(where: tuple[Destination, ...]) -> AgainClause | None:
    """What was put somewhere goes on to another place; "on top" says no such thing."""
    named = all(item.targets and not item.targets[0].pronoun for item in where)
    return AgainClause(None, destinations=where) if named else None


def once_more(things: Things) -> AgainClause | None:
    """Of which the same is asked for as before."""
    return None if begins_like_a_verb(things.phrases[0]) else AgainClause(things)


def _another(things: Things) -> AgainClause | None:
    """What comes second; "the apple on the plate" rather goes there."""
    placed = any(item.prep in (Prep.IN, Prep.ON) for np in things.phrases for item in np.modifiers)
    return None if placed else once_more(things)


def _also(things: Things) -> AgainClause:
    """Behind a place, which it may be one more of."""
    return AgainClause(things, trailing=True)


def joint(name: str, *parts: Part) -> Parser:
    """What goes on a sentence, with a name for what joins it."""
    return sequence(*parts, build=lambda reading: (name, reading))


def _begins_with_place(given: Input, at: int) -> list[Result]:
    """Whether a place comes first, as in "into the bin with it"."""
    return [(at, NOTHING)] if given.words[0] in ("into", "onto", "in", "on") else []


_SO = either(
    sequence(
        # "…, which should be closed afterwards", "…, whose door I want closed": what was named last
        THAT,
        "[then|itself] (should|must|has to|needs to|is to) [then|itself] be [left|kept],"
        " (i|we) (want|need|would like) [to (be|have)] [left|kept]",
        OPEN_OR_CLOSED,
        build=lambda which, word: left_so((which,), word),
    ),
    sequence(
        THAT,
        "[itself] ((should|must|has to|needs to|is to) (stay|remain)|stays|remains)",
        OPEN_OR_CLOSED,
        build=lambda which, word: kept_so((which,), word, always=False),
    ),
)
ENDING_WITH = "(end|ending|finish|finishing) [up] [~comma] with"
WITH_MORE_SO = either(
    joint(
        "and",
        OPTIONAL_COMMA,
        "with",
        plain(either(sequence(NP_LIST, SHUT, build=left_so), UNTOUCHED)),
    ),
    joint("and", LIST, ENDING_WITH, plain(sequence(NP_LIST, OPEN_OR_CLOSED, build=left_so))),
    joint("and", COMMA, optional("but"), plain(either(BESIDES_SO, STANDING_BESIDES))),
    joint("and", OPTIONAL_COMMA, plain(MEANWHILE_SO)),
    joint(
        # "I want the box empty and the tray holding the pen only"
        "and",
        LIST,
        plain(sequence(holding_only(predicates.HOLDING), build=ensured)),
    ),
)
"""How other things are to be besides ("…, with the door closed")."""
JOINED = either(
    joint("and", either(COMMA, LIST), LEFT_SO),
    joint("and", OPTIONAL_COMMA, plain(WITH_A_GRASP)),
    WITH_MORE_SO,
    joint("mere and", "and", LED_CLAUSE),
    joint("and", either(COMMA, small_words.JOINTS), LED_CLAUSE),
    joint("by", OPTIONAL_COMMA, "by", LED_CLAUSE),
    joint("purpose", small_words.PURPOSE, LED_CLAUSE),
    joint("then", OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA, LED_CLAUSE),
    joint("before", OPTIONAL_COMMA, LATER),
    joint(
        # "… and, before you close it, put the pen in"
        "then",
        OPTIONAL_COMMA,
        "and, then, and then, but",
        OPTIONAL_COMMA,
        sequence(ALL_LATER, OPTIONAL_COMMA, LED_CLAUSE, build=done_later),
    ),
    joint("and", either(COMMA, LIST, small_words.JOINTS), NOT_BEFORE),
    joint("after", EARLIER),
    joint("after", COMMA, EARLIER_ALONE),
    joint(
        # "… and once they are out, close it"
        "then",
        OPTIONAL_COMMA,
        "and",
        OPTIONAL_COMMA,
        sequence(EARLIER, OPTIONAL_COMMA, LED_CLAUSE, build=once_done),
    ),
    joint("and", OPTIONAL_COMMA, "and (also|likewise)", plain(sequence(THINGS, build=_also))),
    joint("and", OPTIONAL_COMMA, "and", OPTIONAL_COMMA, plain(PLACE_AHEAD)),
    # "Empty the box and the bag into the bin" empties both
    joint("emptied", COMMA, optional(small_words.AND), PLACED),
    joint("passive", timed(THEN_PLACED, THEN_TURNED, THEN_HELD, ALSO_DONE)),
    joint("passive, then", timed(BEFORE_PLACED)),
    joint(
        # "…, but first the cup on the tray", "…, but before that the cup"
        "and",
        OPTIONAL_COMMA,
        optional("and, but"),
        sequence(
            one_of(
                {
                    Order.FIRST: small_words.LEADING_FIRST,
                    Order.BEFORE_THAT: small_words.LEADING_BEFORE,
                    Order.LAST: small_words.LEADING_LAST,
                }
            ),
            OPTIONAL_COMMA,
            either(PLACED, plain(either(sequence(THINGS, build=once_more), NARRATED))),
            # "…, last, the cup in the box first" is two orders for one thing.
            build=lambda order, placed: (
                None
                if placed[0].order is not Order.SAID
                else (replace(placed[0], order=order, far_fetched=1),)
            ),
        ),
    ),
    joint(
        "so that", OPTIONAL_COMMA, small_words.SO_THAT, plain(sequence(states, build=EnsureClause))
    ),
    joint("and", OPTIONAL_COMMA, small_words.SO_THAT, plain(either(IS_EMPTY, STAYING_UPRIGHT))),
    joint("and", COMMA, timed(_SO)),
    joint("and", COMMA, WHICH_IS_MOVED),
    joint("which", COMMA, WHICH_GOES_ON),
    joint("which in turn", COMMA, WHICH_IN_TURN_IS),
    joint("and", COMMA, WHERE_MORE_GOES),
    joint("after", COMMA, WHICH_FIRST_GETS),
    joint("and", COMMA, so_in_turn(phrase("which", (NounPhrase(pronoun="it", text="which"),)))),
    joint("while", OPTIONAL_COMMA, small_words.WHILE, either(LED_CLAUSE, plain(UNDER_WAY))),
    joint(
        "then",
        OPTIONAL_COMMA,
        small_words.THEN_JOINTS,
        OPTIONAL_COMMA,
        EMPTY_WORDS,
        either(plain(either(sequence(THINGS, build=once_more), NARRATED)), HEADLINE),
    ),
    joint(
        # "Into the bin with the apple, then with the pear"
        "then",
        OPTIONAL_COMMA,
        f"{small_words.THEN_JOINTS}, and",
        Parser(_begins_with_place),
        "with",
        plain(sequence(THINGS, build=once_more)),
    ),
    joint(
        "then",
        OPTIONAL_COMMA,
        after("first", "firstly"),
        small_words.COUNTED_JOINTS,
        COMMA,
        either(LED_CLAUSE, plain(sequence(THINGS, build=once_more)), HEADLINE),
    ),
    joint(
        "counted",
        OPTIONAL_COMMA,
        after("first", "firstly"),
        small_words.COUNTED_JOINTS,
        NOT_OF_ONE,
        either(LED_CLAUSE, plain(sequence(THINGS, build=once_more)), HEADLINE),
    ),
    joint(
        "then",
        LIST,
        after("first"),
        either(plain(sequence(THINGS, build=_another)), plain(VERBLESS)),
        f"{small_words.COUNTED}, after [that|it|them], afterward, later",
    ),
    joint(
        "then",
        OPTIONAL_COMMA,
        small_words.ONWARD,
        plain(sequence(optional("back"), DESTINATIONS, build=_onward)),
    ),
)


_LATER = frozenset({"then", "counted", "passive, then", "which", "before"})


def _maybe_denied(done: Reading, clause: Reading) -> Reading:
    """In "do not touch the cup and open the drawer" the drawer may be denied, too; nobody wants it
    not to be kept closed.
    """
    before, after = done[-1].clause, clause[0].clause
    kept = isinstance(after, EnsureClause) and all(
        state.kept and state.word == "closed" for state in after.states
    )
    if not isinstance(before, AvoidClause) or not before.negated:
        return done
    if kept or isinstance(after, AvoidClause):
        return done
    return (*done[:-1], replace(done[-1], clause=replace(before, goes_on=True)))


def _also_left(before: Clause, clause: Reading) -> Reading:
    """In "the cup stays where it is, the pen too" the pen does, whatever was asked for before."""
    too = clause[0].clause
    if not (isinstance(before, AvoidClause) and isinstance(too, AgainClause) and too.things):
        return clause
    return (replace(clause[0], clause=replace(before, things=too.things)), *clause[1:])


def _is_told_of(before: Clause, joint: str, after: Clause) -> bool:
    """Whether a clause says of a stack, which one before it takes apart or turns over, what its own
    rules have to understand.
    """
    match before:
        case TowerClause(reverses=True):
            return joint == "so that"
        case RemoveClause(stacked=True):
            return any(np.determiner == "its" for np in nodes(after) if isinstance(np, NounPhrase))
    return False


def _is_denied(clause: Clause) -> bool:
    """Whether a clause says what is not to be done, or not to be so."""
    match clause:
        case AvoidClause():
            return clause.negated and not clause.needless
        case EnsureClause(states=states):
            return any(state.denied for state in states)
    return False


def _done_after(done: Reading, clause: Reading) -> Reading:
    """What was asked for, after something else. That comes before all of it, but for what speaks of
    what was done with the same things ("put the pen in and close it once the pen is in").
    """
    *before, last = done
    put = clause[0].clause
    same = isinstance(put, PutClause) and any(
        isinstance(said.clause, PutClause)
        and [np.words for np in said.clause.groups[0].things.phrases]
        == [np.words for np in put.groups[0].things.phrases]
        for said in before
    )
    if before and len(clause) == 1 and same:
        return (*before, *then_done(clause), *then_done((last,)))
    return once_done(clause, done)


def _brought_beside(before: Clause, clause: Clause) -> PutClause | None:
    """What is brought to a thing and then left beside "that" goes beside that thing at once."""
    match before, clause:
        case (
            PutClause(
                groups=(PutGroup(destinations=(Destination(toward=Toward.TO) as to,)) as put,)
            ),
            PutClause(
                groups=(PutGroup(destinations=(Destination(beside=(near,)) as there,)) as left,)
            ),
        ) if len(put.things.phrases) == len(to.targets) == 1 and not there.targets:
            (theme, *more), marks = left.things.phrases, near.phrases
            of_that = len(marks) == 1 and marks[0].text in ("it", "that") and not marks[0].modifiers
            if theme.text != "it" or more or not of_that:
                return None
            where = replace(there, beside=(replace(near, phrases=to.targets),))
            return replace(clause, groups=(replace(put, destinations=(where,)),), stays=False)
    return None


def _where_on_the_desk(before: Clause, clause: Clause) -> PutClause | None:
    """Where exactly on the desk stands what goes there ("take the cup to the desk and set it down
    next to the plate"), which is one place; what stands on a tray may be told to go beside it.
    """
    match before, clause:
        case (
            PutClause(groups=(PutGroup(destinations=(Destination(beside=()) as desk,)) as put,)),
            PutClause(groups=(PutGroup(destinations=(Destination(targets=()) as there,)) as left,)),
        ) if clause == PutClause((left,)) and there.toward is Toward.BESIDE:
            at = [np.words in DESKS and not np.modifiers for np in desk.targets]
            again = [np.text for np in left.things.phrases] in (["it"], ["them"])
            if at != [True] or desk.denied or not again:
                return None
            where = replace(desk, beside=there.beside, stance=there.stance or desk.stance)
            return replace(before, groups=(replace(put, destinations=(where,)),))
    return None


def _into_what_is_closed(before: Clause, clause: Clause) -> Clause:
    """Where something goes "in", if nothing was spoken of before: into what is closed then."""
    match before, clause:
        case (
            PutClause(
                groups=(PutGroup(destinations=(Destination(Toward.HERE, word="in") as at,)) as put,)
            ),
            MoveClause(things=Things(phrases=(np,), either=False), opens=False),
        ) if np.determiner in THE_WORDS and np.words:
            where = (replace(at, targets=(np,)),)
            return replace(before, groups=(replace(put, destinations=where),))
    return before


def chained(first: Reading, more: Joined) -> Reading | None:
    """Clauses in the order in which they are to be done, by what joins them."""
    done = first
    for said, clause in more:
        beside = _brought_beside(done[-1].clause, clause[0].clause)
        if beside is None and said.endswith("and") and clause[0].order is Order.SAID:
            beside = _where_on_the_desk(done[-1].clause, clause[0].clause)
        if beside is not None and len(clause) == 1:
            done = (*done[:-1], replace(done[-1], clause=beside))
            continue
        if said.endswith(("and", "then")):
            closed = _into_what_is_closed(done[-1].clause, clause[0].clause)
            done = (*done[:-1], replace(done[-1], clause=closed))
        put = done[-1].clause if said == "listed" else None
        put = None if isinstance(clause[0].clause, RemoveClause) else put
        if isinstance(put, PutClause) and not any(sources(item.things) for item in put.groups):
            return None  # several things with their places are one clause
        if said == "emptied" and not is_emptying(done[-1].clause):
            return None  # behind another verb that may be said of this, too
        if said.startswith("passive") and not goes_on(done[-1].clause, clause[0].clause):
            return None
        before = done[-1].clause
        if said == "by" and isinstance(clause[0].clause, PickClause):
            return None  # "put it there by gripping it from above" says how it is held meanwhile
        if said == "purpose" and isinstance(before, PickClause) and before.wanted:
            return None  # "I want the box to have the cup in it" does not ask for the box
        if said == "while" and not any(
            isinstance(item, EnsureClause | AvoidClause) for item in (before, clause[0].clause)
        ):
            return None  # "keep it open while you …"; else the hand would do two things
        if _is_told_of(done[-1].clause, said, clause[0].clause):
            return None
        if said not in _LATER and len(done) == 1:
            clause = _also_left(before, clause)
        if said == "mere and":
            further = clause[0].clause
            if isinstance(further, EnsureClause) and further.far_fetched == OF_SEVERAL:
                return None  # "the cup on the tray and the pen in it go in the box"
            done = _maybe_denied(done, clause)
        if said == "before" and _is_denied(before):
            return None  # "do not put it there before …" rather asks for both
        if said == "before" and (ahead := ahead_of(clause, done)):
            done = ahead
            continue
        if said in ("which", "which in turn"):
            named = named_last if said == "which" else held_by
            goes_there = named(before, clause[0].clause)
            if goes_there is None:
                return None
            clause = (replace(clause[0], clause=goes_there),)
        if said == "after" and is_emptying(before) and is_emptying(clause[0].clause):
            return None  # "clear it; when it is empty, …" goes on with something else
        if said == "after":
            done = _done_after(done, clause)
        else:
            done = (*done, *(then_done(clause) if said in _LATER else clause))
        if said == "counted":
            done = (*done[:-1], replace(done[-1], far_fetched=1))
    return done


GOES_ON = some(either(JOINED, joint("listed", LIST, HEADLINE)), most=12)
"""What may follow a clause without a verb."""
BARE_CHAIN = sequence(HEADLINE, GOES_ON, build=chained)
CHAIN = remembered(sequence(either(LED_CLAUSE, NOT_BEFORE), some(JOINED, most=12), build=chained))
