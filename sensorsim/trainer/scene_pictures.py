"""A world drawn for the host: the `PictureSource` that joins the image generator to the renderer.

Each view has a renderer of its own, since a detector may remember the frame before. Walls and surroundings are those of
the last whole second of the host's clock. A new world is taken in whole between two frames.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.errors import SensorsimError
from sensorsim.frames import plane_names
from sensorsim.render import Camera, Illumination, Renderer, World
from sensorsim.render.solids import Solids
from sensorsim.sensor import Sensor
from sensorsim.trainer.background_bake import BackgroundBake, Baked
from sensorsim.trainer.fleet import Fleet
from sensorsim.trainer.frame_request import FrameRequest, ViewRequest
from sensorsim.trainer.host_state import SensorState
from sensorsim.trainer.live_surroundings import live_surroundings
from sensorsim.trainer.sensor_look import look
from sensorsim.trainer.things import Thing, things_asked
from sensorsim.trainer.vehicle_shape import VehicleShape
from sensorsim.trainer.vehicles import built_in_vehicles
from sensorsim.trainer.view_camera import mirrored, view_camera

Planes = Mapping[str, NDArray[Any]]


@dataclass(slots=True, kw_only=True, eq=False)
class _Eye:
    """One view's renderer, and the surroundings it last used with what they were made of."""

    renderer: Renderer
    made_of: object = None
    around: Illumination | None = None


class ScenePictures:
    """Draws what a FrameRequest asks for. Use it in a `with`: it holds OpenGL contexts."""

    def __init__(
        self,
        world: World,
        sensors: Sequence[Sensor],
        size: tuple[int, int],
        *,
        bake: BackgroundBake | None = None,
        on_bake: Callable[[Baked], None] = lambda _: None,
        say: Callable[[str], None] = lambda _: None,
        backend: str = "auto",
        planes: Collection[str] | None = ("display",),
        shapes: Mapping[str, VehicleShape] | None = None,
        heard: Callable[[float], Sequence[Thing]] = lambda _: (),
    ) -> None:
        """sensors: by the number that Sensor Control and view type name them with, from 0; size: of every picture.

        planes: that pictures have besides display, None for all; shapes: of vehicles in place of those built in;
        heard: vehicles that others than the host tell of, at an IG time [s].
        """
        self.world, self.sensors, self.size = world, tuple(sensors), size
        self._bake, self._on_bake, self._say, self._backend = bake, on_bake, say, backend
        self._eyes: dict[tuple[int, int], _Eye] = {}
        self._told: set[str] = set()
        self._planes, self._heard = planes, heard
        self._fleet = Fleet({**built_in_vehicles(), **(shapes or {})})

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()

    def __call__(self, request: FrameRequest) -> dict[int, Planes]:
        """Planes of each view by its number; a view that cannot be drawn is black."""
        self._take_world(request)
        things = [*things_asked(request.entities), *self._heard(request.time)]
        solids = self._fleet.solids(things, request.time, self.world, self._time_of_day(request))
        return {view.number: self._draw(request, view, solids) for view in request.views}

    def release(self) -> None:
        """Gives back the OpenGL contexts."""
        for eye in self._eyes.values():
            eye.renderer.release()
        self._eyes.clear()

    def prepare(self, views: Sequence[int]) -> None:
        """Makes and tries the renderers of views that are about to be drawn, each with the sensor of its number.

        Looks from high above and along the ground meet every kind of surface and the sky, so that all their shaders
        are compiled before the first frame.
        """
        for view in views:
            eye = self._eye(view, view if view < len(self.sensors) else 0, frozenset(views))
            for height, pitch in ((2000.0, -90.0), (50.0, -10.0), (50.0, 30.0)):
                camera = Camera(
                    position=np.array([0.0, 0.0, height]), yaw=0.0, pitch=pitch, horizontal_field_of_view=90.0
                )
                eye.renderer.render(camera, 0.0, planes=self._wanted(eye))

    def _take_world(self, request: FrameRequest) -> None:
        if self._bake is None:
            return
        self._bake.ask(request.bake, request.moment)
        done = self._bake.take()
        if done is None:
            return
        if done.world is not None:
            self.release()
            self.world = done.world
        self._on_bake(done)

    def _time_of_day(self, request: FrameRequest) -> float:
        return float(int(time_of_day(request.moment, self.world.environment.image_start)))

    def _draw(self, request: FrameRequest, view: ViewRequest, solids: Solids | None) -> Planes:
        control, device = self._choice(view)
        if not control.on:
            return self._black()
        try:
            planes = self._look(request, view, control, device, solids)
        except SensorsimError as error:  # the host put the view where there is no picture
            self._tell(f"view {view.number} is black: {error}")
            return self._black()
        return {**planes, "display": mirrored(planes["display"], view.mirror)}

    def _look(
        self, request: FrameRequest, view: ViewRequest, control: SensorState, device: int, solids: Solids | None
    ) -> Planes:
        camera = view_camera(view)
        eye = self._eye(view.number, device, frozenset(one.number for one in request.views))
        time = self._time_of_day(request)
        made_of = (time, request.air, request.sun, view.visibility)
        if eye.around is None or eye.made_of != made_of:
            eye.around = live_surroundings(eye.renderer, time, request, view.visibility)
            eye.made_of = made_of
        return look(
            eye.renderer, camera, time, eye.around, control, request.frame, planes=self._wanted(eye), solids=solids
        )

    def _wanted(self, eye: _Eye) -> tuple[str, ...] | None:
        """Planes asked for, as far as the sensor has them."""
        there = plane_names(eye.renderer.sensor)
        return None if self._planes is None else tuple(name for name in self._planes if name in there)

    def _choice(self, view: ViewRequest) -> tuple[SensorState, int]:
        """The first sensor of a view that is on, and which of ours it is; without a word on any, by the view's type."""
        lit = [sensor for sensor in view.sensors if sensor.on] or list(view.sensors)
        control = lit[0] if lit else SensorState(view=view.number, sensor=view.view_type)
        if control.sensor >= len(self.sensors):
            self._tell(f"view {view.number}: no sensor {control.sensor}, number 0 is shown")
            return control, 0
        return control, control.sensor

    def _eye(self, view: int, device: int, wanted: frozenset[int]) -> _Eye:
        key = (view, device)
        if key not in self._eyes:
            for gone in [other for other in self._eyes if other[0] not in wanted]:
                self._eyes.pop(gone).renderer.release()
            renderer = Renderer(self.world, self.sensors[device], size=self.size, backend=self._backend)
            self._eyes[key] = _Eye(renderer=renderer)
        return self._eyes[key]

    def _black(self) -> Planes:
        return {"display": np.zeros((self.size[1], self.size[0]), dtype=np.uint8)}

    def _tell(self, text: str) -> None:
        """Says a thing once, and no more than some hundred things."""
        if text not in self._told and len(self._told) < 256:
            self._told.add(text)
            self._say(text)


def time_of_day(moment: datetime, midnight: datetime) -> float:
    """Time of the day that is baked [s], of a moment of this day or of any other."""
    return (moment - midnight).total_seconds() % SECONDS_PER_DAY
