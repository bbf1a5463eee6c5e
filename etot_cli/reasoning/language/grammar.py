"""The grammar of the controlled English; ``docs/instructions.md`` is written from its tables.

Every rule finds all its readings; the scene decides between them. Nouns are any words that are no
words of the grammar, so it knows no object. What a phrase of the tables means is in the value
beside it: a word that stands in none of them is never read over.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language import phrases as say
from etot_cli.reasoning.language.lexicon import is_descriptive
from etot_cli.reasoning.language.parsing import (
    Input,
    Parser,
    Rule,
    complete,
    either,
    located,
    optional,
    phrase,
    separated,
    sequence,
    silent,
    some,
    spanned,
    valued,
    word,
)
from etot_cli.reasoning.language.syntax import (
    Avoid,
    AvoidClause,
    Beside,
    Clause,
    Destination,
    EnsureClause,
    Modifier,
    MoveClause,
    NounPhrase,
    Order,
    PickClause,
    Prep,
    PutClause,
    PutGroup,
    RemoveClause,
    ReorientClause,
    Spoken,
    State,
    SwapClause,
    Things,
    Toward,
    TowerClause,
)
from etot_cli.skills.action import GraspPose
from etot_cli.world.spatial import Nearby

Reading = tuple[Spoken, ...]

COMMA = silent(phrase("~comma"))
AND = silent(phrase(say.AND))
OR = silent(phrase(say.OR))
EITHER = silent(phrase(say.EITHER))
NOT = phrase("not")
OF = silent(phrase("of, belonging to"))
WITH = silent(phrase("with"))
BE = silent(phrase(say.BE))
THE = silent(phrase("the"))
EMPTY_WORDS = silent(some(phrase(say.WITHOUT_MEANING)))
LISTED = either(AND, sequence(COMMA, optional(AND), build=lambda: ()))
LIST = silent(LISTED)
ALTERNATIVE = silent(either(COMMA, OR))


def _is_noun(given: Input, text: str) -> bool:
    if text in given.nouns:
        return text not in say.NEVER_NOUNS
    return text[:1].isalnum() and text not in say.GRAMMAR_WORDS and not say.is_adverb(text)


NOUN_WORD = word(_is_noun)
noun_phrase = Rule()
destination = Rule()
exceptions = Rule()
states = Rule()

# -- noun phrases ----------------------------------------------------------------------------------

_NUMBER = sequence(
    word(lambda given, text: text.isdigit() and len(text) < 3),
    silent(optional(phrase("of [the|these|those]"), None)),
    build=lambda number: number,
)
DETERMINER = either(*(phrase(pattern) for pattern in say.DETERMINERS), _NUMBER)
PRONOUN = phrase("it, them, they, this, that, these, those, its")
RELATIVE = silent(phrase(say.RELATIVE))
DENIED = silent(phrase(say.RELATIVE_NOT))
ADJECTIVE = either(
    word(lambda given, text: is_descriptive(text) or text in given.nouns),
    phrase(say.STATES),
)
ADJECTIVES = separated(ADJECTIVE, LIST, most=3)
NON = silent(phrase("non, not"))


def _relation(patterns: str, prep: Prep) -> Parser:
    return phrase(patterns, prep)


PREPOSITION = either(*(_relation(pattern, prep) for prep, pattern in say.PREPOSITIONS.items()))
SIDE = phrase(say.SIDE)


def _with_prep(prep: Prep, np: NounPhrase) -> Modifier:
    return Modifier(prep, (np,))


_plain_modifier = either(
    sequence(PREPOSITION, noun_phrase, build=_with_prep),
    sequence(
        silent(phrase("[in] between")),
        noun_phrase,
        silent(phrase("and")),
        noun_phrase,
        build=lambda one, two: (
            None if (pair := _coordinated(one, (two,))) is None else Modifier(Prep.BETWEEN, pair)
        ),
    ),
    sequence(
        silent(phrase("[in] between")), noun_phrase, build=lambda np: Modifier(Prep.BETWEEN, (np,))
    ),
    valued(SIDE, lambda text: Modifier(Prep.SIDE, words=tuple(text.split()))),
)
_contents = either(
    sequence(
        silent(either(WITH, phrase(say.CONTAINING))),
        noun_phrase,
        build=lambda np: Modifier(Prep.CONTAINING, (np,)),
    ),
    sequence(
        WITH,
        noun_phrase,
        silent(either(phrase("inside, in there, in"), phrase("(inside|in) (it|them)"))),
        build=lambda np: Modifier(Prep.CONTAINING, (np,)),
    ),
    sequence(
        WITH,
        noun_phrase,
        silent(phrase("on [top of] (it|them), on top")),
        build=lambda np: Modifier(Prep.BEARING, (np,)),
    ),
)
_quality = valued(ADJECTIVES, lambda words: Modifier(Prep.QUALITY, words=words))
_described = either(_plain_modifier, _contents, _quality)
MODIFIER = either(
    _plain_modifier,
    _contents,
    sequence(RELATIVE, _described, build=lambda modifier: modifier),
    sequence(DENIED, _described, build=lambda modifier: replace(modifier, denied=True)),
    sequence(
        silent(phrase(say.NOT_PLACED)),
        _plain_modifier,
        build=lambda modifier: replace(modifier, denied=True),
    ),
    sequence(
        silent(optional(phrase("~comma"), None)),
        silent(phrase(say.EXCEPT)),
        exceptions,
        build=lambda nps: Modifier(Prep.EXCEPT, nps),
    ),
)
MODIFIERS = some(MODIFIER, most=4)
WORDS = some(NOUN_WORD, least=1, most=6)


def _named(determiner: str, words: tuple[str, ...], modifiers: Any) -> NounPhrase:
    return NounPhrase(determiner, words, modifiers)


def _joined(
    determiner: str, first: tuple[str, ...], rest: Any, modifiers: Any
) -> NounPhrase | None:
    if len(rest) < 2 or not all(map(is_descriptive, first)) or not is_descriptive(rest[0]):
        return None
    return NounPhrase(determiner, (*first, *rest), modifiers, joined=True)


def _negative(determiner: str, without: str, words: Any, modifiers: Any) -> NounPhrase:
    return NounPhrase(determiner, words, modifiers, without=(without,))


def _general(determiner: str, head: str, quality: Any, modifiers: Any) -> NounPhrase:
    modifiers = modifiers if quality is None else (quality, *modifiers)
    return NounPhrase(determiner, (head,), modifiers)


def _pronoun(pronoun: str, modifiers: Any) -> NounPhrase | None:
    if modifiers and pronoun in ("it", "its"):
        return None
    return NounPhrase(modifiers=modifiers, pronoun=pronoun)


OPTIONAL_DETERMINER = optional(DETERMINER, "")
noun_phrase.define(
    spanned(
        either(
            sequence(OPTIONAL_DETERMINER, WORDS, MODIFIERS, build=_named),
            sequence(OPTIONAL_DETERMINER, NON, NOUN_WORD, WORDS, MODIFIERS, build=_negative),
            sequence(
                OPTIONAL_DETERMINER,
                some(NOUN_WORD, least=1, most=2),
                silent(phrase("and")),
                WORDS,
                MODIFIERS,
                build=_joined,
            ),
            sequence(
                OPTIONAL_DETERMINER,
                phrase(say.GENERAL_NOUNS),
                optional(_quality, None),
                MODIFIERS,
                build=_general,
            ),
            sequence(DETERMINER, MODIFIERS, build=lambda det, mods: NounPhrase(det, (), mods)),
            sequence(
                OPTIONAL_DETERMINER,
                WORDS,
                silent(phrase("'s")),
                WORDS,
                MODIFIERS,
                build=lambda det, owner, words, mods: NounPhrase(
                    "the", words, mods, owner=NounPhrase(det, owner, text=" ".join(owner))
                ),
            ),
            sequence(PRONOUN, MODIFIERS, build=_pronoun),
            sequence(
                DETERMINER, PRONOUN, build=lambda det, pronoun: NounPhrase(det, pronoun=pronoun)
            ),
        ),
        lambda text, np: replace(np, text=text),
    )
)


def _coordinated(first: NounPhrase, more: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """Noun phrases of which all but the last may leave the noun to the next: "the red and the blue
    mug". None where the last one leaves it out, too.
    """
    found = [first, *more]
    for index in range(len(found) - 1, -1, -1):
        item = found[index]
        adjectives = bool(item.words) and all(map(is_descriptive, item.words))
        if index and not item.determiner and item.words and first.determiner:
            item = replace(item, loose=True)
        following = found[index + 1] if index + 1 < len(found) else None
        if adjectives and following is None and not item.determiner:
            return None
        if adjectives and following is not None and len(following.words) > 1:
            item = replace(item, words=(*item.words, following.words[-1]))
        found[index] = item
    return tuple(found)


def _both(both: Any, nps: tuple[NounPhrase, ...] | None) -> tuple[NounPhrase, ...] | None:
    return None if nps is None or (both and len(nps) < 2) else nps


_COORDINATION = sequence(
    noun_phrase,
    some(sequence(LIST, noun_phrase, build=lambda np: np), most=9),
    build=_coordinated,
)
exceptions.define(_COORDINATION)
NP_LIST = Rule(sequence(optional(phrase("both"), None), _COORDINATION, build=_both))


def _one_of(nps: tuple[NounPhrase, ...]) -> Things | None:
    whole = _coordinated(nps[0], nps[1:]) if len(nps) > 1 else None
    return None if whole is None else Things(whole, either=True)


THINGS = either(
    valued(NP_LIST, Things),
    sequence(
        optional(EITHER),
        separated(noun_phrase, OR, most=6),
        build=_one_of,
    ),
)

# -- destinations ----------------------------------------------------------------------------------


def _alternatives(first: Any, listed: tuple[Any, ...], last: Any) -> tuple[Any, ...] | None:
    """Alternatives; commas stand for "or" only where one follows."""
    if last is None:
        return None if listed else (first,)
    return (first, *listed, last)


def _either(parser: Parser, most: int) -> Parser:
    """One or several with "or" before the last."""
    return sequence(
        optional(EITHER),
        parser,
        some(sequence(ALTERNATIVE, parser, build=lambda item: item), most=most),
        optional(
            sequence(optional(COMMA), OR, parser, build=lambda item: item),
            None,
        ),
        build=_alternatives,
    )


TARGETS = sequence(
    _either(noun_phrase, 5), build=lambda nps: _coordinated(nps[0], nps[1:]) if nps else None
)


def _toward(toward: Toward) -> Callable[[tuple[NounPhrase, ...]], Destination]:
    return lambda targets: Destination(toward, targets)


def _region(regions: tuple[Nearby, ...], phrases: Any) -> tuple[Beside, ...]:
    return tuple(Beside(relation, () if phrases is None else (phrases,)) for relation in regions)


def _beside(relation: Nearby, *nps: NounPhrase) -> tuple[Beside, ...]:
    return (Beside(relation, nps),)


_NEARBY = either(*(phrase(text, relation) for relation, text in say.NEARBY.items()))
_REGION = either(*(phrase(text, regions) for regions, text in say.REGIONS.items()))
BESIDE = either(
    sequence(_NEARBY, noun_phrase, build=_beside),
    sequence(
        silent(phrase("[in] between")),
        noun_phrase,
        silent(phrase("and")),
        noun_phrase,
        build=lambda one, two: (
            None if (pair := _coordinated(one, (two,))) is None else (Beside(Nearby.BETWEEN, pair),)
        ),
    ),
    sequence(
        silent(phrase("[in] between")),
        noun_phrase,
        build=lambda np: (Beside(Nearby.BETWEEN, (np,)),),
    ),
    sequence(
        _REGION, optional(sequence(OF, noun_phrase, build=lambda np: np), None), build=_region
    ),
)
BESIDES = valued(
    separated(BESIDE, silent(either(COMMA, phrase("and, but"))), most=3),
    lambda found: tuple(item for several in found for item in several),
)
_into = sequence(silent(phrase(say.INTO)), TARGETS, build=_toward(Toward.INSIDE))
_onto = sequence(silent(phrase(say.ONTO)), TARGETS, build=_toward(Toward.ON))
_to = sequence(silent(phrase(say.TO)), TARGETS, build=_toward(Toward.TO))
_top_of = sequence(
    silent(phrase(say.ONTO)),
    noun_phrase,
    silent(phrase("'s")),
    silent(phrase("top, surface")),
    build=lambda np: Destination(Toward.ON, (np,)),
)
destination.define(
    either(
        _into,
        _onto,
        _to,
        _top_of,
        valued(phrase(say.HERE), lambda text: Destination(Toward.HERE, word=text)),
        valued(phrase(say.HOME), lambda text: Destination(Toward.HOME)),
        valued(BESIDES, lambda found: Destination(Toward.BESIDE, beside=found)),
        sequence(
            either(_onto, _to, _into),
            silent(optional(phrase("~comma"), None)),
            BESIDES,
            build=lambda surface, found: replace(surface, beside=found),
        ),
    )
)
DESTINATIONS = sequence(
    optional(EITHER), separated(destination, OR, most=5), build=lambda found: found
)
_directed = either(
    sequence(silent(phrase(say.INTO_DIRECTED)), TARGETS, build=_toward(Toward.INSIDE)),
    sequence(silent(phrase(say.ONTO_DIRECTED)), TARGETS, build=_toward(Toward.ON)),
    _to,
)
DIRECTED = sequence(optional(EITHER), separated(_directed, OR, most=5), build=lambda found: found)

# -- states ----------------------------------------------------------------------------------------

OPEN_OR_CLOSED = either(phrase(say.OPEN_STATE, "open"), phrase(say.CLOSED_STATE, "closed"))
PREDICATE = either(OPEN_OR_CLOSED, DESTINATIONS)


def _state(subjects: tuple[NounPhrase, ...], predicate: Any) -> State:
    if isinstance(predicate, str):
        return State(subjects, word=predicate)
    return State(subjects, predicate)


STATE = sequence(NP_LIST, BE, PREDICATE, build=_state)
states.define(separated(STATE, LIST, most=6))

# -- clauses ---------------------------------------------------------------------------------------

POSE = either(
    phrase(say.HORIZONTAL, GraspPose.HORIZONTAL), phrase(say.VERTICAL, GraspPose.VERTICAL)
)
POSES = _either(POSE, 1)
SOURCE = sequence(silent(phrase(say.SOURCE)), noun_phrase, build=lambda np: np)
OPTIONAL_SOURCE = optional(SOURCE, None)
OPTIONAL_COMMA = optional(COMMA)
OPTIONAL_POSES = optional(sequence(OPTIONAL_COMMA, POSES, build=lambda found: found), None)


def _from(things: Things, source: NounPhrase | None) -> Things:
    """Things that are to be taken from somewhere."""
    if source is None:
        return things
    modifier = Modifier(Prep.FROM, (source,))
    moved = tuple(replace(np, modifiers=(*np.modifiers, modifier)) for np in things.phrases)
    return replace(things, phrases=moved)


def _pick(before: Any, things: Things, source: Any, after: Any) -> PickClause | None:
    if before and after:
        return None
    poses = dict.fromkeys(before or after or ())
    return PickClause(_from(things, source), tuple(poses))


PICK = sequence(
    optional(sequence(POSES, OPTIONAL_COMMA, build=lambda found: found), None),
    silent(phrase(say.PICK)),
    THINGS,
    silent(optional(phrase("up"), None)),
    OPTIONAL_SOURCE,
    OPTIONAL_POSES,
    build=_pick,
)
GROUPING = either(
    phrase(say.ANYHOW, Grouping.ANY),
    phrase(say.TOGETHER, Grouping.TOGETHER),
    phrase(say.SEPARATELY, Grouping.SEPARATELY),
)
CONDITION = sequence(WITH, NP_LIST, PREDICATE, build=_state)
FIRST_OF_THEM = either(
    sequence(separated(noun_phrase, LIST, most=2), silent(phrase("first")), build=lambda nps: nps),
    sequence(silent(phrase(say.STARTING_WITH)), noun_phrase, build=lambda np: (np,)),
)
EXTRA = sequence(
    OPTIONAL_COMMA,
    either(
        GROUPING,
        CONDITION,
        silent(phrase(say.STANDING)),
        sequence(
            silent(phrase(say.BUT_NOT)),
            separated(destination, OR, most=3),
            build=lambda found: ("not", found),
        ),
        valued(FIRST_OF_THEM, lambda nps: ("first", nps)),
        silent(phrase(say.IN_THIS_ORDER)),
    ),
    build=lambda *found: found[0] if found else (),
)


def _put(groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    groupings = [item for item in extras if isinstance(item, Grouping)]
    conditions = tuple(item for item in extras if isinstance(item, State))
    said = [item for item in extras if isinstance(item, tuple) and item]
    firsts = [item[1] for item in said if item[0] == "first"]
    ruled_out = tuple(place for item in said if item[0] == "not" for place in item[1])
    if len(groupings) > 1 or len(firsts) > 1:
        return None
    grouping = groupings[0] if groupings else Grouping.ANY
    first = firsts[0] if firsts else ()
    return PutClause(groups, grouping, conditions, first, ruled_out)


def _group(directions: Parser, particle: str) -> Parser:
    return sequence(
        THINGS,
        silent(optional(phrase(particle), None)),
        OPTIONAL_COMMA,
        directions,
        build=PutGroup,
    )


PUT_GROUP = _group(DESTINATIONS, "down, upright, away, back, over, inside")
EXTRAS = some(EXTRA, most=3)
DOWN = (Destination(Toward.HERE, word="down"),)
BACK = (Destination(Toward.HOME),)
PUT = either(
    sequence(
        silent(phrase(say.STACK)),
        separated(PUT_GROUP, LIST, most=5),
        build=lambda groups: PutClause(groups) if len(groups) > 1 else None,
    ),
    sequence(silent(phrase(say.PUT)), separated(PUT_GROUP, LIST, most=5), EXTRAS, build=_put),
    sequence(
        silent(phrase(say.BRING)),
        separated(
            sequence(
                valued(sequence(THINGS, OPTIONAL_SOURCE, build=_from), lambda things: things),
                DIRECTED,
                build=PutGroup,
            ),
            LIST,
            most=5,
        ),
        EXTRAS,
        build=_put,
    ),
    sequence(
        silent(phrase(say.PUT_DOWN)),
        THINGS,
        build=lambda things: PutClause((PutGroup(things, DOWN),)),
    ),
    sequence(
        silent(phrase(say.PUT)),
        THINGS,
        silent(phrase("down")),
        build=lambda things: PutClause((PutGroup(things, DOWN),)),
    ),
    sequence(
        silent(phrase(say.PUT_BACK)),
        THINGS,
        silent(optional(phrase("back"), None)),
        build=lambda things: PutClause((PutGroup(things, BACK),)),
    ),
    sequence(
        silent(phrase(say.PUT)),
        THINGS,
        silent(phrase("back")),
        build=lambda things: PutClause((PutGroup(things, BACK),)),
    ),
)
REMOVE = either(
    sequence(
        silent(phrase(say.REMOVE)),
        THINGS,
        OPTIONAL_SOURCE,
        build=lambda things, source: RemoveClause(things, source),
    ),
    sequence(
        silent(phrase(say.BRING)),
        THINGS,
        silent(phrase("out, off, away")),
        OPTIONAL_SOURCE,
        build=lambda things, source: RemoveClause(things, source),
    ),
    sequence(
        silent(phrase(say.BRING)),
        THINGS,
        SOURCE,
        build=lambda things, source: RemoveClause(things, source),
    ),
)


def _contents_of(np: NounPhrase, where: Prep) -> NounPhrase:
    return NounPhrase(
        "all", ("objects",), (Modifier(where, (np,)),), text=f"everything in {np.text}"
    )


def _emptied(things: Things, where: Any) -> Clause:
    contents = Things(tuple(_contents_of(np, Prep.FROM) for np in things.phrases))
    if where is None:
        return RemoveClause(contents)
    return PutClause((PutGroup(contents, where),))


EMPTY = either(
    sequence(
        silent(phrase("empty[ing] [out]")), THINGS, optional(DESTINATIONS, None), build=_emptied
    ),
    sequence(
        silent(phrase(say.TIDY)),
        THINGS,
        DESTINATIONS,
        build=lambda things, where: PutClause((PutGroup(things, where),)),
    ),
    sequence(
        silent(phrase(say.CLEAR)),
        NP_LIST,
        DESTINATIONS,
        build=lambda nps, where: _emptied(Things(nps), where),
    ),
    sequence(silent(phrase(say.CLEAR)), NP_LIST, build=lambda nps: _emptied(Things(nps), None)),
)
MOVE = either(
    sequence(
        silent(phrase("pull[ing] out, slid(e|ing) out, lift[ing] [up], rais(e|ing)")),
        THINGS,
        build=lambda things: MoveClause(things, opens=True),
    ),
    sequence(silent(phrase(say.OPEN)), THINGS, build=lambda things: MoveClause(things, opens=True)),
    sequence(
        silent(phrase(say.PULL)),
        THINGS,
        silent(phrase(say.OPEN_STATE)),
        build=lambda things: MoveClause(things, opens=True),
    ),
    sequence(
        silent(phrase(say.CLOSE)), THINGS, build=lambda things: MoveClause(things, opens=False)
    ),
    sequence(
        silent(phrase("push[ing], slid(e|ing)")),
        THINGS,
        silent(phrase("[back] in")),
        build=lambda things: MoveClause(things, opens=False),
    ),
    sequence(
        silent(phrase(say.PULL)),
        THINGS,
        silent(phrase(say.CLOSED_STATE)),
        build=lambda things: MoveClause(things, opens=False),
    ),
)
ENSURE = either(
    sequence(silent(phrase(say.ENSURE)), states, build=EnsureClause),
    sequence(
        silent(phrase(say.KEEP)),
        NP_LIST,
        OPEN_OR_CLOSED,
        build=lambda nps, state: EnsureClause((State(nps, word=state, kept=True),)),
    ),
    sequence(
        NP_LIST,
        silent(phrase(say.MODAL)),
        PREDICATE,
        build=lambda nps, predicate: EnsureClause((_state(nps, predicate),)),
    ),
    sequence(
        silent(phrase(say.WANT)),
        NP_LIST,
        silent(optional(phrase("to be"), None)),
        PREDICATE,
        build=lambda nps, predicate: EnsureClause((_state(nps, predicate),)),
    ),
)
REORIENT = either(
    sequence(
        silent(phrase(say.REORIENT)),
        THINGS,
        silent(optional(phrase(say.UPRIGHT), None)),
        build=ReorientClause,
    ),
    sequence(silent(phrase(say.TURN)), THINGS, silent(phrase(say.UPRIGHT)), build=ReorientClause),
)
_ENDS = separated(
    sequence(
        noun_phrase,
        optional(BE),
        either(phrase(say.AT_BOTTOM, "bottom"), phrase(say.AT_TOP, "top")),
        build=lambda np, end: (np, end),
    ),
    LIST,
    most=2,
)


def _tower(
    things: Things, upward: bool | None, ends: Any, base: tuple[Destination, ...] = ()
) -> TowerClause | None:
    named = {end: np for np, end in ends or ()}
    if ends and len(named) < len(ends):
        return None
    return TowerClause(things, upward, named.get("bottom"), named.get("top"), base)


_UPWARD = sequence(
    OPTIONAL_COMMA,
    either(phrase(say.BOTTOM_UP, True), phrase(say.TOP_DOWN, False)),
    build=lambda upward: upward,
)
_TOWER_ENDS = optional(sequence(OPTIONAL_COMMA, WITH, _ENDS, build=lambda ends: ends), None)
TOWER = either(
    sequence(
        silent(phrase(say.STACK)),
        THINGS,
        silent(optional(phrase(say.UPON_EACH_OTHER), None)),
        optional(_UPWARD, None),
        _TOWER_ENDS,
        build=_tower,
    ),
    sequence(
        silent(phrase(say.STACK)),
        THINGS,
        optional(_UPWARD, None),
        DESTINATIONS,
        _TOWER_ENDS,
        build=lambda things, upward, base, ends: _tower(things, upward, ends, base),
    ),
    sequence(
        silent(phrase(say.PUT)),
        THINGS,
        silent(phrase(say.UPON_EACH_OTHER)),
        optional(_UPWARD, None),
        _TOWER_ENDS,
        build=_tower,
    ),
    sequence(
        silent(phrase(say.BUILD)),
        optional(_UPWARD, None),
        silent(phrase(say.OUT_OF)),
        THINGS,
        optional(_UPWARD, None),
        _TOWER_ENDS,
        build=lambda before, things, after, ends: (
            None
            if before is not None and after is not None
            else _tower(things, before if after is None else after, ends)
        ),
    ),
)
TOWER = either(
    TOWER,
    sequence(
        silent(phrase(say.BUILD)),
        silent(phrase("a tower, a stack, a pile")),
        _UPWARD,
        COMMA,
        THINGS,
        build=lambda upward, things: _tower(things, upward, None),
    ),
)
SWAP = either(
    sequence(
        silent(phrase(say.SWAP)),
        THINGS,
        silent(optional(phrase("around, over"), None)),
        build=SwapClause,
    ),
    sequence(
        silent(phrase("swap[ping], exchang(e|ing), switch[ing], replac(e|ing)")),
        noun_phrase,
        silent(phrase("with, for")),
        noun_phrase,
        build=lambda one, two: SwapClause(Things((one, two))),
    ),
)

# -- what must not be done -------------------------------------------------------------------------


def _avoid(avoid: Avoid, things: Things, where: Any = ()) -> AvoidClause:
    return AvoidClause(avoid, things, where or ())


_FORBIDDEN = either(
    sequence(phrase(say.TOUCH, Avoid.TOUCH), THINGS, build=_avoid),
    sequence(phrase(say.DISTURB, Avoid.MOVE), THINGS, build=_avoid),
    sequence(phrase(say.PICK, Avoid.MOVE), THINGS, build=_avoid),
    sequence(phrase(say.OPEN, Avoid.OPEN), THINGS, build=_avoid),
    sequence(phrase(say.CLOSE, Avoid.CLOSE), THINGS, build=_avoid),
    sequence(phrase(say.PUT, Avoid.PUT), THINGS, DESTINATIONS, build=_avoid),
    sequence(
        either(phrase(say.TOUCH, Avoid.TOUCH), phrase(say.DISTURB, Avoid.MOVE)),
        silent(phrase(say.ANYTHING_ELSE)),
        build=lambda avoid: AvoidClause(avoid, None),
    ),
)
AVOID = sequence(silent(phrase(say.DO_NOT)), _FORBIDDEN, build=lambda clause: clause)
WITHOUT = sequence(
    OPTIONAL_COMMA, silent(phrase("without")), _FORBIDDEN, build=lambda clause: clause
)
KEEP_STILL = either(
    sequence(
        silent(phrase(say.KEEP)),
        THINGS,
        silent(phrase(say.AS_IT_IS)),
        build=lambda things: AvoidClause(Avoid.MOVE, things),
    ),
    sequence(
        silent(phrase("leav(e|ing), keep[ing]")),
        silent(phrase("everything else, all else, the (rest|others) [of (it|them)]")),
        silent(phrase(say.AS_IT_IS)),
        build=lambda: AvoidClause(Avoid.MOVE, None),
    ),
    sequence(
        silent(phrase("keep[ing], stay[ing]")),
        silent(phrase("[your] (hand|hands|gripper|fingers|arm|), clear")),
        silent(phrase("off, away from, clear of, of")),
        THINGS,
        build=lambda things: AvoidClause(Avoid.TOUCH, things),
    ),
)

# -- sentences -------------------------------------------------------------------------------------

CLAUSE = located(
    sequence(
        EMPTY_WORDS,
        either(PICK, PUT, REMOVE, EMPTY, MOVE, ENSURE, REORIENT, TOWER, SWAP, AVOID, KEEP_STILL),
        EMPTY_WORDS,
        optional(phrase(say.TRAILING_FIRST, Order.FIRST), None),
        optional(phrase(say.TRAILING_LAST, Order.LAST), None),
        optional(phrase(say.TRAILING_THEN, Order.THEN), None),
        EMPTY_WORDS,
        some(WITHOUT, most=3),
        build=lambda clause, first, last, then, avoided: (
            None
            if sum(item is not None for item in (first, last, then)) > 1
            else (clause, first or last or then, avoided)
        ),
    ),
    lambda at, found: (at, *found),
)
ORDER_WORDS = either(
    phrase(say.LEADING_FIRST, Order.FIRST),
    phrase(say.LEADING_BEFORE, Order.BEFORE_THAT),
    phrase(say.LEADING_LAST, Order.LAST),
    phrase(say.LEADING_THEN, Order.THEN),
)
LEAD = sequence(
    some(
        either(
            silent(phrase(say.FRAMES)),
            silent(phrase(say.WITHOUT_MEANING)),
            sequence(ORDER_WORDS, OPTIONAL_COMMA, build=lambda order: order),
            COMMA,
        ),
        most=6,
    ),
    build=lambda orders: orders,
)


def _spoken(orders: tuple[Order, ...], found: Any) -> Reading | None:
    """A clause with what must not be done on the way."""
    at, clause, order, avoided = found
    said = [item for item in dict.fromkeys((*orders, order)) if item is not None]
    strong = [item for item in said if item is not Order.THEN]
    if len(strong) > 1:
        return None
    when = strong[0] if strong else (said[0] if said else Order.SAID)
    return (Spoken(clause, at, when), *(Spoken(item, at) for item in avoided))


LED_CLAUSE = Rule(sequence(LEAD, CLAUSE, build=_spoken))
_JOINED = either(
    sequence(silent(phrase(say.JOINTS)), LED_CLAUSE, build=lambda clause: ("and", clause)),
    sequence(COMMA, LED_CLAUSE, build=lambda clause: ("and", clause)),
    sequence(
        OPTIONAL_COMMA,
        silent(phrase(say.THEN_JOINTS)),
        OPTIONAL_COMMA,
        LED_CLAUSE,
        build=lambda clause: ("then", clause),
    ),
    sequence(
        OPTIONAL_COMMA, silent(phrase("before")), LED_CLAUSE, build=lambda clause: ("then", clause)
    ),
    sequence(
        OPTIONAL_COMMA,
        silent(phrase(say.AFTER)),
        LED_CLAUSE,
        build=lambda clause: ("after", clause),
    ),
    sequence(
        OPTIONAL_COMMA,
        silent(phrase(say.SO_THAT)),
        located(states, lambda at, found: (Spoken(EnsureClause(found), at),)),
        build=lambda clause: ("and", clause),
    ),
)


def _then(clause: Reading) -> Reading:
    first = clause[0]
    if first.order is Order.SAID:
        first = replace(first, order=Order.THEN)
    return (first, *clause[1:])


def _chained(first: Reading, more: tuple[tuple[str, Reading], ...]) -> Reading:
    done = first
    for joint, clause in more:
        if joint == "after":
            done = (*clause, *_then(done))
        else:
            done = (*done, *(_then(clause) if joint == "then" else clause))
    return done


CHAIN = sequence(LED_CLAUSE, some(_JOINED, most=12), build=_chained)
SENTENCE = either(
    CHAIN,
    sequence(
        LEAD,
        located(WITHOUT, lambda at, clause: Spoken(clause, at)),
        COMMA,
        CHAIN,
        build=lambda orders, avoided, rest: None if orders else (avoided, *rest),
    ),
    sequence(
        LEAD,
        silent(phrase(say.AFTER)),
        LED_CLAUSE,
        COMMA,
        CHAIN,
        build=lambda orders, earlier, rest: None if orders else (*earlier, *_then(rest)),
    ),
    sequence(
        LEAD,
        silent(phrase("before")),
        LED_CLAUSE,
        COMMA,
        CHAIN,
        build=lambda orders, later, rest: None if orders else (*rest, *_then(later)),
    ),
)
WHOLE = sequence(
    SENTENCE,
    OPTIONAL_COMMA,
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    build=lambda reading: reading,
)


def readings(given: Input) -> list[Reading]:
    """All readings of a sentence, each as clauses in the order in which the sentence puts them."""
    return complete(WHOLE, given)
