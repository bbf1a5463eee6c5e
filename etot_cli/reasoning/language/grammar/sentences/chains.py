"""Rules for clauses one after the other, and what joins them."""

from __future__ import annotations

from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.left_alone import UNTOUCHED
from etot_cli.reasoning.language.grammar.conditions.prohibitions import (
    NOTHING_ELSE,
    NOTHING_MORE,
    WITHOUT,
)
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    one_of,
    optional,
    phrase,
    remembered,
    sequence,
    silent,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    LIST,
    LIST_COMMA,
    OPTIONAL_COMMA,
    after,
)
from etot_cli.reasoning.language.grammar.parsers.input import Input, Result
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
from etot_cli.reasoning.language.grammar.requests.emptying import IS_EMPTY
from etot_cli.reasoning.language.grammar.requests.grasping import WITH_A_GRASP
from etot_cli.reasoning.language.grammar.requests.word_order import PLACE_AHEAD
from etot_cli.reasoning.language.grammar.sentences.before_and_after import (
    ALL_LATER,
    EARLIER,
    EARLIER_ALONE,
    LATER,
    done_later,
    once_done,
)
from etot_cli.reasoning.language.grammar.sentences.doubles import so_in_turn
from etot_cli.reasoning.language.grammar.sentences.headlines import (
    HEADLINE,
    LEFT_SO,
    PLACED,
    left_so,
    timed,
)
from etot_cli.reasoning.language.grammar.sentences.joining import chained, joint
from etot_cli.reasoning.language.grammar.sentences.led_clauses import LED_CLAUSE, NOT_OF_ONE
from etot_cli.reasoning.language.grammar.sentences.not_before import NOT_BEFORE
from etot_cli.reasoning.language.grammar.sentences.passives import (
    ALSO_DONE,
    BEFORE_PLACED,
    NARRATED,
    THEN_HELD,
    THEN_PLACED,
    THEN_TURNED,
)
from etot_cli.reasoning.language.grammar.sentences.past import UNDER_WAY
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, plain
from etot_cli.reasoning.language.grammar.sentences.verbless import VERBLESS
from etot_cli.reasoning.language.grammar.sentences.which_clauses import (
    THAT,
    WHERE_MORE_GOES,
    WHICH_FIRST_GETS,
    WHICH_GOES_ON,
    WHICH_IN_TURN_IS,
    WHICH_IS_MOVED,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import AgainClause, EnsureClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase, Things
from etot_cli.reasoning.language.words import predicates, small_words
from etot_cli.reasoning.language.words.places import Prep


def _onward(where: tuple[Destination, ...]) -> AgainClause | None:
    """What was put somewhere goes on to another place; "on top" says no such thing."""
    named = all(item.targets and not item.targets[0].pronoun for item in where)
    return AgainClause(None, destinations=where) if named else None


def _once_more(things: Things) -> AgainClause | None:
    """Of which the same is asked for as before."""
    return None if begins_like_a_verb(things.phrases[0]) else AgainClause(things)


def _ahead(nps: tuple[NounPhrase, ...]) -> AgainClause | None:
    """What goes there before what was said to."""
    named = not any(np.pronoun or begins_like_a_verb(np) for np in nps)
    return AgainClause(Things(nps)) if named else None


_AHEAD = sequence(NP_LIST, build=_ahead)


def _another(things: Things) -> AgainClause | None:
    """What comes second; "the apple on the plate" rather goes there."""
    placed = any(item.prep in (Prep.IN, Prep.ON) for np in things.phrases for item in np.modifiers)
    return None if placed else _once_more(things)


def _also(things: Things) -> AgainClause:
    """Behind a place, which it may be one more of."""
    return AgainClause(things, trailing=True)


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
IN_BETWEEN = plain(
    sequence(THINGS, silent(optional(small_words.COMES)), "in between", build=_once_more),
    Order.BETWEEN,
)
"""Things that come behind what comes first, and before what comes last."""
ONCE_MORE = plain(sequence(THINGS, build=_once_more))
"""Things of which the same is asked for as before."""
_ONCE_MORE_OR_NARRATED = either(ONCE_MORE, plain(NARRATED))
_NEXT_ONE = either(LED_CLAUSE, ONCE_MORE, HEADLINE)
JOINED = either(
    joint("verbless and", either(COMMA, LIST), LEFT_SO),
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
    joint("turned", LIST_COMMA, PLACED),
    joint("emptied", COMMA, optional(small_words.AND), PLACED),
    joint("passive", timed(THEN_PLACED, THEN_TURNED, THEN_HELD, ALSO_DONE)),
    joint("passive, then", timed(BEFORE_PLACED)),
    joint(
        # "Put the cup on the tray, but not before the plate"
        "and",
        OPTIONAL_COMMA,
        small_words.NOT_BEFORE,
        plain(_AHEAD, Order.BEFORE_THAT),
    ),
    # "Open the drawer, but the cupboard first"
    joint("and", COMMA, "but", plain(_AHEAD, Order.FIRST), small_words.TRAILING_FIRST),
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
            either(PLACED, _ONCE_MORE_OR_NARRATED),
            # "…, last, the cup in the box first" is two orders for one thing.
            build=lambda order, placed: (
                None
                if placed[0].order is not Order.SAID
                else (replace(placed[0], order=order, far_fetched=1),)
            ),
        ),
    ),
    joint(
        "so that",
        OPTIONAL_COMMA,
        small_words.SO_THAT,
        plain(sequence(states, build=EnsureClause)),
        silent(optional(small_words.BY_THE_END)),
    ),
    joint("and", OPTIONAL_COMMA, small_words.SO_THAT, plain(either(IS_EMPTY, STAYING_UPRIGHT))),
    joint("and", OPTIONAL_COMMA, optional(small_words.SO_THAT), plain(NOTHING_ELSE)),
    joint("and", OPTIONAL_COMMA, optional("and, but"), plain(NOTHING_MORE)),
    joint("and", OPTIONAL_COMMA, optional("and, with"), IN_BETWEEN),
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
        either(
            _ONCE_MORE_OR_NARRATED,
            # "…, and then the cup on the tray, without touching the pen"
            sequence(HEADLINE, optional(plain(WITHOUT), ()), build=add),
        ),
    ),
    joint(
        # "Into the bin with the apple, then with the pear"
        "then",
        OPTIONAL_COMMA,
        f"{small_words.THEN_JOINTS}, and",
        Parser(_begins_with_place),
        "with",
        ONCE_MORE,
    ),
    joint(
        "then",
        OPTIONAL_COMMA,
        after("first", "firstly"),
        small_words.COUNTED_JOINTS,
        COMMA,
        _NEXT_ONE,
    ),
    joint(
        "counted",
        OPTIONAL_COMMA,
        after("first", "firstly"),
        small_words.COUNTED_JOINTS,
        NOT_OF_ONE,
        _NEXT_ONE,
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


GOES_ON = some(either(JOINED, joint("listed", LIST, HEADLINE)), most=12)
"""What may follow a clause without a verb."""
BARE_CHAIN = sequence(HEADLINE, GOES_ON, build=chained)
CHAIN = remembered(sequence(either(LED_CLAUSE, NOT_BEFORE), some(JOINED, most=12), build=chained))
