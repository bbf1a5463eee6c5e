"""An instruction's text as the grammar reads it: lower case, one spelling, one way of speaking."""

from __future__ import annotations

import re
from functools import lru_cache

from etot_cli.reasoning.language.grammar.paraphrasing.paraphrases import in_plain_words
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.known import VERB_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    NUMBERS,
    SIDES,
    SIZES,
    is_descriptive,
    word_set,
)

_LINE = r"(?<![,\n])(?<!\band)(?<!\bthen)(?<!\bto)\s*\n\s*"
_NEW_LINE = Expression(rf"{_LINE}(?=[A-Z]|(?:{'|'.join(VERB_WORDS)})\b)")
"""Where a new line is a new sentence; elsewhere it is but wrapped."""
_TERSE_LINE = Expression(_LINE)
"""The same in a text without any article, which is no prose."""
_ARTICLE = Expression(r"\b(?:the|an?|my|your|this|that|these|those|it|them)\b", re.IGNORECASE)
_LIST_HEAD = (
    r"^(?:(?:(?:please|\w+ you) )*(?:to )?(?:do|follow)?"
    r"(?: the following| these| this)? ?(?:steps|things)?"
    r" ?(?:in (?:this |the following )?order)?:\s*)?"
)
_UH = Expression(
    r"(?P<before>\w+)(?P<comma>,?)\s+(?:uh+m?|um+|erm*|hm+)(?:,|\.\.+)?\s+(?P<after>\w+)",
    re.IGNORECASE,
)
_BEGUN = Expression(
    r"\b(in|on|into|onto|to|by|at|under|behind|beside|between|near|next|from|with|the|an?"
    r"|my)\b(?: (?:the|an?|my)\b)?(?:,?\s+(?:uh+m?|um+|erm*|hm+)\b(?:,|\.\.+)?|(?<=the)(?:,|\.\.+))"
    r"\s+(?=\1\b)",
    re.IGNORECASE,
)
"""What is broken off and begun again ("on the, erm, on the right side")."""
_I_MEAN = Expression(
    r"(?<!\bit)(?<!\bthem)\s*[,(]\s*(?:(?:uh+m?|um+|erm*|hm+),?\s+)?((?:the|an?|my)\s+(?!one\b)"
    r"(?:(?!what\b|which\b|that\b|is\b)[\w-]+\s+){1,4}?)(i meant?)(?=\s*(?:[,.!?;)\n]|$))"
)
"""Behind what is said instead ("the apple, er, the banana I mean")."""
_GOES_ON = word_set("in on into onto to and from inside next then")
_RIGHT = Expression(
    r"(^|[.!?;\n]\s*)right(?: then| so)?,\s*"
    rf"(?=(?:{'|'.join(VERB_WORDS)}|please|can|could|would|will|let|now|i|you|we)\b"
    r"|(?!.*\b(?:left|middle|right)\b)(?:(?:the|my|our|an?) )?(?:\w+ ){1,2}"
    r"(?:is|are|comes?|was|were)\b"
    r"|(?!.*\bleft,)(?:(?:the|my|both|all|your|every) )?\w+ (?:\w+ )?"
    r"(?:in|on|into|onto|goes|go|belongs?|has to|needs to|should|must)\b)"
)
_WELL = Expression(
    r"(^|[.!?;\n]\s*)(?:"
    r"(?:yes|yeah|er|erm|uh|ah|hm+|anyway|next up)(?:,\s*| )(?=[a-z])"
    r"|oh,? (?:and|but)(?:,\s*| )(?=[a-z])"
    rf"|(?:step|job|task|work order|ticket|test(?: case)?|trial)(?: no\.?| number)? #?"
    rf"(?:\d{{1,5}}|{'|'.join(NUMBERS)})(?:\s*[:.)]|\s-)\s+)"
)
"""What begins a sentence and says nothing, such as the number of a step or job alone."""
_I_WOULD = Expression(
    r"^\s*(?:(?:robot|plan|answer):\s*)?(?:i (?:would|will|should):\s*)?(?=(?:step )?\(?1\b)",
    re.IGNORECASE,
)
_DONE = Expression(
    r"(?<=\w)\s*[.,;\n]?\s+(?:(?:and|then)\s+)?"
    r"(?:(?P<number>(?:step )?\(?\d{1,2}[.):]\s*)|(?<=[.,;\n] ))(?:done|finish(?:ed)?)[.!]*\s*$",
    re.IGNORECASE,
)
"""How plans begin and end that are told as a robot tells them ("I would: 1. … 2. … 3. done")."""
_BRACKETED = Expression(r"\b([a-z]{2,}) \(([a-z]+)\)")
_BULLETS = "-*\N{BULLET}\N{EN DASH}"
_QUOTES = Expression('["`*\N{LEFT DOUBLE QUOTATION MARK}\N{RIGHT DOUBLE QUOTATION MARK}]')
_ITEMS = Expression(r"(?:[.)]\s|\bstep\b)")
"""Without such signs nothing is listed by numbers or letters."""
_IN_BRACKETS = Expression(
    r"\(([a-h1-8])\) (?=(?:the|an?|my|our|both|all|every|each|no|neither|nothing)\b)"
)
"""The number or letter of one of several things that are told in one sentence ("that (a) the box is
open and (b) …"); no name is followed by an article ("block (a) and block (b)").
"""
_ARTICLE_LEFT_OUT = Expression(
    r"\b(?:(out of) (?=way\b)|((?<!start )(?<!starting )(?:at|by)) (?=end\b)|"
    r"(on) (?=(?:left|right)(?:$|[,.:;!?\n]"
    r"| (?:side|hand|half|end|edge|of|and|in|into|to|onto)\b))|"
    r"(at) (?=(?:front|back|rear|left|right|top|bottom)(?:$|[,.:;!?\n]| (?:of|and|in|into)\b))|"
    r"((?<!\bon )(?<!\bat )(?<!\bthe )near|by|along) (?=(?:left|right|front|back|rear|far)"
    r" (?:edge|border|side|end)\b)|"
    r"(in) (?=(?:middle|cent(?:re|er))(?:$|[,.:;!?\n]| (?:of|and|in|into)\b)))"
)
"""Fixed phrases as they are typed in haste ("out of way", "at end", "on right")."""
_COUNTED_OFF = Expression(rf"(^|[.!?;\n]\s*)({'|'.join(NUMBERS)}), (?=[a-z])")
"""The number of a step, in words ("One, open the drawer. Two, …")."""

