"""Whether a clause leaves something open, wonders at how things are, or tells what somebody will do
himself: none of them asks for anything.
"""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.asides.asking_words import (
    ASKING,
    PLACED,
    REFERRING,
    IsName,
    asks_besides,
)
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, LEVELS, SIDES, THING_NOUNS

_I = r"(?:i|we)"
_NOT_CARING = (
    rf"(?:{_I} (?:really )?do not (?:really |much )?(?:care|mind)(?: much)?"
    r"|it (?:really )?does not (?:really )?matter|no matter"
    r"|it is (?:not important|unimportant|up to you|your (?:choice|decision)|all the same)"
    r"|it makes no difference)(?: to (?:me|us))?"
)
_NO_MATTER = (
    r"(?:(?:does|do) not (?:really )?matter(?: much| at all)?"
    r"|(?:is|are) (?:not important|unimportant|irrelevant|up to you|your choice|all the same"
    r"|(?:entirely |all )?(?:your (?:own )?(?:affair|business|decision)|up to you))"
    r"|makes? no difference)(?: to (?:me|us))?"
)
_WORDS = r"(?: (?!(?:not|only|never|no|but|except|unless|if|than|instead|and|or)\b)[^ ~]+)"
"""What is left open with another word may be half of what is asked for."""
_BOTH = r"(?: the (?:\w+ )?\w+ and the (?:\w+ )?\w+)"
_STAYS = r"(?:stays?|remains?|is|are|(?:can|may) (?:stay|remain|be))"
_WHETHER = (
    rf"(?:(?:whether|if)(?! (?:you|i|we)\b)(?:{_WORDS}+ or (?:not|{_STAYS}{_WORDS}*)"
    rf"|{_WORDS}+? {_STAYS}{_WORDS}* or{_WORDS}+)|whether or not(?! you\b| i\b| we\b){_WORDS}+"
    rf"|(?:whether|if) you (?:approach|grasp|grip|grab|hold)(?:{_WORDS}| or)+)"
)
"""What is so by now or not ("whether it stays there or goes on the desk")."""
_OF_THEM = r"(?: one| of (?:them|these|those|the \w+))?"
_WHAT = (
    rf"(?:(?:where|how){_BOTH}?{_WORDS}+|how|where"
    rf"|(?:in )?(?:what|which) order(?! you [^~]* (?:in|on|into|onto) (?:the|my|a)\b){_WORDS}*"
    rf"|(?:what|which) (?:\w+ ){{0,4}}?(?:it|they|you)\b{_WORDS}*"
    r"|(?:what|which) (?:\w+ ){0,4}?to (?:use|choose|take|pick)"
    rf"|(?:what|which) (?:\w+ )??\w+ (?:is|are|gets?) (?:used|chosen|taken|picked)"
    rf"|which{_OF_THEM}(?: (?:goes|go|ends? up|is put) (?:where|in which))?"
    rf"|what (?:happens to|becomes of){_WORDS}+|whether(?! you\b| i\b| we\b){_WORDS}+|{_WHETHER})"
)
_AT = "|".join(sorted({*LEVELS, *SIDES}))
_EITHER = rf"(?:the )?(?:{_AT})(?: \w+)? or (?:the )?(?:{_AT})(?: (?!or\b)\w+)??"
"""Either of two of a place's parts ("lower or upper")."""
_ON_DESK = rf"(?: on the (?:{'|'.join(DESK_NOUNS)}))?"
_MANNER = r"(?:(?:grasp|grip|approach) (?:direction|pose)|grasp|grip|pose|orientation|order|way)"
_OF_HOLDING = r"(?: of (?:grasp|gripp|hold|grabb|lift|tak|approach)ing (?:it|them))?"
_OF_DOING = (
    r"(?: (?:in which |that |)(?:you (?:do|move|take|put|place|handle)"
    r" (?:this|that|it|them|these|things)"
    r"|(?:this|that|it) (?:is done|happens)|(?:they|things) are (?:done|moved|put|placed)))"
)
_TOGETHER_OR_APART = (
    r"(?:split|keep|leave|put|store|separate|part|divide|stay|go|have)(?: (?:them|both|the two))?"
    r"(?: (?:up|together|apart|separately|in one(?: place)?|both|as (?:a pair|one)|side by side))*"
)
_LEFT_OPEN = Expression(
    rf"(?:{_NOT_CARING}(?: {_WHAT}| which \w+(?: (?:it|that|this) is)?)?"
    rf"|(?:{_WHAT}|{_EITHER}|(?:what|which) \w+) {_NO_MATTER}"
    rf"|(?:no matter )?whether(?! you\b){_WORDS}+ or not"
    r"|(?:\w+ )?(?P<thing>\w+) or no (?P=thing)"
    rf"|(?:you|they) (?:can|may|could|might) {_TOGETHER_OR_APART} or (?:else )?"
    rf"(?:(?:you|they) (?:can|may) )?{_TOGETHER_OR_APART}"
    rf"|the (?:exact )?{_MANNER}{_OF_DOING}? {_NO_MATTER}"
    rf"|(?:any|either|both|all) {_MANNER}s?{_OF_HOLDING} (?:(?:is|are) (?:both |equally |also )?"
    r"(?:fine|ok|okay|good|all right|alright)|will do|would do|works?)"
    r"(?: (?:for|with|by) me)?"
    r"|(?:(?:the|my|our) (?:(?!not\b)\w+ ){1,3}|(?:it|they) )(?:can|may|might|could)"
    r" (?:go|be|end up|stand|lie|be put) (?:just )?"
    rf"(?:(?:anywhere|wherever)(?: you (?:like|want)| else{_ON_DESK})?|elsewhere{_ON_DESK})"
    r"|do (?:what|as|it how|it however|whatever) you (?:like|want|please))"
)
_WHICH_PLACE = Expression(
    rf"(?:{_NOT_CARING} )?(?:what|which) \w+(?: one)?{_WORDS}+(?: {_NO_MATTER})?"
)
"""Where something goes, where what is asked for says so."""
_ANY_WILL_DO = Expression(
    r"(?:any|either) (?:\w+ ){1,4}?(?:will do|would do|is (?:fine|ok|okay)|works)(?: for me)?"
)
_PLANNED = Expression(
    r"(?:i|we) (?:(?:just|also|still|soon) )?(?:(?:have|need|want|would like|plan|hope) to"
    r"|(?:am|are) (?:going|about) to|will(?: have to| need to)?) (?P<did>\w+(?: [^~]+)?)$"
)
"""What somebody is about to do."""
_WONDERING = Expression(
    r"(?:why (?:is|are|was|were|has|have|did)|how come|who (?:left|put|opened|closed|moved|took"
    r"|forgot|has left|has put|has moved|has opened|has closed))\b(?!.*\b(?:not|you)\b)"
)


