"""Reasons, purposes and remarks beside a request, which ask for nothing.

Where an instruction is not read as it stands, its sentences are cut into clauses, and those that
only tell something are left out; what they name is spoken of before the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.asides.aside_clauses import GRANTED, Clause, clauses_of
from etot_cli.reasoning.language.grammar.asides.asking_words import BEFORE_NAMES, PRONOUNS, IsName
from etot_cli.reasoning.language.grammar.asides.circumstances import KIND, circumstances_apart
from etot_cli.reasoning.language.grammar.asides.cutting import is_aside
from etot_cli.reasoning.language.grammar.asides.displeasure import is_answered
from etot_cli.reasoning.language.grammar.asides.left_open import is_left_open, is_wondering
from etot_cli.reasoning.language.grammar.asides.named_in_asides import (
    are_spoken_of,
    awaits_name,
    is_of_held_one,
    named_in,
    names_stranger,
    of_which,
    refers_back,
    words_of,
)
from etot_cli.reasoning.language.grammar.asides.people import HEARSAY, is_of_people
from etot_cli.reasoning.language.grammar.asides.talk import WHEN, is_talk
from etot_cli.reasoning.language.grammar.asides.telling import stranger_is_there
from etot_cli.reasoning.language.grammar.asides.told_of_things import is_turning, told_of_thing
from etot_cli.reasoning.language.grammar.asides.vague_wishes import (
    wants_room_there,
    wants_such_a_thing,
)
from etot_cli.reasoning.language.grammar.text.splitting import (
    COLON,
    COMMA,
    QUESTION,
    sentences_of,
    spaced,
    words_in,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import word_set

MOST = 4
"""Remarks of one instruction; who has more to tell may be asking for something by it."""
_LEADING = Expression(rf"^(?:and so|so|and|but|that is why|therefore|hence|{COMMA}) ")
_ASKED_ABOUT = Expression(rf"(?:can|could|is it possible|would it be possible)\b.*{QUESTION}")
_CONFIRMED = Expression(
    r"(?:(?:then|so|if (?:so|yes|it can|possible|you can)|well|ok|okay|good|please),? )*"
    r"(?:please )?do (?:it|that|so)(?:,? (?:then|please|now|right away|for me))*"
)
_THEN = Expression(rf"(?:^then\b|\b(?:until|till|after) then\b|\bthen(?: {COMMA}|$))")
"""It may speak of a time that was told ("she comes at three, so do it then")."""
_BY_THEN = Expression(rf"(?: {COMMA})? (?:by|before) then$")
"""All is done by any time that was told."""
IsSentence = Callable[[str], bool]
"""Whether the grammar reads a sentence."""
_OFF = word_set("cancelled canceled skipped forbidden prohibited banned postponed deferred undone")
"""Of tasks, or of what is listed below, it takes them back."""
_ANNOUNCING = word_set(
    "this these following else mistake mistakes error errors task tasks step steps action "
    "actions job jobs item items"
)
"""Before a colon it says something of what stands behind that, which is no remark beside it."""
_MYSELF = word_set("myself ourselves himself herself themselves")
_SWEEPING = word_set("everything all both each every rest other others")
_OF_SEVERAL = word_set("they them those these")
_TAGGED = Expression(
    rf",? (?:right|correct|(?:is|are|was|were|do|does|did|have|has|will|can) not \w+) {QUESTION}$"
)
"""Of what somebody thinks he knows."""
_IS_TO_BE = Expression(r"\b(?:go(?:es)?|belongs?|should|must|(?:has|have|needs?|is|are) to)\b")
_IN_DOUBT = Expression(
    r"(?:^(?:they|you|people|nobody|no ?one|neither|(?:any|some|every)(?:body|one)) "
    r"|\b(?:but|though|although|yet|however|so|if|i|we|he|she|wrong|not|have (?!to\b))\b"
    rf"|{QUESTION})"
)
"""Not everybody's word is to be followed, nor what may be told only to say that it is not."""


class Plain(Struct, frozen=True):
    """An instruction without its asides: the text to be read, and what was cut off."""

    text: str
    asides: tuple[str, ...]
    anyway: tuple[str, ...]
    """Of these, what is done where it has to be."""


