"""What can go wrong, as a tree.

SensorsimError
├── InputError       a file, entry or option that cannot be honoured; says which, its value and the remedy
├── GraphicsError    no OpenGL context, or a shader or uniform that does not fit
└── NumericsError    a computation that left its domain (NaN, infinity, no convergence)
"""


class SensorsimError(Exception):
    """Base of all errors that this package raises on purpose."""


class InputError(SensorsimError):
    """Input that cannot be honoured, told in one line: where, which entry, its value, what is wrong, the remedy."""

    def __init__(self, where: object, entry: str, value: object, problem: str, remedy: str) -> None:
        text = repr(value)
        shown = text if len(text) <= 60 else text[:57] + "..."
        super().__init__(f"{where}: {entry} = {shown}: {problem}; {remedy}")
        self.where, self.entry, self.value, self.problem, self.remedy = str(where), entry, value, problem, remedy


class GraphicsError(SensorsimError):
    """No usable OpenGL context, or a shader, block or texture that does not fit."""


class NumericsError(SensorsimError):
    """A computation left its domain: NaN, infinity or no convergence."""