_REMEMBERED = 64
"""Texts whose normal form is kept: more than the ways to read one instruction otherwise are."""


@lru_cache(maxsize=_REMEMBERED)
def normalized(text: str) -> str:
    """Lower case, plain quotes, one space between words, clitics apart."""
    text = _I_WOULD.sub("", _DONE.sub(_without_done, text))
    text = _UH.sub(_without_uh, _BEGUN.sub("", text))
    line = _NEW_LINE if _ARTICLE.search(text) else _TERSE_LINE
    text = _listed(line.sub("\n ", text).casefold().strip())
    text = _WELL.sub(r"\1", _RIGHT.sub(r"\1", text))
    text = text.replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
    text = re.sub(r"(?<!\w)'|'(?!\w)(?<!s')", " ", _QUOTES.sub(" ", text))
    text = _ARTICLE_LEFT_OUT.sub(
        lambda said: f"{said[0]}the ", in_plain_words(_I_MEAN.sub(r", \2 \1", text))
    )
    text = _BRACKETED.sub(_qualified, text)
    text = re.sub(r"\s+[-\N{EN DASH}\N{EM DASH}]+\s+|[()\[\]]", " , ", text)
    text = text.replace(":", " : ")
    text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    return _counted(re.sub(r"[^\S\n]+", " ", text).strip())


def _without_done(found: re.Match[str]) -> str:
    """Nothing for "done" behind a request, which tells what has been done behind anything else."""
    asked = re.match(r"\s*(?:please )?(\w+)", found.string)
    begins = asked is not None and asked[1].casefold() in VERB_WORDS
    return "" if found["number"] or begins else found[0]


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


def _listed(text: str) -> str:
    """A list in one row ("1. open it 2. fill it", "step 1: …", "* …") as lines."""
    if bullet := re.match(rf"{_LIST_HEAD}([{_BULLETS}]\s)", text):
        return re.sub(rf"(^|[\s,;.]){re.escape(bullet[1])}", r"\1\n ", text[bullet.start(1) :])
    numbers = [f"(?:{number}|{name})" for name, number in NUMBERS.items()]
    text = _COUNTED_OFF.sub(lambda said: f"{said[1]}{NUMBERS[said[2]]}. ", text)
    for labels in (numbers, "abcdefgh") if _ITEMS.search(text) else ():
        items: list[str] = []
        rest = text
        for label in labels:
            mark = rf"(?:\(?{label}[.)]|step {label}\b[.):,]?(?: [{_BULLETS}])?)\s+(?=[a-z])"
            begun = r"(?:^|[.:;,\n]\s*(?:and |then )*)" if items else _LIST_HEAD
            found = re.search(f"{begun}{mark}", rest)
            found = found or (re.search(rf"(?:,?\s(?:and|then))*\s{mark}", rest) if items else None)
            if found is None:
                break
            items, rest = [*items, rest[: found.start()]], rest[found.end() :]
        if len(items) > 1:
            return "\n ".join((*items[1:], rest))
    marks = [(found.start(), found[1]) for found in _IN_BRACKETS.finditer(text)]
    signs = "".join(sign for _, sign in marks)
    if marks[1:] and ("abcdefgh".startswith(signs) or "12345678".startswith(signs)):
        return _IN_BRACKETS.sub("", text)
    return text
