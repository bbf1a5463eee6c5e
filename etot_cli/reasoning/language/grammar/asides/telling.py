"""Whether a clause tells of what is not in the scene: how it is, what it does, what befell it.

What somebody asks for is asked of things of the scene, by a few verbs. A declarative clause about
something else, with any other verb, only tells something ("the inspector arrives at noon"), as do
exclamations ("Bedtime!", "What a lovely day!").
"""

from __future__ import annotations

from collections.abc import Collection

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    BEFORE_NAMES,
    CHANGING,
    DECREEING,
    NO_STRANGERS,
    PROPOSING,
    REFERRING,
    WORK,
    IsName,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    SIDES,
    STATES,
    THING_NOUNS,
    word_set,
)

_ASKING = (
    (ASKING | CHANGING | WORK | PROPOSING | DECREEING)
    - word_set("to by than end ends come comes join joins")
) | word_set("live lives stay stays sit sits stand stands rest rests lie lies hold holds")
"""Of none of these is passed over what it is said of, whatever that is."""
_TIME = Expression(
    r"(?:it is )?(?:(?!next\b|last\b|each\b|every\b|first\b|second\b|this\b|same\b|one\b|any\b)"
    r"\w+ ){0,2}?(?!sometime|anytime|meantime|meanwhile)(?:\w*time|break|over|recess)"
    r"(?: (?:is )?(?:over|up|out|now|again|everybody|everyone|kids))*(?: for (?:the|my|our) \w+)?"
)
_EXCLAIMED = Expression(
    r"(?:what (?:an? )?(?:\w+ ){0,2}\w+|how (?!many\b|much\b|about\b|come\b|to\b)\w+(?: of you)?"
    r"|look (?:at (?:this|that|the)(?: \w+)?|what a) (?:mess|chaos|clutter|state|jumble)"
    r"|\w+ weather(?: today| outside| again)?"
    r"|(?:good|oh my|my) (?:grief|goodness|lord|heavens|god|gracious))"
)
_PLACED_THERE = Expression(
    r"(?P<who>(?:i|we) (?:(?:still|also|soon) )*"
    r"(?:have to|will|need to|(?:am|are) going to) (?:(?:also|soon|then) )?(?:put|fit|get) )?"
    r"(?P<whose>my|our|the|a|an|some|this|that) (?:\w+ )?(?P<what>\w+)"
    r"(?(who)| (?:(?:(?:still|also|soon) )?(?:has|have|needs?|(?:is|are)(?: (?:going|about))?) to"
    r" (?:go|be put|fit)|(?:is|are) (?:going|coming|about to go)|will (?:soon )?(?:go|be put)"
    r"|goes))"
    r" (?:right )?(?:(?:in|into|inside|on|onto)(?: (?:there|it|here))?|there|here)"
    r"(?: (?:in a (?:minute|moment|second|bit)|soon|later|now|shortly|next|afterwards|tonight))?"
)


_THERE_IS = Expression(
    r"there (?:is|are|was|were) (?:(?:still|already|also|even) )?"
    r"(?:(?:an?|some|so much|too much|such an?) |(?=(?:\w+ ){1,2}(?:in|on|inside) (?:it|them)$))"
)
_YONDER = Expression(
    r"(?:(?: (?:in|out|over|up|down))? (?:here|there)(?= |$)| (?:in|on|inside) (?:it|them)$)"
)
_NO_EXISTENCE = REFERRING | {*THING_NOUNS, *LEVELS, *SIDES, *STATES}
"""What is there of these may be in the scene."""


def exclaims(said: str, is_name: IsName) -> bool:
    """Whether a clause is but an exclamation or names a time ("playtime is over")."""
    if _TIME.fullmatch(said):
        first = said.split()[0]
        return first.endswith("ing") or first not in VERB_WORDS - {"tidy", "clean", "clear"}
    found = _EXCLAIMED.fullmatch(said)
    return bool(found) and not any(
        is_name(word) or word in (_ASKING | VERB_WORDS) - BEFORE_NAMES for word in said.split()[1:]
    )


def there_is_such(said: str, is_name: IsName) -> bool:
    """Whether a clause tells that there is something, which is not in the scene ("there is milk in
    it").
    """
    words = _YONDER.sub("", said).split()
    told = {*words[2:]} - {"still"}
    return bool(_THERE_IS.match(said)) and not (
        any(map(is_name, words)) or (_ASKING | _NO_EXISTENCE) & told
    )


_STANDS_THERE = Expression(
    r"(?:my|our|his|her|some|(?:the|my|our) \w+ ?'s) (?P<what>(?:\w+ )?\w+) "
    r"(?:is|are) (?:(?:still|already|soaking|kept|stored) )?(?:in|inside|on)"
    r" (?:the|my|our|that|this) (?:\w+ ){0,2}?(?P<where>\w+)"
)


def stranger_is_there(said: str, is_name: IsName) -> bool:
    """Whether a clause tells what is in or on something of the scene, of which it has no such thing
    ("my teeth are in the cup"); a wish for that has no "so" behind it.
    """
    found = _STANDS_THERE.fullmatch(said)
    if found is None or not is_name(found["where"]):
        return False
    what = found["what"].split()
    return not any(is_name(word) or word in NO_STRANGERS for word in what)


_SOON = Expression(r" (?:next|soon|later|shortly|afterwards|tonight|in a \w+)$")


def goes_there_later(said: str, is_name: IsName) -> bool:
    """Whether somebody tells, behind a request, what he will put there himself ("my soup goes in
    next").
    """
    return bool(_SOON.search(said)) and goes_there(said, is_name)


def goes_there(
    said: str, is_name: IsName, *, whose: Collection[str] = ("my", "our", "a", "an", "some")
) -> bool:
    """Whether somebody tells what will soon be put where something is asked for ("my soup has to go
    in there"), of what is not in the scene.

    Args:
        said: the clause.
        is_name: whether something in the scene is called by a word.
        whose: words that it may begin with; "the soup" may be a wrong name for what is there.
    """
    found = _PLACED_THERE.fullmatch(said)
    known = found is None or found["whose"] not in whose or any(map(is_name, said.split()))
    return not known


_GOES_WITH = Expression(
    r"(?:it|they|he|she) (?:(?:also|always|usually|will) )?(?:comes?|goes|go|travels?|sleeps?"
    r"|is coming|are coming|is going|are going)"
    r"(?: (?:to|in|into) (?:my |our )?\w+| home| out| along| away| on (?:holiday|a trip))?"
    r"(?: with (?:me|us|him|her|them))?"
    r"(?: (?:today|tonight|tomorrow|later|soon|afterwards|anyway))?"
)


def goes_with_somebody(said: str, is_name: IsName) -> bool:
    """Whether a clause tells where somebody takes a thing that was spoken of ("he comes to bed with
    me"), which the robot does not do.
    """
    words = said.split()
    mine = " with me" in said or " with us" in said
    outside = (mine or {*words} & _OUTSIDE) and not {*words} & {"here", "there"}
    return bool(outside) and bool(_GOES_WITH.fullmatch(said)) and not any(map(is_name, words))


_OUTSIDE = word_set("bed home school work church nursery kindergarten holiday")
"""Where no robot arm brings anything."""
