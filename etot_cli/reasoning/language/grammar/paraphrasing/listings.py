"""Ways of announcing several things: lists with their order or number, what is sorted, towers."""

from __future__ import annotations

import re
from collections.abc import Callable

from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    KIND_NOUNS,
    NUMBERS,
    THING_NOUNS,
    is_descriptive,
)
from etot_cli.reasoning.language.words.small_words import NAMED, WHERE

_SO_MANY = rf"both|(?:all|these) (?:{'|'.join(NUMBERS)})"
_NAMES = r"(?:(?:the|my|our) )?\w+(?: \w+){0,3}"
ASKED = (
    r"(?:(?:please|kindly|just|(?:could|can|would|will) you(?! mind\b)"
    r"|(?:i|we) (?:want|need|would like) you to|let us|now) )*"
)
"""Before what somebody is asked for."""
_ALL_NAMED = Expression(
    r"(^|[.;\n]\s*)([^:.;\n]+): (?P<do>(?:(?:please|just) )*(?:put|place|move|store|pack) )?"
    r"(?:all(?: of (?:them|it|these))?|(?P<both>both)(?: of them)?|everything|the lot"
    rf"|(?:all (?:the )?|the )(?P<number>(?!one\b|an?\b)(?:{'|'.join(NUMBERS)}))"
    r"(?: of (?:them|these))?)"
    r" (?=(?:in|on|into|onto|to)\b"
    r"|(?P<verb>(?:go|belong)|(?:should|must|have to|need to|are to) (?:go|be|end up)) )"
)
"""What a list before a colon names, all of it."""
_BOARDS = {"below": "lower", "above": "upper"}


_ONE = r"(?:the|my|our) (?:(?!and\b|or\b|in\b|on\b|to\b)\w+ ){0,3}?\w+"
_ITEM = r"(?:(?:the|my|our) )?(?!the\b|my\b|our\b|each\b)\w+(?: (?!and\b|or\b)\w+){0,2}?"


def _named(item: str) -> str:
    """One of several things that are listed, with the article that lists leave out."""
    return item if re.match(r"(?:the|my|our)\b", item) else f"the {item}"


_NTH = Expression(
    r"\b(?:the (first|second|third|fourth)(?: one)?|(first|second|third|fourth) one)"
    r"(?= (?:in|on|into|onto|to|inside|next|beside|goes|should|must|belongs|has to|is to)\b)"
)
_ORDINALS = ("first", "second", "third", "fourth")
_OF_OTHERS = Expression(r"\b(?:rest|others?|remaining|last|it|them|both|all)\b")


def _by_their_place(said: re.Match[str]) -> str:
    """Several things, and what is said of each by when it was named ("the second one")."""
    begun, listed, rest = said.groups()
    items = re.split(r",? and |, ", listed)
    told = [found[1] or found[2] for found in _NTH.finditer(rest)]
    nth = dict(zip(_ORDINALS, map(_named, items), strict=False))
    twice = len({*told}) < len(told) or not {*told} <= {*nth}
    if twice or (len(told) < len(items) and _OF_OTHERS.search(rest)):
        return said[0]
    if {item.split()[0] for item in items} & VERB_WORDS:
        return said[0]
    return begun + _NTH.sub(lambda found: nth[found[1] or found[2]], rest)


def _in_turn(said: re.Match[str]) -> str:
    """In turn, where "one thing after another" may be said of the things that were named."""
    before = said.string[: said.start()]
    known = said[1] in THING_NOUNS or re.search(rf"\b{said[1]}(?:e?s)?\b", before)
    return " one after another" if known else said[0]


def _one_by_one(said: re.Match[str]) -> str:
    """A list whose order was announced ("these in this order: the cup, the plate")."""
    asked, where, items = said.groups()
    parts = re.split(rf"(?:, | and |, and )(?:then )?(?={NAMED}|\w+$|\w+,)", items)
    return f"{asked} these{where}: {', then '.join(parts)}"


def _named_before(said: re.Match[str]) -> str:
    """What a list names, where that are as many things as it is said to name."""
    items = re.split(r",? and |, ", said[2])
    if said["number"] and len(items) != int(NUMBERS[said["number"]]):
        return said[0]
    if not said["number"] and (said["verb"] or said["do"]):
        return said[0]  # they are topics that the verb speaks of
    named = ", and ".join(filter(None, (", ".join(items[:-1]), items[-1])))
    if said["number"]:
        return f"{said[1]}{said['do'] or ''}{named} "
    return f"{said[1]}{said[2]} {said['both'] or ''} "


