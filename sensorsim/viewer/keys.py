"""Which key does what: the one table that the window, scripts and the help page go by. Key names as GLFW has them."""

from collections.abc import Collection, Mapping

from sensorsim.viewer.motion import Motion

# Held down: a direction of motion.
HELD: Mapping[str, tuple[str, float]] = {
    "W": ("forward", 1.0),
    "S": ("forward", -1.0),
    "D": ("right", 1.0),
    "A": ("right", -1.0),
    "E": ("up", 1.0),
    "Q": ("up", -1.0),
    "RIGHT": ("yaw", 1.0),
    "LEFT": ("yaw", -1.0),
    "UP": ("pitch", 1.0),
    "DOWN": ("pitch", -1.0),
    "Z": ("zoom", 1.0),
    "X": ("zoom", -1.0),
}
FAST_KEYS = frozenset({"LEFT_SHIFT", "RIGHT_SHIFT"})
SCRUB_KEYS: Mapping[str, float] = {"COMMA": -1.0, "PERIOD": 1.0}  # held down: the hour of the day runs

# Pressed: an action.
PRESSED: Mapping[str, str] = {
    "SPACE": "play",
    "V": "side_by_side",
    "P": "polarity",
    "G": "automatic",
    "L": "tone",
    "LEFT_BRACKET": "gain_down",
    "RIGHT_BRACKET": "gain_up",
    "SEMICOLON": "level_down",
    "APOSTROPHE": "level_up",
    "K": "palette",
    "N": "noise",
    "B": "blur",
    "O": "orbit",
    "C": "station",
    "F": "detail",
    "J": "weather",
    "M": "symbology",
    "I": "probe",
    "TAB": "panels",
    "U": "effects",
    "H": "help",
    "F1": "help",
    "Y": "measure",
    "R": "record",
    "BACKSPACE": "replay",
    "F10": "save_window",
    "F11": "save_planes",
    "F12": "save_picture",
    "ESCAPE": "escape",
    **{str(number): f"sensor_{number}" for number in range(1, 10)},
}

HELP: tuple[tuple[str, tuple[tuple[str, str], ...]], ...] = (
    (
        "Fly",
        (
            ("W A S D", "forward, left, back, right"),
            ("Q E", "down, up"),
            ("drag mouse, arrows", "look around"),
            ("wheel", "speed"),
            ("Shift", "five times as fast"),
            ("Z X, Ctrl + wheel", "narrower, wider field of view"),
            ("O", "circle the middle, or fly again"),
            ("C", "next camera of the scene"),
            ("gamepad", "sticks fly, look; triggers down, up"),
        ),
    ),
    (
        "Time",
        (
            ("comma, period", "hold: earlier, later"),
            ("Space", "let the day run, or stop it"),
            ("J", "next weather day (bakes)"),
        ),
    ),
    (
        "Sensor",
        (
            ("1 to 9", "sensor of that number"),
            ("V", "one picture, or two side by side"),
            ("P", "white-hot or black-hot"),
            ("G", "automatic gain, or hold it"),
            ("[ ]", "less, more gain"),
            ("; '", "level down, up"),
            ("L", "straight or equalised greys"),
            ("K", "false colours"),
            ("N B", "noise, blur on or off"),
        ),
    ),
    (
        "Scene and files",
        (
            ("F", "level of detail (bakes)"),
            ("U", "effects: which are on, and why"),
            ("Y", "measure the error of the fit (probe)"),
            ("R, Backspace", "record the flight, fly it again"),
            ("F12", "picture as PNG with its settings"),
            ("F11", "planes as EXR"),
            ("F10", "this window as PNG"),
            ("I M Tab", "probe, symbols, panels on or off"),
            ("H, Esc, Ctrl + Q", "this page, close it, quit"),
        ),
    ),
)


def motion_of(held: Collection[str]) -> Motion:
    """Motion that the keys held down ask for; opposite keys cancel."""
    asked = dict.fromkeys(("forward", "right", "up", "yaw", "pitch", "zoom"), 0.0)
    for key in held:
        if key in HELD:
            direction, amount = HELD[key]
            asked[direction] += amount
    return Motion(**asked, fast=not FAST_KEYS.isdisjoint(held))


def scrub_of(held: Collection[str]) -> float:
    """-1, 0 or 1: where the keys held down take the hour of the day."""
    return sum(amount for key, amount in SCRUB_KEYS.items() if key in held)


def known_keys() -> frozenset[str]:
    """Names of all keys that do something."""
    return frozenset({*HELD, *FAST_KEYS, *SCRUB_KEYS, *PRESSED})
