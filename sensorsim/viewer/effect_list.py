"""The effects as the window lists them: what is asked for of each, and what of that needs a new bake."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from sensorsim.effects import EFFECTS, SURFACE, EffectChoice, Ledger
from sensorsim.render import World
from sensorsim.viewer.state import Place

WORDS = ("as all", "on", "off")  # what can be asked for of one effect: what holds for all, or a word of its own
MEANING: Mapping[str, str] = {effect.name: effect.meaning for effect in EFFECTS}
_BAKED = frozenset(effect.name for effect in EFFECTS if effect.stage == SURFACE)


@dataclass(frozen=True, slots=True, kw_only=True)
class EffectLine:
    """One line of the list."""

    name: str
    word: str  # asked for, one of WORDS
    on: bool
    bound: str  # of what leaving it out changes, with its unit
    hint: str  # what it is, why it is on or off, and whether another choice bakes


def effect_lines(ledger: Ledger, choice: EffectChoice) -> tuple[EffectLine, ...]:
    """All effects that a picture's ledger tells of."""
    return tuple(
        EffectLine(
            name=row.effect,
            word=word_of(choice, row.effect),
            on=row.on,
            bound=f"{row.bound:.3g} {row.unit}",
            hint=f"{MEANING[row.effect]}\n{row.reason}\n"
            + ("of the walls: another choice bakes" if row.effect in _BAKED else "of each picture: no bake"),
        )
        for row in ledger.rows
    )


def word_of(choice: EffectChoice, name: str) -> str:
    """What is asked for of an effect."""
    return "on" if name in choice.wanted else "off" if name in choice.refused else "as all"


def with_word(choice: EffectChoice, name: str, word: str) -> EffectChoice:
    """The choice with another word for one effect."""
    return replace(
        choice,
        wanted=choice.wanted - {name} | ({name} if word == "on" else set()),
        refused=choice.refused - {name} | ({name} if word == "off" else set()),
    )


def baked_choice(choice: EffectChoice) -> EffectChoice:
    """What of it a bake has to know: a world serves sensors of both kinds, so words on pictures come later."""
    return replace(choice, wanted=choice.wanted & _BAKED, refused=choice.refused & _BAKED)


def same_bake(first: Place, second: Place) -> bool:
    """Whether the tables of the one serve the other."""
    return replace(first, choice=baked_choice(first.choice)) == replace(second, choice=baked_choice(second.choice))


def with_choice(world: World, choice: EffectChoice) -> World:
    """The world with the words on pictures of this choice; those on walls stay as they were baked."""
    own = baked_choice(world.choice)
    return replace(
        world,
        choice=replace(own, wanted=own.wanted | choice.wanted - _BAKED, refused=own.refused | choice.refused - _BAKED),
    )
