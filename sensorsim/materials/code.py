"""The four-digit material word of the report's figure 10: two digits material, two digits percent reflectance."""

import re
from dataclasses import dataclass

from sensorsim.errors import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class MaterialWord:
    """What a surface is made of and how much it reflects, as one word of [Report1978] figure 10 says it."""

    code: int
    reflectance: float  # [-], solar

    @property
    def text(self) -> str:
        """The word itself, four digits."""
        return f"{self.code:02d}{round(100.0 * self.reflectance):02d}"


def parse_word(word: str, *, where: object = "material word") -> MaterialWord:
    """Code and reflectance of a word: '2040' is brick (20) that reflects 0.40 [Report1978].

    The word is a text, since a number would lose the leading zero of '0930'. Whether the code exists is for the
    catalogue to say. Raises InputError, naming `where`, unless the word is four digits.
    """
    if not isinstance(word, str) or re.fullmatch(r"[0-9]{4}", word) is None:
        raise InputError(where, "word", word, "not a text of four digits", "write code and percent, such as '2040'")
    return MaterialWord(code=int(word[:2]), reflectance=int(word[2:]) / 100.0)
