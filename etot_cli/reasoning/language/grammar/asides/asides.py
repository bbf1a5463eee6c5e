"""Reasons, purposes and remarks beside a request, which ask for nothing.

Where an instruction is not read as it stands, its sentences are cut into clauses, and those that
only tell something are left out; what they name is spoken of before the rest.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence

from msgspec import Struct

from etot_cli.reasoning.language.grammar.asides.aside_clauses import GRANTED, Clause, clauses_of
from etot_cli.reasoning.language.grammar.asides.asking_words import (
    BEFORE_NAMES,
    IsName,
    asks_besides,
    is_doing,
)
from etot_cli.reasoning.language.grammar.asides.displeasure import (
    dislikes,
    in_state,
    is_answered,
    is_misplaced,
)
from etot_cli.reasoning.language.grammar.asides.facts import tells_fact
from etot_cli.reasoning.language.grammar.asides.going import goes_to_it
from etot_cli.reasoning.language.grammar.asides.lacking_room import lacks_room
from etot_cli.reasoning.language.grammar.asides.left_open import (
    is_desk_wish,
    is_left_open,
    is_plan,
    is_wondering,
)
from etot_cli.reasoning.language.grammar.asides.mishaps import (
    befalls,
    fears_for,
    is_unspoilt,
    may_befall,
)
from etot_cli.reasoning.language.grammar.asides.people import PEOPLE, is_of_people, is_of_relative
from etot_cli.reasoning.language.grammar.asides.reasons import (
    is_comment,
    is_made_possible,
    is_purpose,
    is_reason,
    is_warning,
)
from etot_cli.reasoning.language.grammar.asides.remarks import is_remark, is_unused
from etot_cli.reasoning.language.grammar.asides.talk import is_talk
from etot_cli.reasoning.language.grammar.asides.telling import (
    exclaims,
    goes_there,
    goes_there_later,
    goes_with_somebody,
    is_about_to,
    stranger_is_there,
    tells_of_others,
    there_is_such,
)
from etot_cli.reasoning.language.grammar.asides.told_of_things import (
    is_in_passing,
    is_not_to_stay,
    is_told_apart_by,
    is_turning,
    told_of_thing,
)
from etot_cli.reasoning.language.grammar.asides.vague_wishes import wants_such_a_thing
from etot_cli.reasoning.language.grammar.asides.where_needed import is_hindering
from etot_cli.reasoning.language.grammar.text.splitting import (
    COLON,
    COMMA,
    QUESTION,
    sentences_of,
    spaced,
    words_in,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    JOINT_NOUNS,
    NUMBERS,
    STATES,
    singular,
    word_set,
)

ASIDE = "~aside"
"""Stands behind what a remark names, in its place."""
MOST = 4
"""Remarks of one instruction; who has more to tell may be asking for something by it."""
_PLACES = ("in ", "on ", "at ", "next ", "beside ", "behind ", "near ", "to ", "left ", "right ")
_LEADING = Expression(rf"^(?:and so|so|and|but|that is why|therefore|hence|{COMMA}) ")
_IN_THE_WAY = tuple(f" in {whose} way" for whose in ("the", "my", "our", "your"))
_PARTS = frozenset(noun for nouns in JOINT_NOUNS.values() for noun in nouns)
_LIKED = [["favourite"], ["favorite"], ["best"]]
_IS_ONE = Expression(
    r" (?:is|are|was|were|weighs?|costs?|needs?|makes?|(?:smells?|looks?) like) an? "
)
"""Before what is no other thing ("the vase was a gift")."""
_ASKED_ABOUT = Expression(rf"(?:can|could|is it possible|would it be possible)\b.*{QUESTION}")
_CONFIRMED = Expression(
    r"(?:(?:then|so|if (?:so|yes|it can|possible|you can)|well|ok|okay|good|please),? )*"
    r"(?:please )?do (?:it|that|so)(?:,? (?:then|please|now|right away|for me))*"
)
_WHICH_ONE = Expression(r"which ((?:\w+ )?(?!of\b)\w+) (?:you|it|they|is) ")
IsSentence = Callable[[str], bool]
"""Whether the grammar reads a sentence."""
_OF_A_KIND = Expression(
    r" (?:(?:allergic|partial|addicted) to|(?:afraid|scared|fond|sick|tired) of"
    r"|likes?|loves?|hates?|can not (?:stand|eat|have)|do(?:es)? not (?:like|eat)) (?P<kind>\w+)$"
)
_PRONOUNS = word_set("it they them that this those these he him she her")
_OF_SEVERAL = word_set("they them those these")


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
    parted = [_parted(sentence, is_name, is_sentence) for sentence in sentences]
    rest = [part.rest for part in parted if part.rest]
    asides = [aside for part in parted for aside in part.asides]
    cut = any(part.before or part.after for part in parted)
    cut = cut or rest != sentences_of(text)
    if not cut or not rest or len(asides) > MOST or _mistakable(parted, is_name):
        return None
    told = [item.said for item in asides if item.kind in ("", "plain")]
    told = [said for said in told if not (is_of_people(said) or is_turning(said))]
    topics = [told_of_thing(said, is_name) for said in told]
    if not _are_spoken_of(topics, rest):
        return None
    if not all(is_answered(item.said, rest) for item in asides):
        return None
    kept = (
        said
        for part in parted
        for said in (
            _named(_of_which(part.before, rest), is_name),
            part.rest,
            _named((item.said for item in part.after), is_name),
        )
    )
    return Plain(
        ". ".join(said.replace(f" {COMMA}", ",") for said in kept if said),
        tuple(_as_told(item, part) for part in parted for item in part.asides),
        tuple(_as_told(item, part) for part in parted for item in part.asides
              if item.kind == "anyway"),
    )  # fmt: skip


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
        or (aside.kind != "plain" and aside in part.after)
    )
    return spaced(f"{aside.joint if whole else ''} {aside.said}".split())


def _parted(sentence: str, is_name: IsName, is_sentence: IsSentence) -> _Parted:
    """A sentence and its asides."""
    said = (word for word in words_in(sentence) if word != QUESTION)
    clauses = clauses_of(" ".join(said).replace(COLON, COMMA))
    if (QUESTION in sentence and is_wondering(sentence)) or (
        QUESTION not in sentence
        and is_talk(" ".join(clause.text for clause in clauses), is_name)
        and not is_sentence(sentence)
    ):
        return _Parted("", tuple(clauses))
    cut = [at for at in range(len(clauses)) if _is_aside(clauses, at, is_name)]
    if cut and all(at in cut or _is_sigh(item.said, is_name) for at, item in enumerate(clauses)):
        cut = [*range(len(clauses))]
    # "Dinner is ready" and "the bowl for later" are sentences about things that are not there.
    outside = len(cut) == len(clauses) and not is_of_people(sentence)
    forced = outside or any(_is_no_phrase(clauses[at], is_name) for at in cut)
    granted = any(clause.joint in GRANTED for clause in clauses)
    if not (cut or granted) or (is_sentence(sentence) and not forced):
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


def _is_sigh(said: str, is_name: IsName) -> bool:
    """Whether a few words beside what somebody tells ask for nothing: no verb, no pronoun and
    nothing that is named is among them ("silly me").
    """
    words = {*said.split()}
    asking = VERB_WORDS - {"me"} | OTHER_VERBS | BEFORE_NAMES | _PRONOUNS | {*STATES}
    return len(words) <= MOST and not (words & asking or any(map(is_name, words)))


def _left_of(clauses: Sequence[Clause], at: int, cut: Collection[int]) -> str:
    """A clause as it stands once others are cut: what goes on behind "which", as the verb of what
    that was about, has no comma before it.
    """
    commented = at - 1 in cut and clauses[at - 1].kind == "comment"
    listed = {*clauses[at].said.split()[:1]} & BEFORE_NAMES
    goes_on = commented and not (clauses[at].joint or listed)
    return clauses[at].said if goes_on else clauses[at].text


def _is_no_phrase(aside: Clause, is_name: IsName) -> bool:
    """Whether an aside is one even where the grammar finds a phrase in it, such as a thing called
    "seed box leaks".
    """
    words = () if not told_of_thing(aside.said, is_name) else aside.said.split()
    strange = any(word not in all_words() and not is_name(word) for word in words)
    first, verb = (*aside.said.split(), "", "")[:2]
    outside = (
        first not in all_words() and not is_name(first) and verb in ("is", "are", "has", "have")
    )
    told = aside.is_polite or aside.kind == "benefit" or aside.said.endswith(_IN_THE_WAY)
    told = told or is_not_to_stay(aside.said) or is_desk_wish(aside.said) or lacks_room(aside.said)
    told = told or (
        aside.kind == "purpose" and (is_made_possible(aside.said) or befalls(aside.said))
    )
    told = told or stranger_is_there(aside.said, is_name)
    told = told or goes_to_it(aside.said, "", first=True) or goes_there(aside.said, is_name)
    told = told or is_unspoilt(aside.said) or goes_with_somebody(aside.said, is_name)
    told = told or wants_such_a_thing(aside.said, is_name)
    told = told or is_in_passing(aside.said) or tells_fact(_whole_of(aside), is_name)
    somebody = is_of_people(aside.said) and not re.match(r"(?:you|we|i)\b", aside.said)
    told = told or (aside.joint == "before" and somebody) or is_of_relative(aside.said, is_name)
    told = told or " or no " in aside.said or dislikes(aside.said) or is_hindering(aside.said)
    told = (
        told
        or exclaims(aside.said, is_name)
        or tells_of_others(aside.said, is_name, before_so=True)
    )
    return told or strange or outside or _is_of_own_body(aside.said, is_name)


def _whole_of(clause: Clause) -> str:
    """What a clause says, as a sentence of its own where "which" stands for what it is about."""
    told = clause.kind == "comment" and not is_of_people(clause.said)
    return f"it {clause.said}" if told else clause.said


def _is_of_own_body(said: str, is_name: IsName) -> bool:
    """Whether a clause is about somebody's hands or the like ("my hands are full")."""
    mine = said.startswith(("my ", "our ")) and is_of_people(said)
    return mine and not any(map(is_name, said.split()))


