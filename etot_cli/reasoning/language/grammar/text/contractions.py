"""Contractions written out, also as people type them who leave apostrophes out."""

from __future__ import annotations

_STATES = (
    r"(?:going|on|in|inside|over|too|not|now|still|already|less|more|so|much)\b"
    r"|\w+(?:ed|en)(?: (?:up|out|off))?(?: (?:and|so)\b|[,.;:]|$)"
    r"|(?:open|closed|shut|ajar|empty|full|dirty|clean|ready|broken|fine|dead|done|over|blunt|dull"
    r"|sharp|hot|cold|wet|dry|hungry|tired|late|early|loose|heavy|asleep|awake|ill|sick|busy|here"
    r"|back|gone|ripe|rotten|useless|noisy|sticky|fragile|slippery|out|off)"
    r"(?: (?:and|so|but|where|afterwards|again|when|once|as well|too|(?:at|in) the end)\b"
    r"| -|[,.;:!]|$)"
)
"""What "the door's" is followed by where it is no possessive."""
_OBJECT = "(?:the|my|our|his|her|their|it|them|some|an?|him|us|me)"
"""What somebody's deed is done to; no name of a thing goes before it."""
CONTRACTIONS = (
    # As people type who leave apostrophes out; "its" and "ill" are words of their own.
    (r"\b(that|there|what|where|who)s\b", r"\1's"),
    (r"\b(?:u|ya)\b", "you"),
    (
        r"\b((?:the|my|all|both)(?: (?!and\b|or\b)\w+){1,2}|everything|all|anything)"
        r" what (?=(?:is|are)\b)",
        r"\1 that ",
    ),
    (
        r"(?<!\bis )(?<!\bare )\bfor (?:me|us) "
        r"(?=(?:out|off|from|on|in|into|onto|to|the|both|all)\b"
        r"|and (?!(?:my|our|your|his|her|their|him|them|you)\b))",
        "",
    ),
    (r"\bi\.e\b\.?,?", "that is"),
    (r"\bgimme\b", "give me"),
    (r"\bwon't\b", "will not"),
    (
        r"(?<=\w)'s(?= (?:already |just )?(?:been|gone|fallen|got|come|run out|rolled|slipped)\b)",
        " has",
    ),
    (
        r"(?<=\w)'s(?= (?:(?:always|just|only|still|never|already) )*"
        r"(?:always|never|getting|looking|coming|leaving|arriving|visiting|waiting|having)\b)",
        " is",
    ),
    (r"\b((?:no|some|every)(?:body| ?one))'s(?= \w+ing\b)", r"\1 is"),
    (rf"(?<=\w)'s(?= \w+ing {_OBJECT}\b)", " is"),
    (
        r"(?<=\w)(?<!\blet)'s(?= (?:brought|taken|left|put|made|forgotten|broken|lost|bought)"
        rf" {_OBJECT}\b)",
        " has",
    ),
    (r"\b(that|which|it|there|here|what|who|he|she)'s\b", r"\1 is"),
    (r"\blet's\b", "let us"),
    (r"\b(?:don't|dont)\b", "do not"),
    (r"\bdoesn't\b", "does not"),
    (r"\b(is|are|was|were|has|have|did|should|must|would|could|need)n't\b", r"\1 not"),
    (r"\b(?:can't|cannot)\b", "can not"),
    (r"'d(?= (?:better|best)\b)", " had"),
    (r"\b(i|it|that|we|you|they)'d\b", r"\1 would"),
    (r"\bi'm\b", "i am"),
    (r"(?<=\w)'ll\b", " will"),
    (r"\b(i|you|we|they)'ve\b", r"\1 have"),
    (r"\b(you|we|they)'re\b", r"\1 are"),
    (rf"(?<=\w)'s(?= (?:{_STATES}))", " is"),
    (
        r"\b(?!that one\b)((?:the|that|this) (?:\w+ )?\w+)'s "
        r"(?=(?:mine|ours|hers|theirs|\w+'s)(?: and\b|[.,;:!?]|$))",
        r"\1 is ",
    ),
    (r"(?<=\w)'s\b", " 's"),
    (r"(?<=s)'(?=\s)", " 's"),
)
