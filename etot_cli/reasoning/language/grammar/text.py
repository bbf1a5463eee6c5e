"""An instruction's text: normalized, cut into sentences and words."""

from __future__ import annotations

import re
from collections.abc import Sequence

from etot_cli.reasoning.language.words import small_words
from etot_cli.reasoning.language.words.categories import CATEGORIES
from etot_cli.reasoning.language.words.known import GRAMMAR_WORDS, VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    SIZES,
    is_descriptive,
    word_set,
)
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.verbs import PAST

MAX_CHARACTERS = 2000
MAX_WORDS = 80
"""Longer sentences are refused: the number of readings grows steeply with length."""
MAX_SENTENCES = 24
COMMA = "~comma"
COLON = "~colon"
"""Between what goes where, in a table, in either order."""
QUESTION = "~question"
"""Behind a question: it may be a request, but not one without a verb."""

_SENTENCE_END = re.compile(r"[.!?;\n]+(?:\s+|$)")
_NUMBERING = re.compile(r"(^|[.!?;\n]\s*)\(?\d{1,2}[.)]\s+")
_NEW_LINE = re.compile(
    rf"(?<![,\n])(?<!\band)(?<!\bthen)(?<!\bto)\s*\n\s*(?=[A-Z]|(?:{'|'.join(VERB_WORDS)})\b)"
)
"""Where a new line is a new sentence; elsewhere it is but wrapped."""
_LIST_HEAD = (
    r"^(?:(?:(?:please|\w+ you) )*(?:to )?(?:do|follow)?"
    r"(?: the following| these)? ?(?:steps)?:\s*)?"
)
_UH = re.compile(
    r"(?P<before>\w+)(?P<comma>,?)\s+(?:uh+m?|um+|erm*|hm+)(?:,|\.\.+)?\s+(?P<after>\w+)",
    re.IGNORECASE,
)
_GOES_ON = word_set("in on into onto to and from inside next then")
_WELL = re.compile(
    r"(^|[.!?;\n]\s*)(?:"
    r"right(?: then| so)?,\s*"
    rf"(?=(?:{'|'.join(VERB_WORDS)}|please|can|could|would|will|let|now|i|you|we)\b)"
    r"|(?:yes|yeah|er|erm|uh|ah|hm+|anyway|next up)(?:,\s*| )(?=[a-z])"
    rf"|step (?:\d{{1,2}}|{'|'.join(NUMBERS)})\s*[:.)]\s*)"
)
"""What begins a sentence and says nothing, such as the number of a step alone."""
_WHERE = r"(?:in|on|to|next|inside|onto|into|from|off|out)\b"
_NOTHING_ELSE = re.compile(
    rf"((?:^|[.;\n])(?:(?!\b{_WHERE})[^.;\n])*?),? (?:and|but) nothing else,? ({_WHERE}[^,.;\n]*)"
)
"""Behind the things it stands for what is said of them behind their place."""
_BRACKETED = re.compile(r"\b([a-z]{2,}) \(([a-z]+)\)")
_ALL_NAMED = re.compile(
    r"(^|[.;\n]\s*)([^:.;\n]+): "
    r"(?:all(?: of (?:them|it|these))?|(?P<both>both)(?: of them)?|everything|the lot)"
    r" (?=(?:in|on|into|onto|to)\b)"
)
"""What a list before a colon names, all of it."""
_MAY_GO = re.compile(
    r"(^|[.!?;]\s*)(?:could|can) ((?:the|my|your|our|both|all)\b[^.!?;,:]*?)(?: please)? go\b"
)
"""A request in the words of a question."""
_BULLETS = "-*\N{BULLET}\N{EN DASH}"
_HYPHENS = "-\N{NON-BREAKING HYPHEN}\N{HYPHEN}"
_QUOTES = re.compile(r"[\"`*\N{LEFT DOUBLE QUOTATION MARK}\N{RIGHT DOUBLE QUOTATION MARK}]")
_STATES = (
    r"(?:going|on|in|inside|over|too|not|now|still|already|less|more|so|much)\b"
    r"|\w+(?:ed|en)(?: (?:up|out|off))?(?: (?:and|so)\b|[,.;:]|$)"
    r"|(?:open|closed|shut|ajar|empty|full|dirty|clean|ready|broken|fine)"
    r"(?: (?:and|so|but|where)\b| -|[,.;:!]|$)"
)
"""What "the door's" is followed by where it is no possessive."""
_SO_NOW = r"(?:not|still|already|left|in|on|out|lying|standing|sitting)\b"
_ALL_DONE = re.compile(
    r"(?<=\w[.,;!? ])((?: |\b)(?:once|when|after|as soon as)) (?:everything|all)"
    r" (is|are|has been|have been) ((?:put |all )?(?:in|on|inside|into)\b)"
)
"""After what is asked for, "once everything is in" is about that."""
_DOING = r"put|place|take|move|bring|open|close|shut|pick up|leave"
_NAMED = r"(?:the|a|an|my|our|your|all|both|every|this|that|these|those)\b"
_LYING = r"(?:lying|sitting|standing|left)(?: (?:around|about|there|here|out))+"
_ABOUT = r"(?:still )?(?:left )?(?:lying|scattered|sitting) (?:around|about)(?! (?:the|my|your|of))"
_CLITICS = (
    # As people type who leave apostrophes out; "its" and "ill" are words of their own.
    (r"\b(that|there|what|where|who)s\b", r"\1's"),
    (rf"\bits (?={_STATES})|\bits (?=a\b|the\b)", "it's "),
    (r"\b(do|does|did|is|are|was|has|have|should|could|would|must|need)nt\b", r"\1n't"),
    (r"\b(can|won)t\b", r"\1't"),
    (r"\b(i)(m|ve)\b", r"\1'\2"),
    (r"\b(you|they)(re|ve|ll)\b", r"\1'\2"),
    (r"\bu\b", "you"),
    (r"\bw/?(?= (?:the|a|my|it|that|this|all|both)\b)", "with"),
    (
        r"\b((?:the|my|all|both)(?: (?!and\b|or\b)\w+){1,2}|everything|all|anything)"
        r" what (?=(?:is|are)\b)",
        r"\1 that ",
    ),
    (r"\bfor me (?=(?:out|off|from|on|in|into|onto|to|and)\b)", ""),
    (r"\bgimme\b", "give me"),
    (r"\blemme\b", "let me"),
    (r"\bwanna\b", "want to"),
    (r"\bgotta\b", "have to"),
    (r"(?<=\w) (?:\+|n|'n'?) (?=\w)", " and "),
    (r"\bwon't\b", "will not"),
    (r"'s got\b", " has"),
    (r"(?<=\w)'s(?= been\b)", " has"),
    (r"\b(that|which|it|there|here|what|who)'s\b", r"\1 is"),
    (r"\blet's\b", "let us"),
    (r"\b(?:don't|dont)\b", "do not"),
    (r"\bdoesn't\b", "does not"),
    (r"\bdidn't\b", "did not"),
    (r"\b(is|are|was|were|has|have|should|must|would|could|need)n't\b", r"\1 not"),
    (r"\b(?:can't|cannot)\b", "can not"),
    (r"'d(?= better\b)", " had"),
    (r"\b(i|it|that|we|you|they)'d\b", r"\1 would"),
    (r"\bi'm\b", "i am"),
    (r"\b(i|you|we)'ll\b", r"\1 will"),
    (r"\b(i|you|we|they)'ve\b", r"\1 have"),
    (r"\b(you|we|they)'re\b", r"\1 are"),
    (rf"(?<=\w)'s(?= (?:{_STATES}))", " is"),
    (r"(?<=\w)'s\b", " 's"),
    (r"(?<=s)'(?=\s)", " 's"),
)