def is_left_open(said: str) -> bool:
    """Whether somebody does not mind what a clause is about ("i do not care where it ends up")."""
    return bool(_LEFT_OPEN.fullmatch(said))


def leaves_choice(said: str) -> bool:
    """Whether behind a clause "as long as" says what is asked for, of whatever is left open."""
    return any(found.fullmatch(said) for found in (_LEFT_OPEN, _ANY_WILL_DO, _WHICH_PLACE))


_TIDY = "(?:clear|tidy|clean|empty|free|neat|uncluttered)"
_WISHED = rf"{_I} (?:want|need|like|would like|prefer)(?: to have)?"
_DESK = rf"(?:{'|'.join(DESK_NOUNS)})"
_TIDY_DESK = Expression(
    rf"(?:{_WISHED} (?:the|my|our) {_DESK} (?:to be )?{_TIDY}|{_WISHED} an? {_TIDY} {_DESK}"
    rf"|(?:the|my|our) {_DESK} (?:should|must|has to|needs to) "
    rf"(?:be {_TIDY}|look (?:{_TIDY}|decent|nice|presentable|good|respectable)))"
)


def is_desk_wish(said: str) -> bool:
    """Whether somebody wants his desk clear, before what is to be done for that."""
    return bool(_TIDY_DESK.fullmatch(said))


def is_plan(said: str, is_name: IsName) -> bool:
    """Whether somebody is about to do something himself with what is not in the scene, before "so"
    ("I have to put my lunch in the microwave").
    """
    found = _PLANNED.match(said)
    if not found or asks_besides(said):
        return False
    words = found["did"].split()
    at = next((at for at, word in enumerate(words) if word in PLACED), len(words))
    told = words[1:at]
    vague = (REFERRING | ASKING | {*THING_NOUNS}) - {"something"}
    return not (any(map(is_name, told)) or vague & {*words})


def is_wondering(sentence: str) -> bool:
    """Whether a question only wonders at how things are ("why is it still open")."""
    return bool(_WONDERING.match(sentence))