class _Parted(Struct, frozen=True):
    """A sentence: what is left of it, and the asides before and behind that."""

    rest: str
    before: tuple[Clause, ...] = ()
    after: tuple[Clause, ...] = ()

    @property
    def asides(self) -> tuple[Clause, ...]:
        """Those that tell something."""
        return tuple(item for item in (*self.before, *self.after) if not item.is_polite)


def without_asides(text: str, is_name: IsName, is_sentence: IsSentence) -> Plain | None:
    """An instruction with every aside replaced by what it names.

    None where there is none, and where the rest may speak of something that only an aside names and
    the scene does not have.

    Args:
        text: normalized.
        is_name: whether something in the scene is called by a word.
        is_sentence: whether the grammar reads a sentence as it stands; what it reads stays whole.
    """
    sentences = _without_confirmation(sentences_of(text))
    for at, sentence in enumerate(sentences):
        said = _TAGGED.sub("", sentence)
        if said != sentence and not _parted(said, is_name, is_sentence).rest:
            # "You are busy, right? Then close it"
            behind = [after.removeprefix("then ") for after in sentences[at + 1 : at + 2]]
            sentences[at : at + 2] = [said, *behind]
    parted = [_parted(sentence, is_name, is_sentence) for sentence in sentences]
    if len(sentences) == 1 and (asked := _asked_by_another(sentences[0])):
        parted = [asked]
    timed = False
    for at, part in enumerate(parted):
        timed |= any(WHEN.search(item.said) for item in part.asides)
        parted[at] = replace(part, rest=_BY_THEN.sub("", part.rest)) if timed else part
    rest = [part.rest for part in parted if part.rest]
    asides = [aside for part in parted for aside in part.asides]
    cut = any(part.before or part.after for part in parted)
    cut = cut or rest != sentences_of(text)
    if not cut or not rest or len(asides) > MOST or _mistakable(parted, is_name):
        return None
    told = [item.said for item in asides if item.kind in ("", "plain")]
    told = [said for said in told if not (is_of_people(said) or is_turning(said))]
    topics = [told_of_thing(said, is_name) for said in told]
    if not are_spoken_of(topics, rest):
        return None
    if any(topic[-1:] == ("one",) for topic in topics) and PRONOUNS & words_of(rest):
        # "The red one is for me and the blue one is for my sister, so put it there"
        after = (told_of_thing(item.said, is_name) for part in parted for item in part.after)
        if sum(map(bool, topics)) > 1 or any(topic[-1:] == ("one",) for topic in after):
            return None
    if not all(is_answered(item.said, rest) for item in asides):
        return None
    if any(
        is_of_held_one(said, rest) or wants_room_there(said, rest)
        for said in (item.said for item in asides)
    ):
        return None
    # What is only told behind all that is asked for is meant by nothing, unless a word awaits it.
    asked_last = max(at for at, part in enumerate(parted) if part.rest)
    awaited = awaits_name(" ".join(rest).split(), is_name)
    kept = (
        said
        for at, part in enumerate(parted)
        for referred in [at < asked_last or awaited]
        for said in (
            named_in(of_which(part.before, rest), is_name, rest),
            part.rest,
            named_in((item.said for item in part.after), is_name, rest) if referred else "",
        )
    )
    return Plain(
        ". ".join(said.replace(f" {COMMA}", ",") for said in kept if said),
        tuple(_as_told(item, part) for part in parted for item in part.asides),
        tuple(_as_told(item, part) for part in parted for item in part.asides
              if item.kind == "anyway"),
    )  # fmt: skip


def _asked_by_another(sentence: str) -> _Parted | None:
    """A sentence that tells what is to be so by somebody's word, without that ("mum says the cup
    goes in the box"); None where there is none, or where it may not be followed.
    """
    heard = HEARSAY.match(sentence)
    if heard is None or _IN_DOUBT.search(sentence.removeprefix("i ")):
        return None
    asked = sentence[heard.end() :]
    said = Clause(comma=False, kind="", joint="", said=heard[0].strip())
    return _Parted(asked, before=(said,)) if _IS_TO_BE.search(asked) else None