def normalized(text: str) -> str:
    """Lower case, plain quotes, one space between words, clitics apart."""
    text = _UH.sub(_without_uh, text)
    text = _WELL.sub(r"\1", _listed(_NEW_LINE.sub("\n ", text).casefold().strip()))
    text = text.replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
    text = re.sub(r"(?<!\w)'|'(?!\w)(?<!s')", " ", _QUOTES.sub(" ", text))
    for pattern, plain in _CLITICS:
        text = re.sub(pattern, plain, text)
    text = _WISHED.sub(_as_asked, text)
    text = re.sub(r"\band/or\b", "or", text)
    text = re.sub(
        rf"\b(left|right|top|bottom|front|back|upper|lower)[{_HYPHENS} ]most\b", r"\1most", text
    )
    text = re.sub(rf"\b(left|right)(?:[{_HYPHENS}]hand(?:ed)?\b| hand(?= corner\b))", r"\1", text)
    text = re.sub(r"\b(?:number|no\.|nr\.?)\s*(?=\d)|#(?=\d)", "", text)
    text = re.sub(rf"\bnumber ({'|'.join(NUMBERS)})\b", lambda said: str(NUMBERS[said[1]]), text)
    text = re.sub(
        r"\b(table|counter|work|desk) top\b(?! (?:drawer|shelf|board|level|rack))", r"\1top", text
    )
    text = re.sub(r"\bnothing but\b", "only", text)
    text = re.sub(r"\bnothing (?:more|besides)\b", "nothing else", text)
    text = _ALL_NAMED.sub(lambda said: f"{said[1]}{said[2]} {said['both'] or ''} ", text)
    text = _MAY_GO.sub(r"\1\2 should go", text)
    text = re.sub(r", say,? (?=(?:to|in|on|next|beside|near|behind)\b)", " ", text)
    text = re.sub(r"(?<=\w) please(?=, )", "", text)
    text = re.sub(rf"\bwhichever ([\w ]+?) is (?={_SO_NOW})", r"the only \1 that is ", text)
    text = re.sub(rf"\bwhichever ([\w ]+?) are (?={_SO_NOW})", r"all the \1 that are ", text)
    text = re.sub(
        r"\b((?:that|which) (?:is|are) (?:in|on)) there(?: (?:now|already))?\b", r"\1 it", text
    )
    text = re.sub(
        rf"\b((?:that|which) (?:is|are)) inside(?= (?:and|then)\b| {_WHERE}|[,.;!?]|$)",
        r"\1 in it",
        text,
    )
    text = re.sub(r"\bback (?=(?:(?:in|on) )?there\b)", "", text)
    text = re.sub(rf"(^|[.!?;,]\s*|\band )({_DOING}) (?:also|please) (?={_NAMED})", r"\1\2 ", text)
    text = re.sub(r"\b(left|right) from (?=(?:the|my|that|this|it)\b)", r"\1 of ", text)
    text = re.sub(
        r"(^|[.!?;]\s*)would be (?=(?:good|nice|great|lovely) to have\b)", r"\1it would be ", text
    )
    text = _without_padding(text)
    text = re.sub(r"\b(?:in|inside)(?: there)? (?=(?:next to|beside|alongside) )", "", text)
    text = re.sub(rf"\b(over|down|up) (?:here|there) (?={_WHERE})", r"\1 ", text)
    text = re.sub(r"\bback down (?=(?:on|onto)\b)", "down ", text)
    text = re.sub(rf"(\brather [^.;]*?) than (?:just )?{_LYING}(?=[.,;!?]|$)", r"\1", text)
    text = re.sub(r"(?<=\w) yet(?= (?:in|on|to|into|onto|and|go|goes)\b|[,.;]|$)", "", text)
    text = re.sub(rf"\b((?:that|which) (?:is|are) ){_ABOUT}", r"\1loose", text)
    text = re.sub(rf"(?<!is )(?<!are )\b{_ABOUT}", "that are loose", text)
    text = _ALL_DONE.sub(r"\1 all of that \2 \3", text)
    text = re.sub(r", (?:all|everything) (?:but|except(?: for)?) ", ", except ", text)
    text = re.sub(r"\b(out of|from|off) there\b", r"\1 it", text)
    text = re.sub(
        r"\b(is|are) (in|on|at) the wrong (?!(?:one|place|spot|side)\b)", r"\1 \2 the ", text
    )
    text = re.sub(r"\b((?:not|except|without) (?:\w+ ){1,4})(?:itself|themselves)\b", r"\1", text)
    text = re.sub(
        r"(?:^|(?<=[.!?;]\s))(?:(?:do|can) you )?see (?=the |that |those )([^.!?;]*)\?",
        r"look at \1,",
        text,
    )
    text = re.sub(r"\bonly (put|place|move|take|pick up) (?=the |a )", r"\1 just ", text)
    text = re.sub(
        r"\bonly (open|close|shut) ([^.,;]*?) (after|once|when)\b", r"\1 \2 only \3", text
    )
    text = _NOTHING_ELSE.sub(r"\1 \2, and nothing else", text)
    text = re.sub(r",\s*(?:please\s*,|right (?=at\b))", ", ", text)
    text = re.sub(rf"\b({'|'.join(CATEGORIES)}) (?:items|things|products|articles)\b", r"\1", text)
    # "A piece of fruit" is one, "the pieces of fruit" are all; "the piece" would be one of them.
    pieces = r"(?:(?<!the )(?:piece|item|article)|pieces|items|articles) of"
    text = re.sub(rf"\b{pieces} (?=(?:{'|'.join(CATEGORIES)})\b)", "", text)
    text = re.sub(rf"\b([a-z])[{_HYPHENS}](?=[a-z]{{3}})", r"\1", text)  # "t-shirt", "x-ray"
    text = re.sub(rf"(?<=\w)[{_HYPHENS}](?=\w)|/(?=\w)", " ", text)
    text = re.sub(r"&", " and ", text)
    text = re.sub(r"[-=]+>|\N{RIGHTWARDS ARROW}", " to ", text)
    text = _BRACKETED.sub(_qualified, text)
    text = re.sub(r"\s+[-\N{EN DASH}\N{EM DASH}]+\s+|[()\[\]]", " , ", text)
    text = text.replace(":", " : ")
    text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    return _counted(re.sub(r"[^\S\n]+", " ", text).strip())


