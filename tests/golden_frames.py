"""Golden frames: small float pictures that the software rasteriser made, how they are made, compared and replaced.

Run as a program it makes them anew: see tools/regenerate_goldens.
"""

import hashlib
import json
import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from datetime import date
from functools import lru_cache
from pathlib import Path
from typing import Any

import imageio.v3 as imageio
import numpy as np
from numpy.typing import NDArray

from sensorsim import BakeSettings, Renderer, World, build_world, load_scene, load_sensor, preset, read_weather
from sensorsim.gpu import context_info
from sensorsim.render import station_camera

FOLDER = Path(__file__).resolve().parent / "golden"
MANIFEST = "manifest.json"
COMMAND = "tools/regenerate_goldens"
RASTERISER = "llvmpipe"  # Mesa's software rasteriser; others place some edges a pixel apart
SIZE = (128, 96)
TEMPERATURE_TOLERANCE = 5e-3  # [K]
RADIANCE_TOLERANCE = 1e-4  # [-] of the reference
PIXELS = 0.9975  # share that has to be within the tolerance
AMPLIFIED = 10.0  # a difference of this many tolerances is white

SETTINGS = {
    "icosphere42": BakeSettings(orientations="icosphere42", step=600.0, slice_interval=1800.0),
    "report": preset("report"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Golden:
    """One frame: scene, weather and bake, sensor, camera and hour of the day."""

    name: str
    level: str
    weather: str
    day: str
    bake: str
    sensor: str
    camera: str
    hour: float

    @property
    def plane(self) -> str:
        return "apparent_temperature" if self.sensor == "flir" else "radiance"


def _golden(world: tuple[str, str, str, str], sensor: str, camera: str, hour: float) -> Golden:
    level, weather, day, bake = world
    name = f"{sensor}_{level}_{weather}_{camera}_{round(hour * 100):04d}"
    return Golden(name=name, level=level, weather=weather, day=day, bake=bake, sensor=sensor, camera=camera, hour=hour)


_FINE = ("IIIB", "winter", "1976-02-07", "icosphere42")
_MIDDLE = ("IIA", "fall", "1976-10-07", "report")
GOLDENS = (
    _golden(_FINE, "flir", "tower", 10.0),
    _golden(_FINE, "flir", "hospital", 17.0),
    _golden(_FINE, "lltv", "tower", 10.0),
    _golden(_FINE, "lltv", "cement_plant", 16.0),
    _golden(_MIDDLE, "flir", "tower", 13.3),  # between two slices of the tables
    _golden(_MIDDLE, "lltv", "overhead", 6.0),  # twilight
)


@lru_cache(maxsize=4)
def _world(level: str, weather: str, day: str, bake: str) -> World:
    scene = load_scene("hospital", level=level)
    return build_world(scene, read_weather(weather), image_day=date.fromisoformat(day), settings=SETTINGS[bake])


def draw(golden: Golden) -> tuple[NDArray[np.float32], str]:
    """The frame's plane (height, width) and the name of the renderer that drew it."""
    world = _world(golden.level, golden.weather, golden.day, golden.bake)
    with Renderer(world, load_sensor(golden.sensor), size=SIZE) as renderer:
        picture = renderer.render(station_camera(world.scene, golden.camera), golden.hour * 3600.0)
        return picture.planes[golden.plane].astype(np.float32), str(context_info(renderer.ctx)["renderer"])


def read_golden(name: str, folder: Path = FOLDER) -> NDArray[np.float32]:
    with np.load(folder / f"{name}.npz", allow_pickle=False) as stored:
        return np.asarray(stored["plane"])


def read_manifest(folder: Path = FOLDER) -> dict[str, Any]:
    content: dict[str, Any] = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    return content


def inputs(golden: Golden) -> dict[str, Any]:
    """All that the frame is made from, as plain values."""
    bake = SETTINGS[golden.bake].to_dict()
    chosen = {"scene": "hospital", "size": list(SIZE), "plane": golden.plane, **asdict(golden), "bake": bake}
    plain: dict[str, Any] = json.loads(json.dumps(chosen))
    return plain


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def error_in_tolerances(result: NDArray[np.float32], reference: NDArray[np.float32], plane: str) -> NDArray[np.float64]:
    """Difference of every pixel over what is allowed there."""
    difference = result.astype(np.float64) - reference.astype(np.float64)
    if plane == "apparent_temperature":
        return np.asarray(np.abs(difference) / TEMPERATURE_TOLERANCE)
    return np.asarray(np.abs(difference) / (RADIANCE_TOLERANCE * np.abs(reference.astype(np.float64))))


def fault(golden: Golden, result: NDArray[np.float32], reference: NDArray[np.float32], folder: Path) -> str | None:
    """What is wrong with a result, after writing it, the reference and their amplified difference to `folder`."""
    if result.shape != reference.shape:
        return f"{golden.name}: {result.shape} for {reference.shape}; if it is meant to be so, run {COMMAND}"
    error = error_in_tolerances(result, reference, golden.plane)
    share = float(np.mean(error <= 1.0))
    if share >= PIXELS:
        return None
    written = ", ".join(str(path) for path in _write_evidence(golden, result, reference, error, folder))
    worst = np.unravel_index(int(np.argmax(error)), error.shape)
    return (
        f"{golden.name}: {share:.4%} of the pixels are within the tolerance, {PIXELS:.2%} are asked for; worst "
        f"{result[worst]:.6g} for {reference[worst]:.6g} at row {worst[0]}, column {worst[1]}\n"
        f"see {written}\nif the change is meant, run {COMMAND}"
    )


def _write_evidence(
    golden: Golden,
    result: NDArray[np.float32],
    reference: NDArray[np.float32],
    error: NDArray[np.float64],
    folder: Path,
) -> Iterator[Path]:
    low, high = float(reference.min()), float(reference.max())
    scale = max(high - low, 1e-30)
    folder.mkdir(parents=True, exist_ok=True)
    pictures = {
        "result": np.clip((result - low) / scale, 0.0, 1.0),
        "reference": (reference - low) / scale,
        "difference": np.clip(error / AMPLIFIED, 0.0, 1.0),
    }
    for kind, picture in pictures.items():
        path = folder / f"{golden.name}_{kind}.png"
        imageio.imwrite(path, np.round(255.0 * picture).astype(np.uint8))
        yield path
    path = folder / f"{golden.name}_result.npz"
    np.savez_compressed(path, plane=result)
    yield path


def regenerate(folder: Path) -> list[Path]:
    """Draw all frames into `folder`, with their manifest; refuses any renderer but the software rasteriser."""
    folder.mkdir(parents=True, exist_ok=True)
    frames, written, name_of_renderer = {}, [], ""
    for golden in GOLDENS:
        plane, name_of_renderer = draw(golden)
        if RASTERISER not in name_of_renderer:
            sys.exit(f"drawn by {name_of_renderer}; goldens are made by {RASTERISER}: set LIBGL_ALWAYS_SOFTWARE=1")
        path = folder / f"{golden.name}.npz"
        np.savez_compressed(path, plane=plane)
        frames[golden.name] = {"inputs": inputs(golden), "sha256": sha256(path)}
        written.append(path)
    for stray in sorted(set(folder.glob("*.npz")) - set(written)):
        stray.unlink()
    manifest = {"command": COMMAND, "renderer": name_of_renderer, "frames": frames}
    (folder / MANIFEST).write_text(json.dumps(manifest, indent=2) + "\n", encoding="utf-8")
    return [*written, folder / MANIFEST]


if __name__ == "__main__":
    for made in regenerate(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER):
        print(made)
