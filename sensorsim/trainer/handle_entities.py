"""What the host says of entities: their place, motion, parts and switches."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from sensorsim.errors import InputError
from sensorsim.trainer.fields import Value
from sensorsim.trainer.host_state import Component, Entity, HostState, Part, Query, Rates, Triple
from sensorsim.trainer.motion import PART_AXES, carried_on, part_at
from sensorsim.trainer.settings import Moment

Values = Mapping[str, Value]

DESTROYED = 2
SHORT_AXES = ("xoff", "yoff", "zoff", "yaw", "pitch", "roll")  # of the short packet's choices 1 to 6 [Wireshark4017]
CLAMPS: tuple[Literal["none", "level", "conformal"], ...] = ("none", "level", "conformal")
HIGHEST_LATITUDE, MOST_LONGITUDE = 89.9, 360.0  # [deg]; the map has no north at a pole


def number(values: Values, name: str) -> float:
    """A real value of a packet."""
    return float(values[name])


def whole_number(values: Values, name: str) -> int:
    """A whole value of a packet."""
    return int(values[name])


def flag(values: Values, name: str) -> bool:
    """A bit of a packet."""
    return bool(values[name])


def triple(values: Values, *names: str) -> Triple:
    """Three real values of a packet."""
    first, second, third = (float(values[name]) for name in names)
    return first, second, third


def check_geodetic(packet: str, latitude: float, longitude: float) -> None:
    """InputError for a place that is none."""
    if not (abs(latitude) <= HIGHEST_LATITUDE and abs(longitude) <= MOST_LONGITUDE):
        problem = f"outside +-{HIGHEST_LATITUDE} and +-{MOST_LONGITUDE:g} deg"
        raise InputError(packet, "latitude, longitude", (latitude, longitude), problem, "give degrees")


def entity_control(state: HostState, values: Values, moment: Moment) -> HostState:
    """Entity Control: state, type and, in 3.3, the place; state 2 removes the entity."""
    key = whole_number(values, "entity_id")
    if whole_number(values, "entity_state") == DESTROYED:
        return _destroy(state, key)
    entity = state.entities.get(key)
    if entity is None and len(state.entities) >= moment.settings.most_entities:
        most = moment.settings.most_entities
        raise InputError("entity_control", "entity_id", key, f"more than {most} entities", "destroy some first")
    entity = replace(
        entity or Entity(number=key),
        active=whole_number(values, "entity_state") == 1,
        type_number=whole_number(values, "entity_type"),
        alpha=number(values, "alpha") / 255.0,
        extrapolate=flag(values, "extrapolation_enable"),
    )
    state = replace(state, entities={**state.entities, key: entity})
    return entity_position(state, values, moment) if "lat_xoff" in values else state


def entity_position(state: HostState, values: Values, moment: Moment) -> HostState:
    """The place of an entity that is known: geodetic, or against its parent when it is attached to one."""
    key = whole_number(values, "entity_id")
    entity = _known(state, "entity_control", key)
    parent = whole_number(values, "parent_id") if flag(values, "attach_state") else None
    place = triple(values, "lat_xoff", "lon_yoff", "alt_zoff")
    if parent is None:
        check_geodetic("entity_control", place[0], place[1])
    elif _above(state, parent, key):
        raise InputError("entity_control", "parent_id", parent, f"hangs from entity {key} itself", "break the circle")
    moved = replace(
        entity,
        parent=parent,
        place=place,
        angles=triple(values, "yaw", "pitch", "roll"),
        since=moment.time,
        clamp=CLAMPS[whole_number(values, "ground_ocean_clamp")],
    )
    return replace(state, entities={**state.entities, key: moved})


def rate_control(state: HostState, values: Values, moment: Moment) -> HostState:
    """Rate Control of an entity, or of one of its parts."""
    key = whole_number(values, "entity_id")
    entity = _known(state, "rate_control", key)
    rates = Rates(
        linear=triple(values, "x_rate", "y_rate", "z_rate"),
        angular=triple(values, "roll_rate", "pitch_rate", "yaw_rate"),
        axes="body" if flag(values, "coordinate_system") else "world",
    )
    if flag(values, "apply_to_part"):
        part_key = whole_number(values, "part_id")
        part = replace(_part_now(state, entity, part_key, moment), rates=rates)
        return _with_part(state, entity, part_key, part)
    if state.extrapolate and entity.extrapolate:
        entity = carried_on(entity, moment.time)
    return replace(state, entities={**state.entities, key: replace(entity, rates=rates)})


def articulated_part(state: HostState, values: Values, moment: Moment) -> HostState:
    """Articulated Part Control: the axes enabled take new values, the others keep theirs."""
    entity = _known(state, "art_part_control", whole_number(values, "entity_id"))
    key = whole_number(values, "part_id")
    part = _part_now(state, entity, key, moment)
    said = {axis: number(values, axis) for axis in PART_AXES if flag(values, f"{axis}_enable")}
    part = replace(part, enabled=flag(values, "part_enable"), values={**part.values, **said})
    return _with_part(state, entity, key, part)


def short_articulated_part(state: HostState, values: Values, moment: Moment) -> HostState:
    """Short Articulated Part Control: one axis each of two parts, which may be the same; axis 0 is none."""
    for which in ("1", "2"):
        entity = _known(state, "short_art_part_control", whole_number(values, "entity_id"))
        axis = whole_number(values, f"dof_select_{which}")
        if axis == 0:
            continue
        key = whole_number(values, f"part_id_{which}")
        part = _part_now(state, entity, key, moment)
        said = {SHORT_AXES[axis - 1]: number(values, f"dof_{which}")}
        part = replace(part, enabled=flag(values, f"part_enable_{which}"), values={**part.values, **said})
        state = _with_part(state, entity, key, part)
    return state


def component_control(state: HostState, values: Values, moment: Moment) -> HostState:
    """Component Control, short or long: the switch's state and its words."""
    names = ("component_class", "instance_id", "component_id")
    first, second, third = (whole_number(values, name) for name in names)
    key = (first, second, third)
    if key not in state.components and len(state.components) >= moment.settings.most_components:
        most = moment.settings.most_components
        raise InputError("component_control", "component_id", third, f"more than {most} components", "use fewer")
    words = tuple(whole_number(values, name) for name in sorted(values) if name.startswith("data_"))
    switched = Component(state=whole_number(values, "component_state"), words=words)
    return replace(state, components={**state.components, key: switched})