def _mistakable(parted: Sequence[_Parted], is_name: IsName) -> bool:
    """Whether a pronoun may mean what only an aside before it names."""
    meaning = frozenset[str]()
    for part in parted:
        for item in part.asides:
            if _names_stranger(item.said, is_name) or wants_such_a_thing(item.said, is_name):
                # "My teeth are in the cup, so do not touch it": the cup.
                several = stranger_is_there(item.said, is_name) and " are " in item.said
                meaning |= _OF_SEVERAL if several else _PRONOUNS
        if part.rest:
            if _refers_back(part.rest.split(), is_name, meaning):
                return True
            meaning = frozenset()
    return False


def _are_spoken_of(topics: Sequence[tuple[str, ...]], rest: Sequence[str]) -> bool:
    """Whether what is told of things may be why something is asked of them; else it may ask for
    something itself ("the shears are forbidden").
    """
    words = {word for said in rest for word in said.replace(",", "").split()}
    referring = _PRONOUNS | {"either", "one", "both"}
    return all(
        (referring | {*topic[-1:]}) & words or topic[-1] in {*DESK_NOUNS, *_PRONOUNS}
        for topic in topics
        if topic
    )


def _is_aside(clauses: Sequence[Clause], at: int, is_name: IsName) -> bool:
    """Whether one of a sentence's clauses asks for nothing."""
    clause = clauses[at]
    behind = "" if at + 1 == len(clauses) else clauses[at + 1].said.removeprefix("then ")
    last = all(item.is_polite for item in clauses[at + 1 :])
    last = last or is_doing((behind.split() or [""])[0])
    trailing = at > 0 and last and not asks_besides(clause.said)
    if clause.joint == "where" and not last:
        trailing = clauses[at + 1].comma and clauses[at + 1].said.startswith(_PLACES)
    if clause.is_polite and len(clauses) > 1:
        return not clause.said or clause.kind != "polite"
    if clause.joint in GRANTED:
        return False
    if clause.kind == "anyway" or is_left_open(clause.whole):
        return True
    match clause.kind, clause.joint:
        case _ if not clause.said:
            return False
        case "provided", _:
            return False
        case (("reason" | "meanwhile"), _):
            reason = (
                is_reason(clause.said, is_name)
                or may_befall(clause.said)
                or lacks_room(clause.said)
                or bool(told_of_thing(clause.said, is_name))
                or tells_fact(clause.said, is_name)
                or goes_there(clause.said, is_name, whose=BEFORE_NAMES)
            )
            return reason and (trailing or (at == 0 and clauses[1:] != []))
        case "comment", "who":
            of_somebody = at > 0 and clauses[at - 1].kind == "benefit"
            return of_somebody and is_remark(f"she {clause.said}", is_name)
        case "benefit", _:
            _, _, does = clause.said.partition(" who ")
            if does and not is_remark(f"she {does}", is_name):
                return False
            apart = at > 0 and (last or clauses[at + 1].comma or clauses[at + 1].joint == "and")
            return apart and not any(map(is_name, clause.said.split()))
        case "purpose", "before":
            # "…, but before you do that, close it" says when.
            named = clause.said.startswith("you do ") or any(map(is_name, clause.said.split()))
            if at == 0 and not all(item.is_polite for item in clauses[1:]):
                # "Before you do that, …" is about an order.
                told = not re.match(r"(?:you|we|i)\b", clause.said)
                return befalls(clause.said) or (
                    told and not named and is_remark(clause.said, is_name)
                )
            return trailing and (befalls(clause.said) or not named)
        case "purpose", ("so" | "so that" | "where"):
            where = clause.joint == "where"
            # "So that you can open it, …" and "so that it stands, …" may ask for that.
            ahead = at == 0 and clause.joint == "so that" and clauses[1:] != []
            ahead = ahead and is_of_people(clause.said) and not clause.said.startswith("you ")
            if clause.joint == "so" and (
                tells_fact(clause.said, is_name) or is_unused(clause.said)
            ):
                return True  # "We had soup, so I am not hungry"
            return (trailing or ahead) and is_purpose(clause.said, is_name, where=where)
        case "purpose", _:
            return trailing and is_warning(clause.said)
        case "comment", _:
            return clause.comma and (
                is_comment(clause.said, is_name) or tells_fact(_whole_of(clause), is_name)
            )
    so = at + 1 < len(clauses) and clauses[at + 1].joint in ("so", "and so")
    planned = so and (
        is_desk_wish(clause.said)
        or is_plan(clause.said, is_name)
        or goes_there(clause.said, is_name)
        or stranger_is_there(clause.said, is_name)
    )
    if at == 0 and exclaims(clause.said, is_name):
        return True
    if at + 1 < len(clauses) and goes_to_it(clause.said, behind, first=at == 0):
        return True
    if (at or _is_whole(clauses, at)) and goes_with_somebody(clause.said, is_name):
        return True
    if _is_whole(clauses, at) and (
        fears_for(clause.said)
        or may_befall(clause.said)
        or goes_there_later(clause.said, is_name)
        or tells_of_others(clause.said, is_name, before_so=so)
    ):
        return True
    if (
        trailing
        and clause.comma
        and (
            goes_there(clause.said, is_name)
            or is_about_to(clause.said, is_name)
            or there_is_such(clause.said, is_name)
        )
    ):
        return True
    if dislikes(clause.said) or is_hindering(clause.said):
        return True
    if is_not_to_stay(clause.said) and told_of_thing(clause.said, is_name):
        return True
    if trailing and is_unspoilt(clause.said):
        return True
    if planned or wants_such_a_thing(clause.said, is_name):
        return True
    return (
        is_remark(clause.said, is_name)
        or bool(told_of_thing(clause.said, is_name))
        or tells_fact(clause.said, is_name)
    )