_PADDING = (
    (r"\bwith the (\w+s) still in it\b", r"with the \1 that are in it in it"),
    (r"\bhidden (?=(?:in|inside|behind) )", ""),
    (r"\bstacked (?:on|upon)(?: top of)? (?:each other|one another)\b", "stacked"),
    (r"\bone (?:beside|next to) the other\b", "next to each other"),
    (r"\b(should|must|has to|have to) still (?=(?:be|stay|remain|stand|lie)\b)", r"\1 "),
    # What alone "needs to go" there says nothing of what is there.
    (
        r"(^|[.;,] )only ((?:the|my) [^.,;]*?) (?:needs? to|has to|have to|should|must) go "
        r"(?=(?:in|on|into|onto|to)\b)",
        r"\1put just \2 ",
    ),
    (
        r"(,?)(?: and)? (?:once|when|as soon as) (?:it is|they are) "
        r"(?:there|in there|inside|in place),? "
        rf"(?=(?:please )?(?:{_DOING})\b)",
        r"\1 then ",
    ),
    (r"\bno ((?:\w+ )?\w+) left (?=(?:in|on) )", r"no \1 "),
    (r"(\bnot (?:in|on|inside) [^.;,]*?) any ?(?:more|longer)\b", r"\1"),
    (r"\bup (?=with\b)", ""),
    (r"(^|[.;,] )only then (?=\w)", r"\1then "),
    (
        r"\bthe (middle|left|right|\w+most|\w+est|first|second|third|last) (\w+) of the "
        r"(two|three|four|five)\b(?! \w+s\b)",
        r"the \1 of the \3 \2s",
    ),
    (r"\b(mrs?|ms|dr)\. ", r"\1 "),
    (
        r"\b(?:(?:my|our|the) )?(?:gran(?:ny|dma|dpa|d)?|grand(?:mother|father)|mum|mom|dad|sister|"
        r"brother|mother|father|wife|husband|teacher|nurse|guest|boss) 's (?=\w+)",
        "my ",
    ),
    (r"\b(is|are) (open|closed|shut) again(?=,| and|[.;])", r"\1 \2"),
    (
        r"\b(?:everything|anything|all things|the things) (?:(?:that )?(?:you|one|i|we) can "
        r"write with|(?:that|which) writes|(?:that is )?for writing)\b",
        "all the writing utensils",
    ),
    (
        r"(^|[.;,] )((?:i |we )?need (?:the|my|our|a) [^,.;]*?), (?:it is|they are) "
        r"((?:in|on|next to|beside|behind) [^,.;]*)(?=[,.;])",
        r"\1\2 that is \3",
    ),
    # "The mug off the tray, the glass on" it, "take the mug out of the box and put the cup in"
    (
        r"\b(off|out of) ((?:the|my|our) (?:\w+ ){0,2}?\w+?)((?: first)?(?:,? and|,)(?: then)?) "
        r"((?:(?:put|place) )?[^.,;]*?) (on|in)(?=[,.;!?]| and\b|$)",
        lambda said: _in_turn(said),
    ),
    # What stands beside a place and says nothing of it: "back out of", "there on the table"
    (r"\bback (?=(?:out of|off) )", ""),
    (r"\bup(?: there)? (?=in its place\b)", ""),
    (r"\b(?:up|down|over) there, (?=(?:on|in|next to) )", ""),
    (
        r"(?<!in )(?<!on )(?<!is )(?<!are )(?<!from )(?<!of )\b(?:here|there) "
        r"(?=(?:on|in) (?:the|my|our)\b)",
        "",
    ),
    (
        r"\b(?:to|in|on|at) (?:a|some) (?:spot|place|position|location) "
        r"(?=(?:between|next to|beside|near|behind|in front of|on|in|(?:to the )?(?:left|right) of)"
        r"\b)",
        "",
    ),
    (
        r"(^|[.;,] )((?:just |please )*(?:open|close|shut) [^.;,]*?) over there(?=[.;,!?]|$)",
        r"\1\2",
    ),
    (r"\b(first|second|third|fourth) (drawer|shelf|board|level) down\b", r"\1 \2 from the top"),
    (
        r"(?<!is )(?<!are )(?<!was )(?<!were )\balready (?=(?:in|on|inside) (?:the|my|it|there)\b)",
        "",
    ),
    (r", (?:you choose|i do not (?:care|mind)|it does not matter) which(?: one)?(?=[,.;!?]|$)", ""),
    (
        r"\b((?:belongs?|goes|go|lives?) [^.;]*?), (?:so |and |please )*put (?:it|them) away"
        r"(?=[.;!?]|$)",
        r"\1",
    ),
    # "Everything in the box or in the bin" is everything in either.
    (
        r"\b(everything|all) (?:(?:that|which) is )?(in|on|from) ((?:the|my) (?:\w+ ){0,2}\w+) "
        r"(?:and|or) (in|on|from) (?=(?:the|my)\b)",
        r"\1 \2 \3 and everything \4 ",
    ),
    (rf"\bthe (?:piece|item) of (?=(?:{'|'.join(CATEGORIES)})\b)", "the 1 "),
)


