"""Whether a clause only tells something: what people did, how things are, what something is for.

A clause is taken for a request wherever it may be one: where it says what should be, what stays or
goes, where something is, or what tells one thing from another.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from etot_cli.reasoning.language.grammar.asides.lacking_room import lacks_room
from etot_cli.reasoning.language.grammar.asides.mishaps import befalls, is_spared
from etot_cli.reasoning.language.words import predicates, verbs
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.fillers import TURNED
from etot_cli.reasoning.language.words.known import OTHER_VERBS, VERB_WORDS, all_words
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    STATES,
    THING_NOUNS,
    is_descriptive,
    word_set,
)
from etot_cli.reasoning.language.words.patterns import words_of

IsName = Callable[[str], bool]
"""Whether something in the scene is called by a word."""
_RELATIONS = (
    "kids?|children|guests?|visitors?|boss|sister|brother|mother|mom|mum|father|dad|wife|husband|"
    "friends?|colleagues?|students?|neighbou?rs?|team|cat|dog|baby|family|customers?|clients?|"
    "patients?|grand(?:ma|pa)|granny|grandad|uncle|aunt|cousin|niece|nephew|parents|toddler|grandchild(?:ren)?|lady|ladies|gentlem[ae]n|wom[ae]n|son|daughter|grand(?:mother|father|son|daughter)|flatmate|teacher|doctor|nurse|roommate"
)
_OWN = (
    "hands?|feet|foot|back|eyes|knees?|arms?|legs?|head|fingers|throat|nose|shins?|elbows?|toes?|hips?"
    "|ankles?|wrists?|shoulders?|bus|train|taxi|shift"
)
"""Of people, and of nothing that is in a scene."""
PEOPLE = (
    r"(?:i|we|you|he|she|nobody|no one|somebody|someone|anybody|anyone|everybody|everyone|people"
    r"|grand(?:ma|pa)|granny|grandad|nan|mum|mom|dad|mummy|mommy|daddy"
    r"|(?:mr|mrs|ms|dr|miss) \w+"
    rf"|(?:(?:my|our|your|his|her|the|an?|one|another) )"
    rf"(?:(?:old|little|young|elder|dear|poor|older|younger) )?(?:{_RELATIONS}|little ones?)"
    rf"|(?:my|our) (?:{_OWN}))"
)
ON_ARRIVAL = (
    r"(?:when(?:ever)?|once|after|before|until|till|by the time|as soon as) "
    rf"(?:{PEOPLE}|they) (?:(?:finally|first|next) )?(?:gets?|comes?|arrives?|returns?|wakes?|"
    r"(?:is|are|am) (?=back|home|up|here|done|in))"
    r"(?: (?:back|home|in|up|here|done|down|over|out|around|tonight|tomorrow|later|today|again)"
    r"| (?:from|for|to) (?:the |my |our |his |her |their )?\w+)*"
)
"""When something is so with people."""
_PERSON = Expression(
    rf"^{PEOPLE} (?:just |already |also |really |always |still |usually |often |"
    r"never |hardly |rarely )*(?P<did>.+)$"
)
_SOMEBODY = Expression(rf"^(?P<who>{PEOPLE}) ")
_MISHAPS = "slip|trip|fall|break|spill|roll|tip|drop|get|knock|bump|lose|hurt|burn|cut|step"
_HAPPENED = Expression(
    r"(?:^forgot to (?:put|take|tidy|pack|clear) (?:\w+ )?away$"
    r"|^likes? (?:it|them|(?:my|our|his|her|the) \w+) "
    r"(?:cold|cool|warm|hot|chilled|fresh|clean|neat|better|best)(?= anyway|$)"
    r"|^(?:comes?|gets?) (?:back |home )+(?:late|early|soon|tired|hungry)\b"
    r"|^(?:can not (?:reach|see|find|get at|get to|lift|sleep|work|write|read)"
    r"|(?:do|will) not (?:be )?(?:need|use|using|miss)(?:ing)?|will not (?:bend|let (?:me|us)))\b"
    r"|^(?:am going to need|"
    r"would hate (?:it )?(?:for|if|to)|go to (?:sleep|bed|work|school)(?= |$))"
    rf"|^do not want (?:any(?:one|body|thing) |it |them )?(?=to (?:{_MISHAPS})\b)"
    r"|^(?:wants?|needs?|have|has|plans?|hopes?|would like|(?:am|are|is) (?:going|about)"
    r"|will have) to |^will (?!be\b|need\b|[^~]* (?:myself|ourselves)$)"
    r"|^(?:need|want) something to \w+(?: (?:with|on|from|in))?$"
    r"|^will [^~]* (?:myself|ourselves)$"
    r"|^keeps? (?:on )?(?!standing\b|lying\b|sitting\b)\w+ing\b"
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
_TAKES = Expression(
    r"^(?!you\b)[^~]+? (?:(?:always|usually|only) )?"
    r"(?:takes?|has|have|drinks?|eats?) (?!(?:the|an?|it|them|that|this|these|those|to)\b)"
    r"(?:no |some |lots of |plenty of )?\w+(?: (?:and|or|but no) (?:no )?\w+)?"
    r"(?: (?:in|with|on|for) (?:(?:his|her|my|our|their) )?(?:tea|coffee|cereal|porridge|toast"
    r"|breakfast|lunch|dinner|everything))?$"
)
"""What somebody takes in general ("my husband takes sugar in his tea")."""
_UNUSED = Expression(
    r"^(?:nobody|no one) (?:is going to |will |would |ever |really )*"
    r"(?:use|need|drink|eat|read|wear)s? "
)
_DOES = Expression(
    r"^(?:(?:will|might|may|could|can|would|does not|do not|did not|"
    r"will not|can not|keeps?) )?(?P<verb>\w+)"
)
_TIDYING = [["cleaning"], ["tidying"], ["packing"], ["moving"], ["clearing"], ["sorting"]]
"""What people are at who do not say what the robot is to do about it."""
_MAKING = [["making"], ["baking"], ["cooking"], ["building"], ["packing"]]
"""What people are at who tell what for, where the scene has none of it ("making soup")."""
_AT_TABLE = word_set("some today tonight now for and of breakfast lunch dinner supper dessert")
"""With what they make, and for when, which is nothing to the robot."""
PROPOSING = word_set(
    """
    suggest recommend propose expect insist demand require request vote choose pick say says tell
    ask beg advise order urge bet mean means vote count rely trust
    """
)
"""What somebody does who asks for something in a roundabout way."""
BIDDING = PROPOSING | word_set(
    """
    asked agreed having decided chosen chose ordered promised arranged suggested recommended voted
    told warned instructed let lets letting
    """
)
"""The same of what he has done or is doing ("we agreed on the cup")."""
ASKING = word_set(
    """
    want wants need needs wanted needed wish like prefer should must shall would could may let ought
    go goes belong belongs hoping wondering please not never no none nothing without if
    unless when until instead except only
    """
)
DECREEING = word_set(
    """
    forbid forbids forbidden prohibit prohibits prohibited ban bans banned bar bars barred taboo
    reserved reserve reserves allow allows allowed permit permits permitted require requires
    required excluded exclude excludes exempt limits bounds mandatory obligatory demands prevents
    prevent avoid avoids deserve deserves await awaits insists expects protected
    """
)
"""Words by which things are ruled out, or meant for something."""
CHANGING = word_set(
    """
    stay stays remain remains live lives come comes join joins move moves leave leaves open opens
    close closes shut shuts swap swaps switch switches return returns replace replaces change
    changes fit fits follow follows end ends better to by than
    """
)
"""What a thing does that somebody asks for, and words before such things."""
_DOING = {
    verb
    for verb in VERB_WORDS
    if VERB_WORDS & {f"{verb}ing", f"{verb[:-1]}ing", f"{verb}{verb[-1]}ing"}
} | {"open", "shut", "empty"}
"""What the robot could be asked to do."""
WORK = _DOING - {"clean", "tidy"}
"""Those that say nothing else of a thing."""
_ASKED = Expression(rf"\b(?:and|but|then|please) (?:\w+ )?(?:{'|'.join(sorted(_DOING))})\b")
_OUTSIDE = Expression(r"\b(?:is|are|was|were|has|have|had)\b(?! to\b)")
_TOO = Expression(
    r"^(?:it|they|that|(?:the|my|your|our) [^~]+) (?:is|are|looks?|gets?) (?:far |much )?too \w+"
)
_IN_GENERAL = Expression(
    rf"(?:^it is (?:(?:already|nearly|almost|just|about) )*(?:half past|(?:a )?quarter (?:past|to)"
    rf"|{'|'.join(sorted(set(NUMBERS) - {'a', 'an'}))})(?: (?:past|to) \w+)?(?: already)?$"
    r"|^it is (?:\w+ing|(?:\w+ )?(?:\w*time|late|early|dark|morning|noon|evening|night))$"
    r"|^it (?:is|gets|looks|feels) (?:so |very |too |"
    r"really |quite )?\w+ (?:in here|outside|out there)$"
    r"|^(?:the |our |my )?(?:\w+ )?\w*time is (?:over|up)(?: now)?$"
    rf"|^(?:it is )?time (?:for|to) "
    rf"(?!(?:{'|'.join(sorted(VERB_WORDS))}|the|a|my)\b)\w+(?: up| out)?$"
    r"|^(?:that|this|it) is where (?:i|we|it|they) "
    r"(?:like|want|need|keep|prefer|belongs?|goes?|lives?)"
    r"(?: it| them)?$|^(?:it|that|this) is (?:my|our|his|her) (?:favou?rite|best) \w+$"
    r"|^it is \w+time for (?:the|my|our) \w+(?: \w+)?$"
    r"|^let (?:me|us) (?:see|check|know) (?:what|if|whether|how)\b)"
)
_IN_PASSING = Expression(
    r"(?:(?:it|they) (?:is|are) "
    r"(?:(?:still|quite|very|really|rather|almost|too|nearly|half) )*full"
    r"(?: of \w+| to the (?:brim|rim|top))?"
    r"|(?:it|they) (?:is|are) (?:going|about) to (?:be|get) (?P<done>\w+(?:ed|t|n))"
    r"(?: (?:today|tomorrow|tonight|soon|later|next week|this week|in a (?:minute|moment)))?)"
)
_WHENEVER = Expression(r" (?:when|whenever|if|as soon as) (?:it|they|i|we|somebody|one) [^~]+$")
"""When something does what it does ("the tube leaks when it lies down")."""
_YONDER = Expression(r" (?:(?:over|up|down|in|out) )?(?:here|there)$")
REFERRING = word_set(
    "it they them this that these those one ones two three other others another rest everything "
    "anything all both each every any same here there first last which whichever whatever whoever"
)
"""They may speak of what was asked for ("one of them is enough")."""
BEFORE_NAMES = word_set("the a an my your our his her their this that these those both all")
_PREDICATE = Expression(
    r"(?:(?:is|are|was|were|has|have|had)(?: not| been| got)?|(?:does|do|did|will|can) not"
    r"|keeps?(?= \w+ing\b)|looks?|seems?|feels?|smells?|takes? up|gets?|got|fell|broke"
    r"|\w+[^s]s|\w+ed)"
    r"(?: (?:still|just|already|always|all|so|very|too|really|a bit|far|badly|quite|less|more))*"
    r"(?= |$)"
)
_A_BIT = Expression(
    r" (?:a (?:little|bit|lot)|quite a bit|by now|all the time|so often|every time)(?= |$)"
)
_TOO_SO = Expression(r"^(?:is|are|looks?|gets?) (?:far |much )?too \w+")
_TOO_BIG = Expression(
    r"^(?:is|are) (?:just |far |much |a bit |a little )*too \w+ "
    r"(?:to (?:stand|fit|lie|sit|go|be put)(?: (?:up|upright|straight|standing up|in|inside))?|for)"
    r"(?: (?:(?:in|into|on|onto|inside) )?(?:there|it|that|(?:the|my) (?:\w+ ){0,3}\w+))?$"
)
"""Why something lies rather than stands somewhere, or goes elsewhere."""
_NOT_STAYING = (
    r"(?:can|must|should|may|does|do) not (?:be (?:left|kept)|stay|remain"
    r"|(?:stand|lie|sit|belong|live|be|go)(?= (?:(?:up|down|over|out) )?(?:here|there)$))"
    r"(?: (?:like (?:this|that)|as (?:it is|they are)|that way|so))?"
)
_OVER_THE_EDGE = (
    r"(?:sticking|poking|peeking|hanging|jutting|bulging|spilling|protruding|leaning)"
    r"(?: (?:out|over|up|off|halfway))*(?: (?:of |over |at |from )?(?:the )?"
    r"(?:top|edge|side|rim|front))?"
)
_NO_PLACE = Expression(
    rf"(?:^belong(?:s|ed)? to {PEOPLE}$"
    rf"|^(?:is|are|was) (?:\w+ )?{_OVER_THE_EDGE}$|^(?:is|are) {PEOPLE} 's$"
    r"|^(?:is|are|stands|lies) in (?:the|my|our|your) way(?: (?:here|there))?$"
    r"|^(?:is|are) getting \w+$"
    r"|^(?:(?:always|constantly|often|just|only|easily) )*(?:roll|slide|slip|fall|tip|topple)s? "
    r"(?:off|over|away|down|around|everywhere|out)(?: (?:again|easily|constantly))?$"
    rf"|^(?:is|are) (?:going|turning) (?:{TURNED})$"
    rf"|^{_NOT_STAYING}$"
    r"|^(?:must|should) (?:stay|keep|remain|be kept) (?:warm|cold|cool|fresh)$"
    r"|^(?:needs?|has|have) to (?:stay|keep|remain|be kept) "
    r"(?:warm|cold|cool|dry|fresh|clean|safe)$)"
)
_NEEDED = Expression(r"^needs? (?:a |some )?(?:little |good )?(?P<done>\w+ing)$")
_DONE_TO_THINGS = VERB_WORDS | words_of(
    (verbs.COVER, verbs.UNCOVER, verbs.FILL, verbs.LOAD, verbs.THROW_AWAY, verbs.OPEN, verbs.CLOSE)
)
"""What a thing may need of the robot; whatever else it needs, such as chilling, is a reason."""
_TELLING = (
    word_set("full free clear ready taken occupied") | set(STATES) | set(LEVELS) | set(SIDES)
    | set(NUMBERS) - {"a", "an"} | set(THING_NOUNS) | REFERRING
)  # fmt: skip
"""They tell one thing from another, or say how one is to be."""
PLACED = word_set("in on into onto at next beside near off out")
_GONE_WRONG = Expression(r" (?:go|goes) (?:out|off|wrong|bad|missing|cold|home)$")
_THING = r"(?:the|my|our) (?:\w+ )?\w+"
_SO_OF_ITSELF = Expression(
    rf"^{_THING} (?:(?:stays?|keeps?|remains?) (?:warm|cold|cool|dry|fresh|clean|safe)"
    rf"|(?:do|does|will) not (?:get|go|turn) (?:{TURNED}))$"
)
_SO_IT_CAN = Expression(
    rf"^(?:it|they|{_THING}) (?:(?:can|could|will|may|might) (?:then )?"
    r"(?:be (?:closed|shut|opened)|close|shut|open|fit)|closes|shuts|fits)(?: again| properly)?$"
)
_UNFIT_THERE = Expression(
    rf"^(?P<what>it|they|(?:(?:the|my|our) )?(?:\w+ )?\w+) {_NOT_STAYING}"
    r"(?: (?:(?:up|down|over|out) )?(?:here|there))?$"
)
_TURNING = Expression(
    rf"(?: (?:(?:is|are) (?:getting|going|turning)|(?:has|have) gone) (?:{TURNED})$"
    r"|(?:must|should|(?:needs?|has|have) to) "
    r"(?:stay|keep|remain|be kept) (?:warm|cold|cool|fresh)$)"
)
"""Of whatever it is said, it asks for nothing."""


_NOBODY_DOES = Expression(rf"^(?:nobody|no one) (?:ever )?(?:{'|'.join(sorted(_DOING))})(?:e?s)?\b")


def is_forbidding(said: str) -> bool:
    """Whether a clause may forbid what it says that nobody does ("nobody touches the cup")."""
    return bool(_NOBODY_DOES.match(said))


def is_unused(said: str) -> bool:
    """Whether a clause tells that nobody needs something."""
    return bool(_UNUSED.match(said))


_SO_PEOPLE = Expression(
    rf"^{PEOPLE} (?:can|could|may|might|will|do|does|would|have|has|need not)\b"
)
_SO_NOTHING = Expression(
    r"^(?:(?:it|they) (?:stays?|keeps?|remains?) (?!open$|closed$|shut$|put$)\w+"
    r"|nothing (?:gets|can get|is|will be) (?:lost|broken|spilt|spilled|wet|dirty)"
    r"|(?:nobody|no one) [^~]+"
    r"|(?:it|they) (?:do|does|will|can|could|would) not (?:roll|fall|tip|spill|break|get|slip|slide"
    r"|cool|wobble|leak|melt|dry|rot|topple|burn)\b[^~]*)$"
)
_OR_WILL = Expression(rf"^(?:{PEOPLE}|it|they) \w+")
_COMMENT = Expression(r"^(?:is|are|was|were|has|have) ")


def is_in_passing(said: str) -> bool:
    """Whether this tells of what was spoken of why some care is taken, or what others will do with
    it ("it is full", "it is going to be painted tomorrow").
    """
    found = _IN_PASSING.fullmatch(said)
    done = (found and found["done"]) or ""
    stems = {done, done[:-1], done[:-2], done[:-3], f"{done[:-3]}y"}
    return found is not None and not stems & (
        _DONE_TO_THINGS | words_of((predicates.BROUGHT,)) | WORK
    )


def is_not_to_stay(said: str) -> bool:
    """Whether something cannot stay as or where it is, of which is not said how that is."""
    return bool(_UNFIT_THERE.match(said))


def is_doing(word: str) -> bool:
    """Whether a word says what the robot could be asked to do."""
    return word in _DOING


def asks_besides(said: str) -> bool:
    """Whether something is asked for behind what is told ("because I need it and put it …")."""
    return bool(_ASKED.search(said))


def is_of_people(said: str) -> bool:
    """Whether a clause is about somebody."""
    return bool(_PERSON.match(said))


def somebody(said: str) -> tuple[str, str] | None:
    """Who a clause is about, and what it says of him; none where it is about no person."""
    found = _SOMEBODY.match(said)
    return (found["who"], said[found.end() :]) if found else None


_RELATIVE = Expression(rf"^(?:the|my|our|your|his|her) (?:\w+ )?(?:{_RELATIONS}) ")


def is_of_relative(said: str, is_name: IsName) -> bool:
    """Whether a clause is about somebody and no thing of the scene ("the boss is on his way")."""
    return bool(_RELATIVE.match(said)) and not any(map(is_name, said.split()))


def is_purpose(said: str, is_name: IsName, *, where: bool = False) -> bool:
    """Whether this tells what is to be gained, behind "so" ("I can see it") or ``where``."""
    named = any(map(is_name, said.split()))
    if where:
        home = re.fullmatch(r"(?:it|they) (?:belongs?|goes?|lives?|should be)", said)
        return bool(_SO_PEOPLE.match(said) or home) and not named
    if _SO_PEOPLE.match(said) or (_SO_NOTHING.match(said) and not named):
        return True
    if _SO_OF_ITSELF.match(said) or is_made_possible(said) or is_spared(said):
        return True
    told_of = told_of_thing(said, is_name)
    return bool(told_of and re.search(r" (?:is|are|looks?|seems?|feels?) ", said))


def is_made_possible(said: str) -> bool:
    """Whether this tells, behind "so that", what can be done then ("the drawer can be closed")."""
    return bool(_SO_IT_CAN.match(said))


def is_turning(said: str) -> bool:
    """Whether this tells how something gets by itself, as food that stands in the warmth."""
    return bool(_TURNING.search(said))


def is_warning(said: str) -> bool:
    """Whether this tells, behind "or", what else would happen ("it will fall")."""
    return befalls(said) or (
        bool(_OR_WILL.match(said))
        and not (_DOING - {"get"} | ASKING - {"will", "would", "not"}) & {*said.split()}
    )


def is_comment(said: str, is_name: IsName) -> bool:
    """Whether a relative clause behind a comma tells nothing apart ("which is fragile")."""
    if is_of_people(said):
        return is_remark(said, is_name) and not any(map(is_name, said.split()))
    return bool(_COMMENT.match(said)) and _is_idle(said, is_name)


_YOU_DO = Expression(r"^you (?:then )?(\w+)")


_IS_OPEN = Expression(
    rf"(?:it|they|{_THING}) (?:is|are|stands?)(?: (?:still|already|now|currently|just|wide|half))* "
    r"(?:open|closed|shut|ajar)"
)


def is_reason(said: str, is_name: IsName) -> bool:
    """Whether this may stand behind "because" and asks for nothing itself."""
    if _IS_OPEN.fullmatch(said):
        return True
    said = _GONE_WRONG.sub(" fails", said)
    words = {*said.split()}
    asked = _YOU_DO.match(said)  # "even if you have to move it" asks for nothing
    if asked and asked[1] in VERB_WORDS - OTHER_VERBS - {"have"} and any(map(is_name, words)):
        return False  # "as you move the cup over there, keep it upright"
    if "going" in words and PLACED & words and any(map(is_name, words)):
        return False  # "as it is going in the box"
    if not is_of_people(said):
        return not (ASKING | CHANGING - {"to", "by", "than"} | WORK) & words
    wanted = {"want", "wants", "like", "prefer", "need", "needs"} & words
    return not (wanted and PLACED & words and any(map(is_name, words)))


_THEN = Expression(rf" {ON_ARRIVAL}$")
"""Behind what somebody is or does it is no condition for what is asked for."""


def is_remark(said: str, is_name: IsName) -> bool:
    """Whether this tells what somebody did, or how things outside of the scene are."""
    if is_of_people(said) and (then := _THEN.search(said)):
        return not any(map(is_name, said.split())) and is_remark(said[: then.start()], is_name)
    words = said.split()
    person = _PERSON.match(said)
    if is_in_passing(said):
        return True
    if asks_besides(said) or lacks_room(said):
        return lacks_room(said)
    if is_forbidding(said):
        return False
    if person:
        happened, habit = _HAPPENED.match(person["did"]), _HABIT.match(person["did"])
        takes = _TAKES.match(said) and not (ASKING | REFERRING | WORK - {"take"}) & {*words[2:]}
        if _UNUSED.match(said) or takes or (habit and _is_of_no_thing(habit, words, is_name)):
            return True
        if happened is None:
            verb, *more = person["did"].split()
            named = more if verb in OTHER_VERBS else words  # "I drink from it" is of no drink
            return not any(map(is_name, named)) and _does_nothing(person["did"])
        if BIDDING & {*words} and any(map(is_name, words)):
            return False
        did = person["did"].removeprefix(happened[0]).split()
        if happened[0].endswith((" to ", "will ")):
            has = did[0] == "have" and not (PLACED | ASKING | {*STATES}) & {*did}
            himself = words[0] != "you" or happened[0] != "will "
            return himself and (has or did[0] in OTHER_VERBS or did[0] not in all_words())
        if happened[0].startswith(("would hate", "do not want")):
            return not any(map(is_name, words))
        placed = PLACED & {*did} and any(map(is_name, did))
        if did[:1] == ["to"] or (placed and happened[0].startswith(("like", "love", "hate"))):
            return False  # "nobody is to use it", "she likes the cup on the tray"
        if did[:1] in _TIDYING and not any(map(is_name, words)):
            return True
        if did[:1] in _MAKING and did[1:] and not any(map(_is_known_to(is_name), did[1:])):
            return True
        jointly = {word for word in did if words[0] in ("you", "we") and word in VERB_WORDS}
        return not ((WORK | ASKING) & {*did} or any(word.endswith("ing") for word in jointly))
    outside = _TOO.search(said) or (_OUTSIDE.search(said) and not any(map(is_name, words)))
    told = _TOO.sub("", said).split()  # "too close" is no "close"
    asking = (WORK | ASKING | REFERRING) & {*told}
    return bool(_IN_GENERAL.match(said) or (outside and not asking))


def _is_known_to(is_name: IsName) -> Callable[[str], bool]:
    """Whether a word may be about the scene, or about what is done in it."""
    known = all_words() - BEFORE_NAMES - _AT_TABLE
    return lambda word: word in known or is_name(word)


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


def told_of_thing(said: str, is_name: IsName) -> tuple[str, ...]:
    """The words for something in the scene of which this tells what places nothing, singles nothing
    out and speaks of nothing else; none where it does not.
    """
    if unfit := _UNFIT_THERE.match(said):
        what = [word for word in unfit["what"].split() if word not in BEFORE_NAMES]
        return tuple(what) if is_name(what[-1]) or what[-1] in ("it", "they") else ()
    words = _YONDER.sub("", _WHENEVER.sub("", said)).split() or [""]
    end = _named_until(words, is_name)
    while words[end : end + 1] == ["and"] and words[end + 1 : end + 2] == ["the"]:
        end += 1 + _named_until(words[end + 1 :], is_name)  # "the tape and the pencil are trash"
    if words[0] in ("it", "they") and _is_idle(" ".join(words[1:]), is_name):
        return (words[0],)
    if words[0] not in BEFORE_NAMES or end == 1 or not is_name(words[end - 1]):
        return ()
    return tuple(words[1:end]) if _is_idle(" ".join(words[end:]), is_name) else ()


def is_told_apart_by(word: str, is_name: IsName) -> bool:
    """Whether a word may stand in a phrase for something of the scene ("that open drawer")."""
    return is_name(word) or is_descriptive(word) or word in STATES or word in LEVELS


def _named_until(words: Sequence[str], is_name: IsName) -> int:
    """Where a phrase for something of the scene ends, which begins with the first word."""
    end = 1
    while words[end : end + 1] and is_told_apart_by(words[end], is_name):
        end += 1
    return end


def _is_idle(predicate: str, is_name: IsName) -> bool:
    """Whether a predicate is such a one."""
    if _TOO_BIG.match(predicate) or _TOO_SO.fullmatch(predicate):
        return True
    predicate = _TOO_SO.sub("is so", _A_BIT.sub("", predicate))
    needed = _NEEDED.match(predicate)
    if _NO_PLACE.match(predicate) or (needed and needed["done"] not in _DONE_TO_THINGS):
        return True
    found = _PREDICATE.match(predicate)
    if not found:
        return False
    verb, *_ = found[0].split()
    more = {*predicate[found.end() :].split()}
    stems = {verb, *(verb.removesuffix(ending) for ending in ("s", "es", "d", "ed"))}
    asking = (ASKING | CHANGING | WORK | DECREEING) - {"not"}
    if asking & more or (asking - {"get", "keep"}) & stems or _TELLING & more:
        return False
    if any(is_name(word) or is_descriptive(word) for word in more):
        return False
    return bool(more) or verb not in all_words()
