"""Measure the march of the catalogue's walls: surface-steps a second and core, memory floor, compile time.

A surface-step is one surface (one orientation at one reflectance) through one time step. Processor time is counted, so
that a busy machine spoils the figures less; the last row is elapsed time of all walls on the given threads.

    python tools/benchmark_march.py [--orientations icosphere642] [--days 5] [--step 300] [--threads 2] [--json]
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from datetime import date
from pathlib import Path

import numpy as np

from sensorsim.environment import Environment, build_environment, read_weather
from sensorsim.materials import WallType, load_catalogue
from sensorsim.tables.orientations import orientation_set
from sensorsim.thermal import Exposure, build_interior, expose
from sensorsim.thermal.natural import melting_depth, surface_boundary
from sensorsim.thermal.paths import march_paths, wall_paths

ROOT = Path(__file__).resolve().parents[1]
REFLECTANCES = np.array([0.1, 0.3, 0.5, 0.7, 0.9])
SHOWN = {20: "brick", 12: "metal", 25: "concrete", 99: "snow"}  # codes of figure 9 of [Report1978], and snow
SNOW = 99
RECORDED = 900.0  # [s] between slices of the image day
# EnergyPlus 25.2, one core: 225 to 270 surfaces for 38 days in steps of a minute, the sun and zones in it. Measured
# once beside this project, on two cores of a Xeon; not measured here.
PEERS = {"EnergyPlus, transfer functions": 1.10, "EnergyPlus, finite differences": 0.28}  # [M surface-steps/s]
COMPILE = "import time, runpy; runpy.run_path({path!r}, run_name='warm')['warm']()"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--orientations", default="icosphere642")
    parser.add_argument("--days", type=int, default=5)
    parser.add_argument("--step", type=float, default=300.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--json", action="store_true", help="print all figures as JSON")
    options = parser.parse_args()
    found = measure(options.orientations, options.days, options.step, options.threads)
    print(json.dumps(found, indent=1) if options.json else _table(found))


def measure(orientations: str, days: int, step: float, threads: int) -> dict:
    """All figures by name."""
    environment, exposure = _weather(orientation_set(orientations).normal, days, step)
    catalogue = load_catalogue()
    walls = {code: catalogue.wall_type(code, "heated") for code in catalogue.materials}
    warm()
    rows = {name: _measure_wall(environment, exposure, walls[code]) for code, name in SHOWN.items()}
    dry = [wall for code, wall in walls.items() if code != SNOW]
    boundaries = [(wall, *_conditions(environment, exposure, wall)) for wall in dry]
    begin, busy = time.perf_counter(), time.process_time()
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(lambda job: _march(environment, *job), boundaries))
    elapsed, busy = time.perf_counter() - begin, time.process_time() - busy
    steps = sum(_surface_steps(environment, exposure, wall) for wall in dry)
    return {
        "walls": rows,
        "catalogue": {
            "walls": len(dry), "surface_steps": steps, "processor_s": busy, "elapsed_s": elapsed, "threads": threads,
            "rate": steps / busy / 1e6,
        },
        "peers": PEERS,
        "compile_s": _compile_time(),
        "bandwidth": _bandwidth(),
    }  # fmt: skip


def warm() -> None:
    """Compile or load the march of dry and of melting walls."""
    environment, exposure = _weather(np.array([[0.0, 0.0, 1.0]]), 1, 3600.0)
    for code in (20, SNOW):
        wall = load_catalogue().wall_type(code, "heated")
        _march(environment, wall, *_conditions(environment, exposure, wall))


def _weather(normal: np.ndarray, days: int, step: float) -> tuple[Environment, Exposure]:
    environment = build_environment(
        read_weather("winter"), image_day=date(1976, 2, 7), lead_in_days=float(days - 1), step=step
    )
    return environment, expose(environment, normal, environment.air_temperature)


def _conditions(environment: Environment, exposure: Exposure, wall: WallType) -> tuple:
    outside = surface_boundary(environment, exposure, wall)
    air, wind = environment.air_temperature, environment.wind_speed
    return outside, build_interior(wall.interior, air, wind, environment.step, wall.interior_emissivity)


def _march(environment: Environment, wall: WallType, outside: object, inside: object) -> None:
    stride = max(1, round(RECORDED / environment.step))
    record = np.arange(environment.image_window.start, environment.time.size, stride)
    march_paths(
        wall, outside, inside, 1.0 - REFLECTANCES, step=environment.step, record=record,
        melting_depth=melting_depth(wall),
    )  # fmt: skip


def _surface_steps(environment: Environment, exposure: Exposure, wall: WallType) -> int:
    paths = len(wall_paths(wall, environment.step))
    return paths * (environment.time.size - 1) * exposure.normal.shape[0] * REFLECTANCES.size


def _measure_wall(environment: Environment, exposure: Exposure, wall: WallType) -> dict:
    """Best of three of one wall on one core; bytes are boundary values read and states and results moved once."""
    outside, inside = _conditions(environment, exposure, wall)
    spent = []
    for _ in range(3):
        begin = time.thread_time()
        _march(environment, wall, outside, inside)
        spent.append(time.thread_time() - begin)
    steps, cells = _surface_steps(environment, exposure, wall), wall_paths(wall, environment.step)[0].grid.capacity.size
    columns = exposure.normal.shape[0] * REFLECTANCES.size
    moved = sum(values.nbytes for values in outside if isinstance(values, np.ndarray)) + 16.0 * (cells + 8) * columns
    return {"cells": cells, "surface_steps": steps, "processor_s": min(spent), "rate": steps / min(spent) / 1e6,
            "bytes": moved}  # fmt: skip


def _compile_time() -> float:
    """Processor time [s] that a fresh process needs beyond one that finds all compiled."""
    with tempfile.TemporaryDirectory() as cache:
        spent = []
        for _ in range(2):
            before = os.times()
            subprocess.run(
                [sys.executable, "-c", COMPILE.format(path=str(Path(__file__).resolve()))],
                check=True, cwd=ROOT, env=os.environ | {"NUMBA_CACHE_DIR": cache, "PYTHONPATH": str(ROOT)},
            )  # fmt: skip
            after = os.times()
            spent.append(after.children_user - before.children_user)
    return spent[0] - spent[1]


def _bandwidth() -> float:
    """Bytes a second that one core reads and writes in copying 256 MB."""
    source, target, spent = np.ones(2**25), np.zeros(2**25), []
    for _ in range(5):
        begin = time.perf_counter()
        np.copyto(target, source)
        spent.append(time.perf_counter() - begin)
    return 2.0 * source.nbytes / min(spent)


def _table(found: dict) -> str:
    lines = [
        f"{'wall':10} {'cells':>5} {'surface-steps':>14} {'processor s':>12} {'M steps/s/core':>15} {'floor s':>8}"
    ]
    for name, row in found["walls"].items():
        floor = row["bytes"] / found["bandwidth"]
        lines.append(
            f"{name:10} {row['cells']:5d} {row['surface_steps']:14,d} {row['processor_s']:12.3f} {row['rate']:15.2f} "
            f"{floor:8.4f}"
        )
    row = found["catalogue"]
    lines.append(f"{'all dry':10} {'':5} {row['surface_steps']:14,d} {row['processor_s']:12.3f} {row['rate']:15.2f}")
    lines.append(f"{row['walls']} walls on {row['threads']} threads: {row['elapsed_s']:.2f} s elapsed")
    lines += [f"{name}: {rate:.2f} M surface-steps/s on one core" for name, rate in found["peers"].items()]
    lines.append(f"compiling both marches: {found['compile_s']:.1f} s of processor time, once")
    lines.append(f"floor: what has to be moved at least, at {found['bandwidth'] / 1e9:.1f} GB/s as measured")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