def _is_whole(clauses: Sequence[Clause], at: int) -> bool:
    """Whether a clause may be a sentence rather than an item of a list ("the pens, the keys")."""
    alone = all(item.is_polite for at_, item in enumerate(clauses) if at_ != at)
    behind = clauses[at + 1] if at + 1 < len(clauses) else None
    asked = behind is not None and (
        behind.joint in ("so", "and so", "but", "that is why", "therefore", "hence")
        or (not behind.joint and at == 0 and is_doing((behind.said.split() or [""])[0]))
        or (behind.is_polite and at == 0)
    )
    return alone or asked


def _of_which(asides: Sequence[Clause], rest: Sequence[str]) -> Iterator[str]:
    """What asides say; where it is left open which of several things is meant, "one" of the rest is
    one of these.
    """
    one = any("one" in said.split() for said in rest)
    for aside in asides:
        open_one = one and is_left_open(aside.whole) and _WHICH_ONE.match(aside.whole)
        yield f"the {open_one[1]}s" if open_one else aside.said


def _named(asides: Iterable[str], is_name: IsName) -> str:
    """What asides name in the scene, as a remark. Of what stands too close to something else more
    is said next, so that is named last and alone.
    """
    phrases, alone = list[str](), list[str]()
    for aside in asides:
        said = f"the {aside}" if _is_bare(aside, is_name) else _with_kind(aside, is_name)
        found = [in_state(said, phrase) for phrase in _phrases(said.split(), is_name)]
        alone += found[:1] if is_misplaced(said) else []
        phrases += found[1:] if is_misplaced(said) else found
    remarks = (" and ".join(dict.fromkeys(named)) for named in (phrases, alone))
    return ". ".join(f"{named} {ASIDE}" for named in remarks if named)


