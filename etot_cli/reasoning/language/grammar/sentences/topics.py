"""Rules for what is named before a clause speaks of it, and for what is only said of it."""

from __future__ import annotations

from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.occupied import ALREADY
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    one_of,
    optional,
    quiet,
    sequence,
    silent,
    some,
    spanned,
    word,
)
from etot_cli.reasoning.language.grammar.parsers.common import COLON, WORDS, ahead, noun_phrase
from etot_cli.reasoning.language.grammar.parsers.input import Input
from etot_cli.reasoning.language.grammar.phrases.descriptions import ADJECTIVES, DESCRIBED
from etot_cli.reasoning.language.grammar.phrases.modifiers import MODIFIERS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.sentences.hindrances import HINDRANCE, UNFIT
from etot_cli.reasoning.language.grammar.sentences.spoken import plain
from etot_cli.reasoning.language.grammar.syntax.clauses import Clause, ReorientClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.grammar.text.splitting import ASIDE
from etot_cli.reasoning.language.words import fillers, predicates, small_words, verbs
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.known import GRAMMAR_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    JOINT_NOUNS,
    is_in_lexicon,
    matches_any,
    singular,
    word_set,
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


def all_of_any(np: NounPhrase) -> Things | None:
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
        build=all_of_any,
    ),
    sequence(
        "there is, there are, (i|you|we) [can] see, (i|you|we) have [got], "
        f"{predicates.OTHERS_WANT}",
        ALL_THINGS,
        silent(optional("[over|right] here")),
        build=_the_some,
    ),
)
"""How things are, said of them before something is asked of them."""


def _meant_for(things: Things, words: tuple[str, ...]) -> Things | None:
    """A vessel and things that it is for, of which some may be spoken of next."""
    several = singular(words[-1]) != words[-1]
    return Things((*things.phrases, NounPhrase("the", words))) if several else None


def _is_stranger(given: Input, said: str) -> bool:
    """Whether a word names nobody and nothing that may be in the scene ("customer", "party")."""
    return said.isalpha() and not (
        said in {*given.nouns, *GRAMMAR_WORDS} or is_category(said) or is_in_lexicon(said)
    )


_FOR_STRANGERS = sequence(
    "(is|are) [only|just|meant] for (a|an|the|my|our|one of (my|our|the))",
    some(word(_is_stranger), least=1, most=3),
)
"""What a thing is said to be for that is nowhere here; who gets it then is nothing to the robot."""
_OTHERS = word_set("else other others rest")
_NO_OTHERS = Parser(lambda given, at: [] if _OTHERS & {*given.words[at:]} else [(at, NOTHING)])
_REMARK = either(
    sequence(ALL_THINGS, "(is|are|stands|lies) [right] in the way of", silent(noun_phrase)),
    sequence(ALL_THINGS, "is for, are for", WORDS, build=_meant_for),
    sequence(ALL_THINGS, either(fillers.REMARKS, sequence("is for, are for", silent(WORDS)))),
    sequence(ALL_THINGS, silent(_FOR_STRANGERS)),
    # What "the drawer is for pens only" asks for is told behind a colon, unless it is "all else".
    sequence(
        ALL_THINGS,
        either(
            sequence("(is|are) (only|just|exclusively) for", silent(WORDS)),
            sequence("is for, are for", silent(WORDS), "only, exclusively"),
        ),
        ahead(COLON),
        _NO_OTHERS,
    ),
    sequence(fillers.DONE_WITH, ALL_THINGS, silent(optional(small_words.ANY_MORE))),
    sequence("(i|we) do not need", ALL_THINGS, small_words.ANY_MORE),
    sequence(
        "(i|we) (need|want|have) to (get (at|into|inside|in)|reach [into]), let me get (at|into)",
        ALL_THINGS,
    ),
    sequence("(i|we) do not want", ALL_THINGS, "(rolling|lying|standing|sitting) (around|about)"),
)
MAKING_ROOM = spanned(
    sequence(verbs.MAKE_ROOM, ALL_THINGS, silent(optional(sequence("in, on, for", noun_phrase)))),
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


def are_several(topic: Clause) -> bool:
    """Whether several things are named."""
    nps = topic.things.phrases if isinstance(topic, ReorientClause) else ()
    return len(nps) > 1 or any(singular(np.head) != np.head for np in nps)
