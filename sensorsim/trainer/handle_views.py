"""What the host says of pictures: where they look from, their field, and the sensor that makes them."""

from collections.abc import Mapping
from dataclasses import replace

from sensorsim.errors import InputError
from sensorsim.trainer.fields import Value
from sensorsim.trainer.handle_entities import flag, number, whole_number
from sensorsim.trainer.host_state import HostState, SensorState, View
from sensorsim.trainer.settings import ImageSettings, Moment

Values = Mapping[str, Value]

WIDEST_HALF_ANGLE = 85.0  # [deg]; a plane picture grows with its tangent
TRACK_MODES = ("off", "force correlate", "scene", "target", "ship")


def view_control(state: HostState, values: Values, moment: Moment) -> HostState:
    """View Control: entity, offsets and angles of one view, or of every view of a group."""
    views = _addressed(state, values, moment, "view_control")
    return replace(state, views={**state.views, **{view.number: _placed(view, values) for view in views}})


def view_definition(state: HostState, values: Values, moment: Moment) -> HostState:
    """View Definition: group, half-angles, distances and type; what is not enabled keeps its value."""
    view = _view(state, whole_number(values, "view_id"), moment, "view_def")
    if flag(values, "projection_type"):
        raise InputError("view_def", "projection_type", 1, "orthographic", "sensors see in perspective: send 0")
    said = {
        name: number(values, name)
        for name in ("near", "far", "left", "right", "top", "bottom")
        if flag(values, f"{name}_enable")
    }
    sides = _signed(view, said, moment.settings)
    view = replace(
        view,
        group=whole_number(values, "group_id"),
        view_type=whole_number(values, "view_type"),
        mirror=whole_number(values, "mirror_mode"),
        left=sides["left"],
        right=sides["right"],
        bottom=sides["bottom"],
        top=sides["top"],
        near=said.get("near", view.near),
        far=said.get("far", view.far),
    )
    _check_volume(view)
    return replace(state, views={**state.views, view.number: view})


def sensor_control(state: HostState, values: Values, moment: Moment) -> HostState:
    """Sensor Control of one sensor of a view."""
    view, sensor = whole_number(values, "view_id"), whole_number(values, "sensor_id")
    known = (view, sensor) in state.sensors
    if not known and sum(1 for key in state.sensors if key[0] == view) >= moment.settings.most_views:
        raise InputError("sensor_control", "sensor_id", sensor, "too many sensors in one view", "use fewer")
    seen = _view(state, view, moment, "sensor_control")
    control = SensorState(
        view=view,
        sensor=sensor,
        on=flag(values, "sensor_on_off"),
        black_hot=flag(values, "polarity"),
        line_dropout=flag(values, "line_dropout_enable"),
        auto_gain=flag(values, "auto_gain"),
        gain=number(values, "gain"),
        level=number(values, "level"),
        ac_coupling=number(values, "ac_coupling"),
        noise=number(values, "noise"),
        track_mode=TRACK_MODES[whole_number(values, "track_mode")],  # type: ignore[arg-type]
        track_black=flag(values, "track_white_black"),
        extended_response=flag(values, "response_type"),
    )
    sensors = {**state.sensors, (view, sensor): control}
    return replace(state, sensors=sensors, views={**state.views, view: seen})


def _addressed(state: HostState, values: Values, moment: Moment, packet: str) -> list[View]:
    group = whole_number(values, "group_id")
    if group == 0:
        return [_view(state, whole_number(values, "view_id"), moment, packet)]
    views = [view for view in state.views.values() if view.group == group]
    if not views:
        raise InputError(packet, "group_id", group, "no view is in it", "send View Definitions with that group first")
    return views


def _view(state: HostState, key: int, moment: Moment, packet: str) -> View:
    """The view of that number; the first word about one makes it."""
    if key not in state.views and len(state.views) >= moment.settings.most_views:
        most = moment.settings.most_views
        raise InputError(packet, "view_id", key, f"more than {most} views", "use fewer views")
    return state.views.get(key, View(number=key))


def _placed(view: View, values: Values) -> View:
    """The view with the offsets and angles that are enabled."""

    def chosen(names: tuple[str, str, str], before: tuple[float, float, float]) -> tuple[float, float, float]:
        a, b, c = (
            number(values, name) if flag(values, f"{name}_enable") else old
            for name, old in zip(names, before, strict=True)
        )
        return a, b, c

    return replace(
        view,
        entity=whole_number(values, "entity_id"),
        offset=chosen(("xoff", "yoff", "zoff"), view.offset),
        angles=chosen(("yaw", "pitch", "roll"), view.angles),
    )


def _signed(view: View, said: dict[str, float], settings: ImageSettings) -> dict[str, float]:
    """Half-angles with left and bottom negative; a pair that would enclose nothing was meant as magnitudes."""
    before = {"left": view.left, "right": view.right, "bottom": view.bottom, "top": view.top}
    sides = {side: said.get(side, angle) for side, angle in before.items()}
    for low, high in (("left", "right"), ("bottom", "top")):
        if settings.half_angles == "magnitude" or sides[low] >= sides[high]:
            sides[low], sides[high] = -abs(sides[low]), abs(sides[high])
    return sides


def _check_volume(view: View) -> None:
    sides = (view.left, view.right, view.bottom, view.top)
    if max(abs(side) for side in sides) > WIDEST_HALF_ANGLE or view.left >= view.right or view.bottom >= view.top:
        problem = f"encloses nothing, or is beyond {WIDEST_HALF_ANGLE:g} deg"
        raise InputError("view_def", "left, right, bottom, top", sides, problem, "give half-angles in degrees")
    if not 0.0 < view.near < view.far:
        raise InputError("view_def", "near, far", (view.near, view.far), "not 0 < near < far", "give metres")
