"""Rules for what stands before, or comes with, what a sentence asks for."""

from __future__ import annotations

from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.left_alone import OTHERS_STILL
from etot_cli.reasoning.language.grammar.conditions.prohibitions import AVOID, WITHOUT
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    OPTIONAL_COMMA,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.requests.emptying import EMPTY
from etot_cli.reasoning.language.grammar.requests.moves import IF_NOT_SO
from etot_cli.reasoning.language.grammar.requests.put_groups import PAIRS
from etot_cli.reasoning.language.grammar.requests.unstacking import UNSTACK
from etot_cli.reasoning.language.grammar.sentences.afterthoughts import TOLD_BEHIND
from etot_cli.reasoning.language.grammar.sentences.ahead import NOT_SO
from etot_cli.reasoning.language.grammar.sentences.announced import ANNOUNCED_PLACES
from etot_cli.reasoning.language.grammar.sentences.before_and_after import (
    ALL_LATER,
    EARLIER,
    done_later,
    once_done,
    out_of_the_way,
    same_receiver,
)
from etot_cli.reasoning.language.grammar.sentences.chains import BARE_CHAIN, CHAIN, JOINED
from etot_cli.reasoning.language.grammar.sentences.end_states import END_STATES
from etot_cli.reasoning.language.grammar.sentences.joining import chained
from etot_cli.reasoning.language.grammar.sentences.led_clauses import LED_CLAUSE
from etot_cli.reasoning.language.grammar.sentences.meanwhile import MEANWHILE
from etot_cli.reasoning.language.grammar.sentences.named_ahead import NAMED_AHEAD
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading, Spoken, plain
from etot_cli.reasoning.language.grammar.sentences.taking_turns import by_turns
from etot_cli.reasoning.language.grammar.sentences.told_with import WITH_SO
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    EnsureClause,
    MoveClause,
    PutClause,
    ReorientClause,
    Turns,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import frames, manner, places, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, singular


def _started_with(first: NounPhrase, done: Reading) -> Reading | None:
    """What is done with several things, the first of which is told before."""
    if several := by_turns(done, Turns(first=(first,))):
        return several
    clause = done[0].clause
    if not isinstance(clause, PutClause | MoveClause) or clause.turns != Turns():
        return None
    return (replace(done[0], clause=replace(clause, turns=Turns(first=(first,)))), *done[1:])


def _placed_there(np: NounPhrase, things: Things) -> PutClause:
    """Where the robot goes to put something down is where that goes."""
    return put_to(things, (Destination(Toward.TO, (np,)),))


def _of_one_thing(denied: Reading) -> Reading | None:
    """What is not to be done with one thing while others go somewhere ("do not touch the cup: pen
    in the box"); of several things it may rather be told where they are.
    """
    clause = denied[0].clause
    nps = clause.things.phrases if isinstance(clause, AvoidClause) and clause.things else ()
    single = nps and all(np.words and singular(np.head) == np.head for np in nps)
    known = all(np.determiner in ("the", "") and np.head not in THING_NOUNS for np in nps)
    return denied if single and known else None


def _turned_before(said: str, rest: Reading) -> Reading | None:
    """What has been turned by the time that it goes somewhere."""
    first = rest[0].clause
    if not isinstance(first, PutClause | EnsureClause) or "it" in said.split():
        return None
    turned = ReorientClause(Things((NounPhrase(pronoun="it", text="it"),)), meanwhile=True)
    return (rest[0], Spoken(turned, rest[0].position), *rest[1:])


_INVERTED = sequence(
    either(
        # "Only after that has been done should the pen be put in the cup"
        sequence("(should|may|can|could|must|shall|will) you", LED_CLAUSE),
        sequence("(are|do) you [allowed|supposed|free] [to]", LED_CLAUSE),
        plain(
            sequence(
                "should, may, can, could, must, shall, will, is, are, has, have, does, do",
                ALL_THINGS,
                f"[to] (go|come|be ({predicates.DONE_WITH_IT}))",
                DESTINATIONS,
                build=put_to,
            )
        ),
        plain(
            sequence(
                "should, may, can, could, must, shall, will, is, are, has, have",
                ALL_THINGS,
                "[to] be",
                one_of({True: "opened, pulled open", False: "closed, shut"}),
                build=MoveClause,
            )
        ),
    ),
    some(JOINED, most=6),
    build=chained,
)
"""What is asked for behind a condition that begins with "only" or "not"."""
WITH_MORE_BEFORE_IT = either(
    NAMED_AHEAD,
    END_STATES,
    ANNOUNCED_PLACES,
    sequence(plain(either(EMPTY, UNSTACK)), COLON, BARE_CHAIN, build=add),
    sequence(sequence(plain(AVOID), build=_of_one_thing), COLON, BARE_CHAIN, build=add),
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
        either(COMMA, "and, and then, then"),
        CHAIN,
        build=out_of_the_way,
    ),
    TOLD_BEHIND,
    sequence(TOLD_BEHIND, "~comma [so|and|then]", CHAIN, build=add),
    sequence(verbs.TIDY_AWAY, COMMA, plain(PAIRS)),
    sequence(
        plain(IF_NOT_SO),
        optional(sequence(OPTIONAL_COMMA, "and, but", plain(OTHERS_STILL)), ()),
        build=add,
    ),
    sequence(
        "if you (could|would)", CHAIN, COMMA, f"[then] ({frames.WOULD_BE_NICE}), that would do"
    ),
    WITH_SO,
    NOT_SO,
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
        EARLIER,
        OPTIONAL_COMMA,
        optional("[and] only then, [and] not before [then|that], [and] (no|not) (sooner|earlier)"),
        OPTIONAL_COMMA,
        either(CHAIN, _INVERTED),
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
