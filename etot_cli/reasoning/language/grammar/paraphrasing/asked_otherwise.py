"""What is wanted, permitted or proposed in words of everyday speech, put into plain ones."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.paraphrasing.listings import ASKED
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import (
    KIND_NOUNS,
    LEVELS,
    OPEN_VESSELS,
    THING_NOUNS,
    is_descriptive,
    singular,
)
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE
from etot_cli.reasoning.language.words.verbs import DOING_OF, PERFORMED

_THERE = r"(?:in|on|inside|into|onto|next to|beside|behind|between|under)\b"
_ONE = r"(?:the|my|our) (?:(?!and\b|or\b|in\b|on\b|to\b)\w+ ){0,3}?\w+"
_ANY = (
    r"(?:the|my|our|an?|one of the|any|either) (?:(?!and\b|or\b|in\b|on\b|to\b|of\b)\w+ ){0,3}?"
    r"(?!robot\b|arm\b|gripper\b)\w+"
)
_HOLD = dict.fromkeys(("receive", "house", "take"), "hold")
"""Verbs for what a vessel does, put into the plain one; others say whether it is in or on it."""
_FINE = (
    r"(?:(?:is|would be|will be|should be) (?:fine|ok|okay|good|all right|alright|best|perfect)"
    r"|(?:will|would|should) do|works)(?: (?:for|with|by) (?:me|us|now))?"
)
_GO_AWAY = (
    rf"(?:out of (?:the|my|our) way|aside|away(?: from {_ONE})?"
    rf"|(?:off|out of|from) (?:{_ONE}|it))"
)
_FROM_STATE = (
    r"from (?:(?:half |being )?(?:open|closed|shut)|ajar) to "
    r"(?=(?:being )?(?:fully |completely |wide )?(?:open|closed|shut)\b)"
)
_COMPARED = (
    r"(?:bigger|larger|smaller|taller|shorter|longer|wider|narrower"
    r"|(?:further|farther|more) to the (?:left|right|front|back)"
    rf"|(?:closer|nearer) to {_ONE}|(?:still )?(?:empty|free|open|closed|shut))"
)
_WISH = Expression(
    r"(?:(?<=^)|(?<=[.;!?,:] )|(?<=\b(?:and|but) ))(?:i|we) (?P<no>do not |would not )?"
    r"(?:would )?(?:really |just )?(?:want|need|like|prefer)\b[^.;!?]* left (?:in|on|inside)\b"
    r"[^.;!?]*"
)
_LEFT_THERE = Expression(
    r"(?P<with>\bwith (?=(?:the|my|our|both|all)\b))?(?P<what>(?:(?!\bwith\b)[^,;])*?"
    r"(?<!\bbe)(?<!\bis)(?<!\bare)(?<!\bthe)(?<!\bthat)(?<!\bhave)) left "
    r"(?=(?:in|on|inside) (?:the|my|our|it|them)\b)"
)
_NONE = Expression(r"\b(?:nothing|none|no) (?:\w+ ){0,3}?left\b")
_ONLY_WISH = r"(?:want|need|would like|care to have|wish)"
_MOVED = r"(?:moved|put|placed|taken|brought|set|returned|transferred|dropped|to (?:go|be|end up))"
_FROM = Expression(
    rf"^({ASKED})(?:(?:starting|counting|going|beginning) )?from (?:the |your )?(left|right)"
    r"(?: to (?:the )?(?:left|right))?,? ((?:[^.;]*?\b)?the (?:first|second|third|last) [^.;]*)"
)
_NOUN = r"(?!(?:in|on|to|into|onto|one|goes|go|should|belongs)\b)\w+"
_NTH = Expression(
    rf"\bthe (first|second|third|fourth|last)(?: ({_NOUN}(?: {_NOUN})?))?(?: one)?"
    r"(?= (?:in|on|into|onto|to|inside|goes|should|belongs|next)\b)"
)

_RIDER = r"(?:the |my )?((?!and\b|the\b)\w+(?: \w+)?) (?:included|and all)"
_VESSELS = OPEN_VESSELS.union(KIND_NOUNS["cup"], KIND_NOUNS["bowl"], ("dish", "mortar"))
_INCLUDED = Expression(
    rf"^({ASKED})((?:put|place|move|get|take|bring|set|stand|carry|transfer|store|stow) (?:the|my) "
    r"((?:\w+ ){0,2}?\w+))"
    rf"(?:, {_RIDER},(?= {WHERE})([^.,;:]*)|(?= (?:and|with|{WHERE})[^,;:]*)([^.;:]*?), {_RIDER})"
    r"(?=[.,;!?]|$)"
)


def _as_verb(said: re.Match[str]) -> str:
    """What is asked for by a noun, by its verb."""
    verb = DOING_OF.get(said["noun"]) or (PERFORMED.get(said["noun"]) if said["does"] else None)
    if not verb:
        return said[0]
    wish = said["who"] and f"{said['who']} want you to"
    when = said["when"] and f"{said['when']} you"
    return f"{said['ahead'] or ''}{wish or when or (said['is'] and 'is to') or ''} {verb} ".lstrip()


def _whichever(said: re.Match[str]) -> str:
    """One of two things, told by how it is, each with the noun that may stand with one of them."""
    one, other, where, so = said.groups()
    noun, behind = one.split()[-1], other.split()[-1]
    if behind == "one":
        other = f"{other.removesuffix('one')}{noun}"
    elif len(one.split()) == 2 and (is_descriptive(noun) or noun in LEVELS):
        one = f"{one} {behind}"
    return f"the one of {one} and {other} that is {so}{where or ''}"


def _stays(wish: re.Match[str]) -> str:
    """What is wanted "left" somewhere: there still, or there no longer where it is not wanted."""
    if _NONE.search(wish[0]):
        return wish[0]
    if wish["no"]:
        return _LEFT_THERE.sub(lambda said: f"{said['with'] or ''}{said['what']} ", wish[0])
    return _LEFT_THERE.sub(
        lambda said: f"{'and ' if said['with'] else ''}{said['what']} to stay ", wish[0]
    )


def _counted_from(said: re.Match[str]) -> str:
    """What is counted from a side that is said ahead of it."""
    asked, side, rest = said.groups()
    noun = ""

    def told(item: re.Match[str]) -> str:
        nonlocal noun
        noun = item[2] or noun
        return f"the {item[1]} {noun} from the {side}" if noun else item[0]

    return f"{asked}{_NTH.sub(told, rest)}"


def _goes_along(said: re.Match[str]) -> str:
    """What stands in or on a thing that goes somewhere "included": it stays there."""
    please, asked, thing, ahead, where, there, behind = said.groups()
    noun, rider, rest = thing.rpartition(" ")[2], ahead or behind, where or there
    if singular(noun) != noun or noun in THING_NOUNS:
        return said[0]
    if rider == "contents":
        return f"{please}{asked}{rest}, contents and all"
    kept = f"keep the {rider} {'in' if noun in _VESSELS else 'on'} the {thing}"
    return f"{please}{asked} with the {rider}{rest} and {kept}"


_WITH_IT = rf"with {NAMED} (?:\w+ ){{0,2}}?(?!ones?\b)\w+ (?:on|in|inside) it"
ASKED_OTHERWISE: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "Please kindly to put one in the box and other one on the tray", by who speaks another tongue
    (
        r"\b(please(?: kindly)?|kindly) to (?=(?:put|place|move|take|pick|bring|open|close)\b)",
        r"\1 ",
    ),
    (
        r"\b((?:must|should|have to|need to|you to) [^.,;!?]*? and )to "
        r"(?=(?:put|place|move|take|pick|bring|open|close)\b)",
        r"\1",
    ),
    (r"\b(one [^.;]*? and )(?=other one\b)", r"\1the "),
    # "Move the tray next to the box together with the cup on it": that goes along on it
    (
        rf"\b((?:move|bring|carry|take|put) {NAMED} (?:\w+ ){{0,2}}?\w+),? (?:together|along) "
        rf"({_WITH_IT}),?( {WHERE}[^.,;:]*?)(?=[.,;!]|$| (?:and|then)\b)",
        r"\1\3 \2",
    ),
    (
        rf"\b((?:move|bring|carry|take|put) {NAMED} [^.,;:]*? {WHERE}[^.,;:]*?),? "
        rf"(?:together|along) (?={_WITH_IT}(?:[.,;!]|$| (?:and|then)\b))",
        r"\1 ",
    ),
    # "Behind the bin there is room for the bear, put it there"
    (
        r"(\bthere is (?:still |enough |some )?(?:room|space) [^.,;!?]*)[.,;!] "
        rf"(?={ASKED}(?:put|place|set|stand) (?:it|them) there\b)",
        r"\1, so ",
    ),
    # "First comes the pot on the stove, then the spoon in the pot"
    (
        rf"(^|[.;!] |, (?:and )?)(first|then|next|last(?: of all)?) comes? (?={NAMED} [^.,;!]*? "
        r"(?:in|on|inside|into|onto|next to|to the|behind|beside) )",
        r"\1\2 ",
    ),
    # "You will have to turn it for that": of what goes somewhere, as "it has to be turned" is
    (
        r"(^|[.;!] )(?:for (?:that|this),? )?you (?:will )?(?:probably )?(?:have|need) to "
        r"(?:turn|rotate|reorient) it(?: for (?:that|this)| first)*"
        r"(?=[.;!]|$)",
        r"\1it needs to be turned first",
    ),
    (
        r"\b(it (?:has|needs) to be (?:turned|rotated|reoriented))"
        r" for (?:that|this)(?=[.;!]|$)",
        r"\1 first",
    ),
    (_WISH, _stays),
    (_FROM, _counted_from),
    # Whichever is at hand
    (
        r"\b(whichever (?:(?!is\b|are\b)\w+ ){1,3}?)"
        r"(?:you (?:can|could|may) (?:reach|get to|get at|access|grasp|grab|get hold of)"
        r"|you find|suits(?: you)?|works|comes to hand)"
        r"(?: (?:the |more |most )?(?:easily|easier|easiest|best|better|comfortably|convenient"
        r"|suitable|simplest|quickly|fastest|first))?(?: to (?:reach|get to|get at|access))?"
        r"(?: for you)?(?=[.,;!]|$)",
        r"\1you like",
    ),
    # "The cup or the jar, whichever is bigger"
    (
        rf"(?<!, )\b(?:either )?({_ONE}) or ({_ONE})( (?:in|into|on|onto|inside|to) {_ONE})?, "
        rf"whichever(?: one)? is (?:the )?({_COMPARED})(?:,|(?=[.;!?]|$))",
        _whichever,
    ),
    # A question whose answer is what something is done with
    (
        r"(?:(?<=^)|(?<=[.;!?] ))which ((?!of\b|one\b)\w+(?: (?!is\b)\w+)?) is ([^.,;:!?]+)\? "
        r"((?:(?:please|then|just|now) )*(?:\w+ ){1,4}?)(?:that one|it)\b",
        r"whichever \1 is \2, \3it",
    ),
    # "Have the cup hold the pen"
    (
        rf"(^|[.;!?] |, |\band )({ASKED})"
        rf"(?:let|have|make) ({_ANY}) "
        rf"(hold|contain|receive|house|take|bear|carry|support) (?={NAMED})",
        lambda said: f"{said[1]}{said[3]} should {_HOLD.get(said[4], said[4])} ",
    ),
    (r"\b(turn(?:ed|ing)?|swivel(?:led|ling)?)( (?:it|them))? round\b", r"\1\2 around"),
    # "The opening of the drawer", "do a pick of the cup"
    (
        r"(?:(?P<ahead>^|[.;:,!?\n] ?|\b(?:and|then|first|please|(?:could|can|would|will) you) )"
        r"|\b(?P<when>after|before) "
        r"|\b(?P<is>is) |\b(?P<who>i|we) (?:want|need|would like|request|ask for) )"
        r"(?P<does>(?:do|perform|execute|make|attempt|carry out)(?:ing)? (?:an?|one|the) )?"
        r"(?:the )?(?P<noun>(?!of\b)\w+(?: up| out| and place)?) (?:of|(?<!ing )on) (?=\w)",
        _as_verb,
    ),
    # What has to be turned "first" is what goes somewhere, not where that goes
    (
        r"(?:[,;.]|,?(?= but\b| and\b))(?: but| and)? "
        r"(?:it (?:needs (?:turning|rotating)"
        r"|(?:needs|has|will have|is) to be (?:turned|rotated|reoriented))"
        r"|you will have to turn it)"
        r"(?: around)? (?:first|beforehand|before that)(?=[.;!]|$)",
        ", turning it as needed",
    ),
    # A place proposed for what is to go somewhere else
    (
        rf"\b((?:get|take|move|clear|bring|put|shift) (?:(?:{_ONE}|it|them|both|all|these|those)"
        rf"[^.,;]*?) {_GO_AWAY})(?:[.;!,]+| -)(?: (?:i think|maybe|perhaps|for example))? "
        rf"(?:(?:in|into|on|onto|to) )?({_ONE}(?: or (?:(?:in|on|to) )?{_ONE})?) {_FINE}"
        r"(?: for (?:it|them|that))?(?=[.;!]|$)",
        lambda said: f"{re.sub('aside$', 'out of the way', said[1])} to {said[2]}",
    ),
    (r"\b(i|we) (?:will|(?:am|are) going to) need you to (?=\w)", r"\1 need you to "),
    # What is the only thing wanted is wanted; what else is there is not spoken of.
    (
        rf"\b(i|we) (?:only|just) ({_ONLY_WISH}) (?={NAMED}[^.,;]*? {_MOVED}\b)",
        r"\1 \2 ",
    ),
    (
        rf"\b(i|we) (?:will|(?:am|are) going to)(?: be)? (?:need|want|require)(?:ing)? "
        rf"(?={NAMED}[^.,;]* {_THERE} {NAMED}(?: (?!later\b|tomorrow\b|tonight\b|soon\b|for\b)"
        r"\w+){1,4}(?:[.!;]|, (?:please|and)\b| and\b|$))",
        r"\1 need ",
    ),
    (
        rf"^({ASKED})(?:one|either) ((?:\w+ )?\w+) (into|onto|to) ({_ONE}) (?:is|would be|will be) "
        r"(?:enough|plenty|sufficient)(?=[.,;!]|$)",
        r"\1put 1 \2 \3 \4",
    ),
    (
        rf"^({ASKED})(?:change|rearrange|arrange|set up|modify|alter) (?:the )?"
        r"(?:scene|setup|set up|layout|arrangement|objects|items|stuff|workspace) "
        r"(?:around |up )?(?=(?:so that|such that|in such a way that|so)\b)",
        r"\1arrange things ",
    ),
    # What is asked of a thing that is named ahead
    (
        rf"(^|[.;!?] )(?:as (?:for|to)|regarding|concerning|with (?:regard|respect) to"
        rf"|when it comes to) ({NAMED}[^.,;:!?]*?)[,:] (?=\w)",
        r"\1\2: ",
    ),
    # "From ajar to open" is open in the end
    (
        r"\b(should|must|has to|needs to|is to) (?:go|change|be (?:moved|brought|taken)) "
        rf"{_FROM_STATE}",
        r"\1 be ",
    ),
    (rf"[,:] {_FROM_STATE}", ": "),
    # Which things there are to be seen says nothing of them
    (
        rf"\b({NAMED}(?: (?!you\b|that\b|which\b|see\b)\w+)+) (?:that |which )?you (?:can )?see"
        r"(?: (?:there|here|before you|in front of you))?(?=[.,;:!?]|$)",
        r"\1",
    ),
    # "May only be grasped from above" is about how
    (
        r"\b(?:may|must|should|can|is to|has to|shall) only be "
        r"(grasped|gripped|held|grabbed|lifted|picked up|approached) "
        r"(?=(?:from|by|with|using|vertically|horizontally|sideways)\b)",
        r"must be \1 only ",
    ),
    # Nothing is asked of "the other one"
    (
        rf"\b(the (?:\w+ ){{0,3}}?\w+(?: {WHERE} (?:the|your|my) \w+)?),? (?:and |but )?"
        r"(?:not|rather than|instead of) the other(?: one)?(?=[.;!?]|$)",
        r"\1",
    ),
    (
        r"\b(put|place|store|stow|set) ([^.,;:]*?) where (?:the |other )?\w+s "
        r"(?:go|belong|live|are kept)[,:] (?:namely,? |that is,? )?(?=(?:in|into|on|onto) )",
        r"\1 \2 ",
    ),
    (
        rf"\blet (it|them|{_ONE}) down (?=(?:in|into|on|onto)\b)",
        r"put \1 down ",
    ),
    # Which of several does not matter, said ahead of what is done with one of them
    (
        r"(^|[.;!?] )(?:it (?:does not matter|makes no difference|is (?:up to you|your (?:choice|"
        r"decision)))|(?:i|we) do not (?:care|mind)|no matter) (which (?:of the (?:two )?)?"
        r"(?:\w+ ){1,2}?(?:you (?:use|choose|take|pick|select)|to (?:use|choose|take|pick)"
        r"|is (?:used|chosen)))[.,;:]",
        r"\1\2 does not matter,",
    ),
    # Putting down what is held
    (
        rf"\b(?:release|let go of) (it|them|{_ONE}) (?={_THERE}|(?:at|over|above) )",
        r"put \1 ",
    ),
    # "Your choice which goes where"
    (
        r", (?:it is )?(?:your|my|the robot 's) (?:choice|decision|call) "
        r"(?=(?:which|what|where|how|in which)\b)",
        ", no matter ",
    ),
    (
        rf"^({_ONE}) (?:and|or) ({_ONE}) are the only (?:places|spots|containers|ones) "
        rf"(?:(?:where|in which|that|to which) ({_ONE}(?: and {_ONE})?) (?:may|can|could|should"
        r"|(?:is|are) allowed to) (?:go|be|be put|end up)(?: in| into)?"
        rf"|for ({_ONE}(?: and {_ONE})?))[.;:,!] (?:so )?(?:please )?put (?:them|it) there\b",
        lambda said: f"put {said[3] or said[4]} in {said[1]} or {said[2]}",
    ),
    # "Store each pen separately: one in the mug, one in the basket"
    (
        rf"^({ASKED})(?:put|store|place|keep|stow) each (?:of the )?((?:\w+ )?\w+?)s? "
        r"(?:away )?(?:separately|in (?:a different|its own|another) (?:place|spot)): (?=one\b)",
        r"\1put the \2s separately: ",
    ),
    (
        r"\b(should|must|shall|have to|need to|are to) (all|both) "
        r"((?:be|go|end up|stand|lie)(?: (?:put|kept|stored|placed))?) together\b",
        r"\1 \3 \2 together",
    ),
    # "Put it in any cup. Don't use the red one"
    (
        r"\b((?:an?|any|either|one of (?:the|my|our)) (?:(?!then\b)[^.;!?])*?)"
        r"(?:[.;!?]+ (?:(?:but|please|just) )*not|"
        r"[.;!?,]+ (?:(?:but|please|just|and) )*do not (?:use|take|pick|choose)) "
        r"((?:the|my) (?:\w+ )?\w+ one)(?=(?:,? please)?(?:[.;!?]|$))",
        r"\1, but not \2",
    ),
    (r"\b(that|which) (?:occupies|sits on|takes up) (?=it\b|them\b)", r"\1 is on "),
    (r"\bwhat (?:lies|stands|sits|is lying) in there\b", "what is in it"),
    # "Here or, if you prefer, there" is a free choice
    (
        r",? or,? if you (?:prefer|like|wish|want|would rather|would prefer|find it easier),? "
        r"(?=(?:(?:in|on|into|onto|to|next|beside|the|my|a|an)\b))",
        " or ",
    ),
    # "The cup has to come out first and can go on the tray"
    (
        rf"(?<!and )(?<!or )\b({_ONE}(?: (?:that|which) is (?:there|in there|inside))?)"
        r"(?: (?:now|already|still))? (has to|needs to|must|should) come out"
        r"((?: of (?:it|there))? (?:first|beforehand|before that)) and "
        r"(?:(?=(?:can|may|could|must|should|has to|goes)\b(?! not\b))"
        r"|(go|be put|be placed|be moved)\b)",
        lambda said: (
            f"{said[1]} {said[2]} come out{said[3]}, it {f'should {said[4]}' if said[4] else ''}"
        ),
    ),
    # "The cup and the mug should not be in the same box: one in the red, one in the blue box"
    (
        rf"^({NAMED} [^.,;:]*? and [^.,;:]*?) (?:should|must|shall) not (?:both )?"
        r"(?:be(?: put)?|go|end up|stand|lie) (?:in|on|into|onto) the same \w+[:;,.] (?=one\b)",
        r"put \1 separately: ",
    ),
    (_INCLUDED, _goes_along),
    # What stays in or comes out asks for nothing.
    (
        rf"\b({_ONE}|it|they) (can|may|could|might) (?:either )?(?:stay|remain|be|stay put)"
        rf"(?: (?:in there|inside|there|in it|inside it|where it is|{_THERE} {_ONE}))? "
        r"or (?:(?:can |may )?(?:come|go|be|be taken|be put) (?:back )?(?:out|outside|elsewhere))"
        r"(?=[.,;!]|$)",
        r"\1 \2 go anywhere",
    ),
    (
        rf"\b({_ONE}|it|they) (can|may|could|might) (?:be )?(?:come|go|taken|put|moved) "
        r"(?:back )?(?:out|away|outside|elsewhere)(?: of (?:it|there))? "
        r"(?:later(?: on)?|tomorrow|tonight|another (?:day|time))(?=[.,;!]|$)",
        r"\1 \2 go anywhere",
    ),
)
"""In order."""
