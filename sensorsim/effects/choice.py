"""What a user asks for: auto, all or none of the effects, and single ones on or off."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass

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

    def __post_init__(self) -> None:
        """Refuse unknown words, and effects that are wanted and refused at once."""
        if self.base not in BASES:
            raise InputError("effects", "choice", self.base, "unknown", f"begin with one of {', '.join(BASES)}")
        for name in sorted(self.wanted | self.refused):
            require_known(name)
        for name in sorted(self.wanted & self.refused):
            raise InputError("effects", "choice", f"+{name},-{name}", "on and off at once", "keep one of the two")

    def asked(self, name: str) -> bool | None:
        """True or False where the user decides, None where the bounds do."""
        if name in self.wanted or name in self.refused:
            return name in self.wanted
        return {"auto": None, "all": True, "none": False}[self.base]

    @property
    def text(self) -> str:
        """As `read_choice` takes it."""
        signs = [f"+{name}" for name in sorted(self.wanted)] + [f"-{name}" for name in sorted(self.refused)]
        return ",".join((self.base, *signs))

    def with_refused(self, name: str) -> "EffectChoice":
        """The choice with one effect left out as well; InputError where it is wanted."""
        return EffectChoice(base=self.base, wanted=self.wanted, refused=self.refused | {name})

    def with_wanted(self, name: str) -> "EffectChoice":
        """The choice with one effect asked for as well; InputError where it is refused."""
        return EffectChoice(base=self.base, wanted=self.wanted | {name}, refused=self.refused)

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
    """Choice from `auto`, `all`, `none`, `+name,-name` (to `auto`), or `none,+name`."""
    words = [word.strip() for word in text.split(",")]
    base = "auto" if words[0][:1] in ("+", "-") else words.pop(0)
    for word in words:
        if word[:1] not in ("+", "-"):
            remedy = f"write {', '.join(BASES)}, +name or -name, with commas between"
            raise InputError("command line", "--effects", text, f"'{word}' has no sign", remedy)
    wanted = frozenset(word[1:] for word in words if word[0] == "+")
    refused = frozenset(word[1:] for word in words if word[0] == "-")
    return EffectChoice(base=base, wanted=wanted, refused=refused)