def _destroy(state: HostState, key: int) -> HostState:
    """Without the entity, all that hangs from it, and the questions asked about any of them."""
    gone = {number for number in state.entities if _above(state, number, key)}
    kept = {number: entity for number, entity in state.entities.items() if number not in gone}
    queries = {name: query for name, query in state.queries.items() if not gone & _asked_of(query)}
    return replace(state, entities=kept, queries=queries)


def _asked_of(query: Query) -> set[int]:
    """Entities in whose axes a question gives or wants places."""
    values = query.values
    switches = ("coordinate_system", "source_coord", "response_coord", "destination_coord")
    own = {whole_number(values, "entity_id")} if any(values.get(switch) for switch in switches) else set()
    return own | (
        {whole_number(values, "destination_entity_id")} if values.get("destination_entity_id_valid") else set()
    )


def _above(state: HostState, key: int | None, ancestor: int) -> bool:
    """Whether the entity is `ancestor`, or hangs from it."""
    while key is not None and key != ancestor:
        entity = state.entities.get(key)
        key = entity.parent if entity else None
    return key == ancestor


def _known(state: HostState, packet: str, key: int) -> Entity:
    if key not in state.entities:
        raise InputError(packet, "entity_id", key, "no such entity", "send its Entity Control first")
    return state.entities[key]


def _part_now(state: HostState, entity: Entity, key: int, moment: Moment) -> Part:
    """The part as its rates have brought it here, or a new one."""
    part = entity.parts.get(key, Part())
    moving = state.extrapolate and entity.extrapolate
    return replace(part_at(part, moment.time) if moving else part, since=moment.time)


def _with_part(state: HostState, entity: Entity, key: int, part: Part) -> HostState:
    changed = replace(entity, parts={**entity.parts, key: part})
    return replace(state, entities={**state.entities, entity.number: changed})
