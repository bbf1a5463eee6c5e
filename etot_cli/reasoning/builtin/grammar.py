"""The grammar of the controlled English, as Lark reads it; ``docs/instructions.md`` shows it.

It is written for an Earley parser, which finds every reading of an ambiguous sentence ("the ball in
the cup on the chest"); the scene decides between them. Nouns are any words that are no function
words, so the grammar knows no object.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache
from typing import TYPE_CHECKING

from etot_cli.reasoning.builtin.terminals import FUNCTION_WORDS, TERMINALS, VERBS

if TYPE_CHECKING:
    from lark import Lark

_RULES = r"""
start: LEAD* seq (COMMA? ADVERB)* COMMA?

seq: clause                              -> first
   | seq JOINT LEAD* clause              -> then
   | seq SO_THAT states                  -> result
   | seq AFTER clause                    -> after
   | AFTER clause COMMA LEAD* seq        -> in_order
   | BEFORE clause COMMA LEAD* seq       -> after

?clause: pick | put | remove | move | ensure | reorient

pick: (poses COMMA?)? ADVERB* PICK things (UP source?)? (COMMA? poses)? ADVERB*
put: ADVERB* PUT put_group (_list_sep put_group)* extra*
   | ADVERB* BRING bring_group (_list_sep bring_group)* extra*
   | ADVERB* DROP things ADVERB*                         -> put_down
   | ADVERB* PUT things DOWN ADVERB*                     -> put_down
put_group: things (DOWN | UPRIGHT | AWAY)? COMMA? destinations
bring_group: things destinations_to -> put_group
remove: ADVERB* REMOVE things source? ADVERB*
      | ADVERB* BRING things (OUT | source) ADVERB*
      | ADVERB* EMPTY things ADVERB*                     -> empty
source: SOURCE np
move: ADVERB* OPEN things ADVERB*                        -> open
    | ADVERB* PULL things OPEN_ADJ ADVERB*               -> open
    | ADVERB* CLOSE things ADVERB*                       -> close
    | ADVERB* PULL things CLOSED_ADJ ADVERB*             -> close
ensure: ADVERB* ENSURE states ADVERB*
      | ADVERB* LEAVE np adjective ADVERB*               -> leave
      | np_list MODAL predicate ADVERB*                  -> should
reorient: ADVERB* REORIENT things UPRIGHT? ADVERB*
        | ADVERB* TURN things UPRIGHT ADVERB*

things: np_list | EITHER? np (OR np)+ -> either
np_list: BOTH? np (_list_sep np)*
_list_sep: AND | COMMA AND?

destinations: EITHER? destination (OR destination)*
destination: INTO targets   -> into
           | ONTO targets   -> onto
           | TO targets     -> to
           | HERE           -> here
destinations_to: EITHER? destination_to (OR destination_to)* -> destinations
destination_to: INTO_DIR targets -> into
              | ONTO_DIR targets -> onto
              | TO targets       -> to
targets: EITHER? np ((COMMA | COMMA? OR) np)*

extra: COMMA? (grouping | condition | ADVERB | SO_THAT_POSE)
?grouping: ANYHOW | TOGETHER | SEPARATELY
condition: WITH state_without_verb
state_without_verb: np_list predicate -> state

states: state ((AND | COMMA AND?) state)*
state: np_list BE predicate
predicate: adjective | EITHER? destination (OR destination)*
?adjective: OPEN_ADJ | CLOSED_ADJ

poses: EITHER? pose ((COMMA | COMMA? OR) pose)*
pose: HORIZONTAL | VERTICAL

np: DET? words modifier*            -> noun
  | DET modifier*                   -> bare
  | DET? words POSSESSIVE words modifier* -> owned
  | PRONOUN modifier*               -> pronoun
  | DET PRONOUN                     -> of_pronoun
words: WORD+

modifier: RELATIVE? prep np                      -> related
        | RELATIVE? BETWEEN np AND np            -> between
        | RELATIVE? SIDE                         -> side
        | RELATIVE adjective                     -> state_of
        | RELATIVE STATE                         -> state_of
        | (WITH | RELATIVE? CONTAINING) np       -> containing
        | WITH np (HERE | INTO PRONOUN)          -> containing
        | WITH np ONTO PRONOUN                   -> bearing
!prep: P_ON | P_IN | P_FROM | P_OF | P_NEAR | P_LEFT | P_RIGHT | P_BEHIND | P_FRONT | P_UNDER
     | P_ABOVE | P_NEAREST | P_FARTHEST

COMMA: ","
%ignore /\s+/
"""


def parser(vocabulary: frozenset[str]) -> Lark:
    """The parser for scenes with these object words.

    Args:
        vocabulary: words of the scene's names and labels, lower case.
    """
    return _parser(frozenset(word for word in vocabulary if word in VERBS or word.endswith("ly")))


@lru_cache(maxsize=8)
def _parser(vocabulary: frozenset[str]) -> Lark:
    """The parser that takes these verbs and adverbs for nouns as well; hardly any scene has one."""
    from lark import Lark

    stop = FUNCTION_WORDS | (VERBS - vocabulary)
    adverb = rf"(?!(?:{_alternatives(vocabulary) or '0'})\b)\w+ly"
    word = rf"(?!(?:{_alternatives(stop)}|{adverb})\b)[^\W_]\w*(?:\.\w+)?"
    terminals = {**TERMINALS, "WORD": word}
    lines = [f"{name}: /{_bounded(name, pattern)}/" for name, pattern in terminals.items()]
    return Lark(
        _RULES + "\n".join(lines),
        parser="earley",
        lexer="dynamic",
        ambiguity="explicit",
        propagate_positions=True,
    )


def _bounded(name: str, pattern: str) -> str:
    """A pattern that ends at a word's end, commas aside."""
    return rf"(?:{pattern})(?!\w)" if name != "WORD" else pattern


def _alternatives(words: Iterable[str]) -> str:
    return "|".join(re.escape(word) for word in sorted(words))