def _picked_and_placed(said: re.Match[str]) -> str:
    """What goes where, told as two entries of a form ("pick: pen. place: cup")."""
    thing, place = said["thing"].strip(), said["place"].strip()
    return said["before"] + (f"{thing} {place}" if re.match(WHERE, place) else f"{place}: {thing}")


_FOR_LAST = (
    r"(?:leav|sav|keep)(?:e|ing)? (?P<what>(?:the|my|our|that) (?:\w+ ){0,2}?\w+) "
    r"(?:for|until|till) (?:last|the (?:very )?end)"
)
_LAST_TURN = Expression(r"\b(?:then|finally|lastly|last)\b,? (?!.*\b(?:then|finally|lastly)\b)(.*)")


def _left_for_last(said: re.Match[str]) -> str:
    """What is left for last, said ahead of what is done: as the last of what is told in turn, else
    behind it.
    """
    begun, what, rest = said["begun"], said["what"], said["rest"]
    if last := _LAST_TURN.search(rest):
        words = what.split()[1:]
        named = re.match(r"(?:the |my |our |that )?(\w+)", last[1])
        return f"{begun}{rest}" if named and named[1] in words else said[0]
    return f"{begun}{rest}, {what} last"


_LABEL = (
    rf"(?!(?:{'|'.join(VERB_WORDS)})\b)(?:{NAMED} )?"
    r"(?:(?!(?:is|are|in|on|to|if|and)\b)[\w-]+)(?: (?!(?:is|are|in|on|to|if|and)\b)[\w-]+){0,3}?"
)
"""What something is called that is told on a label."""
_DASH = "[-\N{EN DASH}\N{EM DASH}]"
_SPOILT = "(?:expired|damaged|defective|contaminated|broken|faulty|outdated)"
_SORTED = r"(?:sort|arrang|distribut|organi[sz]|plac|handl|treat|stor)ed"
_SORT = r"(?:sort|arrange|distribute|organi[sz]e|place|handle|treat|store)"
_LIKE_THIS = r"(?:as follows|like this|like so|this way|in (?:this|the following) way|as listed)"
_PART = r"(?:top|upper|middle|lower|bottom) (?:board|shelf|drawer|level|compartment)"
_ROW = rf"(?:the )?({_PART})(?: ?:| is| ->)? (?:the )?(\w+)(?=[.,;]|$)[.,;]?"
_ROWS = Expression(
    r"\b((?:sort|arrange|distribute|shelve|store|put)(?: away)? (?:all |both )?"
    rf"(?:(?:of )?(?:the|my|our) )?(?:\w+ )?\w+s(?: (?:in|on|into|onto) {NAMED} \w+)?)[:.;]"
    rf"(?P<rows>(?: {_ROW}){{2,}})"
)


def _row_by_row(said: re.Match[str]) -> str:
    """What is in each of several drawers or on each board, told by its colour alone ("bottom board:
    blue").
    """
    rows = re.findall(_ROW, said["rows"])
    if not all(is_descriptive(what) for _, what in rows):
        return said[0]
    told = (f"the {what} one {'in' if 'draw' in at else 'on'} the {at}" for at, what in rows)
    return f"{said[1]}: {', '.join(told)}"


_LAYER = Expression(
    r"(?:(?:the|my|our) )?(?:(?!in\b|on\b|at\b|and\b|then\b)\w+ ){1,4}?"
    r"(?!in\b|on\b|at\b|and\b|then\b)\w+"
)
_FOOT, _HEAD = "first|at the bottom|underneath|below", "last|on top|at the top|uppermost"
_NEXT = r"(?:and |then |next |finally |lastly |after that )*"
_LAYERS = Expression(
    r"\b(?P<stack>(?:stack|pile)(?: up)? (?:the|my|our|these) (?:\w+ ){0,2}?\w+s"
    rf"(?: (?:on|in|onto) {NAMED} (?:\w+ )?\w+)?)[:,] "
    rf"(?P<layers>[^.;:!?]*? (?:{_FOOT}|{_HEAD}))(?=[.;!]|$)"
)


