"""Rules that single an instance out by what it holds or bears, and by what stands somewhere."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    quiet,
    sequence,
    spanned,
)
from etot_cli.reasoning.language.grammar.parsers.common import EXACTLY, after, noun_phrase
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words import nouns, places
from etot_cli.reasoning.language.words.places import Prep

_INSIDE_IT = """
    [still|safely] inside, [still|safely] in there, in,
    [still|safely] [lying|standing|sitting] (inside|in) (it|them|which)
"""
_UPON_IT = "[still|safely|left] on [top of] (it|them), [still] on top"
_POSED = "currently|now|standing|lying|sitting|resting"
_HAVING = f"with, {nouns.CONTAINING}"


def _contents_with(having: str | Parser, denied: bool, bare: bool = False) -> Parser:
    """What is, or is not, in or on a thing; ``bare``: its noun may stand alone.

    Elsewhere a bare noun behind "without" may stand before anything.
    """
    return sequence(
        having,
        noun_phrase,
        optional(sequence("and", noun_phrase), None),
        optional(one_of({Prep.CONTAINING: _INSIDE_IT, Prep.BEARING: _UPON_IT}), Prep.WITH),
        build=lambda np, other, prep: (
            None
            if denied and (other or (prep is Prep.WITH and not (bare or np.determiner)))
            else Modifier(prep, (np, other) if other else (np,), denied=denied)
        ),
    )


WITH_IN_IT = sequence(
    "with",
    noun_phrase,
    one_of({Prep.CONTAINING: _INSIDE_IT, Prep.BEARING: _UPON_IT}),
    build=lambda np, prep: Modifier(prep, (np,)),
)
"""What is in or on a thing, as it is said between commas."""
_SUCH = NounPhrase("a", ("one",), text="one")
_HAVING_NONE = either(
    sequence(_HAVING, "none"),
    sequence("with", "none"),
    sequence(f"{nouns.LACKING}, without", "one, any"),
)
HERE_BEFORE = "before"
"""The word of a modifier that tells by what was in or on a thing before anything was moved."""
_CAME_FROM = """
    (it|they) came (from|out of), (it|they) (was|were) [taken|removed] (from|in|on|out of),
    [you] (took|got|removed) (it|them) (from|out of|off)
"""
WHERE_THAT_IS = quiet(
    sequence(
        optional("that, which"),
        noun_phrase,
        either(
            phrase(f"(is|are) [{_POSED}], stands, stand, lies, lie, sits, sit", ()),
            phrase(f"(was|were) [{_POSED}], stood, lay, sat", (HERE_BEFORE,)),
        ),
        optional(phrase("not", True), False),
        spanned(one_of(places.STANDS_AT), lambda said, prep: (prep, tuple(said.split()[1:]))),
        # "The cup that is not on" is one that nothing is said of.
        build=lambda np, words, denied, at: (
            None if np.text == "that" else Modifier(at[0], (np,), words + at[1], denied)
        ),
    )
)
"""Of what is meant, how something else is to it ("that the cup stands on")."""
CONTENTS = either(
    sequence(
        # "The cup that has none", "the cup without one"
        _HAVING_NONE,
        optional(one_of({Prep.CONTAINING: _INSIDE_IT, Prep.BEARING: _UPON_IT}), Prep.WITH),
        build=lambda prep: Modifier(prep, (_SUCH,), denied=True),
    ),
    sequence(
        # "The cup with one in it", "the cup that already has one"
        _HAVING,
        "one [already]",
        optional(one_of({Prep.CONTAINING: _INSIDE_IT, Prep.BEARING: _UPON_IT}), Prep.WITH),
        build=lambda prep: Modifier(prep, (_SUCH,)),
    ),
    sequence(
        optional("that, which"),
        phrase(_CAME_FROM),
        build=lambda said: Modifier(
            Prep.WITH,
            (NounPhrase(HERE_BEFORE, pronoun="it" if "it" in said.split() else "them", text=said),),
            (HERE_BEFORE,),
        ),
    ),
    _contents_with(_HAVING, denied=False),
    _contents_with(f"without, {nouns.LACKING}", denied=True),
    _contents_with(nouns.LACKING_ANY, denied=True, bare=True),
    quiet(
        _contents_with(
            # "Whichever cup does not have a ball in it"
            sequence(after("whichever"), "(does|do) not (have|hold|contain), (is|are) not holding"),
            denied=True,
        )
    ),
    sequence(
        nouns.CONTAINED,
        noun_phrase,
        optional(f"{_INSIDE_IT}, {_UPON_IT}, before"),
        build=lambda np: Modifier(Prep.WITH, (np,), (HERE_BEFORE,)),
    ),
    quiet(
        sequence(
            one_of({Prep.CONTAINING: "in which, where", Prep.BEARING: "on which"}),
            one_of({True: "there (is|are) (no|not [a|an|any])", False: "there (is|are)"}),
            noun_phrase,
            build=lambda prep, denied, np: Modifier(prep, (np,), denied=denied),
        )
    ),
    sequence(
        _HAVING,
        noun_phrase,
        EXACTLY,
        spanned(one_of(places.IT_HAS), lambda said, prep: (prep, tuple(said.split()))),
        build=lambda np, found: Modifier(found[0], (np,), found[1]),
    ),
    sequence(
        _HAVING,
        "nothing",
        either(_INSIDE_IT, _UPON_IT),
        build=lambda: Modifier(Prep.QUALITY, words=("empty",)),
    ),
    sequence(
        "where",
        noun_phrase,
        either(
            phrase("is, are, stands, stand, lies, lie, sits, sit, belongs", ()),
            phrase(
                "(is|are|stands|stand|lies|lie|sits|sit) (now|currently), (was|were) [before]",
                (HERE_BEFORE,),
            ),
        ),
        optional(phrase("not", True), False),
        # "The cups where they are" is no place that tells which.
        build=lambda np, words, denied: (
            None if np.pronoun and not words else Modifier(Prep.WITH, (np,), words, denied=denied)
        ),
    ),
    WHERE_THAT_IS,
    quiet(
        sequence(
            one_of({Prep.CONTAINING: "in which", Prep.BEARING: "on which"}),
            noun_phrase,
            "is, are, stands, stand, lies, lie, sits, sit",
            optional(phrase("not", True), False),
            build=lambda prep, np, denied: Modifier(prep, (np,), denied=denied),
        )
    ),
)