def only_tells(text: str, is_name: IsName) -> bool:
    """Whether nothing is asked for by a text, so that nothing can be taken back behind it."""
    return all(
        clauses[at].is_polite or is_aside(clauses, at, is_name)
        for clauses in map(clauses_of, sentences_of(text))
        for at in range(len(clauses))
    )


def _without_confirmation(sentences: Sequence[str]) -> list[str]:
    """Sentences without those that only say that what was asked about is to be done ("Can it be
    closed? Then do it, please").
    """
    return [
        said
        for at, said in enumerate(sentences)
        if not (at and _CONFIRMED.fullmatch(said) and _ASKED_ABOUT.match(sentences[at - 1]))
    ]


def _as_told(aside: Clause, part: _Parted) -> str:
    """An aside, with the word for why where it stands behind a request."""
    whole = (
        is_left_open(aside.whole)
        or aside.joint == "before"
        or aside.kind == KIND
        or (aside.kind != "plain" and aside in part.after)
    )
    return spaced(f"{aside.joint if whole else ''} {aside.said}".split())


def _parted(sentence: str, is_name: IsName, is_sentence: IsSentence) -> _Parted:
    """A sentence and its asides."""
    said = [word for word in words_in(sentence) if word != QUESTION]
    ahead = said[: said.index(COLON)] if COLON in said else []
    if _OFF & {*said} or _ANNOUNCING & {*ahead} or ahead[:1] == ["what"]:
        return _Parted(sentence)
    told = clauses_of(" ".join(said).replace(COLON, COMMA))
    clauses = list(circumstances_apart(told, is_name))
    if (QUESTION in sentence and is_wondering(sentence)) or (
        QUESTION not in sentence
        and is_talk(" ".join(clause.text for clause in clauses), is_name)
        and not is_sentence(sentence)
    ):
        return _Parted("", tuple(clauses))
    cut = [at for at in range(len(clauses)) if is_aside(clauses, at, is_name)]
    granted = any(clause.joint in GRANTED for clause in clauses)
    if not cut and (not granted or is_sentence(sentence)):
        return _Parted(sentence)
    left = [at for at in range(len(clauses)) if at not in cut]
    rest = " ".join(_left_of(clauses, at, cut) for at in left)
    while led := _LEADING.match(rest):
        rest = rest[led.end() :]
    first = left[0] if left else len(clauses)
    return _Parted(
        rest,
        tuple(clauses[at] for at in cut if at < first),
        tuple(clauses[at] for at in cut if at > first),
    )


def _left_of(clauses: Sequence[Clause], at: int, cut: Collection[int]) -> str:
    """A clause as it stands once others are cut: what goes on behind "which", as the verb of what
    that was about, has no comma before it.
    """
    commented = at - 1 in cut and clauses[at - 1].kind == "comment"
    listed = {*clauses[at].said.split()[:1]} & BEFORE_NAMES
    goes_on = commented and not (clauses[at].joint or listed)
    return clauses[at].said if goes_on else clauses[at].text


def _mistakable(parted: Sequence[_Parted], is_name: IsName) -> bool:
    """Whether a pronoun may mean what only an aside before it names, "then" when that is, or
    "everything" what somebody does himself.
    """
    himself = any(_MYSELF & {*item.said.split()} for part in parted for item in part.asides)
    if himself and any(_SWEEPING & {*part.rest.split()} for part in parted):
        return True  # "I will do the cups myself. Put everything away"
    meaning = frozenset[str]()
    told = False
    for part in parted:
        told |= any(item.kind != "anyway" for item in part.asides)
        if part.rest and told and _THEN.search(part.rest):
            return True
        told = not part.rest
        for item in part.before if part.rest else part.asides:
            if item.kind == KIND:
                continue  # it says of what was named what that is for
            if names_stranger(item.said, is_name) or wants_such_a_thing(item.said, is_name):
                # "My teeth are in the cup, so do not touch it": the cup.
                several = stranger_is_there(item.said, is_name) and " are " in item.said
                meaning |= _OF_SEVERAL if several else PRONOUNS
            elif named_in((item.said,), is_name):
                meaning = frozenset()  # what was named last is meant
        if part.rest:
            if refers_back(part.rest.split(), is_name, meaning):
                return True
            meaning = frozenset()
    return False