def _in_turn(said: re.Match[str]) -> str:
    """What goes "on" where something else went "off" of, or "in" where it went "out of"."""
    away, where, joint, other, back = said.groups()
    if {"lid", "cover", "cap"} & {*other.split()}:
        return said[0]  # it goes on what was taken
    place = {("off", "on"): f"on {where}", ("out of", "in"): f"in {where}"}.get((away, back), back)
    return f"{away} {where}{joint} {other} {place}"


def _without_padding(text: str) -> str:
    for said, plain in _PADDING:
        text = re.sub(said, plain, text)
    return text


def _without_uh(found: re.Match[str]) -> str:
    """Words without what fills a gap between them, where nothing may be put right by it (as in "the
    apple, er, banana").
    """
    before, after = found["before"].casefold(), found["after"].casefold()
    waits = before in ("the", "in", "on", "to") or after in _GOES_ON
    told = is_descriptive(before) and is_descriptive(after)
    return (
        f"{found['before']} {found['after']}" if waits or not (found["comma"] or told) else found[0]
    )


def _counted(text: str) -> str:
    """With numbers for "the biggest …, the next biggest …" of one sort of things."""
    for size in re.findall(r"\bnext (\w+est)\b", text):
        first, *more = text.split(f" next {size}")
        if size in SIZES and len(re.findall(rf"\b{size}\b", text)) == len(more) + 1 < 5 + 1:
            numbered = zip(("second", "third", "fourth", "fifth"), more, strict=False)
            text = first + "".join(f" {number} {size}{rest}" for number, rest in numbered)
    return text


