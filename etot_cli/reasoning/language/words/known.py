"""Which words the grammar knows, which are never nouns, and why others are not understood."""

from __future__ import annotations

from functools import cache
from types import ModuleType

from etot_cli.reasoning.language.words import (
    fillers,
    forbidden,
    frames,
    manner,
    nouns,
    places,
    predicates,
    small_words,
    verbs,
)
from etot_cli.reasoning.language.words.lexicon import word_set
from etot_cli.reasoning.language.words.patterns import openings_of, words_of

_FUNCTION = """
    the a an any some another these those this that my your its their our his her it them they
    of and or then in into inside within on onto upon atop to from off out at by next beside near
    nearby behind beyond under underneath below beneath above over between with without is
    are be was were been being am should must shall has have had which who whose whom either both
    all
    each every not non no never neither nor except unless if while until because where so but before
    after once when whenever as please don t do does did together separately respectively
    horizontally
    vertically upright ensure up down there here than instead two three four five six seven eight
    nine ten i we us me you he him she what why how whether himself aside away everything anything
    something everyone nothing apart along plus via per using twice thrice times half halfway
    backwards forwards sideways rather also too just simply could would will may might i'd d ll
    ve re 's whichever upside goes go belong belongs want wants need needs like
    such only again now hey hi hello ok okay robot let lets alone untouched undisturbed unmoved
    except during through across around toward towards against among anyone someone yet still even
    ever most more less few several many much enough half quite very really almost nearly maybe
    anymore perhaps anywhere somewhere otherwise else other others remaining same single exactly
"""
VERB_WORDS = words_of(
    (
        verbs.PICK, verbs.PUT, verbs.PUT_DOWN, verbs.REMOVE, verbs.OPEN, verbs.CLOSE, verbs.PULL,
        verbs.ENSURE, verbs.KEEP, verbs.REORIENT, verbs.TURN, verbs.STACK, verbs.NEST, verbs.BUILD,
        verbs.SWAP, forbidden.TOUCH, forbidden.HIT, verbs.UNSTACK, verbs.REVERSE, verbs.DISMANTLE,
        forbidden.DISTURB,
        verbs.TIDY, verbs.CLEAR, forbidden.DO_NOT, forbidden.NEED_NOT,
    )
) - {"open", "closed", "shut", "empty", "top", "the", "tower", "hand", "of", "on", "onto",
    "back", "free", "places", "positions", "position", "us", "him", "her", "them", "a",
    # Things are called so, too, though none may be in the scene.
    "jam", "bundle", "house", "post", "station", "cart", "seat", "heap", "stuff",
    "whisk", "dish", "mess", "shelving",
    "finger", "so", "much", "as", "even", "past", "anywhere", "brush", "watch", "look",
    "at", "time", "moment", "point", "stage",  # of "at no time"
    "out", "careful", "mindful", "go", "going", "ask", "can", "could",
    *words_of((verbs.THE_ROBOT,))}  # fmt: skip
"""Words for doing; part of a noun phrase only where the scene has a thing called so."""
OTHER_VERBS = word_set(
    """
    use using pour pouring wipe wiping wash washing clean cleaning cook cooking stir stirring cut
    cutting slice slicing press pressing toss tossing throw throwing kick kicking juggle
    juggling shake shaking spin spinning roll rolling squeeze squeezing fold folding fill
    filling peel drink eat light plug unplug screw unscrew twist pinch poke break crush drag
    dragging sweep sweeping dust polish paint draw write hit hammer count find look search
    wait stop follow show tell describe explain say measure weigh heat warm cool mix blend scoop
    feed water inspect scan balance hang catch wave point dance walk drive fly jump
    sing toggle activate knock topple tip bump touch chuck chucking discard
    discarding dispose disposing fling flinging
    """
)
"""What no skill does."""
LINKS = word_set(
    """
    the a an my your this that these those its their of to and or nor but into in inside on onto
    from off out at by next beside near behind between with without before after than as if for
    is are be then when while until where which who under above below
    """
)
"""Words that are nothing without what stands behind them."""
BEFORE_NOUNS = [(word,) for word in ("the", "a", "an", "my", "this", "that", "both", "all")]
"""Before what a verb is about; a noun has none of them behind it."""
BLAMED = words_of((verbs.PULL, verbs.PUSH)) | {"where", "room", "space"}
"""Words that are understood in some places only, and where they are not are what is wrong."""
NEVER_NOUNS = frozenset({"the", "a", "an", "and", "or", "in", "on", "of", "not", "~comma", "to"})
GRAMMAR_WORDS = frozenset(_FUNCTION.split()) | VERB_WORDS | OTHER_VERBS | {"~comma"}

