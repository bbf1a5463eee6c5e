"""Whether an instruction is in another language than English, told by its small words."""

from __future__ import annotations

import re

from etot_cli.reasoning.language.words.known import all_words

_SMALL_WORDS = {
    "German": "der die das den dem ein eine einen und in auf auf den nimm lege stelle öffne "
    "schließe bitte die schale tasse mit nicht neben links rechts schublade tu leg stell mach",
    "French": "le la les un une des et dans sur mets mettez pose prends ouvre ouvrez ferme fermez "
    "le tiroir s'il vous plaît dans avec à gauche droite du au",
    "Spanish": "el la los las un una y en sobre pon ponga coloca toma abre cierra cajón por favor "
    "con de izquierda derecha del dentro taza manzana recoge",
    "Italian": "il lo la gli le un una e nel nella sul sulla metti prendi apri chiudi cassetto per "
    "favore con di sinistra destra dentro",
    "Portuguese": "o a os as um uma e no na sobre coloque ponha pegue abra feche gaveta por favor "
    "com de esquerda direita dentro",
    "Dutch": "de het een en in op leg zet pak open sluit lade alsjeblieft met naast links rechts "
    "doe",
    "Polish": "na do i połóż postaw weź otwórz zamknij szufladę proszę z obok",
    "Turkish": "ve bir koy al aç kapat lütfen üzerine içine çekmeceyi",
}
"""A few words that requests in these languages have, those that English has too left out below."""
_SCRIPTS = (
    ("Chinese or Japanese", "\u3040", "\u9fff"),
    ("Korean", "\uac00", "\ud7af"),
    ("a language in Cyrillic letters", "\u0400", "\u04ff"),
    ("Arabic", "\u0600", "\u06ff"),
    ("Hebrew", "\u0590", "\u05ff"),
    ("Greek", "\u0370", "\u03ff"),
    ("Hindi", "\u0900", "\u097f"),
)
SHARE = 0.4
"""Share of an instruction's words that have to be a language's small words."""


def other_language(instruction: str, named: frozenset[str]) -> str | None:
    """The language that an instruction seems to be in, None for English or no guess.

    Args:
        instruction: as it was given.
        named: words that the scene's things are called by, whatever language these are in.
    """
    letters = [letter for letter in instruction if letter.isalpha()]
    for name, first, last in _SCRIPTS:
        if sum(first <= letter <= last for letter in letters) * 2 > len(letters) > 0:
            return name
    known = all_words() | named
    words = re.findall(r"[^\W\d_]+(?:'[^\W\d_]+)?", instruction.casefold())
    if not words:
        return None
    best, most = None, 0
    for name, small in _SMALL_WORDS.items():
        own = set(small.split())
        strange = [word for word in words if word in own and word not in known]
        if (
            strange
            and len(strange) > most
            and sum(word in own for word in words) >= SHARE * len(words)
        ):
            best, most = name, len(strange)
    return best
