"""Past tenses, participles and gerunds of verbs, from the patterns that they are listed in.

A pattern says how its verb takes an ending ("grab[bing]", "mov(e|ing)"), which is how it takes that
of the past, too; verbs of other forms are told one by one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

_VERB = re.compile(r"\b(?P<stem>[a-z]+)(?:\[(?P<doubled>[a-z]?)ing\]|\((?P<e>e)\|ing\))")
_IRREGULAR = {
    "bring": ("brought", "brought"), "break": ("broke", "broken"), "build": ("built", "built"),
    "deal": ("dealt", "dealt"), "dig": ("dug", "dug"), "find": ("found", "found"),
    "get": ("got", "got"), "give": ("gave", "given"), "hide": ("hid", "hidden"),
    "hold": ("held", "held"), "keep": ("kept", "kept"), "lay": ("laid", "laid"),
    "leave": ("left", "left"), "make": ("made", "made"), "put": ("put", "put"),
    "rid": ("rid", "rid"), "set": ("set", "set"), "shut": ("shut", "shut"),
    "sit": ("sat", "sat"), "slide": ("slid", "slid"), "sling": ("slung", "slung"),
    "split": ("split", "split"), "spread": ("spread", "spread"), "stand": ("stood", "stood"),
    "stick": ("stuck", "stuck"), "swing": ("swung", "swung"), "take": ("took", "taken"),
    "throw": ("threw", "thrown"), "withdraw": ("withdrew", "withdrawn"),
}  # fmt: skip
"""Verbs with their past tense and participle."""


def _inflected(patterns: str) -> Iterator[tuple[str, str, str]]:
    """Each verb of patterns with its past tense and its participle."""
    for found in _VERB.finditer(patterns):
        stem, doubled, e = found["stem"], found["doubled"] or "", found["e"] or ""
        soft = stem.endswith("y") and stem[-2:-1] not in (*"aeiou",)
        regular = (
            f"{stem[:-1]}ied" if soft else f"{stem}{doubled}{'d' if stem[-1] == 'e' else 'ed'}"
        )
        yield (stem + e, *_IRREGULAR.get(stem + e, (regular, regular)))


def past_tenses(*patterns: str) -> dict[str, str]:
    """Verbs by their past tense, without those that have none of their own ("put")."""
    every = (item for each in patterns for item in _inflected(each))
    return {past: verb for verb, past, _ in every if past != verb}


def participles(patterns: str) -> tuple[str, ...]:
    """What has been done, of each verb of patterns."""
    return tuple(dict.fromkeys(done for _, _, done in _inflected(patterns)))


def gerunds(*patterns: str) -> dict[str, str]:
    """Verbs by what somebody does who is at it ("moving")."""
    found = (item for each in patterns for item in _VERB.finditer(each))
    return {
        f"{verb['stem']}{verb['doubled'] or ''}ing": f"{verb['stem']}{verb['e'] or ''}"
        for verb in found
    }
