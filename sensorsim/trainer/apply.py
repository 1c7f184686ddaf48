"""A message applied to what is known: whole or not at all, packet by packet, with a word on each that was refused."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeAlias

from sensorsim.errors import InputError
from sensorsim.trainer.decode import Message
from sensorsim.trainer.fields import Value
from sensorsim.trainer.handle_entities import (
    articulated_part,
    check_geodetic,
    component_control,
    entity_control,
    entity_position,
    number,
    rate_control,
    short_articulated_part,
    whole_number,
)
from sensorsim.trainer.handle_environment import atmosphere, celestial_sphere, weather
from sensorsim.trainer.handle_views import sensor_control, view_control, view_definition
from sensorsim.trainer.host_state import Clock, HostState, Query, QueryKind
from sensorsim.trainer.settings import ImageSettings, Moment

Handler: TypeAlias = Callable[[HostState, Mapping[str, Value], Moment], HostState]

STANDBY, OPERATE, DEBUG, MAINTENANCE = range(4)


def initial_state(settings: ImageSettings, time: float = 0.0) -> HostState:
    """What holds before the host has said anything, and again after every standby."""
    clock = Clock(moment=settings.start, since=time)
    return HostState(clock=clock, views={view.number: view for view in settings.views})


def apply_message(state: HostState, message: Message, moment: Moment) -> tuple[HostState, tuple[str, ...]]:
    """The new state and what was refused. A message that is unsound, or not a host's, changes nothing.

    In standby all packets but IG Control are ignored, and entering it resets all that the host has said.
    """
    if not message.sound or not message.packets:
        return state, message.faults
    first = message.packets[0]
    if first.name != "ig_control":
        return state, (
            *message.faults,
            f"a message that begins with {first.name} is not a host's",
        )
    faults = list(message.faults)
    state = _ig_control(state, first.values, moment)
    for packet in message.packets[1:] if state.mode != STANDBY else ():
        handler = HANDLERS.get(packet.name)
        if handler is None:
            faults.append(f"{packet.name}: not acted upon")
            continue
        try:
            state = handler(state, packet.values, moment)
        except InputError as refusal:
            faults.append(str(refusal))
    return state, tuple(faults)


def _ig_control(state: HostState, values: Mapping[str, Value], moment: Moment) -> HostState:
    mode = whole_number(values, "ig_mode")
    if mode == STANDBY and state.mode != STANDBY:
        state = initial_state(moment.settings, moment.time)
    return replace(
        state,
        mode=mode,
        database=whole_number(values, "db_number") if mode != STANDBY else 0,
        host_frame=whole_number(values, "host_frame_number"),
        last_image_frame=whole_number(values, "last_ig_frame_number"),
        extrapolate=bool(values["extrapolation_enable"]),
    )


def _query(kind: QueryKind, key_name: str) -> Handler:
    """Handler that keeps a question until it is answered, or, with a period, until the host takes it back."""

    def ask(state: HostState, values: Mapping[str, Value], moment: Moment) -> HostState:
        key = (kind, whole_number(values, key_name))
        others = {name: query for name, query in state.queries.items() if name != key}
        if len(others) >= moment.settings.most_queries:
            most = moment.settings.most_queries
            raise InputError(kind, key_name, key[1], f"more than {most} questions are open", "ask fewer at a time")
        _check_places(kind, values)
        period = whole_number(values, "update_period")
        asked = Query(kind=kind, number=key[1], values=values, period=period, due=moment.frame)
        return replace(state, queries={**others, key: asked})

    return ask


def _check_places(kind: QueryKind, values: Mapping[str, Value]) -> None:
    """Refuses geodetic places that are none; places in an entity's axes may be any."""
    places = {"coordinate_system": "", "source_coord": "source_", "destination_coord": "destination_"}
    for switch, prefix in places.items():
        if switch in values and not values[switch]:
            check_geodetic(kind, number(values, f"{prefix}lat_xoff"), number(values, f"{prefix}lon_yoff"))


HANDLERS: Mapping[str, Handler] = {
    "entity_control": entity_control,
    "entity_position": entity_position,
    "rate_control": rate_control,
    "art_part_control": articulated_part,
    "short_art_part_control": short_articulated_part,
    "component_control": component_control,
    "short_component_control": component_control,
    "celestial_sphere_control": celestial_sphere,
    "atmosphere_control": atmosphere,
    "weather_control": weather,
    "view_control": view_control,
    "view_def": view_definition,
    "sensor_control": sensor_control,
    "hat_hot_request": _query("hat_hot_request", "hat_hot_id"),
    "los_segment_request": _query("los_segment_request", "los_id"),
    "los_vector_request": _query("los_vector_request", "los_id"),
}
