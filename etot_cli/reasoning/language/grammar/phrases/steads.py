"""Rules for places that are told by what is, was or goes there."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    sequence,
    silent,
    spanned,
)
from etot_cli.reasoning.language.grammar.parsers.common import noun_phrase
from etot_cli.reasoning.language.grammar.phrases.contents import HERE_BEFORE
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Toward,
)
from etot_cli.reasoning.language.words import places, verbs
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS

WITH = spanned(
    either(
        sequence(
            "with, together with",
            phrase("it, them"),
            build=lambda text: NounPhrase(pronoun=text, text=text),
        ),
        sequence(
            "[exactly|precisely] [to] where",
            noun_phrase,
            places.IS_THERE,
            build=lambda np: None if np.pronoun else np,
        ),
    ),
    lambda text, np: Destination(Toward.WITH, (np,), text),
)
"""Where something is or was."""
STEAD = spanned(
    sequence(
        optional("[in|on] there"),
        either(
            sequence("in [the] place of", noun_phrase),
            sequence("in, into, to", noun_phrase, "'s", "[old] (place|spot|position)"),
            phrase("in its place", NounPhrase(pronoun="it", text="its")),
            phrase("in their place", NounPhrase(pronoun="them", text="their")),
            phrase("in (his|her) place", NounPhrase(pronoun="him", text="its")),
        ),
    ),
    lambda text, np: Destination(Toward.STEAD, (np,), text),
)
"""Where something was that goes elsewhere."""
INSTEAD_OF_IT = spanned(
    sequence(
        "instead of",
        noun_phrase,
        build=lambda np: None if np.pronoun or np.is_elliptic or np.head in DESK_NOUNS else np,
    ),
    lambda text, np: Destination(Toward.STEAD, (np,), text),
)
"""Behind a place: what is there goes elsewhere; "one" is rather another such place."""

PLACE_OF = either(
    sequence("the (place|spot|position) of", noun_phrase),
    sequence(noun_phrase, "'s", "[old] (place|spot|position)"),
    phrase("its place [there]", NounPhrase(pronoun="it", text="its")),
    phrase("their place [there], their places", NounPhrase(pronoun="them", text="their")),
)
TAKES_A_PLACE = spanned(
    sequence(silent(phrase(verbs.TAKE_THE_PLACE)), PLACE_OF),
    lambda text, np: Destination(Toward.STEAD, (np,), text.replace("'s ", " ")),
)
"""The same, by a verb for that: who takes the cup's place makes it go away."""


def told_by_it(where: Destination, around: Destination) -> Destination | None:
    """A place that is told by what is there ("where the pen is, inside the drawer")."""
    (np,) = around.targets[:1]
    if around.targets[1:] or np.pronoun or where.targets[0].pronoun:
        return None
    before = where.word.split()[-1] in places.WAS_THERE
    words = (HERE_BEFORE,) if before else ()
    told = np.told_by(Modifier(places.Prep.WITH, where.targets, words))
    return Destination(around.toward, (told,), around.word)
