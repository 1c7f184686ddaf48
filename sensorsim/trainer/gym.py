"""A gymnasium environment: a camera that is flown over a scene, and what its sensor shows (extra `trainer`).

    gymnasium.make("sensorsim.trainer.gym:sensorsim/Hospital-v0")

Action: forward, right and up speed and yaw, pitch and roll rate, each from -1 to 1 of the fastest. Observation:
`image`, apparent temperature in hundredths of a kelvin of a thermal sensor, display codes of others; `pose`, east,
north, up of the scene's origin [m] and yaw, pitch, roll [deg]. Reward: cosine of the angle between where the camera
looks and the scene's target. An episode ends where the camera leaves the bounds of the pose.
"""

from datetime import datetime
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import read_weather
from sensorsim.render import Camera, Picture, Renderer, World, build_world, station_camera
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.tables import preset as bake_preset
from sensorsim.trainer.delivery import pixels_of

FASTEST = np.array([30.0, 30.0, 30.0, 45.0, 45.0, 45.0])  # [m s-1], [deg s-1]
REACH, LOWEST, HIGHEST = 5000.0, 2.0, 3000.0  # [m]: bounds of the pose
SCATTER = np.array([20.0, 20.0, 5.0, 5.0, 2.0, 0.0])  # [m], [deg]: of the pose that an episode begins with
ENVIRONMENT = "sensorsim/Hospital-v0"

Observation = dict[str, NDArray[Any]]


class SceneEnvironment(gymnasium.Env[Observation, NDArray[np.float32]]):
    """A camera over a scene. Holds an OpenGL context until it is closed."""

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}  # noqa: RUF012  as gymnasium has it

    def __init__(
        self,
        *,
        scene: str = "hospital",
        level: str = "IIIB",
        sensor: str = "flir",
        at: str = "1976-02-07T14:00",
        size: tuple[int, int] = (160, 120),
        preset: str = "report",
        step_time: float = 0.1,
        render_mode: str | None = None,
        backend: str = "auto",
        world: World | None = None,
        start: Camera | None = None,
        target: tuple[float, float, float] | None = None,
    ) -> None:
        """at: local standard time at which episodes begin; step_time [s]; world and start in place of what is named."""
        moment = datetime.fromisoformat(at)
        self.render_mode, self.step_time = render_mode, step_time
        world = _world(scene, level, moment, preset) if world is None else world
        self._start = station_camera(world.scene, world.scene.cameras[0].name) if start is None else start
        self._target = np.array(_target(world) if target is None else target)
        self._begin = float(moment.hour * 3600 + moment.minute * 60 + moment.second)
        self._renderer = Renderer(world, load_sensor(sensor), size=size, backend=backend)
        self._emissive = self._renderer.band_table is not None
        self._pose, self._time, self._frame = np.zeros(6), self._begin, 0
        self._picture: Picture | None = None
        shape = (size[1], size[0], 1)
        low = np.array([-REACH, -REACH, LOWEST, 0.0, -90.0, -180.0])
        high = np.array([REACH, REACH, HIGHEST, 360.0, 90.0, 180.0])
        image = spaces.Box(0, 65535, shape, np.uint16) if self._emissive else spaces.Box(0, 255, shape, np.uint8)
        parts: Any = {"image": image, "pose": spaces.Box(low, high, dtype=np.float64)}
        self.observation_space = spaces.Dict(parts)  # type: ignore[assignment]  # Dict is invariant in its values
        self.action_space = spaces.Box(-1.0, 1.0, (6,), np.float32)
        self._bounds = low, high

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Back to the start, a little beside it by the seed; option `pose` (6,) sets it instead."""
        super().reset(seed=seed)
        camera, options = self._start, options or {}
        here = np.array([*camera.position, camera.yaw % 360.0, camera.pitch, camera.roll])
        here = here + SCATTER * self.np_random.uniform(-1.0, 1.0, 6)
        self._pose = np.clip(np.asarray(options.get("pose", here), dtype=np.float64), *self._bounds)
        self._time, self._frame = self._begin, 0
        return self._observe(), self._info()

    def step(self, action: NDArray[np.float32]) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Moves the camera for one step of time."""
        move = np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0) * FASTEST * self.step_time
        forward, right, up = self._camera().axes()
        pose = self._pose.copy()
        pose[:3] += move[0] * forward + move[1] * right + move[2] * up
        pose[3:] += move[3:]
        pose[3] %= 360.0
        pose[4] = np.clip(pose[4], -90.0, 90.0)
        pose[5] = (pose[5] + 180.0) % 360.0 - 180.0
        self._pose = np.clip(pose, *self._bounds)
        left = bool(np.any(self._pose[:3] != pose[:3]))
        self._time, self._frame = (self._time + self.step_time) % SECONDS_PER_DAY, self._frame + 1
        return self._observe(), self._reward(), left, False, self._info()

    def render(self) -> NDArray[np.uint8] | None:
        """The display as RGB (h, w, 3), in mode rgb_array."""
        if self.render_mode != "rgb_array" or self._picture is None:
            return None
        return np.repeat(self._picture.planes["display"][:, :, None], 3, axis=2)

    def close(self) -> None:
        """Gives back the OpenGL context; a second call does nothing."""
        self._renderer.release()

    def _camera(self) -> Camera:
        field = self._start.horizontal_field_of_view
        yaw, pitch, roll = map(float, self._pose[3:])
        return Camera(position=self._pose[:3].copy(), yaw=yaw, pitch=pitch, roll=roll, horizontal_field_of_view=field)

    def _observe(self) -> Observation:
        self._picture = self._renderer.render(self._camera(), self._time, frame=self._frame)
        image = pixels_of(self._picture.planes, "centikelvin" if self._emissive else "display")
        return {"image": image[:, :, None], "pose": self._pose.copy()}

    def _reward(self) -> float:
        forward, _, _ = self._camera().axes()
        way = self._target - self._pose[:3]
        return float(forward @ way / max(float(np.linalg.norm(way)), 1e-9))

    def _info(self) -> dict[str, Any]:
        return {"time_of_day": self._time}


def _world(scene: str, level: str, moment: datetime, preset: str) -> World:
    place, weather = load_scene(scene, level=level), read_weather(moment.date().isoformat())
    return build_world(place, weather, image_day=moment.date(), settings=bake_preset(preset))


def _target(world: World) -> tuple[float, float, float]:
    """What the scene's first camera looks at [m]."""
    station = world.scene.cameras[0]
    east, north, up = station.target(world.scene.frame)
    return float(east), float(north), float(up)


gymnasium.register(id=ENVIRONMENT, entry_point="sensorsim.trainer.gym:SceneEnvironment", max_episode_steps=1000)