def _layer_by_layer(said: re.Match[str]) -> str:
    """A tower whose layers are told from one end to the other, in the order of building ("the big
    one first, then the red one, the small one on top").
    """
    one, *more = re.split(rf",? (?:and|then) {_NEXT}|, {_NEXT}", said["layers"])
    ends = [re.search(rf" (?:({_FOOT})|({_HEAD}))$", layer) for layer in (one, [one, *more][-1])]
    foot_first = [bool(end and end[1]) for end in ends]
    layers = [
        re.sub(rf" (?:{_FOOT}|{_HEAD}|next|in the middle|in between)$", "", layer)
        for layer in (one, *more)
    ]
    if foot_first[0] is foot_first[1] or not (all(ends) and all(map(_LAYER.fullmatch, layers))):
        return said[0]
    listed = ", ".join(map(_named, layers if foot_first[0] else reversed(layers)))
    return f"{said['stack']} in this order: {listed}"


_STORES = "|".join(
    noun
    for kind in ("drawer_unit", "cabinet", "shelf", "bowl", "cup", "box")
    for noun in KIND_NOUNS[kind]
)
_PLACE_FOR = (
    rf"(?:(?:the|my|our) )?(?:\w+ )?(?:(?:{_STORES}|tray|plate|basket|bin|board|compartment)"
    r"|(?:edge|corner|side|middle|centre|center) of the \w+) for (?:the|my|both|all|every) "
    r"(?:(?!and\b)\w+ ){0,2}\w+(?: and (?:the|my) (?:(?!for\b)\w+ )?\w+(?! for\b| \w+ for\b))?"
)
"""A place without a verb, and what goes there."""


def _places_for(said: re.Match[str]) -> str:
    """What is listed by the places that are for it."""
    items = re.split(r", and |, | and (?=[^,]* for )", said[2])
    pairs = (item.split(" for ") for item in items)
    named = ((re.sub(r"^(?!(?:the|my|our)\b)", "the ", where), what) for where, what in pairs)
    return said[1] + ", and ".join(f"{what} must go to {where}" for where, what in named)


def _made_so(said: re.Match[str]) -> str:
    """What has to be so before, with the verb that it leaves out."""
    what = re.sub(r"^((?!.*\b(?:is|are)\b)(?:\w+ )+)(open|closed|shut|empty)$", r"\1is \2", said[2])
    return f"{said[1]}make sure that {what}. "