def _qualified(found: re.Match[str]) -> str:
    """A word in brackets behind a noun as what tells which it is ("the cup (red)")."""
    noun, word = found.groups()
    if word in LEVELS:
        return f"{word} {noun}"
    if word in SIDES:
        return f"{noun} {'on' if word in ('left', 'right') else 'at'} the {word}"
    return f"{noun} that is {word}" if is_descriptive(word) else found[0]


_COUNTED_OFF = re.compile(rf"(^|[.!?;\n]\s*)({'|'.join(NUMBERS)}), (?=[a-z])")
"""The number of a step, in words ("One, open the drawer. Two, …")."""


def _listed(text: str) -> str:
    """A list in one row ("1. open it 2. fill it", "step 1: …", "* …") as lines."""
    if bullet := re.match(rf"{_LIST_HEAD}([{_BULLETS}]\s)", text):
        return re.sub(rf"(^|[\s,;.]){re.escape(bullet[1])}", r"\1\n ", text[bullet.start(1) :])
    numbers = [f"(?:{number}|{name})" for name, number in NUMBERS.items()]
    text = _COUNTED_OFF.sub(lambda said: f"{said[1]}{NUMBERS[said[2]]}. ", text)
    for labels in (numbers, "abcdefgh"):
        items: list[str] = []
        rest = text
        for label in labels:
            mark = rf"(?:\(?{label}[.)]|step {label}\b[.):,]?(?: [{_BULLETS}])?)\s+(?=[a-z])"
            begun = r"(?:^|[.:;,\n]\s*(?:and |then )*)" if items else _LIST_HEAD
            found = re.search(f"{begun}{mark}", rest)
            found = found or (re.search(rf"\s{mark}", rest) if items else None)
            if found is None:
                break
            items, rest = [*items, rest[: found.start()]], rest[found.end() :]
        if len(items) > 1:
            return "\n ".join((*items[1:], rest))
    return text