_THINGS_IN_LY = word_set("jelly belly lily doily telly lolly brolly dolly holly butterfly")


def is_adverb(text: str) -> bool:
    """Whether a word looks like one that says how something is done."""
    return len(text) > 4 and text.endswith("ly") and text not in _THINGS_IN_LY


NO_SKILL = "no skill does that; things can be picked up, put somewhere, opened and closed"
REASONS = {
    **dict.fromkeys(
        ("turn on", "turn off", "switch on", "switch off", "shut off", "turning on", "turning off",
         "turn over", "flip over", "turn around"),
        NO_SKILL,
    ),
    **dict.fromkeys(
        ("if", "unless", "when", "whenever", "while", "until", "once", "provided", "as soon",
         "as long"),
        "conditions and waiting are not supported; say what is to be done",
    ),
    **dict.fromkeys(
        ("twice", "thrice", "times", "repeat", "again"), "repetitions are not supported"
    ),
    **dict.fromkeys(
        ("quickly", "slowly", "fast", "faster", "slower", "quick", "carelessly", "rapidly"),
        "how fast something is done cannot be asked for",
    ),
    **dict.fromkeys(
        ("what", "why", "how", "who", "whose", "does", "did", "do"),
        "questions are not answered; say what is to be done",
    ),
    **dict.fromkeys(
        ("is", "are"), "how things are is neither asked nor said; say what is to be done"
    ),
    **dict.fromkeys(
        ("hands", "arms", "tongs", "fingers", "tool"), "the robot has one gripper and nothing else"
    ),
    **dict.fromkeys(
        ("halfway", "half", "partially", "slightly", "partly", "little", "bit"),
        "how far something goes cannot be asked for",
    ),
    **dict.fromkeys(
        ("moment", "moments", "seconds", "minutes", "hour", "hours", "day", "days"),
        "how long something lasts cannot be asked for",
    ),
    "least": "say how many exactly",
    **dict.fromkeys(
        ("push", "pull", "slide", "swing", "shove", "nudge", "drag"),
        "no skill pushes or pulls, but for opening and closing; say where it is to be put",
    ),
    **dict.fromkeys(
        ("hand", "arm", "tong"), "the robot has one gripper and no other tool",
    ),
    **dict.fromkeys(
        ("cm", "mm", "centimeters", "centimetres", "inches", "meters", "metres", "degrees"),
        "distances and angles cannot be asked for; say beside what it is to be",
    ),
    **dict.fromkeys(("row", "line", "circle"), "patterns of several things are not supported"),
    **dict.fromkeys(("same", "likewise", "ditto"), "say again what is to be done"),
    **dict.fromkeys(
        ("under", "underneath", "below", "beneath", "above", "through", "around"),
        "things can be put on, into and beside others, no other way",
    ),
    "way around": "of two things to two places alike, and no others, may either go to either",
    **dict.fromkeys(
        ("side", "sides"), "say whether to the left or to the right of what"
    ),
    "rather": "say only what is to be done",
    "instead": "say only what is to be done",
    "room": "room is made by what goes elsewhere: say what that is, or what goes there",
    "space": "room is made by what goes elsewhere: say what that is, or what goes there",
    "upside": "how a thing is to lie cannot be asked for",
    "where": "where something is does not say what is there: say into, onto or beside what",
    **dict.fromkeys(
        ("nothing", "do not", "does not", "did not", "do nothing"), "say what is to be done"
    ),
    "never": "say first what is to be done",
}  # fmt: skip
"""Why words are not understood, wherever they stand; two words together go before one."""


def _patterns(module: ModuleType) -> list[str]:
    """All patterns in a module's tables."""
    tables = [table for name, table in vars(module).items() if not name.startswith("_")]
    texts = [t for item in tables for t in (item.values() if isinstance(item, dict) else [item])]
    return [text for text in texts if isinstance(text, str)]


@cache
def all_words() -> frozenset[str]:
    """Every word that the grammar knows, worked out where something is not understood."""
    modules = (fillers, frames, manner, nouns, places, predicates, small_words, verbs)
    return GRAMMAR_WORDS.union(*(words_of(_patterns(module)) for module in modules))


@cache
def opening_words() -> frozenset[str]:
    """Words that a sentence may begin with that is not about a thing of the scene."""
    return GRAMMAR_WORDS.union(
        *(
            openings_of(_patterns(item))
            for item in (fillers, frames, predicates, small_words, verbs)
        )
    )