LISTINGS: tuple[tuple[str | Expression, str | Callable[[re.Match[str]], str]], ...] = (
    # "Precondition: the drawer is open. Effect: …": what is not so yet is made so before
    (
        r"(^|[.;\n] ?)pre ?-?conditions?:(?! ?(?:none|no)\b) ?([^.;:\n]+)[.;\n] ?"
        r"(?=(?:(?:desired|expected|intended|required) )?"
        r"(?:effects?|post ?-?conditions?|results?|outcome|goal(?: \w+)?):)",
        _made_so,
    ),
    # "Load the oven: both pots inside, door closed": how that is to be in the end
    (
        rf"(^|[.;\n] ?)(?:please )?(?:load|fill|pack|stock|prepare|set up) ({NAMED} [^,.;:!?\n]+):"
        r"(?= [^.;:!?\n]*? (?:inside|in it|on it|in there)(?:[.;!,]|$| and\b))",
        r"\1\2:",
    ),
    # "Pack the pot: the cheese first, then the butter, and finally the lid on top"
    (
        rf"(^|[.;\n] ?)(?:please )?(?:load|fill|pack|stock) ({NAMED} [^,.;:!?\n]+): (?:first )?"
        rf"(?!(?:put|place|set|lay|move|take|add|open)\b)({_ITEM})(?: first)?,? (?:and )?then "
        rf"(?={NAMED})(?!the (?:lid|cover)(?:[.;!]|$))",
        r"\1put \3 in \2, then ",
    ),
    (r"(^|[.;\n] ?)actions?: ?", r"\1"),
    (r"\b(?:acceptance|pass(?:ing)?|exit) criteri(?:on|a):", "success criterion:"),
    # "Bottom shelf for the cups, top shelf for the pens"
    (
        rf"(?<![^.;\n])( ?(?:please,? )?)({_PLACE_FOR}(?:(?:,| and|, and) {_PLACE_FOR})*)"
        r"(?=[.;!]|,? (?:so|please)\b|$)",
        _places_for,
    ),
    # "White bottle: store in the drawer", "brown vial expired - discard in the bin", "cup: move to
    # the tray"
    (
        rf"(^|[.;!\n] ?)({_LABEL}) ({_SPOILT})(?=(?: ?[:,;]| {_DASH}) )",
        r"\1\2 is \3",
    ),
    (
        rf"((?:^|[.;,!\n] ?){_LABEL}(?: is {_SPOILT})?(?: ?[:;]| {_DASH}) ?)"
        r"(?:store|stow|keep|transfer|move|discard) (?=(?:in|into|on|onto|inside|next to"
        r"|(?P<to>to)) (?!it\b|them\b|there\b))",
        lambda said: f"{said[1]}{'' if said['to'] else 'put '}",
    ),
    # "Do the following: open it, close it"
    (
        rf"(^|[.;!\n] |\bif [^.,;:!?]*, (?=[^.;!?\n]*[.!]?$))({ASKED})"
        r"(?:do|perform|carry out|execute|proceed|act) (?:(?:exactly )?(?:the following|these)"
        r"(?: (?:steps|actions|things|operations))?|as follows)"
        r"(?: in (?:this|the given) order)?[:.] ?(?=\w)",
        r"\1\2",
    ),
    # "I need the pens sorted as follows: …", "sort the pens as follows: …"
    (
        rf"(^|[.;!] )({ASKED})(?:(?:i|we) (?:want|need|would like)(?: to have)? "
        rf"({NAMED} [^.,;:]*?)"
        rf" (?:to be )?{_SORTED}|{_SORT} ({NAMED} [^.,;:]*?)|({NAMED} [^.,;:]*?) (?:are|is|must"
        rf"|should|have|has)(?: to)?(?: be)? {_SORTED}),? {_LIKE_THIS}[:,] ",
        lambda said: f"{said[1]}{said[2]}sort {said[3] or said[4] or said[5]}: ",
    ),
    (_ROWS, _row_by_row),
    (_LAYERS, _layer_by_layer),
    # "Empty the box: everything in it goes on the tray"
    (
        rf"\b((?:empty|unload|unpack|clear)(?: out)? {NAMED} (?:\w+ )??\w+)(?::| -|;) "
        r"(?=(?:everything|all|anything|whatever is|what is) (?:that is )?(?:in|on|inside) it\b)",
        r"\1. ",
    ),
    (
        r"(^|[.;!,] )(?:and )?(?:next|then|after that|finally|last)(?: up)? "
        rf"(?:comes?|is|are|follows?) ({_ONE}(?:(?:, {_ONE})*,? and {_ONE})?)[:,;] "
        r"(?:and )?(?:it|that one|they|those|these|which) (?=(?:goes|go|belongs?|should|must)\b)",
        r"\1then \2 ",
    ),
    # "Distribute the pens so that each cup contains exactly one"
    (
        r"\b(?:distribute|divide|share out|spread)(?: out)? (?:all )?(?:the|my|our) "
        r"((?:\w+ )?\w+s)(?: among \w+)? so that (?:each|every) ((?:\w+ )?\w+) "
        r"(?:contains|holds|has|gets|receives|bears) (?:exactly|just|only)? ?one"
        r"(?: of them)?(?: in it| on it)?(?=[.;!]|$)",
        r"distribute the \1 over the \2s, one in each",
    ),
    (
        r"(?P<before>^|[.;\n] ?)(?:pick(?: up)?|grasp|object|item): ?(?P<thing>[^.,;:\n]+)"
        r"[.,;\n]\s*(?:and )?(?:place|put|drop|target|destination): ?(?P<place>[^.,;:\n]+)",
        _picked_and_placed,
    ),
    (
        r"\b(put|place|set|stack) (?:these|them|the following|these things|the following things)"
        r"( (?:on|in|into|onto) [^:.;]*?),? in (?:this|the following) order: ([^.;]*)",
        _one_by_one,
    ),
    # "The cup, then the pen: that is the order in which they go into the box"
    (
        r"(^|[.;!?] )((?:first,? )?[^.;:!?]*?\b(?:then|finally|lastly)\b[^.;:!?]*?)(?:[:,;.] | - )"
        r"(?:that|this) is (?:the|my|our) (?:order|sequence)"
        r"(?: in which| (?:i|we) want)? "
        r"(?:they|these|those|them|all of (?:them|these))(?: all)? (?=\w)",
        r"\1\2 ",
    ),
    # "Leave the cup for last: first the pen, …", "put all in the box, but leave the cup for last"
    (
        rf"(?P<begun>(?:^|[.;!] ){ASKED}){_FOR_LAST}[:;,.] (?P<rest>[^.;!]*)",
        _left_for_last,
    ),
    (
        r"\b((?:put|place|move|bring|stack|take) [^.;:]*?)(?:[,;.]|(?= but\b| and\b))"
        rf"(?: but| and)?(?: please)? (?:{_FOR_LAST}|(?P<it>(?:the|my) (?:\w+ )??\w+) "
        r"(?:goes|comes|(?:should|must|has to) (?:go|come|be)) last)(?=[.;!]|$)",
        lambda said: f"{said[1]}, {said['what'] or said['it']} last",
    ),
    # "One thing after another" is in turn
    (
        r"(?:,? by (?:picking|taking|moving|carrying|bringing)(?: out| over| up| off)?)? "
        r"one (?!by\b|after\b)(\w+) (?:after|by) (?:another|the other|one)\b(?! \1)",
        _in_turn,
    ),
    (
        r"\b(?:re)?build (?:the|a second|another|a new) (tower|stack)\b"
        r"(?![^.;:]*\b(?:reverse|other way|opposite order)\b)",
        r"build a \1",
    ),
    (
        r"\bmake (?:the|a second|another|a new) (tower|stack) (?=(?:out of|with|from|of|on)\b)",
        r"make a \1 ",
    ),
    (r"^(?:a )?(tower|stack) (?=from (?:bottom to top|top to bottom)\b)", r"build a \1 "),
    (r"\bpart of (?=the (?:tower|stack|pile)\b)", "in "),
    # What is stacked goes on what was put down just before, not beside it.
    (
        r"\b((?:put|place|set|lay) ((?:the|my) [^.,;]*?) (?:on|onto) (?:the|my) [^.,;]*?[,;.]? "
        r"(?:and |then )*(?:stack|pile) (?:the|my) [^.,;]*? (?:on|onto))(?: top of)? it\b",
        r"\1 \2",
    ),
    # "All three, the cup, the mug and the plate, in the box"
    (
        rf"\b({_SO_MANY})(?: of them)?(?:,| -|:) ({_NAMES}(?:, {_NAMES})*,? and {_NAMES})"
        rf"(?:(?:,| -) (?={WHERE})|(?=[.;!]|$))",
        r"\1 things, \2, ",
    ),
    # "I want both on the tray: the cup, and in it the pen"
    (
        rf"\b(?:{_SO_MANY}|two things|the following)(?: of them| things)? "
        rf"({WHERE} {NAMED} [^,.;:]*)[:,] ({NAMED} [^,.;:]*?),? and,? "
        rf"((?:in|on) it),? ({NAMED} [^,.;:]*)(?=[.;!]|$)",
        r"\2 \1, and \3 \4",
    ),
    # "Into one of these: bowl, box"
    (
        rf"\b(in|into|on|onto|inside) (?:either )?(?:one|any|either) of (?:the following|these)"
        rf"(?: \w+)?: (?:either )?({_ITEM})(?:,| or|, or) ({_ITEM})(?=[.;!]|$)",
        lambda said: f"{said[1]} {_named(said[2])} or {_named(said[3])}",
    ),
    (
        rf"\beach of (?:these|the following)(?: (?:two|three))?(?: \w+)?[,:] "
        rf"({_ITEM}) and ({_ITEM}), (?={WHERE})",
        lambda said: f"each of {_named(said[1])} and {_named(said[2])} ",
    ),
    # "For each of the cup and the pen: in the box or in the bin"
    (
        rf"(^|[.;!?] )for (?:(?:each|both|either|all) of ({_ITEM} and {_ITEM})"
        rf"|({_ONE}(?: and {_ONE})*))[:,] (?=(?:either )?(?:in|into|inside|on|onto) )",
        lambda said: f"{said[1]}{said[2] or said[3]}: ",
    ),
    (_ALL_NAMED, _named_before),
    # "The cup and the pen: first one on the tray, second one in the box"
    (
        rf"(^|[.;!] )({_ITEM}(?:(?:,| and|, and) {_ITEM}){{1,3}})[:;] "
        r"([^.;!]*\b(?:first|second|third)\b[^.;!]*)",
        _by_their_place,
    ),
    (
        rf"^({ASKED}(?:sort|arrange|organi[sz]e) (?:the|my) [^.,;:]*?) by (?=\w+ing\b)",
        r"\1: ",
    ),
    (
        rf"(\beach (?:shelf|board|level)\b[^.;]*?)({NAMED} [^.,;:]*?) (below|above),? (?:and )?"
        rf"({NAMED} [^.,;:]*?) (?!\3)(below|above)\b",
        lambda said: (
            f"{said[1]}{said[2]} on the {_BOARDS[said[3]]} one, "
            f"{said[4]} on the {_BOARDS[said[5]]} one"
        ),
    ),
)
"""What they are put into, in order (see ``paraphrases``)."""