def _with_kind(said: str, is_name: IsName) -> str:
    """What is said of somebody, with an article for the kind of thing that he likes or cannot
    stand, of which the next sentence may mean the one that is there ("is allergic to lemons").
    """
    found = _OF_A_KIND.search(said) if is_of_people(said) else None
    known = found and found["kind"] != singular(found["kind"]) and is_name(found["kind"])
    return (
        f"{said[: found.start('kind')]}the {singular(found['kind'])}" if found and known else said
    )


def _is_bare(said: str, is_name: IsName) -> bool:
    """Whether what cannot stay is named without an article ("honey must not stand up there")."""
    return is_not_to_stay(said) and is_name(said.split()[0])


def _phrases(words: Sequence[str], is_name: IsName) -> Iterator[str]:
    """Phrases that name something in the scene."""
    for at, word in enumerate(words):
        if word in BEFORE_NAMES:
            counted = words[at + 1 : at + 2] in _LIKED or {*words[at + 1 : at + 2]} & {*NUMBERS}
            end = last = at + 1 + bool(counted)
            while end < len(words) and is_told_apart_by(words[end], is_name):
                end += 1
                last = end if is_name(words[end - 1]) else last
            if at + 1 < last == end < len(words) and words[end] in _PARTS:
                last += 1  # "the bottom drawer"
            if last > at + 1:
                owner = "the" if word in ("his", "her", "their") else word
                if re.match(rf"{PEOPLE}\b", " ".join(words[at:])):
                    continue  # "my hands" are no hand cream
                yield " ".join((owner, *(w for w in words[at + 1 : last] if [w] not in _LIKED)))


def _names_stranger(said: str, is_name: IsName) -> bool:
    """Whether something is named that the scene does not have, and no person."""
    words = _IS_ONE.sub(" ", said).split()
    return any(
        word in BEFORE_NAMES
        and words[at + 1] not in all_words()
        and not any(map(is_name, words[at + 1 : at + 4]))
        and not re.match(rf"{PEOPLE}\b", " ".join(words[at:]))
        for at, word in enumerate(words[:-1])
    )


def _refers_back(words: Sequence[str], is_name: IsName, meaning: frozenset[str]) -> bool:
    """Whether one of some pronouns comes before anything that is named."""
    return next((word in meaning for word in words if word in _PRONOUNS or is_name(word)), False)