_DID = re.compile(
    rf"\b(if you )({'|'.join(PAST)})\b|((?:,|\band|\bthen) )({'|'.join(PAST)})(?= (?:up|out|off|it|"
    r"them|him|her|the|this|that|these|those|my|your|our|a|an|both|all|every|everything|each)\b)"
)
_WISHED = re.compile(r"\bwould (?:be|appreciate|like|love|prefer)\b[^.;:!?\n]*? if you [^.;:!?\n]*")


def _as_asked(wish: re.Match[str]) -> str:
    """What is wished for in the past tense ("it would be nice if you took it and closed …")."""
    asked = _DID.sub(lambda said: f"{said[1] or said[3]}{PAST[said[2] or said[4]]}", wish[0])
    return re.sub(r"\bif you (?!(?:would|could|can|will)\b)", "if you would ", asked)


_PAIR = re.compile(r"(?:\w+ ){0,2}\w+, (?:\w+ ){0,2}\w+")


def _paired(parts: list[str]) -> list[str]:
    """With a colon between things and their places, where several sentences are such pairs ("green
    book, basket. Blue book, shelf"); one alone may be a list of two things.
    """
    pairs = [
        part
        for part in parts
        if _PAIR.fullmatch(part) and not GRAMMAR_WORDS & {*part.replace(",", "").split()}
    ]
    return [part.replace(",", ":") if pairs[1:] and part in pairs else part for part in parts]


_LOOK_FOR = re.compile(rf"\b(?:{'|'.join(spellings(small_words.LOOK_FOR))}) [^,]*$")
_AHEAD = frozenset({*spellings(small_words.FRAMES), "please", "now", "first", "then"})


def _is_looked_for(part: str) -> bool:
    """Whether all that a sentence asks for is to find something ("please find the cup")."""
    return any(_are_frames(part[: found.start()]) for found in _LOOK_FOR.finditer(part))


def _are_frames(text: str) -> bool:
    """Whether words are what may stand before a request, and nothing else."""
    words = text.replace(",", "").split()
    ends = {0}
    for at in range(len(words)):
        if at in ends:
            ends |= {n for n in range(at + 1, len(words) + 1) if " ".join(words[at:n]) in _AHEAD}
    return len(words) in ends


def sentences_of(text: str) -> list[str]:
    """The sentences of normalized text, without numbering."""
    plain = re.sub(r"\?", f" {QUESTION}?", _NUMBERING.sub(r"\1", text))
    parts = _paired([" ".join(part.split()).strip(" ,") for part in _SENTENCE_END.split(plain)])
    found: list[str] = []
    for part in parts:
        if found and _is_looked_for(found[-1]):
            # What is looked for, and what is to be done with it.
            found[-1] = f"{found[-1].removesuffix(QUESTION).strip()}, {part}"
        elif part.removesuffix(QUESTION).strip(" ,:"):
            found.append(part)
    return found


def words_in(sentence: str) -> tuple[str, ...]:
    """Words and commas of a normalized sentence."""
    found: list[str] = []
    marked = sentence.replace(",", f" {COMMA} ").replace(":", f" {COLON} ")
    for item in marked.split():
        if item in (COMMA, COLON) and found[-1:] in ([COMMA], [COLON], []):
            continue
        found.append(item)
    while found[-1:] in ([COMMA], [COLON]):
        found.pop()
    return tuple(found)


def spaced(words: Sequence[str]) -> str:
    """Words as a person writes them."""
    return (
        " ".join(words)
        .replace(f" {COMMA}", ",")
        .replace(f" {COLON}", ":")
        .removeprefix(f"{COMMA} ")
        .removeprefix(f"{COLON} ")
        .replace(f" {QUESTION}", "")
        .replace(" 's", "'s")
        .replace("_", " ")
    )
