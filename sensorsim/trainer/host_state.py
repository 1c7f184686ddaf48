"""What the host has said so far, as one frozen value: every message makes a new one of the last."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from typing import Literal, TypeAlias

from sensorsim.trainer.fields import Value

Triple: TypeAlias = tuple[float, float, float]
QueryKind: TypeAlias = Literal["hat_hot_request", "los_segment_request", "los_vector_request"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rates:
    """Steady motion. axes: 'world' is north, east, down (or the parent's axes) and angles as such; 'body' its own."""

    linear: Triple  # [m s-1]
    angular: Triple  # roll, pitch, yaw [deg s-1]
    axes: Literal["world", "body"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """An articulated part: offsets [m] and roll, pitch, yaw [deg] against its rest, as far as they are enabled."""

    enabled: bool = True
    values: Mapping[str, float] = field(default_factory=dict)
    rates: Rates | None = None
    since: float = 0.0  # IG time at which the values were true [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Entity:
    """Something that the host moves. place: latitude, longitude, height, or offsets in the parent's body axes [m]."""

    number: int
    active: bool = True
    type_number: int = 0
    parent: int | None = None
    place: Triple | None = None  # None until the host has said it
    angles: Triple = (0.0, 0.0, 0.0)  # yaw, pitch, roll [deg]
    since: float = 0.0  # IG time at which place and angles were true [s]
    clamp: Literal["none", "level", "conformal"] = "none"
    extrapolate: bool = False
    alpha: float = 1.0
    rates: Rates | None = None
    parts: Mapping[int, Part] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """One picture. Half-angles [deg]: left and bottom negative, right and top positive; distances [m]."""

    number: int
    group: int = 0
    entity: int = 0
    offset: Triple = (0.0, 0.0, 0.0)  # forward, right, down of its entity [m]
    angles: Triple = (0.0, 0.0, 0.0)  # yaw, pitch, roll [deg]
    left: float = -20.0
    right: float = 20.0
    bottom: float = -15.0
    top: float = 15.0
    near: float = 1.0
    far: float = 100000.0
    view_type: int = 0
    mirror: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorState:
    """Sensor Control of one sensor of one view, in its own numbers."""

    view: int
    sensor: int
    on: bool = True
    black_hot: bool = False
    line_dropout: bool = False
    auto_gain: bool = True
    gain: float = 0.5  # 0 to 1, contrast
    level: float = 0.5  # 0 to 1, brightness
    ac_coupling: float = 0.0  # decay constant [us], 0 for none
    noise: float = 0.0  # 0 to 1
    track_mode: Literal["off", "force correlate", "scene", "target", "ship"] = "off"
    track_black: bool = False
    extended_response: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """The host's date and time: `moment` was true at IG time `since` [s]; it runs on unless the host holds it."""

    moment: datetime
    since: float = 0.0
    running: bool = True
    sun: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Air:
    """The global atmosphere as the host wants it, SI; wind_from is where it blows from [deg of true north]."""

    path_model: bool  # True: apparent radiance, through the air; False: source radiance
    relative_humidity: float  # 0 to 1
    temperature: float  # [K]
    visibility: float  # [m]
    wind_speed: float  # [m s-1]
    updraught: float  # [m s-1]
    wind_from: float
    pressure: float  # [Pa]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layer:
    """A weather layer, the same everywhere: fog, a cloud deck, rain or other precipitation."""

    kind: str
    visibility: float  # [m]
    temperature: float  # [K]
    relative_humidity: float  # 0 to 1
    coverage: float  # 0 to 1
    severity: int  # 0 to 5
    base: float  # geodetic height of its lower face [m]
    thickness: float  # [m]
    wind_speed: float  # [m s-1]
    wind_from: float  # [deg]


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """A switch that the host set: its state and the raw words that came with it."""

    state: int
    words: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Query:
    """A question, answered every `period` frames, once where that is 0; `due` is the frame of the next answer."""

    kind: QueryKind
    number: int
    values: Mapping[str, Value]
    period: int
    due: int


@dataclass(frozen=True, slots=True, kw_only=True)
class HostState:
    """All that the host has said. components: by class, instance (entity, view ...) and component."""

    clock: Clock
    mode: int = 0
    database: int = 0  # as last asked for
    host_frame: int = 0
    last_image_frame: int = 0
    extrapolate: bool = False
    entities: Mapping[int, Entity] = field(default_factory=dict)
    views: Mapping[int, View] = field(default_factory=dict)
    sensors: Mapping[tuple[int, int], SensorState] = field(default_factory=dict)
    air: Air | None = None
    layers: Mapping[int, Layer] = field(default_factory=dict)
    components: Mapping[tuple[int, int, int], Component] = field(default_factory=dict)
    queries: Mapping[tuple[QueryKind, int], Query] = field(default_factory=dict)
