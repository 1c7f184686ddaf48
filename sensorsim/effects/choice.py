"""What a user asks for: auto, all or none of the effects, single ones on or off, and what auto may change."""

import math
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from sensorsim.effects.catalogue import BY_NAME, SURFACE, Effect
from sensorsim.effects.plan import require_known
from sensorsim.errors import InputError

BASES = ("auto", "all", "none")


@dataclass(frozen=True, slots=True, kw_only=True)
class EffectChoice:
    """`base` holds for all effects that are neither in `wanted` nor in `refused`."""

    base: str = "auto"
    wanted: frozenset[str] = frozenset()
    refused: frozenset[str] = frozenset()
    tolerance: float | None = None  # [K] of all that bounds may leave out; None: by the sensor's noise

    def __post_init__(self) -> None:
        """Refuse unknown words, effects that are wanted and refused at once, and a tolerance that is none."""
        if self.base not in BASES:
            raise InputError("effects", "choice", self.base, "unknown", f"begin with one of {', '.join(BASES)}")
        for name in sorted(self.wanted | self.refused):
            require_known(name)
        for name in sorted(self.wanted & self.refused):
            raise InputError("effects", "choice", f"+{name},-{name}", "on and off at once", "keep one of the two")
        if self.tolerance is not None and not 0.0 <= self.tolerance < math.inf:
            raise InputError("effects", "tolerance", self.tolerance, "not a number from 0 on", "give kelvin: 0.1K")

    def asked(self, name: str) -> bool | None:
        """True or False where the user decides, None where the bounds do."""
        if name in self.wanted or name in self.refused:
            return name in self.wanted
        return {"auto": None, "all": True, "none": False}[self.base]

    @property
    def text(self) -> str:
        """As `read_choice` takes it."""
        signs = [f"+{name}" for name in sorted(self.wanted)] + [f"-{name}" for name in sorted(self.refused)]
        return ",".join((self.base, *signs, *([] if self.tolerance is None else [f"{self.tolerance!r}K"])))

    def with_refused(self, name: str) -> "EffectChoice":
        """The choice with one effect left out as well; InputError where it is wanted."""
        return replace(self, refused=self.refused | {name})

    def with_wanted(self, name: str) -> "EffectChoice":
        """The choice with one effect asked for as well; InputError where it is refused."""
        return replace(self, wanted=self.wanted | {name})

    @property
    def wants_temperature(self) -> bool:
        """Whether surface temperatures are asked for: as such, or by a term of theirs."""
        return self.asked("temperature") is True or any(BY_NAME[name].stage == SURFACE for name in self.wanted)

    def require_inputs(self, *, sky: str, mode: str, parts: Collection[str] | None = None) -> None:
        """Refuse effects asked for by name whose inputs are missing: another sky, kind of sensor, or part of it.

        `parts` of the sensor's chain; None where no sensor is chosen yet.
        """
        for name in sorted(self.wanted - {"temperature"}):
            missing = _missing(BY_NAME[name], sky, mode, BY_NAME if parts is None else parts)
            if missing is not None:
                raise InputError("effects", "choice", f"+{name}", f"its inputs are missing: {missing}", "leave it out")
        if mode != "emissive" and self.tolerance is not None:
            problem = f"its inputs are missing: kelvin need a sensor in an emissive band, this one is {mode}"
            raise InputError("effects", "tolerance", f"{self.tolerance!r}K", problem, "leave it out")
        if mode == "emissive" and "temperature" in self.refused:
            problem = "an emissive sensor sees nothing else"
            raise InputError("effects", "choice", "-temperature", problem, "leave it on, or take a reflective sensor")


def _missing(effect: Effect, sky: str, mode: str, parts: Collection[str]) -> str | None:
    if effect.part and effect.name not in parts:
        return f"needs a sensor whose chain has {effect.name}"
    if effect.sky is not None and effect.sky != sky:
        return f"needs the sky '{effect.sky}', the bake has '{sky}'"
    if effect.mode is not None and effect.mode != mode:
        return f"needs a sensor in an {effect.mode} band, this one is {mode}".replace("an reflective", "a reflective")
    return None


def applicable(effects: Iterable[Effect], *, sky: str, mode: str, parts: Collection[str] = ()) -> tuple[Effect, ...]:
    """The effects whose inputs are there."""
    return tuple(effect for effect in effects if _missing(effect, sky, mode, parts) is None)


def read_choice(text: str) -> EffectChoice:
    """Choice from `auto`, `all`, `none`, `+name,-name` (to `auto`), or `none,+name`; a tolerance as `auto,0.1K`."""
    words = [word.strip() for word in text.split(",")]
    given = [word for word in words if word.endswith("K")]
    words = [word for word in words if word not in given] or ["auto"]
    base = "auto" if words[0][:1] in ("+", "-") else words.pop(0)
    if base in BY_NAME:
        raise InputError("command line", "--effects", text, f"'{base}' has no sign", f"write +{base} or -{base}")
    for word in words:
        if word[:1] not in ("+", "-"):
            remedy = f"write {', '.join(BASES)}, +name, -name or a tolerance in K, with commas between"
            raise InputError("command line", "--effects", text, f"'{word}' has no sign", remedy)
    wanted = frozenset(word[1:] for word in words if word[0] == "+")
    refused = frozenset(word[1:] for word in words if word[0] == "-")
    return EffectChoice(base=base, wanted=wanted, refused=refused, tolerance=_kelvin(text, given))


def _kelvin(text: str, given: list[str]) -> float | None:
    """Tolerance [K] of one word or none."""
    if not given:
        return None
    try:
        (value,) = (float(word.removesuffix("K")) for word in given)
    except ValueError as error:
        problem = "not one number in kelvin"
        raise InputError("command line", "--effects", text, problem, "write for example auto,0.1K") from error
    return value
