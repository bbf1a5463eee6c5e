"""Whether a clause only tells something: what people did, or how things outside of the scene are.

A clause is taken for a request wherever it may be one: where it says what should be, what stays or
goes, where something is, or what tells one thing from another.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    BIDDING,
    DOING,
    PLACED,
    PROPOSING,
    WORK,
    IsName,
    asks_besides,
)
from etot_cli.reasoning.language.grammar.asides.people import (
    ON_ARRIVAL_THEN,
    PEOPLE,
    deed_of,
    is_of_people,
)
from etot_cli.reasoning.language.grammar.asides.told_of_things import is_in_passing
from etot_cli.reasoning.language.grammar.asides.vague_wishes import lacks_room
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import NUMBERS, STATES, word_set

_MISHAPS = "slip|trip|fall|break|spill|roll|tip|drop|get|knock|bump|lose|hurt|burn|cut|step"
_HAPPENED = Expression(
    r"(?:^forgot to (?:put|take|tidy|pack|clear) (?:\w+ )?away$"
    r"|^likes? (?:it|them|(?:my|our|his|her|the) \w+) "
    r"(?:cold|cool|warm|hot|chilled|fresh|clean|neat|better|best)(?= anyway|$)"
    r"|^(?:comes?|gets?) (?:back |home )+(?:late|early|soon|tired|hungry)\b"
    r"|^(?:(?:can|could) (?:not|never|hardly|barely|rarely)(?: ever)? "
    r"(?:reach|see|find|get at|get to|lift|sleep|work|write|read)"
    r"|(?:do|will) not (?:be )?(?:need|use|using|miss)(?:ing)?|will not (?:bend|let (?:me|us)))\b"
    r"|^(?:insists?(?: on (?:it|that))?|demands? (?:it|that|so)|told me so)$"
    r"|^(?:am going to need|"
    r"would hate (?:it )?(?:for|if|to)|go to (?:sleep|bed|work|school)(?= |$))"
    rf"|^do not want (?:(?:anything|it|them|him|her|us|{PEOPLE}) )?(?=to (?:{_MISHAPS})\b)"
    r"|^(?:wants?|needs?|have|has|plans?|hopes?|would like|(?:am|are|is) (?:going|about)"
    r"|will have) to |^will (?!be\b|need\b|[^~]* (?:myself|ourselves)$)"
    r"|^(?:need|want) something to \w+(?: (?:with|on|from|in))?$"
    r"|^will [^~]* (?:myself|ourselves)$"
    r"|^(?:worry|look|work|like(?! (?:the|my|our|your|this|that|these|those|it|them)\b))\b"
    r"|^(?:have|has|had|am|are|is|was|were|likes|loves?|hates?|broke|bought|left|made|forgot|lost|"
    r"found|got|did|went|came|ate|drank|saw|spilt|felt|gave|sent|"
    r"sold|will (?:be|need)|hope|think|know|"
    r"(?!(?:want|lik|wish|ask|hop|expect|prefer)\w*ed\b|need)\w+ed|forget|lose|spill)\b)"
)
"""What somebody did, is or is about to do."""
_HABIT = Expression(
    r"^(?:take|have|drink|eat|like|love|prefer)s? (?:my|our|his|her|their) (?P<what>\w+) "
)
"""What somebody has as he likes it, which is no thing of the scene ("I take my tea with lemon")."""
_UNUSED = Expression(
    r"^(?:nobody|no one|(?:hardly|barely) any(?:one|body)|none of (?:us|them|you)) "
    r"(?:(?:is|are) going to |will |would |ever |really |actually |still )*"
    r"(?:use|need|want|drink|eat|read|wear)s? "
)
_DOES = Expression(
    r"^(?:(?:will|might|may|could|can|would|does not|do not|did not|"
    r"will not|can not|keeps?) )?(?P<verb>\w+)"
)
_IN_GENERAL = Expression(
    r"(?:^it is (?:(?:already|nearly|almost|just|about) )*"
    r"(?:(?:half past|(?:a )?quarter (?:past|to)) \w+"
    rf"|{'|'.join(sorted(set(NUMBERS) - {'a', 'an'}))})(?: (?:past|to) \w+)?"
    r"(?: o ?'clock)?(?: already)?$"
    r"|^it is (?:(?:already|nearly|almost|just) )*the (?:very )?(?:end|start|beginning|middle"
    r"|(?:last|first) (?:day|hour)) of (?:the|our|my|a|this) (?:(?:working|school|long|busy) )*"
    r"(?:day|week|month|year|shift|lesson|class|term|morning|afternoon|evening|night|weekend)$"
    r"|^it is (?:\w+ing|(?:\w+ )?(?:\w*time|late|early|dark|morning|noon|evening|night))$"
    r"|^it (?:is|gets|looks|feels) (?:so |very |too |"
    r"really |quite )?\w+ (?:in here|outside|out there)$"
    r"|^(?:the |our |my )?(?:\w+ )?\w*time is (?:over|up)(?: now)?$"
    rf"|^(?:it is )?time (?:for|to) "
    rf"(?!(?:{'|'.join(sorted(VERB_WORDS))}|the|a|my)\b)\w+(?: up| out)?$"
    rf"|^(?:that|this|it) is (?:where|how|why|when) (?:{PEOPLE}|it|they) "
    r"(?:(?:always|usually|often) )?\w+(?: (?:for|at|to|after))?(?: it| them)?$"
    r"|^(?:it|that|this) is (?:my|our|his|her) (?:favou?rite|best) \w+$"
    r"|^it is \w+time for (?:the|my|our) \w+(?: \w+)?$"
    r"|^let (?:me|us) (?:see|check|know) (?:what|if|whether|how)\b)"
)


_NOBODY_DOES = Expression(rf"^(?:nobody|no one) (?:ever )?(?:{'|'.join(sorted(DOING))})(?:e?s)?\b")
_WILL = word_set("will shall may can could would is are am")
_GIVEN = Expression(
    r"\bbe (?:given|shown|handed|offered|served|provided|supplied|issued|assigned|brought|sent) "
)
"""Of people to whom a thing is to be brought ("each student will be given a cup")."""


def is_forbidding(said: str, is_name: IsName) -> bool:
    """Whether a clause may forbid what it says that nobody does ("nobody touches the cup"), or all
    but what it says will be done ("the guests will use the red cup only"), or ask for that.
    """
    words = said.split()
    asked = ("only" in words and _WILL & {*words}) or _GIVEN.search(said)
    return bool((asked and any(map(is_name, words))) or _NOBODY_DOES.match(said))


def is_unused(said: str) -> bool:
    """Whether a clause tells that nobody needs something."""
    return bool(_UNUSED.match(said))


_PLACING = ("like", "love", "hate", "is", "are", "am", "has", "have")
"""Behind which a place says where something is to be, or somebody is no thing of the scene."""


def is_remark(said: str, is_name: IsName) -> bool:
    """Whether this tells what somebody did, or how things outside of the scene are."""
    if is_of_people(said) and (then := ON_ARRIVAL_THEN.search(said)):
        return not any(map(is_name, said.split())) and is_remark(said[: then.start()], is_name)
    words = said.split()
    deed = deed_of(said)
    if is_in_passing(said):
        return True
    if asks_besides(said) or lacks_room(said):
        return lacks_room(said)
    if is_forbidding(said, is_name):
        return False
    if unused := _UNUSED.match(said):
        # "Nobody needs it in the box", "open", "moved" may say how it is to be.
        what = {*said[unused.end() :].split()}
        done = any(word.endswith("ed") and word != "red" for word in what)
        how = WORK | ASKING | PLACED | {*STATES, "to", "back", "there", "here", "left", "taken"}
        return not (done or how & what)
    if deed:
        happened, habit = _HAPPENED.match(deed), _HABIT.match(deed)
        if habit and _is_of_no_thing(habit, words, is_name):
            return True
        if happened is None:
            verb, *more = deed.split()
            named = more if verb in OTHER_VERBS else words  # "I drink from it" is of no drink
            return not any(map(is_name, named)) and _does_nothing(deed)
        if BIDDING & {*words} and any(map(is_name, words)):
            return False
        did = deed.removeprefix(happened[0]).split()
        if happened[0].endswith((" to ", "will ")):
            has = did[0] == "have" and not (PLACED | ASKING | {*STATES}) & {*did}
            himself = words[0] != "you" or happened[0] != "will "
            return himself and (has or did[0] in OTHER_VERBS or did[0] not in all_words())
        if happened[0].startswith(("would hate", "do not want")):
            return not any(map(is_name, words))
        placed = PLACED & {*did} and any(map(is_name, did))
        if did[:1] == ["to"] or (placed and happened[0].startswith(_PLACING)):
            return False  # "nobody is to use it", "she likes the cup on the tray"
        jointly = {word for word in did if words[0] in ("you", "we") and word in VERB_WORDS}
        return not ((WORK | ASKING) & {*did} or any(word.endswith("ing") for word in jointly))
    return bool(_IN_GENERAL.match(said))


def _is_of_no_thing(habit: re.Match[str], words: Sequence[str], is_name: IsName) -> bool:
    """Whether what somebody has as he likes it is no thing of the scene, nor is to be at one."""
    strange = not is_name(habit["what"]) and habit["what"] not in all_words()
    return strange and not (PLACED & {*words} and any(map(is_name, words)))


def _does_nothing(did: str) -> bool:
    """Whether this is what somebody does that is nothing to the robot ("trips over it")."""
    verb, more = _DOES.match(did), {*did.split()}
    asking = ASKING - {"will", "would", "could", "may", "not"}
    if verb is None or (WORK - OTHER_VERBS | asking) & more:
        return False
    stems = {verb["verb"], verb["verb"].removesuffix("s"), verb["verb"].removesuffix("es")}
    known = any(stem in all_words() and stem not in OTHER_VERBS for stem in stems)
    doing = any(word in VERB_WORDS and word.endswith("ing") for word in more)
    return not (known or doing or PROPOSING & stems)
